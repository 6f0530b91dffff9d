//! A cell as its file describes it: a robot, the objects about it, goals, and what changes.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use adit_planners::adapt::{Arm, Configuration, Object, PointRobot, Robot, Scenario, Settings, distance};
use adit_planners::geometry::Point;
use adit_planners::pose::Pose;

use crate::error::{Code, Error, Result};
use crate::words::number::number;
use crate::words::suggest::did_you_mean;

/// A cell that can be planned in.
#[derive(Clone, Debug)]
pub struct Cell {
    /// Under which its experience is kept.
    pub name: String,
    pub robot: RobotKind,
    pub objects: Vec<Object>,
    /// Where the robot is before its first task.
    pub home: Configuration,
    pub goals: Vec<Goal>,
    /// Of the planner that learns.
    pub settings: Settings,
    /// What changes while tasks are done; a cell of a TOML file changes when the file is edited.
    pub change: Option<Change>,
    pub tasks: usize,
}

#[derive(Clone, Debug)]
pub enum RobotKind {
    Arm(Arc<Arm>),
    /// A disc, or a point, in the plane.
    Point(Arc<PointRobot>),
}

#[derive(Clone, Debug, PartialEq)]
pub struct Goal {
    pub name: String,
    pub target: Target,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Target {
    Configuration(Configuration),
    /// Where the tool is at a pose in the frame of an object, so that the goal goes along with it.
    Tool {
        object: String,
        pose: Pose,
    },
}

/// What changes after a task: objects and goals that are new.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    pub after_task: usize,
    pub objects: Vec<Object>,
    pub goals: Vec<Goal>,
}

impl Goal {
    /// Its configuration, where it is given as one.
    pub const fn configuration(&self) -> Option<&Configuration> {
        match &self.target {
            Target::Configuration(at) => Some(at),
            Target::Tool { .. } => None,
        }
    }
}

/// What stands before its limits in a robot's text.
const JOINTS: &str = " and joints ";
const BOUNDS: &str = " in ";

impl RobotKind {
    /// As planners see it.
    pub fn robot(&self) -> Arc<dyn Robot> {
        match self {
            Self::Arm(arm) => Arc::clone(arm) as Arc<dyn Robot>,
            Self::Point(point) => Arc::clone(point) as Arc<dyn Robot>,
        }
    }

    /// In words and numbers; experience of a robot of which another text is said, but for its limits, is none of this one.
    pub fn text(&self) -> String {
        let limits: Vec<[f64; 2]> =
            self.robot().limits().iter().map(|limit| [limit.low, limit.high]).collect();
        match self {
            Self::Arm(arm) => {
                let (base, lengths, radius) = (arm.base(), arm.lengths(), arm.radius());
                format!(
                    "arm at {:?} with links {lengths:?} of radius {radius}{JOINTS}{limits:?}",
                    [base.x, base.y]
                )
            }
            Self::Point(disc) => {
                let [x, y] = [0, 1].map(|axis| limits[axis]);
                format!("disc of radius {}{BOUNDS}{:?}", disc.radius(), [x[0], y[0], x[1], y[1]])
            }
        }
    }

    /// A robot's text without how far it goes.
    pub fn without_limits(text: &str) -> &str {
        let body = text.rsplit_once(JOINTS).or_else(|| text.rsplit_once(BOUNDS));
        body.map_or(text, |(body, _)| body)
    }

    /// What people call a number of a configuration, from 1.
    pub fn coordinate(&self, number: usize) -> String {
        match (self, number) {
            (Self::Point(_), 1) => "x".to_owned(),
            (Self::Point(_), _) => "y".to_owned(),
            _ => format!("joint {number}"),
        }
    }

    /// Base and joints of an arm, or the one place of a disc.
    pub fn joints(&self, at: &[f64]) -> Vec<Point> {
        match self {
            Self::Arm(arm) => arm.joints(at),
            Self::Point(_) => vec![Point::new(at[0], at[1])],
        }
    }
}

impl Cell {
    /// Why a task is not kept: rows that are there already are another program's.
    pub(super) fn not_kept(&self, error: adit_db::Error) -> Error {
        match error {
            adit_db::Error::Refused { reason, .. } => {
                let message = format!(
                    "another program keeps experience of {} in this database, too: {reason}",
                    self.name
                );
                let help = "what it kept stands; run the task again, one program at a time".to_owned();
                Error::said(Code::PlanTwoPrograms, message, Some(help))
            }
            other => other.into(),
        }
    }

    /// The cell once `tasks` are done: changed, if its change is due by then.
    #[must_use]
    pub fn after(&self, tasks: usize) -> Self {
        let mut cell = self.clone();
        if let Some(change) = cell.change.take_if(|change| tasks >= change.after_task) {
            cell.objects.extend(change.objects);
            cell.goals.extend(change.goals);
        }
        cell
    }

    /// A goal by its name, `home`, or a configuration `a,b,...`.
    pub fn goal(&self, text: &str) -> Result<Goal> {
        if let Some(goal) = self.goals.iter().find(|goal| goal.name == text) {
            return Ok(goal.clone());
        }
        let named =
            |configuration| Goal { name: text.to_owned(), target: Target::Configuration(configuration) };
        if text == "home" {
            return Ok(named(self.home.clone()));
        }
        let numbers: Option<Vec<f64>> = text.split(',').map(|part| part.trim().parse().ok()).collect();
        let robot = self.robot.robot();
        match numbers {
            Some(numbers) if robot.admits(&numbers) => Ok(named(numbers)),
            Some(numbers) => {
                let limits: Vec<String> = robot
                    .limits()
                    .iter()
                    .map(|limit| format!("{} to {}", number(limit.low), number(limit.high)))
                    .collect();
                let within = limits.join(" and ");
                let message = if numbers.len() == limits.len() {
                    format!("`{text}` lies outside of the robot's limits: {within}")
                } else {
                    format!(
                        "`{text}` has {} numbers, and a configuration {}, within {within}",
                        numbers.len(),
                        limits.len()
                    )
                };
                Err(Error::said(Code::PlanConfiguration, message, None))
            }
            None => {
                let names: Vec<&str> = self.goals.iter().map(|goal| goal.name.as_str()).collect();
                let message = format!("`{text}` is no goal of {}, and no configuration `a,b`", self.name);
                let help = did_you_mean(text, names.iter().copied())
                    .or_else(|| Some(format!("goals: {}, home", names.join(", "))));
                Err(Error::said(Code::PlanUnknownGoal, message, help))
            }
        }
    }

    /// The configurations in which the robot is at a goal, the nearest to home first; none where it is out of reach.
    pub fn configurations(&self, goal: &Goal) -> Vec<Configuration> {
        let (object, pose) = match &goal.target {
            Target::Configuration(at) => return vec![at.clone()],
            Target::Tool { object, pose } => (object, pose),
        };
        let Some(object) = self.object(object) else { return Vec::new() };
        let tool = object.pose.then(pose);
        let robot = self.robot.robot();
        let mut found: Vec<Configuration> = Vec::new();
        for at in [0, 1].into_iter().filter_map(|branch| robot.inverse(&tool, branch, &self.home)) {
            if found.iter().all(|known| distance(known, &at) > 1e-9) {
                found.push(at);
            }
        }
        found.sort_by(|a, b| distance(a, &self.home).total_cmp(&distance(b, &self.home)));
        found
    }

    pub fn object(&self, name: &str) -> Option<&Object> {
        self.objects.iter().find(|object| object.name == name)
    }

    /// As an experiment has it; its goals are configurations.
    pub fn scenario(&self) -> Scenario {
        let at = |goals: &[Goal]| goals.iter().filter_map(Goal::configuration).cloned().collect();
        let changed = self.after(usize::MAX);
        Scenario {
            name: self.name.clone(),
            robot: self.robot.robot(),
            objects: self.objects.clone(),
            changed: changed.objects,
            change_after_task: self.change.as_ref().map_or(self.tasks, |change| change.after_task) as u32,
            tasks: self.tasks as u32,
            home: self.home.clone(),
            goals: at(&self.goals),
            added_goals: self.change.as_ref().map_or_else(Vec::new, |change| at(&change.goals)),
        }
    }
}

/// Whether a file is a scenario, and not a world.
pub fn is_scenario(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("json"))
}

/// The name of a cell that its file does not name.
pub(super) fn name_of(path: &Path) -> String {
    PathBuf::from(path).file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned())
}
