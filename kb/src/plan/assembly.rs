//! A part that is taken out of another through channels (Lee, sections 2 to 4).

use std::collections::BTreeMap;

use adit_planners::channels::assembly::{self as geometry, Cuboid, PartPath, PathError};
use adit_planners::read::{Code, Fields, Located, Problem};

use super::answer::Answer;
use super::gap::Asked;
use super::refusal::NoPath;
use super::said::Said;
use super::steps::{Steps, Wishes};
use super::world::{Task, flag};

/// A part in channels, and what is asked of its path.
#[derive(Clone, Debug)]
pub struct Assembly<const D: usize> {
    pub geometry: geometry::Assembly<D>,
    pub gap: Asked<D>,
    /// Where it is another one: the number of the junction.
    pub gaps: BTreeMap<usize, Asked<D>>,
    /// Whether the part must not be scratched.
    pub fragile: bool,
    pub hurry: bool,
    /// Whether the part around the channels is the one that moves.
    pub female_moves: bool,
    /// The displacement of the part from the assembled to the final state, relative to the other.
    pub displacement: Option<[f64; D]>,
    /// Where the origin of the channels' coordinates lies in the base frame, in the assembled state.
    pub base: Option<[f64; D]>,
}

impl<const D: usize> Assembly<D> {
    /// The part's way out, by what the rules say at each junction.
    pub fn plan(&self, steps: &mut Steps) -> Result<PartPath<D>, NoPath> {
        let decide = |facts: &geometry::StepFacts<D>| steps.decide(facts, self.wishes(facts.number));
        self.geometry.disassemble(self.displacement, decide).map_err(|error| no_path(&error))
    }

    /// As [`plan`](Self::plan), and what rules said at each junction.
    pub fn explained(&self, steps: &mut Steps) -> Answer<PartPath<D>> {
        let mut said = Vec::new();
        let decide = |facts: &geometry::StepFacts<D>| {
            let decision = steps.decide(facts, self.wishes(facts.number));
            let (considered, facts_said) = (steps.considered(), steps.facts());
            said.push(Said { junction: facts.number, considered, facts: facts_said });
            decision
        };
        let path = self.geometry.disassemble(self.displacement, decide).map_err(|error| no_path(&error));
        Answer { path, said }
    }

    /// What is asked for at a junction.
    pub fn wishes(&self, junction: usize) -> Wishes<'_, D> {
        let gap = self.gaps.get(&junction).unwrap_or(&self.gap);
        Wishes { gap, fragile: self.fragile, hurry: self.hurry }
    }

    /// The same with another gap everywhere.
    #[must_use]
    pub fn with_gap(&self, gap: Asked<D>) -> Self {
        Self { gap, gaps: BTreeMap::new(), ..self.clone() }
    }

    /// What the part is in at a waypoint: assembled where it starts (definition 3.1), disassembled where it is above
    /// the free space (3.2).
    pub fn state(&self, path: &PartPath<D>, waypoint: usize) -> Option<&'static str> {
        let height = path.waypoints.get(waypoint)?[D - 1];
        if waypoint == 0 {
            Some("assembled")
        } else {
            (height >= self.geometry.top()).then_some("disassembled")
        }
    }

    /// Where the origin of the other part is in the base frame, at each waypoint, where that part moves: it goes the
    /// opposite way.
    pub fn female_waypoints(&self, path: &PartPath<D>) -> Option<Vec<[f64; D]>> {
        if !self.female_moves {
            return None;
        }
        let (from, base) = (path.waypoints.first()?, self.base.unwrap_or([0.0; D]));
        let moved = |point: &[f64; D]| std::array::from_fn(|axis| base[axis] - (point[axis] - from[axis]));
        Some(path.waypoints.iter().map(moved).collect())
    }
}

fn no_path<const D: usize>(error: &PathError<D, NoPath>) -> NoPath {
    let junction = match error {
        PathError::Undecided { reason, .. } => return reason.clone(),
        PathError::BadGap { junction, .. } | PathError::Collides { junction, .. } => Some(*junction),
        _ => None,
    };
    NoPath { junction, reason: error.to_string(), considered: vec![] }
}

const KEYS: [&str; 10] =
    ["channels", "female", "male", "gap", "junction", "fragile", "hurry", "moves", "displacement", "base"];

/// Reads `[assembly]`; in three dimensions where the channels are boxes of six numbers.
pub(super) fn read(fields: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> Option<Task> {
    fields.refuse_unknown(&KEYS, problems);
    let solid = fields.get("channels").and_then(|_| {
        let lists = fields.lists("channels", &mut Vec::new())?;
        lists.value.first().map(|first| first.value.len() == 6)
    });
    if solid == Some(true) {
        read_in::<3>(fields, problems).map(Task::SolidAssembly)
    } else {
        read_in::<2>(fields, problems).map(Task::Assembly)
    }
}

fn read_in<const D: usize>(fields: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> Option<Assembly<D>> {
    let gap = Asked::read(fields, problems);
    let gaps = gaps_of_junctions(fields, problems);
    let (fragile, hurry) = (flag(fields, "fragile", problems), flag(fields, "hurry", problems));
    let female_moves = match fields.get("moves").and_then(|_| fields.string("moves", problems)) {
        None => false,
        Some(moves) if moves.value == "male" => false,
        Some(moves) if moves.value == "female" => true,
        Some(moves) => {
            let message = format!("`moves` is `{}`; expected \"male\" or \"female\"", moves.value);
            problems.push(fields.text.problem(Code::WrongType, &moves.span, message));
            false
        }
    };
    let mut vector = |key| fields.get(key).and_then(|_| fields.numbers::<D>(key, problems));
    let (displacement, base) = (vector("displacement"), vector("base"));
    let part = part::<D>(fields, problems);
    let channels = channels::<D>(fields, part.as_ref(), problems);
    let (part, (channels, span)) = (part?, channels?);
    let geometry = match geometry::Assembly::new(channels, part.value) {
        Ok(geometry) => geometry,
        Err(error) => {
            use geometry::AssemblyError::{PartIsNoBox, PartOutside};
            let about_part = matches!(error, PartOutside { .. } | PartIsNoBox { .. });
            let at = if about_part { &part.span } else { &span };
            problems.push(fields.text.problem(Code::Impossible, at, error.to_string()));
            return None;
        }
    };
    for (number, (_, at)) in &gaps {
        if *number == 0 || *number > geometry.junctions().len() {
            let message = format!("there is no junction {number}; there are {}", geometry.junctions().len());
            problems.push(fields.text.problem(Code::Outside, at, message));
        }
    }
    Some(Assembly {
        geometry,
        gap,
        gaps: gaps.into_iter().map(|(number, (gap, _))| (number, gap)).collect(),
        fragile,
        hurry,
        female_moves,
        displacement: displacement.map(|found| found.value),
        base: base.map(|found| found.value),
    })
}

type GapAt<const N: usize> = (Asked<N>, std::ops::Range<usize>);

/// `[[....junction]]`: a gap of its own for one junction.
pub(super) fn gaps_of_junctions<const N: usize>(
    fields: &Fields<'_, '_>,
    problems: &mut Vec<Problem>,
) -> BTreeMap<usize, GapAt<N>> {
    let mut gaps = BTreeMap::new();
    for entry in fields.tables("junction", "[[junction]]", problems) {
        entry.refuse_unknown(&["number", "gap"], problems);
        let Some(number) = entry.number("number", problems) else { continue };
        if number.value.fract() != 0.0 || number.value < 1.0 {
            let message = format!("`number` is {}; junctions are numbered 1, 2, ...", number.value);
            problems.push(entry.text.problem(Code::WrongType, &number.span, message));
            continue;
        }
        let gap = Asked::read(&entry, problems);
        if gaps.insert(number.value as usize, (gap, number.span.clone())).is_some() {
            let message = format!("junction {} stands here twice", number.value);
            problems.push(entry.text.problem(Code::DuplicateName, &number.span, message));
        }
    }
    gaps
}

/// The bounding box of the moving part's corners. In two dimensions they must be an outline that does not cross itself.
fn part<const D: usize>(fields: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> Option<Located<Cuboid<D>>> {
    let corners = corners::<D>(fields, "male", problems)?;
    let span = corners.span.clone();
    if D == 2 {
        let outline: Vec<[f64; 2]> = corners.value.iter().map(|corner| [corner[0], corner[D - 1]]).collect();
        match geometry::bounding_box(&outline) {
            Ok(_) => {}
            Err(error) => {
                problems.push(fields.text.problem(Code::SelfCrossing, &span, error.to_string()));
                return None;
            }
        }
    }
    let mut part = Cuboid::new(*corners.value.first()?, *corners.value.first()?);
    for corner in &corners.value {
        part = part.joined(&Cuboid::new(*corner, *corner));
    }
    Some(Located { value: part, span })
}

fn corners<const D: usize>(
    fields: &Fields<'_, '_>,
    key: &str,
    problems: &mut Vec<Problem>,
) -> Option<Located<Vec<[f64; D]>>> {
    let lists = fields.lists(key, problems)?;
    let mut corners: Vec<[f64; D]> = Vec::new();
    for list in &lists.value {
        if let Ok(corner) = list.value.as_slice().try_into() {
            corners.push(corner);
        } else {
            let axes = if D == 2 { "[x, z]" } else { "[x, y, z]" };
            let message = format!("a corner of `{key}` has {} numbers; expected {axes}", list.value.len());
            problems.push(fields.text.problem(Code::WrongType, &list.span, message));
        }
    }
    let needed = if D == 2 { 3 } else { 2 };
    if corners.len() < needed && corners.len() == lists.value.len() {
        let message = format!("`{key}` has {} corners, and needs {needed} at least", corners.len());
        problems.push(fields.text.problem(Code::FewCorners, &lists.span, message));
        return None;
    }
    (corners.len() == lists.value.len()).then_some(Located { value: corners, span: lists.span })
}

type Channels<const D: usize> = (Vec<Cuboid<D>>, std::ops::Range<usize>);

/// The channels as they are given, or as they are found in the outline of the part around them.
fn channels<const D: usize>(
    fields: &Fields<'_, '_>,
    part: Option<&Located<Cuboid<D>>>,
    problems: &mut Vec<Problem>,
) -> Option<Channels<D>> {
    if fields.get("channels").is_some() || fields.get("female").is_none() {
        if let Some(female) = fields.get("female") {
            let message =
                "`female` and `channels` are both given; the channels follow from the one, or are the other";
            problems.push(fields.text.problem(Code::DuplicateName, &female.span(), message));
        }
        let lists = fields.lists("channels", problems)?;
        let mut channels = Vec::new();
        for list in &lists.value {
            if list.value.len() != 2 * D {
                let axes = if D == 2 { "[x0, z0, x1, z1]" } else { "[x0, y0, z0, x1, y1, z1]" };
                let message = format!("a channel has {} numbers; expected {axes}", list.value.len());
                problems.push(fields.text.problem(Code::WrongType, &list.span, message));
                continue;
            }
            let corner = |from: usize| std::array::from_fn(|axis| list.value[from + axis]);
            channels.push(Cuboid::new(corner(0), corner(D)));
        }
        return (channels.len() == lists.value.len()).then_some((channels, lists.span));
    }
    let outline = corners::<2>(fields, "female", problems)?;
    let part = part?;
    let flat =
        Cuboid::new([part.value.min[0], part.value.min[D - 1]], [part.value.max[0], part.value.max[D - 1]]);
    match geometry::channels_of(&outline.value, &flat) {
        Ok(channels) => {
            // Only a flat world has a female part.
            let same = |corner: [f64; 2]| std::array::from_fn(|axis| corner[axis.min(1)]);
            let channels = channels.iter().map(|channel| Cuboid::new(same(channel.min), same(channel.max)));
            Some((channels.collect(), outline.span))
        }
        Err(error) => {
            let code = if matches!(error, geometry::FemaleError::Outline(_)) {
                Code::SelfCrossing
            } else {
                Code::Impossible
            };
            problems.push(fields.text.problem(code, &outline.span, error.to_string()));
            None
        }
    }
}
