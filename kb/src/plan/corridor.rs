//! A rectangular robot that drives through corridors (Lee, section 5).

use std::sync::Arc;

use adit_planners::channels::corridor::{Corridors, Drive, DriveError, Robot, RouteError, StepFacts};
use adit_planners::geometry::{Point, Rect};
use adit_planners::read::{Code, Fields, Located, Problem};

use super::gap::{Asked, Wanted, refuse_beyond};
use super::refusal::NoPath;
use super::said::{Answer, Said};
use super::turns::Turns;

/// A robot in corridors, and what is asked of its path.
#[derive(Clone, Debug)]
pub struct Corridor {
    pub corridors: Corridors,
    pub robot: Robot,
    pub start: Point,
    /// Where it looks at first, in radians; `None`: along its first line.
    pub heading: Option<f64>,
    pub goal: Point,
    pub wanted: Wanted<1>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Driven {
    pub drive: Drive,
    /// The channels that it takes, by number.
    pub channels: Vec<usize>,
    pub weight: f64,
    pub remarks: Vec<String>,
}

impl Corridor {
    /// The robot's path, by what the rules say of passages and at each junction.
    pub fn plan(&self, turns: &mut Turns) -> Result<Driven, NoPath> {
        self.driven(turns, |_, _| {})
    }

    /// As [`plan`](Self::plan), and what rules said at each junction.
    pub fn explained(&self, turns: &mut Turns) -> Answer<Driven> {
        let mut said = Vec::new();
        let path = self.driven(turns, |turns, junction| {
            let (considered, facts) = (turns.considered(), turns.facts());
            said.push(Said { junction, considered, facts });
        });
        Answer { path, said }
    }

    fn driven(&self, turns: &mut Turns, mut look: impl FnMut(&mut Turns, usize)) -> Result<Driven, NoPath> {
        turns.take_refusals();
        let weigh = |passage: &_| turns.weigh(passage, self.robot, self.wanted.general());
        let route = self.corridors.route(self.start, self.goal, weigh);
        let route = route.map_err(|error| no_route(error, &turns.take_refusals()))?;
        let mut remarks = Vec::new();
        let steer = |facts: &StepFacts| {
            let decided = turns.decide(facts, self.wanted.at(facts.junction));
            look(turns, facts.junction);
            let (steer, remark) = decided?;
            remarks.extend(remark.map(|remark| remark.to_string()));
            Ok(steer)
        };
        let drive = route.drive(self.robot, self.heading, steer).map_err(no_drive)?;
        Ok(Driven { drive, channels: route.channels().to_vec(), weight: route.weight(), remarks })
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

const KEYS: [&str; 5] = ["channels", "robot", "start", "heading", "goal"];

/// Reads `[corridor]`.
pub(super) fn read(fields: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> Option<Corridor> {
    fields.refuse_unknown(&[&KEYS[..], &Wanted::<1>::KEYS].concat(), problems);
    let corridors = corridors(fields, problems);
    let robot = robot(fields, problems);
    let start = end(fields, "start", corridors.as_ref(), problems);
    let goal = end(fields, "goal", corridors.as_ref(), problems);
    let heading = fields.get("heading").and_then(|_| fields.number("heading", problems));
    let wanted = Wanted::read(fields, problems);
    let (corridors, robot, start, goal) = (corridors?, robot?, start?, goal?);
    refuse_beyond(corridors.junctions().len(), fields, problems);
    let heading = heading.map(|degrees| degrees.value.to_radians());
    Some(Corridor { corridors, robot, start, heading, goal, wanted })
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
