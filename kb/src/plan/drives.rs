//! Corridors as a site: the tables that their file fills, and drives through them.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

use adit_db::Cell;
use adit_db::course::Course as Row;
use adit_db::place::Place;
use adit_db::route::{Step, Waypoint};
use adit_planners::channels::CorridorJunctions;
use adit_planners::channels::corridor::{Corridors, End, Primitive, Robot, Through};
use adit_planners::geometry::{Point, Rect};
use adit_planners::planner::Planner;

use super::consult::Class;
use super::corridor::{Corridor, Driven};
use super::course::{
    Asked as Rules, Course, Found, NoEnd, Pathfinder, no_map, no_through, numbered, refuse_gaps,
};
use super::gap::{self, Asked, Wanted};
use super::rules::Kind;
use super::said::{Answer, Said};
use super::turns::{self, Turns};
use crate::draw::{ChannelPanel, render_channels};
use crate::error::Result;
use crate::site::tables::TableFile;
use crate::words::number::counted;
use crate::words::point::point;
use crate::words::suggest::did_you_mean;

const CHANNELS: [(&str, &str); 6] = [
    ("channel", "INTEGER"),
    ("x0", "REAL"),
    ("y0", "REAL"),
    ("x1", "REAL"),
    ("y1", "REAL"),
    ("closed", "BOOLEAN"),
];
const VEHICLES: [(&str, &str); 8] = [
    ("robot", "TEXT"),
    ("width", "REAL"),
    ("length", "REAL"),
    ("heading", "REAL"),
    ("gap", "REAL"),
    ("gap_by", "TEXT"),
    ("fragile", "BOOLEAN"),
    ("hurry", "BOOLEAN"),
];
const GAPS: [(&str, &str); 3] = [("junction", "INTEGER"), ("gap", "REAL"), ("gap_by", "TEXT")];

/// A gap as its two columns: the metres, and by what it is chosen where there are none.
fn gap_cells(gap: &Asked<1>) -> [Cell; 2] {
    match gap {
        Asked::Gap([gap]) => [Cell::Real(*gap), Cell::Null],
        asked => [Cell::Null, Cell::from(asked.word())],
    }
}

/// Corridors as their file has them.
#[derive(Debug)]
pub struct CorridorsOf {
    pub file: PathBuf,
    pub corridor: Corridor,
}

impl Course for CorridorsOf {
    fn name(&self) -> &'static str {
        "corridors"
    }

    fn tables(&self) -> Vec<TableFile> {
        let Corridor { corridors, robot, heading, wanted, closed, .. } = &self.corridor;
        let channels = (1..).zip(corridors.channels()).map(|(number, rect)| {
            let [x0, y0, x1, y1] = [rect.x0, rect.y0, rect.x1, rect.y1].map(Cell::Real);
            let is_closed = closed.contains(&(number as usize));
            vec![Cell::Integer(number), x0, y0, x1, y1, Cell::Integer(i64::from(is_closed))]
        });
        let [gap, gap_by] = gap_cells(&wanted.gap);
        let vehicle = vec![
            Cell::from(wanted.mover.as_str()),
            Cell::Real(robot.width),
            Cell::Real(robot.length),
            heading.map_or(Cell::Null, |heading| Cell::Real(heading.to_degrees())),
            gap,
            gap_by,
            Cell::Integer(wanted.fragile.into()),
            Cell::Integer(wanted.hurry.into()),
        ];
        let gaps = wanted.gaps.iter().map(|(junction, gap)| {
            let [gap, gap_by] = gap_cells(gap);
            vec![Cell::Integer(*junction as i64), gap, gap_by]
        });
        vec![
            TableFile::of_map(&self.file, "channels", (&CHANNELS, 1), channels.collect()),
            TableFile::of_map(&self.file, "vehicles", (&VEHICLES, 1), vec![vehicle]),
            TableFile::of_map(&self.file, "gaps", (&GAPS, 1), gaps.collect()),
        ]
    }

    fn places(&self) -> Vec<Place> {
        let Corridor { start, goal, places, .. } = &self.corridor;
        let place = |(place, at): (&str, &Point)| Place { place: place.to_owned(), x: at.x, y: at.y };
        let named = places.iter().map(|(name, at)| (name.as_str(), at));
        [("start", start), ("goal", goal)].into_iter().chain(named).map(place).collect()
    }

    fn planner(&self) -> Option<Arc<dyn Planner>> {
        Some(Arc::new(CorridorJunctions))
    }

    fn asks(&self) -> Vec<Class> {
        Kind::Channels.classes()
    }

    fn pathfinder(&self, rules: &Rules<'_>) -> Result<Box<dyn Pathfinder>> {
        let channels = rules.objects("CHANNELS");
        refuse_gaps(channels, "channel")?;
        let rect = |row: usize| -> Result<Rect> {
            let side = |name| channels.needed(row, name);
            Ok(Rect { x0: side("x0")?, y0: side("y0")?, x1: side("x1")?, y1: side("y1")? })
        };
        let rects = channels.rows().map(rect).collect::<Result<Vec<_>>>()?;
        let corridors = Corridors::new(&rects).map_err(no_map)?;
        let closed =
            channels.rows().filter(|row| channels.truth(*row, "closed")).map(|row| row + 1).collect();
        let (places, gaps) = (rules.objects("PLACES"), rules.objects("GAPS"));
        let place = |row: usize| -> Result<(String, Point)> {
            let at = Point::new(places.needed(row, "x")?, places.needed(row, "y")?);
            Ok((places.text(row, "place").unwrap_or_default(), at))
        };
        let places = places.rows().map(place).collect::<Result<BTreeMap<_, _>>>()?;
        let column = ["gap".to_owned()];
        let at_junctions = gap::at_junctions(gaps, corridors.junctions().len(), &column)?;
        let vehicles = rules.objects("VEHICLES");
        let vehicle = |row: usize| -> Result<Vehicle> {
            let size = |name: &str| {
                let metres = vehicles.needed(row, name)?;
                let found = metres.to_string();
                if metres > 0.0 {
                    Ok(metres)
                } else {
                    Err(vehicles.wrong(row, name, "more than 0", Some(&found)))
                }
            };
            let mover = vehicles.text(row, "robot").unwrap_or_default();
            Ok(Vehicle {
                robot: Robot { width: size("width")?, length: size("length")? },
                heading: vehicles.number(row, "heading").map(f64::to_radians),
                wanted: Wanted {
                    mover,
                    gap: gap::of_row(vehicles, row, &column)?,
                    gaps: at_junctions.clone(),
                    fragile: vehicles.truth(row, "fragile"),
                    hurry: vehicles.truth(row, "hurry"),
                },
            })
        };
        let vehicles = vehicles.rows().map(vehicle).collect::<Result<Vec<_>>>()?;
        let with_gaps = at_junctions.keys().copied().collect();
        let [turns, passages] = turns::classes();
        let turns = Mutex::new(Turns::of(rules.consultation(&turns)?, rules.consultation(&passages)?));
        Ok(Box::new(Drives { corridors, closed, with_gaps, vehicles, places, turns }))
    }
}

struct Vehicle {
    robot: Robot,
    heading: Option<f64>,
    wanted: Wanted<1>,
}

/// Drives through corridors as they are.
struct Drives {
    corridors: Corridors,
    closed: BTreeSet<usize>,
    /// The junctions that have gaps of their own.
    with_gaps: BTreeSet<usize>,
    vehicles: Vec<Vehicle>,
    places: BTreeMap<String, Point>,
    turns: Mutex<Turns>,
}

impl Drives {
    fn end(&self, text: &str, is_start: bool) -> std::result::Result<Point, NoEnd> {
        let no_end = |reason| NoEnd { is_start, reason };
        let at = self.places.get(text).copied().or_else(|| point(text)).ok_or_else(|| {
            let meant = did_you_mean(text, self.places.keys().map(String::as_str));
            let meant = meant.map_or(String::new(), |help| format!("; {help}"));
            no_end(format!("`{text}` is no place and no point `x,y`{meant}"))
        })?;
        if self.corridors.at(at).next().is_none() {
            return Err(no_end(format!("{text} is at {},{}, which lies in no channel", at.x, at.y)));
        }
        Ok(at)
    }

    fn labelled(&self, panel: ChannelPanel) -> ChannelPanel {
        let places = self.places.iter().map(|(name, at)| (name.as_str(), *at));
        panel.labelled(|channel| self.closed.contains(&channel), places)
    }

    fn explained(
        &self,
        robot: &str,
        ends: [&str; 2],
        through: Option<Through>,
    ) -> std::result::Result<(Corridor, Answer<Driven>), NoEnd> {
        let start = self.end(ends[0], true)?;
        let goal = self.end(ends[1], false)?;
        let vehicle = self.vehicles.iter().find(|vehicle| vehicle.wanted.mover == robot);
        let vehicle = vehicle
            .ok_or_else(|| NoEnd { is_start: true, reason: format!("there is no robot `{robot}`") })?;
        let corridor = Corridor {
            corridors: self.corridors.clone(),
            robot: vehicle.robot,
            start,
            heading: vehicle.heading,
            goal,
            places: Vec::new(),
            closed: self.closed.clone(),
            wanted: vehicle.wanted.clone(),
        };
        let mut turns = self.turns.lock().unwrap_or_else(PoisonError::into_inner);
        let answer = corridor.explained(&mut turns, through);
        Ok((corridor, answer))
    }
}

impl Pathfinder for Drives {
    fn told_by_number(&self) -> BTreeMap<usize, String> {
        let junction = |number: &usize| {
            let junction = self.corridors.junctions().get(number.checked_sub(1)?)?;
            let (one, other) = (junction.lying.min(junction.upright), junction.lying.max(junction.upright));
            Some((*number, format!("channels {one} and {other}")))
        };
        self.with_gaps.iter().filter_map(junction).collect()
    }

    fn robots(&self) -> Vec<String> {
        self.vehicles.iter().map(|vehicle| vehicle.wanted.mover.clone()).collect()
    }

    fn ends(&self) -> Vec<Place> {
        self.places.iter().map(|(place, at)| Place { place: place.clone(), x: at.x, y: at.y }).collect()
    }

    fn find(&self, robot: &str, start: &str, goal: &str) -> std::result::Result<Found, NoEnd> {
        let (_, answer) = self.explained(robot, [start, goal], None)?;
        Ok(found([robot, start, goal], answer))
    }

    fn find_through(&self, robot: &str, ends: [&str; 2], through: &str) -> Result<Found> {
        let channels = self.corridors.channels().len();
        let junctions = self.corridors.junctions().len();
        let channel = numbered(through, "channel").filter(|number| (1..=channels).contains(number));
        let junction = numbered(through, "junction").filter(|number| (1..=junctions).contains(number));
        let via = channel.map(Through::Channel).or_else(|| junction.map(Through::Junction));
        let via = via.ok_or_else(|| {
            no_through(
                through,
                &format!("`channel 1` to `channel {channels}`, `junction 1` to `junction {junctions}`"),
            )
        })?;
        let (_, answer) = self.explained(robot, ends, Some(via))?;
        Ok(found([robot, ends[0], ends[1]], answer))
    }

    fn picture(&self, title: &str, route: Option<[&str; 3]>) -> std::result::Result<String, NoEnd> {
        let Some([robot, start, goal]) = route else {
            let panel = ChannelPanel::corridors("corridors", &self.corridors);
            return Ok(render_channels(title, &[self.labelled(panel)]));
        };
        let (corridor, answer) = self.explained(robot, [start, goal], None)?;
        let name = format!("{start} to {goal}");
        let panel = match &answer.path {
            Ok(driven) => ChannelPanel::drive(&name, &self.corridors, corridor.robot, &driven.drive),
            Err(_) => ChannelPanel::corridors(&format!("{name}: no route"), &self.corridors),
        };
        Ok(render_channels(title, &[self.labelled(panel)]))
    }

    fn trouble(&self) -> Option<String> {
        self.turns.lock().unwrap_or_else(PoisonError::into_inner).trouble().map(str::to_owned)
    }

    fn summary(&self) -> String {
        [(self.corridors.channels().len(), "channel"), (self.corridors.junctions().len(), "junction")]
            .map(|(count, what)| counted(count, what))
            .join(", ")
    }
}

/// What rules say of a drive, as it is kept.
fn found([robot, start, goal]: [&str; 3], answer: Answer<Driven>) -> Found {
    let Answer { path, said } = answer;
    let mut row = Row::blank(robot, start, goal);
    match path {
        Ok(driven) => {
            (row.steps, row.waypoints) = rows(&driven, &said);
            row.cost = Some(driven.weight);
            row.distance = Some(driven.drive.length);
            row.clearance = Some(driven.drive.min_clearance);
            row.remarks = driven.remarks;
        }
        Err(no_path) => {
            row.reason = Some(no_path.reason);
        }
    }
    Found { row, said: said.into_iter().map(Arc::new).collect() }
}

/// A drive as rows: a step and a waypoint for each line and arc. What a passage weighs is the step's that leads through it.
fn rows(driven: &Driven, said: &[Said]) -> (Vec<Step>, Vec<Waypoint>) {
    let (mut steps, mut points): (Vec<Step>, Vec<Waypoint>) = (Vec::new(), Vec::new());
    let (mut cost, mut distance) = (0.0, 0.0);
    let mut legs = driven.legs.iter().peekable();
    let primitives = &driven.drive.primitives;
    for (at, primitive) in primitives.iter().enumerate() {
        // a line leads through all that comes before the next arc
        let next_arc = primitives[at..].iter().find_map(|next| match next {
            Primitive::Arc { junction, .. } => Some(*junction),
            Primitive::Line { .. } => None,
        });
        let (mut hardness, mut action, mut rule, mut channels) = (0.0, None, None, Vec::new());
        if let Primitive::Line { .. } = primitive {
            while let Some(leg) = legs.next() {
                hardness += leg.weight;
                channels.push(leg.passage.channel);
                let said = leg.said.as_ref();
                action = action.or_else(|| said.and_then(|said| said.action.clone()));
                rule = rule.or_else(|| said.and_then(|said| said.rule_of("weight")));
                let is_last = match (leg.passage.to, next_arc) {
                    (End::Junction(number), Some(next)) => number == next,
                    _ => false,
                };
                if is_last || legs.peek().is_none() {
                    break;
                }
            }
        }
        let (kind, place, from, b, headings, circle) = match *primitive {
            Primitive::Line { a, b, from_heading, to_heading, .. } => {
                let named: Vec<String> = channels.iter().map(ToString::to_string).collect();
                let s = if named.len() > 1 { "s" } else { "" };
                let place = format!("channel{s} {}", named.join(", "));
                ("line", place, a, b, (from_heading, to_heading), None)
            }
            Primitive::Arc { junction, centre, turn, a, b, from_heading, to_heading, .. } => {
                let of = said.iter().find(|said| said.junction == junction);
                action = of.and_then(|said| said.action.clone());
                rule = of.and_then(|said| said.rule_of("corner_x"));
                (
                    "arc",
                    format!("junction {junction}"),
                    a,
                    b,
                    (from_heading, to_heading),
                    Some((centre, turn)),
                )
            }
        };
        cost += hardness;
        distance += primitive.length();
        let heading = Some(headings.1.to_degrees());
        let action = action.map(|action| action.to_string());
        let number = steps.len() as i64 + 1;
        if points.is_empty() {
            points.push(Waypoint {
                waypoint: 1,
                x: from.x,
                y: from.y,
                heading: Some(headings.0.to_degrees()),
                action: action.clone(),
                distance: Some(0.0),
                ..Waypoint::default()
            });
        }
        points.push(Waypoint {
            waypoint: number + 1,
            x: b.x,
            y: b.y,
            heading,
            action: action.clone(),
            clearance: Some(primitive.clearance()),
            distance: Some(distance),
            cost,
            centre_x: circle.map(|(centre, _)| centre.x),
            centre_y: circle.map(|(centre, _)| centre.y),
            turn: circle.map(|(_, turn)| turn.name().to_owned()),
            ..Waypoint::default()
        });
        steps.push(Step {
            step: number,
            kind: kind.to_owned(),
            place,
            action,
            hardness: Some(hardness),
            cost,
            x: Some(b.x),
            y: Some(b.y),
            heading,
            rule,
            ..Step::default()
        });
    }
    (steps, points)
}
