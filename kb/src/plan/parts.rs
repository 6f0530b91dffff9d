//! A part in another one as a site: the tables that its file fills, and the way out and back in.

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use adit_db::Cell;
use adit_db::course::Course as Row;
use adit_db::place::Place;
use adit_db::route::{Step, Waypoint};
use adit_planners::channels::PartJunctions;
use adit_planners::channels::assembly::{self as geometry, Cuboid, PartPath};
use adit_planners::planner::Planner;

use super::assembly::Assembly;
use super::consult::Class;
use super::course::{
    Asked as Rules, Course, Found, NoEnd, ObjectsOf, Pathfinder, no_map, no_through, numbered, refuse_gaps,
};
use super::gap::{self, Asked, Wanted};
use super::rules::Kind;
use super::said::{Answer, Said};
use super::steps::{self, AXES, Steps, named};
use crate::draw::{ChannelPanel, render_channels};
use crate::error::Result;
use crate::site::tables::TableFile;
use crate::words::number::counted;
use crate::words::suggest::did_you_mean;

/// The two ends of every way: in the other part (Lee, definition 3.1), and above it (3.2).
const ASSEMBLED: &str = "assembled";
const DISASSEMBLED: &str = "disassembled";

/// A part in another one as its file has it.
#[derive(Debug)]
pub struct PartsOf<const D: usize> {
    pub file: PathBuf,
    pub assembly: Assembly<D>,
}

/// The names of columns that hold a number for each axis: `x0`, `z0` or `gap_x`, `gap_z`.
fn along<const D: usize>(name: impl Fn(&str) -> String) -> [String; D] {
    std::array::from_fn(|axis| name(AXES[named::<D>(axis)]))
}

fn low<const D: usize>() -> [String; D] {
    along(|axis| format!("{axis}0"))
}

fn high<const D: usize>() -> [String; D] {
    along(|axis| format!("{axis}1"))
}

fn of_axes<const D: usize>(what: &str) -> [String; D] {
    along(|axis| format!("{what}_{axis}"))
}

fn table(file: &Path, name: &str, columns: &[(String, &'static str)], rows: Vec<Vec<Cell>>) -> TableFile {
    let columns: Vec<(&str, &'static str)> =
        columns.iter().map(|(name, kind)| (name.as_str(), *kind)).collect();
    TableFile::of_map(file, name, (&columns, 1), rows)
}

fn real<const D: usize>(names: [String; D]) -> impl Iterator<Item = (String, &'static str)> {
    names.into_iter().map(|name| (name, "REAL"))
}

fn text(name: &str) -> (String, &'static str) {
    (name.to_owned(), "TEXT")
}

fn numbers<const D: usize>(numbers: &[f64; D]) -> impl Iterator<Item = Cell> {
    numbers.iter().copied().map(Cell::Real)
}

fn perhaps<const D: usize>(numbers: Option<&[f64; D]>) -> impl Iterator<Item = Cell> {
    (0..D).map(move |axis| numbers.map_or(Cell::Null, |numbers| Cell::Real(numbers[axis])))
}

/// A gap as its columns: the metres along each axis, and by what it is chosen where there are none.
fn gap_cells<const D: usize>(gap: &Asked<D>) -> Vec<Cell> {
    let (metres, by) = match gap {
        Asked::Gap(gap) => (Some(gap), Cell::Null),
        asked => (None, Cell::from(asked.word())),
    };
    perhaps(metres).chain([by]).collect()
}

impl<const D: usize> Course for PartsOf<D> {
    fn name(&self) -> &'static str {
        "parts"
    }

    fn tables(&self) -> Vec<TableFile> {
        let Assembly { geometry, wanted, female_moves, displacement, base } = &self.assembly;
        let extent =
            |cuboid: &Cuboid<D>| numbers(&cuboid.min).chain(numbers(&cuboid.max)).collect::<Vec<_>>();
        let channels = (1..).zip(geometry.channels());
        let channels =
            channels.map(|(number, channel)| [vec![Cell::Integer(number)], extent(channel)].concat());
        let moves = Cell::from(if *female_moves { "female" } else { "male" });
        let truths = [wanted.fragile, wanted.hurry].map(|truth| Cell::Integer(truth.into()));
        let part =
            [vec![Cell::from(wanted.mover.as_str())], extent(&geometry.part()), gap_cells(&wanted.gap)]
                .concat()
                .into_iter()
                .chain(truths)
                .chain([moves])
                .chain(perhaps(base.as_ref()))
                .chain(perhaps(displacement.as_ref()));
        let gaps = wanted.gaps.iter();
        let gaps = gaps
            .map(|(junction, gap)| [vec![Cell::Integer(*junction as i64)], gap_cells(gap)].concat())
            .collect();
        let of_channels: Vec<_> = [("channel".to_owned(), "INTEGER")]
            .into_iter()
            .chain(real(low::<D>()))
            .chain(real(high::<D>()))
            .collect();
        let of_gaps: Vec<_> = [("junction".to_owned(), "INTEGER")]
            .into_iter()
            .chain(real(of_axes::<D>("gap")))
            .chain([text("gap_by")])
            .collect();
        let of_parts: Vec<_> = [text("part")]
            .into_iter()
            .chain(real(low::<D>()))
            .chain(real(high::<D>()))
            .chain(real(of_axes::<D>("gap")))
            .chain([text("gap_by"), ("fragile".to_owned(), "BOOLEAN"), ("hurry".to_owned(), "BOOLEAN")])
            .chain([text("moves")])
            .chain(real(of_axes::<D>("base")))
            .chain(real(of_axes::<D>("displacement")))
            .collect();
        vec![
            table(&self.file, "channels", &of_channels, channels.collect()),
            table(&self.file, "parts", &of_parts, vec![part.collect()]),
            table(&self.file, "gaps", &of_gaps, gaps),
        ]
    }

    fn places(&self) -> Vec<Place> {
        Vec::new()
    }

    fn planner(&self) -> Option<Arc<dyn Planner>> {
        Some(Arc::new(PartJunctions::<D>))
    }

    fn asks(&self) -> Vec<Class> {
        Kind::Channels.classes()
    }

    fn pathfinder(&self, rules: &Rules<'_>) -> Result<Box<dyn Pathfinder>> {
        let (channels, parts, gaps) =
            (rules.objects("CHANNELS"), rules.objects("PARTS"), rules.objects("GAPS"));
        refuse_gaps(channels, "channel")?;
        let boxes = channels.rows().map(|row| cuboid::<D>(channels, row)).collect::<Result<Vec<_>>>()?;
        let columns = of_axes::<D>("gap");
        let part = |row: usize| -> Result<Assembly<D>> {
            let moves = parts.text(row, "moves");
            let female_moves = match moves.as_deref() {
                None | Some("male") => false,
                Some("female") => true,
                Some(other) => return Err(parts.wrong(row, "moves", "`male` or `female`", Some(other))),
            };
            let geometry =
                geometry::Assembly::new(boxes.clone(), cuboid::<D>(parts, row)?).map_err(no_map)?;
            let gaps = gap::at_junctions(gaps, geometry.junctions().len(), &columns)?;
            Ok(Assembly {
                geometry,
                wanted: Wanted {
                    mover: parts.text(row, "part").unwrap_or_default(),
                    gap: gap::of_row(parts, row, &columns)?,
                    gaps,
                    fragile: parts.truth(row, "fragile"),
                    hurry: parts.truth(row, "hurry"),
                },
                female_moves,
                displacement: vector::<D>(parts, row, "displacement")?,
                base: vector::<D>(parts, row, "base")?,
            })
        };
        let parts = parts.rows().map(part).collect::<Result<Vec<_>>>()?;
        let steps = Mutex::new(Steps::of(rules.consultation(&steps::class())?));
        Ok(Box::new(Ways { parts, steps }))
    }
}

fn cuboid<const D: usize>(of: ObjectsOf<'_>, row: usize) -> Result<Cuboid<D>> {
    let corner = |names: [String; D]| -> Result<[f64; D]> {
        let mut corner = [0.0; D];
        for (at, name) in corner.iter_mut().zip(&names) {
            *at = of.needed(row, name)?;
        }
        Ok(corner)
    };
    Ok(Cuboid::new(corner(low())?, corner(high())?))
}

/// A number for each axis; `None` where there is none at all.
fn vector<const D: usize>(of: ObjectsOf<'_>, row: usize, what: &str) -> Result<Option<[f64; D]>> {
    let names = of_axes::<D>(what);
    if names.iter().all(|name| of.number(row, name).is_none()) {
        return Ok(None);
    }
    let mut vector = [0.0; D];
    for (at, name) in vector.iter_mut().zip(&names) {
        *at = of.needed(row, name)?;
    }
    Ok(Some(vector))
}

/// The ways of parts out of another one and into it, as they are.
struct Ways<const D: usize> {
    parts: Vec<Assembly<D>>,
    steps: Mutex<Steps>,
}

impl<const D: usize> Ways<D> {
    /// A part's way out, and whether it is asked for the other way round.
    fn explained(
        &self,
        part: &str,
        ends: [&str; 2],
    ) -> std::result::Result<(&Assembly<D>, Answer<PartPath<D>>, bool), NoEnd> {
        let of = self.parts.iter().find(|known| known.wanted.mover == part);
        let of = of.ok_or_else(|| NoEnd { is_start: true, reason: format!("there is no part `{part}`") })?;
        for (end, is_start) in ends.into_iter().zip([true, false]) {
            if ![ASSEMBLED, DISASSEMBLED].contains(&end) {
                let meant = did_you_mean(end, [ASSEMBLED, DISASSEMBLED].into_iter());
                let meant = meant.map_or(String::new(), |help| format!("; {help}"));
                let reason = format!("`{end}` is neither `{ASSEMBLED}` nor `{DISASSEMBLED}`{meant}");
                return Err(NoEnd { is_start, reason });
            }
        }
        let mut steps = self.steps.lock().unwrap_or_else(PoisonError::into_inner);
        let mut answer = of.explained(&mut steps);
        drop(steps);
        if ends[0] == ends[1]
            && let Ok(path) = &mut answer.path
        {
            path.legs.clear();
            let keep = if ends[0] == ASSEMBLED { 0 } else { path.waypoints.len().saturating_sub(1) };
            path.waypoints = path.waypoints.get(keep).copied().into_iter().collect();
            path.clearances = path.clearances.get(keep).copied().into_iter().collect();
            path.length = 0.0;
        }
        Ok((of, answer, ends[0] == DISASSEMBLED))
    }
}

impl<const D: usize> Pathfinder for Ways<D> {
    fn robots(&self) -> Vec<String> {
        self.parts.iter().map(|part| part.wanted.mover.clone()).collect()
    }

    fn ends(&self) -> Vec<Place> {
        [ASSEMBLED, DISASSEMBLED].map(|place| Place { place: place.to_owned(), x: 0.0, y: 0.0 }).into()
    }

    fn find(&self, robot: &str, start: &str, goal: &str) -> std::result::Result<Found, NoEnd> {
        let (of, Answer { path, said }, is_back) = self.explained(robot, [start, goal])?;
        let mut row = Row::blank(robot, start, goal);
        match path {
            Ok(path) => {
                let mut places = of.female_waypoints(&path).unwrap_or_else(|| path.waypoints.clone());
                let path = if is_back { path.reversed() } else { path };
                if is_back {
                    places.reverse();
                }
                (row.steps, row.waypoints) = rows(&path, &places, &said, is_back);
                (row.cost, row.distance) = (Some(path.length), Some(path.length));
                row.clearance = Some(path.min_clearance);
            }
            Err(no_path) => row.reason = Some(no_path.reason),
        }
        Ok(Found { row, said: said.into_iter().map(Arc::new).collect() })
    }

    fn find_through(&self, robot: &str, ends: [&str; 2], through: &str) -> Result<Found> {
        let first = self.parts.first().map(|part| &part.geometry);
        let (channels, junctions) = first.map_or((0, 0), |of| (of.channels().len(), of.junctions().len()));
        let of = |kind, count: usize| numbered(through, kind).filter(|number| (1..=count).contains(number));
        if of("channel", channels).or_else(|| of("junction", junctions)).is_none() {
            let known =
                format!("`channel 1` to `channel {channels}`, `junction 1` to `junction {junctions}`");
            return Err(no_through(through, &known));
        }
        // channels are a chain: whatever way there is leads through all of them
        Ok(self.find(robot, ends[0], ends[1])?)
    }

    fn picture(&self, title: &str, route: Option<[&str; 3]>) -> std::result::Result<String, NoEnd> {
        // in three dimensions from the front and from above
        let views: &[(&str, [usize; 2])] =
            if D == 2 { &[("", [0, 1])] } else { &[(" from the front", [0, 2]), (" from above", [0, 1])] };
        let first = self.parts.first().map_or("", |part| part.wanted.mover.as_str());
        let [part, start, goal] = route.unwrap_or([first, ASSEMBLED, ASSEMBLED]);
        let (of, answer, is_back) = self.explained(part, [start, goal])?;
        let still = |at: [f64; D]| PartPath {
            waypoints: vec![at],
            legs: Vec::new(),
            clearances: Vec::new(),
            length: 0.0,
            min_clearance: 0.0,
        };
        let (name, path) = match answer.path {
            Ok(path) => (if start == goal { start.to_owned() } else { format!("{start} to {goal}") }, path),
            Err(_) => (format!("{start} to {goal}: no route"), still(of.geometry.part().min)),
        };
        let path = if is_back { path.reversed() } else { path };
        let panels: Vec<ChannelPanel> = views
            .iter()
            .map(|(view, axes)| {
                ChannelPanel::assembly(&format!("{part}: {name}{view}"), &of.geometry, &path, *axes)
            })
            .collect();
        Ok(render_channels(title, &panels))
    }

    fn trouble(&self) -> Option<String> {
        self.steps.lock().unwrap_or_else(PoisonError::into_inner).trouble().map(str::to_owned)
    }

    fn summary(&self) -> String {
        let first = self.parts.first().map(|part| &part.geometry);
        let (channels, junctions) = first.map_or((0, 0), |of| (of.channels().len(), of.junctions().len()));
        [(channels, "channel"), (junctions, "junction"), (self.parts.len(), "part")]
            .map(|(count, what)| counted(count, what))
            .join(", ")
    }
}

/// A way as rows: a step and a waypoint for each leg. It weighs its metres.
///
/// # Arguments
/// `places` are where that is which moves, at each waypoint.
fn rows<const D: usize>(
    path: &PartPath<D>,
    places: &[[f64; D]],
    said: &[Said],
    is_back: bool,
) -> (Vec<Step>, Vec<Waypoint>) {
    let (mut steps, mut points) = (Vec::new(), Vec::new());
    let mut distance = 0.0;
    for (number, at) in (1..).zip(places) {
        let [x, y, z] = three(at);
        let leg = usize::try_from(number - 2).ok().and_then(|leg| path.legs.get(leg));
        let state = match (number == 1, number as usize == path.waypoints.len()) {
            (true, _) => Some(if is_back { DISASSEMBLED } else { ASSEMBLED }),
            (_, true) => Some(if is_back { ASSEMBLED } else { DISASSEMBLED }),
            _ => None,
        };
        let state = state.map(str::to_owned);
        let of = leg.and_then(|leg| said.iter().find(|said| said.junction == leg.junction));
        // on the last stretch out nothing is left to be asked
        let action = of.or_else(|| said.last()).and_then(|said| said.action.as_deref()).map(str::to_owned);
        let metres = leg.map_or(0.0, |leg| leg.displacement.iter().map(|by| by * by).sum::<f64>().sqrt());
        distance += metres;
        points.push(Waypoint {
            waypoint: number,
            x,
            y,
            z: Some(z),
            state: state.clone(),
            action: action.clone(),
            clearance: leg.map(|leg| leg.min_clearance),
            distance: Some(distance),
            cost: distance,
            ..Waypoint::default()
        });
        if leg.is_none() {
            continue;
        }
        steps.push(Step {
            step: number - 1,
            kind: "move".to_owned(),
            place: ends_in(path, number as usize - 2, is_back),
            state,
            action,
            hardness: Some(metres),
            cost: distance,
            x: Some(x),
            y: Some(y),
            z: Some(z),
            rule: of.and_then(|said| said.rule_of("margin_x")),
            ..Step::default()
        });
    }
    (steps, points)
}

/// Where a leg ends: on the way in where on the way out the one before it did.
fn ends_in<const D: usize>(path: &PartPath<D>, leg: usize, is_back: bool) -> String {
    let of = if is_back { path.legs.get(leg + 1) } else { path.legs.get(leg) };
    match of.map(|leg| leg.junction) {
        None => ASSEMBLED.to_owned(),
        Some(0) => "outside".to_owned(),
        Some(junction) => format!("junction {junction}"),
    }
}

/// x, y and z of a point; a world of two dimensions lies at y = 0.
fn three<const D: usize>(at: &[f64; D]) -> [f64; 3] {
    let mut three = [0.0; 3];
    for (axis, value) in at.iter().enumerate() {
        three[named::<D>(axis)] = *value;
    }
    three
}
