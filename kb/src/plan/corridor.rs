//! A rectangular robot that drives through corridors (Lee, section 5).

use std::collections::BTreeSet;
use std::sync::Arc;

use adit_planners::channels::corridor::{
    Corridors, Drive, DriveError, End, Passage, Robot, RouteError, StepFacts, Through,
};
use adit_planners::geometry::{Point, Rect};
use adit_planners::read::{Code, Fields, Located, Problem};

use super::gap::{Asked, Wanted, refuse_beyond};
use super::refusal::{NoPath, Spoke};
use super::said::{Answer, Said};
use super::turns::{Entered, Turns};
use crate::words::number::number;

/// A robot in corridors, and what is asked of its path.
#[derive(Clone, Debug)]
pub struct Corridor {
    pub corridors: Corridors,
    pub robot: Robot,
    pub start: Point,
    /// Where it looks at first, in radians; `None`: along its first line.
    pub heading: Option<f64>,
    pub goal: Point,
    /// Further points that have names.
    pub places: Vec<(String, Point)>,
    /// The channels that are closed, by number.
    pub closed: BTreeSet<usize>,
    pub wanted: Wanted<1>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Driven {
    pub drive: Drive,
    /// The channels that it takes, by number.
    pub channels: Vec<usize>,
    pub weight: f64,
    /// The stretches of these channels, one after the other.
    pub legs: Vec<Leg>,
    pub remarks: Vec<String>,
}

/// A stretch of one channel, up to a junction or the goal.
#[derive(Clone, Debug, PartialEq)]
pub struct Leg {
    pub passage: Passage,
    pub weight: f64,
    /// What the robot does there, and the rule by which it is weighed; where that was asked for and rules say so.
    pub said: (Option<Arc<str>>, Option<Spoke>),
}

impl Corridor {
    /// The robot's path, by what the rules say of passages and at each junction.
    pub fn plan(&self, turns: &mut Turns) -> Result<Driven, NoPath> {
        self.driven(turns, None, |_, _| {})
    }

    /// As [`plan`](Self::plan), and what rules said at each junction; of the ways through a channel or junction where one is
    /// given.
    pub fn explained(&self, turns: &mut Turns, through: Option<Through>) -> Answer<Driven> {
        let mut said = Vec::new();
        let mut path = self.driven(turns, through, |turns, junction| {
            let (considered, facts, action) = (turns.considered(), turns.facts(), turns.action());
            // a junction is asked about again where another gap is tried
            said.retain(|said: &Said| said.junction != junction);
            said.push(Said { junction, considered, facts, action });
        });
        for leg in path.iter_mut().flat_map(|driven| &mut driven.legs) {
            leg.said = turns.driven_in(self.entered(&leg.passage));
        }
        Answer { path, said }
    }

    fn driven(
        &self,
        turns: &mut Turns,
        through: Option<Through>,
        mut look: impl FnMut(&mut Turns, usize),
    ) -> Result<Driven, NoPath> {
        turns.take_refusals();
        let mut weighed: Vec<(Passage, f64)> = Vec::new();
        let weigh = |passage: &Passage| {
            let weight = turns.weigh(self.entered(passage))?;
            weighed.extend(weight.map(|weight| (*passage, weight)));
            Ok(weight)
        };
        let route = self.corridors.route_through(self.start, self.goal, through, weigh);
        let route = route.map_err(|error| no_route(error, &turns.take_refusals()))?;
        // at which junctions the safest gap is driven, since the one that is asked for cannot be kept
        let mut wanted = self.wanted.clone();
        let mut fallen: Vec<(usize, String)> = Vec::new();
        let (drive, mut remarks) = loop {
            let (mut remarks, mut may_fall) = (Vec::new(), BTreeSet::new());
            let steer = |facts: &StepFacts| {
                let decided = turns.decide(facts, wanted.at(facts.junction));
                look(turns, facts.junction);
                let (steer, remark) = decided?;
                if turns.falls_back() {
                    may_fall.insert(facts.junction);
                }
                remarks.extend(remark.map(|remark| remark.to_string()));
                Ok(steer)
            };
            let error = match route.drive(self.robot, self.heading, steer) {
                Ok(drive) => break (drive, remarks),
                Err(error) => error,
            };
            let is_of_gap = matches!(
                error,
                DriveError::InsideCircle { .. }
                    | DriveError::TooNearInnerWall { .. }
                    | DriveError::HitsInTurn { .. }
                    | DriveError::TooNearEachOther { .. }
            );
            let refusal = no_drive(error);
            let junction = refusal.junction.filter(|junction| is_of_gap && may_fall.contains(junction));
            let Some(junction) = junction else { return Err(refusal) };
            fallen.push((
                junction,
                wanted
                    .at(junction)
                    .gap
                    .along(0)
                    .map_or("asked for".to_owned(), |gap| format!("of {} m", number(gap))),
            ));
            wanted.gaps.insert(junction, Asked::Safest);
        };
        for (junction, asked) in fallen {
            let driven = drive.turns.iter().find(|turn| turn.facts.junction == junction);
            let gap = driven.map_or(0.0, |turn| turn.steer.gap);
            let gap = number(gap);
            remarks.push(format!(
                "at junction {junction} the gap {asked} cannot be kept; the safest, {gap} m, is driven"
            ));
        }
        let ends = route.junctions().iter().copied().map(Some).chain([None]);
        let mut from = End::Start;
        let mut legs = Vec::new();
        for (&channel, to) in route.channels().iter().zip(ends) {
            let to = to.map_or(End::Goal, End::Junction);
            let is_it = |(of, _): &&(Passage, f64)| (of.channel, of.from, of.to) == (channel, from, to);
            legs.extend(weighed.iter().find(is_it).map(|(passage, weight)| Leg {
                passage: *passage,
                weight: *weight,
                said: (None, None),
            }));
            from = to;
        }
        let (channels, weight) = (route.channels().to_vec(), route.weight());
        Ok(Driven { drive, channels, weight, legs, remarks })
    }

    fn entered<'p>(&'p self, passage: &'p Passage) -> Entered<'p> {
        let is_closed = self.closed.contains(&passage.channel);
        Entered { passage, robot: self.robot, wishes: self.wanted.general(), is_closed }
    }

    /// The same with another gap everywhere.
    #[must_use]
    pub fn with_gap(&self, gap: Asked<1>) -> Self {
        Self { wanted: self.wanted.with_gap(gap), ..self.clone() }
    }
}

fn no_route(error: RouteError<NoPath>, refusals: &[Arc<str>]) -> NoPath {
    match error {
        RouteError::Weigh(no_path) => no_path,
        other => {
            let reason = std::iter::once(other.to_string()).chain(refusals.iter().map(ToString::to_string));
            NoPath::because(reason.collect::<Vec<_>>().join("; "))
        }
    }
}

fn no_drive(error: DriveError<NoPath>) -> NoPath {
    let junction = match &error {
        DriveError::BadGap { junction, .. }
        | DriveError::NotOnCircle { junction, .. }
        | DriveError::InsideCircle { junction, .. }
        | DriveError::TooNearInnerWall { junction, .. }
        | DriveError::HitsInTurn { junction, .. } => Some(*junction),
        DriveError::TooNearEachOther { first, .. } => Some(*first),
        _ => None,
    };
    match error {
        DriveError::Steer(no_path) => no_path,
        other => NoPath { junction, ..NoPath::because(other.to_string()) },
    }
}

/// What the robot is called.
const ROBOT: &str = "robot";

const KEYS: [&str; 6] = ["channels", "robot", "start", "heading", "goal", "place"];

/// Reads `[corridor]`.
pub(super) fn read(fields: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> Option<Corridor> {
    fields.refuse_unknown(&[&KEYS[..], &Wanted::<1>::KEYS].concat(), problems);
    let corridors = corridors(fields, problems);
    let robot = robot(fields, problems);
    let start = end(fields, "start", corridors.as_ref(), problems);
    let goal = end(fields, "goal", corridors.as_ref(), problems);
    let heading = fields.get("heading").and_then(|_| fields.number("heading", problems));
    let wanted = Wanted::read(ROBOT, fields, problems);
    let places = places(fields, corridors.as_ref(), problems);
    let (corridors, robot, start, goal) = (corridors?, robot?, start?, goal?);
    refuse_beyond(corridors.junctions().len(), fields, problems);
    let heading = heading.map(|degrees| degrees.value.to_radians());
    let closed = BTreeSet::new();
    Some(Corridor { corridors, robot, start, heading, goal, places, closed, wanted })
}

fn corridors(fields: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> Option<Corridors> {
    let lists = fields.lists("channels", problems)?;
    let mut channels = Vec::new();
    for list in &lists.value {
        match list.value.as_slice() {
            [x0, y0, x1, y1] => channels.push(Rect { x0: *x0, y0: *y0, x1: *x1, y1: *y1 }),
            other => {
                let message = format!("a channel has {} numbers; expected [x0, y0, x1, y1]", other.len());
                problems.push(fields.text.problem(Code::WrongType, &list.span, message));
            }
        }
    }
    if channels.len() != lists.value.len() {
        return None;
    }
    Corridors::new(&channels)
        .map_err(|error| {
            problems.push(fields.text.problem(Code::Impossible, &lists.span, error.to_string()));
        })
        .ok()
}

fn robot(fields: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> Option<Robot> {
    let Some(robot) = fields.table("robot", "robot", problems) else {
        if fields.get("robot").is_none() {
            let message = "[corridor] needs a `robot`, as { width = 1.0, length = 1.5 }";
            problems.push(fields.text.problem(Code::MissingKey, &fields.span, message));
        }
        return None;
    };
    robot.refuse_unknown(&["width", "length"], problems);
    let (width, length) = (robot.positive("width", problems), robot.positive("length", problems));
    Some(Robot { width: width?.value, length: length?.value })
}

/// `[[corridor.place]]`: further points that have names.
fn places(
    fields: &Fields<'_, '_>,
    corridors: Option<&Corridors>,
    problems: &mut Vec<Problem>,
) -> Vec<(String, Point)> {
    let mut places: Vec<(String, Point)> = Vec::new();
    for entry in fields.tables("place", "[[place]]", problems) {
        entry.refuse_unknown(&["name", "at"], problems);
        let (name, at) = (entry.string("name", problems), end(&entry, "at", corridors, problems));
        let (Some(name), Some(at)) = (name, at) else { continue };
        if ["start", "goal"].contains(&name.value.as_str())
            || places.iter().any(|(known, _)| *known == name.value)
        {
            let message = format!("two places are called `{}`", name.value);
            problems.push(entry.text.problem(Code::DuplicateName, &name.span, message));
            continue;
        }
        places.push((name.value, at));
    }
    places
}

fn end(
    fields: &Fields<'_, '_>,
    key: &str,
    corridors: Option<&Corridors>,
    problems: &mut Vec<Problem>,
) -> Option<Point> {
    let Located { value: [x, y], span } = fields.numbers::<2>(key, problems)?;
    let point = Point::new(x, y);
    if corridors.is_some_and(|corridors| corridors.at(point).next().is_none()) {
        let message = format!("the {key} ({x}, {y}) lies in no channel");
        problems.push(fields.text.problem(Code::PlaceInWall, &span, message));
        return None;
    }
    Some(point)
}
