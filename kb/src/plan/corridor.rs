//! A rectangular robot that drives through corridors (Lee, section 5).

use std::collections::BTreeSet;
use std::sync::Arc;

use adit_planners::channels::corridor::{
    Corridors, Drive, DriveError, End, NoRoute, Passage, Robot, Route, RouteError, StepFacts, Through,
};
use adit_planners::geometry::{Point, Rect};
use adit_planners::read::{Code, Fields, Located, Problem};

use super::gap::{Asked, Wanted, refuse_beyond};
use super::refusal::NoPath;
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
    /// What rules were told of it and what they said, where that was asked for.
    pub said: Option<Said>,
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
            let place = format!("junction {junction}");
            said.retain(|said: &Said| said.place != place);
            said.push(Said { junction, place, considered, facts, action });
        });
        for leg in path.iter_mut().flat_map(|driven| &mut driven.legs) {
            let leg_said = turns.driven_in(self.entered(&leg.passage));
            said.push(leg_said.clone());
            leg.said = Some(leg_said);
        }
        Answer { path, said }
    }

    /// The way of least weight that can be driven: where geometry refuses one, the search goes on without the stretch that it
    /// fails behind.
    fn driven(
        &self,
        turns: &mut Turns,
        through: Option<Through>,
        mut look: impl FnMut(&mut Turns, usize),
    ) -> Result<Driven, NoPath> {
        let mut left_out: BTreeSet<(usize, End)> = BTreeSet::new();
        let mut first: Option<NoPath> = None;
        loop {
            turns.take_refusals();
            let mut weighed: Vec<(Passage, f64)> = Vec::new();
            let weigh = |passage: &Passage| {
                if left_out.contains(&(passage.channel, passage.to)) {
                    return Ok(None);
                }
                let weight = turns.weigh(self.entered(passage));
                weighed.extend(weight.map(|weight| (*passage, weight)));
                Ok(weight)
            };
            let route = match self.corridors.route_through(self.start, self.goal, through, weigh) {
                Ok(route) => route,
                Err(error) => return Err(first.unwrap_or_else(|| no_route(error, &turns.take_refusals()))),
            };
            let legs = legs(&route, &weighed);
            match self.on(&route, turns, &mut look) {
                Ok((drive, mut remarks)) => {
                    let other = first
                        .iter()
                        .map(|refusal| format!("the way of least weight cannot be driven: {refusal}"));
                    remarks.extend(other);
                    let (channels, weight) = (route.channels().to_vec(), route.weight());
                    return Ok(Driven { drive, channels, weight, legs, remarks });
                }
                Err((refusal, behind)) => {
                    let failed = behind.and_then(|end| legs.iter().find(|leg| leg.passage.to == end));
                    let is_new =
                        failed.is_some_and(|leg| left_out.insert((leg.passage.channel, leg.passage.to)));
                    let first = first.get_or_insert(refusal);
                    if !is_new {
                        return Err(first.clone());
                    }
                }
            }
        }
    }

    /// Drives along a route, at some junctions with the safest gap where the one that is asked for cannot be kept; with the
    /// drive, what is worth a remark. An error says at the end of which stretch it fails.
    fn on(
        &self,
        route: &Route<'_>,
        turns: &mut Turns,
        look: &mut impl FnMut(&mut Turns, usize),
    ) -> Result<(Drive, Vec<String>), (NoPath, Option<End>)> {
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
            let on_line = match &error {
                DriveError::HitsOnLine { to, .. } => Some(*to),
                DriveError::TooNearEachOther { second, .. } => Some(End::Junction(*second)),
                _ => None,
            };
            let refusal = no_drive(error);
            let junction = refusal.junction.filter(|junction| is_of_gap && may_fall.contains(junction));
            let Some(junction) = junction else {
                let behind = on_line.or_else(|| refusal.junction.map(End::Junction));
                return Err((refusal, behind));
            };
            let gap = wanted.at(junction).gap.along(0);
            fallen
                .push((junction, gap.map_or("asked for".to_owned(), |gap| format!("of {} m", number(gap)))));
            wanted.gaps.insert(junction, Asked::Safest);
        };
        for (junction, asked) in fallen {
            let driven = drive.turns.iter().find(|turn| turn.facts.junction == junction);
            let gap = number(driven.map_or(0.0, |turn| turn.steer.gap));
            remarks.push(format!(
                "at junction {junction} the gap {asked} cannot be kept; the safest, {gap} m, is driven"
            ));
        }
        Ok((drive, remarks))
    }

    fn entered<'p>(&'p self, passage: &'p Passage) -> Entered<'p> {
        let is_closed = self.closed.contains(&passage.channel);
        Entered { passage, robot: self.robot, wishes: self.wanted.general(), is_closed }
    }
}

/// The stretches of a route, with what they weigh.
fn legs(route: &Route<'_>, weighed: &[(Passage, f64)]) -> Vec<Leg> {
    let ends = route.junctions().iter().copied().map(End::Junction).chain([End::Goal]);
    let mut from = End::Start;
    let mut legs = Vec::new();
    for (&channel, to) in route.channels().iter().zip(ends) {
        let is_it = |(of, _): &&(Passage, f64)| (of.channel, of.from, of.to) == (channel, from, to);
        let known = weighed.iter().find(is_it);
        legs.extend(known.map(|(passage, weight)| Leg { passage: *passage, weight: *weight, said: None }));
        from = to;
    }
    legs
}

fn no_route(error: RouteError<NoPath>, refusals: &[Arc<str>]) -> NoPath {
    match error {
        RouteError::Weigh(no_path) => no_path,
        other => {
            // the cause first, and only it where rules name one
            let causes: Vec<String> = refusals.iter().map(ToString::to_string).collect();
            let passages = match &other {
                RouteError::NoRoute(NoRoute::Refused(passages)) => passages.len(),
                _ => 0,
            };
            NoPath::because(match (causes.is_empty(), passages) {
                (true, _) => other.to_string(),
                (false, 0..=2) => format!("{other}; {}", causes.join("; ")),
                (false, _) => causes.join("; "),
            })
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
        let what = if key == "at" { "place" } else { key };
        let message = format!("the {what} ({x}, {y}) lies in no channel");
        problems.push(fields.text.problem(Code::PlaceInWall, &span, message));
        return None;
    }
    Some(point)
}
