//! A part that is taken out of another through channels (Lee, sections 2 to 4).

use adit_planners::channels::assembly::{self as geometry, Cuboid, Decision, PartPath, PathError};
use adit_planners::read::{Code, Fields, Located, Problem};

use super::gap::{Wanted, refuse_beyond};
use super::refusal::NoPath;
use super::said::{Answer, Said};
use super::steps::Steps;

/// What the part that moves is called.
const PART: &str = "part";

/// A part in channels, and what is asked of its path.
#[derive(Clone, Debug)]
pub struct Assembly<const D: usize> {
    pub geometry: geometry::Assembly<D>,
    pub wanted: Wanted<D>,
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
        self.path(|facts| steps.decide(facts, self.wanted.at(facts.number)))
    }

    /// As [`plan`](Self::plan), and what rules said at each junction.
    pub fn explained(&self, steps: &mut Steps) -> Answer<PartPath<D>> {
        let mut said = Vec::new();
        let path = self.path(|facts| {
            let decision = steps.decide(facts, self.wanted.at(facts.number));
            let (considered, facts_said, action) = (steps.considered(), steps.facts(), steps.action());
            let place = format!("junction {}", facts.number);
            said.push(Said { junction: facts.number, place, considered, facts: facts_said, action });
            decision
        });
        Answer { path, said }
    }

    fn path(
        &self,
        decide: impl FnMut(&geometry::StepFacts<D>) -> Result<Decision<D>, NoPath>,
    ) -> Result<PartPath<D>, NoPath> {
        self.geometry.disassemble(self.displacement, decide).map_err(|error| no_path(&error))
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
    NoPath { junction, ..NoPath::because(error.to_string()) }
}

const KEYS: [&str; 6] = ["channels", "female", "male", "moves", "displacement", "base"];

/// Whether `[assembly]` is in three dimensions: its channels are boxes of six numbers.
pub(super) fn is_solid(fields: &Fields<'_, '_>) -> bool {
    let lists = fields.get("channels").and_then(|_| fields.lists("channels", &mut Vec::new()));
    lists.and_then(|lists| Some(lists.value.first()?.value.len() == 6)).unwrap_or_default()
}

/// Reads `[assembly]`.
pub(super) fn read<const D: usize>(
    fields: &Fields<'_, '_>,
    problems: &mut Vec<Problem>,
) -> Option<Assembly<D>> {
    fields.refuse_unknown(&[&KEYS[..], &Wanted::<D>::KEYS].concat(), problems);
    let wanted = Wanted::read(PART, fields, problems);
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
    refuse_beyond(geometry.junctions().len(), fields, problems);
    let (displacement, base) = (displacement.map(|found| found.value), base.map(|found| found.value));
    Some(Assembly { geometry, wanted, female_moves, displacement, base })
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
