//! Motions in a cell of a site: each is planned for itself, by a planner that knows nothing yet. So a route is the same
//! whatever was asked before, and goes straight where that is free. Experience is what `adit tasks` keeps.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use adit_db::course::Course as Row;
use adit_db::place::Place;
use adit_db::route::{Step, Waypoint};
use adit_planners::adapt::{Adapt, Configuration, Outcome, Plugins, Report, Workcell, distance};
use adit_planners::geometry::Point;

use super::cell::{Cell, Goal};
use super::drawn::drawn_of;
use super::judge::RuleJudge;
use super::session::{Done, out_of_reach, reason};
use crate::draw::render_cell;
use crate::error::{Code, Error, Result};
use crate::plan::course::{Found, NoEnd, Pathfinder, no_map};
use crate::words::number::{counted, number};

/// Where the robot is before its first task.
pub(super) const HOME: &str = "home";

/// What the robot is called.
pub(super) const ROBOT: &str = "robot";

/// A configuration as people write it.
pub(super) fn written(at: &[f64]) -> String {
    let numbers: Vec<String> = at.iter().map(|value| number(*value)).collect();
    numbers.join(", ")
}

/// Motions in a cell as it is.
pub(super) struct Motions {
    cell: Cell,
    workcell: Workcell,
    /// What rules say is done on the way to a goal.
    actions: BTreeMap<String, String>,
    judge: Mutex<RuleJudge>,
}

impl Motions {
    /// Motions in a cell, to the objects of which the robot keeps a margin, metres.
    pub(super) fn new(
        (cell, margin): (Cell, f64),
        actions: BTreeMap<String, String>,
        judge: RuleJudge,
    ) -> Result<Self> {
        let workcell = Workcell::new(cell.robot.robot(), cell.objects.clone(), margin).map_err(no_map)?;
        Ok(Self { cell, workcell, actions, judge: Mutex::new(judge) })
    }

    /// A planner whose robot stands at a configuration, and which knows nothing.
    fn planner(&self, at: Configuration) -> Adapt {
        Adapt::new(self.workcell.clone(), Plugins::standard(), self.cell.settings.clone(), at)
    }

    fn end(&self, text: &str, is_start: bool) -> std::result::Result<Goal, NoEnd> {
        self.cell.goal(text).map_err(|error| NoEnd { is_start, reason: error.to_string() })
    }

    /// Where the robot is at a goal: of the configurations in which its tool is there the nearest to home in which it touches
    /// nothing; where it touches something in each, the nearest.
    fn at(&self, goal: &Goal) -> Option<Configuration> {
        let all = self.cell.configurations(goal);
        let mut planner = self.planner(self.cell.home.clone());
        all.iter().find(|at| planner.is_free(at)).or(all.first()).cloned()
    }

    /// A motion from one end to another, with who planned it: the shorter one of there, and of back by reversal.
    fn motion(&self, ends: [&str; 2]) -> std::result::Result<(Done, Adapt), NoEnd> {
        let (start, goal) = (self.end(ends[0], true)?, self.end(ends[1], false)?);
        let at = [&start, &goal].map(|end| self.at(end));
        let [Some(from), Some(to)] = at.clone() else {
            let lost = if at[0].is_none() { &start } else { &goal };
            let done = Done::none(goal.clone(), Some(out_of_reach(&lost.name)));
            return Ok((done, self.planner(self.cell.home.clone())));
        };
        let mut judge = self.judge.lock().unwrap_or_else(PoisonError::into_inner);
        let mut there = self.planner(from.clone());
        let report = there.task(&to, &mut *judge);
        let mut back = self.planner(to.clone());
        let mut reversed = back.task(&from, &mut *judge);
        reversed.path.reverse();
        let is_shorter = |report: &Report, other: &Report| {
            report.outcome == Outcome::Found
                && (other.outcome != Outcome::Found || report.length < other.length)
        };
        let (adapt, report) = if is_shorter(&reversed, &report) { (back, reversed) } else { (there, report) };
        let reason = reason(&goal.name, &report);
        let done = Done { at: Some(to), report: Some(report), ..Done::none(goal, reason) };
        Ok((done, adapt))
    }

    fn tool(&self, at: &[f64]) -> Point {
        self.cell.robot.robot().tool(at).at
    }
}

impl Pathfinder for Motions {
    fn robots(&self) -> Vec<String> {
        vec![ROBOT.to_owned()]
    }

    fn ends(&self) -> Vec<Place> {
        let home = self.cell.goal(HOME).ok();
        let mut ends: Vec<Place> = (self.cell.goals.iter().cloned().chain(home))
            .map(|end| {
                let at = self.at(&end).map_or(Point::default(), |at| self.tool(&at));
                Place { place: end.name, x: at.x, y: at.y }
            })
            .collect();
        ends.sort_by(|a, b| a.place.cmp(&b.place));
        ends
    }

    fn find(&self, robot: &str, start: &str, goal: &str) -> std::result::Result<Found, NoEnd> {
        let mut row = Row::blank(robot, start, goal);
        let (done, _) = self.motion([start, goal])?;
        match (done.reason, done.report) {
            (None, Some(report)) => {
                (row.steps, row.waypoints) = self.rows(&report.path, goal);
                row.cost = Some(row.steps.last().map_or(0.0, |step| step.cost));
                row.distance = row.waypoints.last().and_then(|point| point.distance);
            }
            (reason, _) => row.reason = reason,
        }
        Ok(Found { row, said: Vec::new() })
    }

    fn find_through(&self, _: &str, _: [&str; 2], through: &str) -> Result<Found> {
        let message =
            format!("motions in a cell lead through nothing that has a name, and not through `{through}`");
        Err(Error::said(Code::WhyThrough, message, None))
    }

    fn picture(&self, title: &str, route: Option<[&str; 3]>) -> std::result::Result<String, NoEnd> {
        let (done, adapt) = match route {
            Some([_, start, goal]) => {
                let (done, adapt) = self.motion([start, goal])?;
                (Some(done).filter(|done| done.reason.is_none()), adapt)
            }
            None => (None, self.planner(self.cell.home.clone())),
        };
        let mut picture = drawn_of(&self.cell, &adapt, done.as_slice());
        title.clone_into(&mut picture.title);
        Ok(render_cell(&picture))
    }

    fn trouble(&self) -> Option<String> {
        let judge = self.judge.lock().unwrap_or_else(PoisonError::into_inner);
        judge.trouble().map(str::to_owned)
    }

    fn summary(&self) -> String {
        let (objects, goals) = (self.cell.objects.len(), self.cell.goals.len());
        format!("{}, {}", counted(objects, "object"), counted(goals, "goal"))
    }
}

impl Motions {
    /// A path as rows: a step and a waypoint for each straight motion. It weighs the distance of its configurations.
    fn rows(&self, path: &[Configuration], goal: &str) -> (Vec<Step>, Vec<Waypoint>) {
        let (mut steps, mut points) = (Vec::new(), Vec::new());
        let (mut cost, mut metres) = (0.0, 0.0);
        let action = self.actions.get(goal).cloned();
        for (place, at) in path.iter().enumerate() {
            let tool = self.tool(at);
            let hardness = place.checked_sub(1).map_or(0.0, |before| distance(&path[before], at));
            metres += place.checked_sub(1).map_or(0.0, |before| self.tool(&path[before]).distance(tool));
            cost += hardness;
            points.push(Waypoint {
                waypoint: place as i64 + 1,
                x: tool.x,
                y: tool.y,
                state: Some(written(at)),
                action: action.clone(),
                distance: Some(metres),
                cost,
                ..Waypoint::default()
            });
            if place == 0 {
                continue;
            }
            let is_last = place + 1 == path.len();
            steps.push(Step {
                step: place as i64,
                kind: "motion".to_owned(),
                place: if is_last { goal.to_owned() } else { format!("by way of {}", written(at)) },
                state: Some(written(at)),
                action: action.clone(),
                hardness: Some(hardness),
                cost,
                x: Some(tool.x),
                y: Some(tool.y),
                ..Step::default()
            });
        }
        (steps, points)
    }
}
