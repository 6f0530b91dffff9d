//! Scenarios of arms as the files of the peers have them.

use std::sync::Arc;

use adit_planners::adapt::{Arm, ArmError, Configuration, Limit, Object, Robot, Scenario, Shape, ShapeError};
use adit_planners::geometry::Point;
use serde::Deserialize;

/// A scenario of an arm as its file has it; lengths in metres, angles in radians. Other fields are left to others.
#[derive(Clone, Debug, Deserialize, PartialEq)]
pub struct ArmScenario {
    pub name: String,
    pub links: Vec<f64>,
    pub link_radius: f64,
    pub base: [f64; 2],
    /// Low and high limit of each joint.
    pub joint_limits: Vec<[f64; 2]>,
    /// Whether angles wrap: not supported, so it has to be false.
    pub wrap: bool,
    /// Corners of the objects.
    pub obstacles: Vec<Vec<[f64; 2]>>,
    /// Corners of the object that comes with the change, where only one comes.
    #[serde(default)]
    pub added_obstacle: Option<Vec<[f64; 2]>>,
    /// Corners of the others that come with it.
    #[serde(default)]
    pub added_obstacles: Vec<Vec<[f64; 2]>>,
    pub change_after_task: u32,
    pub tasks: u32,
    pub home: Configuration,
    pub goals: Vec<Configuration>,
    /// The goal that comes with the change, where only one comes.
    #[serde(default)]
    pub added_goal: Option<Configuration>,
    /// The others that come with it.
    #[serde(default)]
    pub added_goals: Vec<Configuration>,
}

/// What is wrong with a scenario. Obstacles and goals are numbered from 0.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ScenarioError {
    #[error(transparent)]
    Arm(#[from] ArmError),
    #[error("obstacles[{0}]: {1}")]
    Obstacle(usize, ShapeError),
    /// An obstacle that is added has no outline; `added_obstacle` counts before `added_obstacles`.
    #[error("added obstacle {0}: {1}")]
    AddedObstacle(usize, ShapeError),
    #[error("wrap is true, and only joints that do not wrap are known")]
    Wrap,
    #[error("{0} is {1:?}, which is no configuration of the arm: {2}")]
    Configuration(String, Configuration, &'static str),
    #[error("there are {0} goals, and two are needed at least")]
    Goals(usize),
}

impl TryFrom<&ArmScenario> for Scenario {
    type Error = ScenarioError;

    fn try_from(file: &ArmScenario) -> Result<Self, ScenarioError> {
        if file.wrap {
            return Err(ScenarioError::Wrap);
        }
        let limits = file.joint_limits.iter().map(|&[low, high]| Limit { low, high }).collect();
        let arm =
            Arm::new(Point::new(file.base[0], file.base[1]), file.links.clone(), file.link_radius, limits)?;
        let goals =
            (0..).zip(&file.goals).map(|(number, goal): (usize, _)| (format!("goals[{number}]"), goal));
        let added_goals: Vec<Configuration> =
            file.added_goal.iter().chain(&file.added_goals).cloned().collect();
        let added =
            (0..).zip(&added_goals).map(|(number, goal): (usize, _)| (format!("added goal {number}"), goal));
        for (name, at) in [("home".to_owned(), &file.home)].into_iter().chain(goals).chain(added) {
            let why = match at.len() == file.links.len() {
                true if arm.admits(at) => continue,
                true => "a joint is beyond its limits",
                false => "it needs an angle for each joint",
            };
            return Err(ScenarioError::Configuration(name, at.clone(), why));
        }
        if file.goals.len() < 2 {
            return Err(ScenarioError::Goals(file.goals.len()));
        }
        let mut objects = Vec::new();
        for (number, corners) in file.obstacles.iter().enumerate() {
            let shape = shape(corners).map_err(|error| ScenarioError::Obstacle(number, error))?;
            objects.push(Object::fixed(format!("obstacle {number}"), shape));
        }
        let mut changed = objects.clone();
        for (number, corners) in file.added_obstacle.iter().chain(&file.added_obstacles).enumerate() {
            let shape = shape(corners).map_err(|error| ScenarioError::AddedObstacle(number, error))?;
            changed.push(Object::fixed(format!("added obstacle {number}"), shape));
        }
        Ok(Self {
            name: file.name.clone(),
            robot: Arc::new(arm),
            objects,
            changed,
            change_after_task: file.change_after_task,
            tasks: file.tasks,
            home: file.home.clone(),
            goals: file.goals.clone(),
            added_goals,
        })
    }
}

fn shape(corners: &[[f64; 2]]) -> Result<Shape, ShapeError> {
    Shape::new(corners.iter().map(|&[x, y]| Point::new(x, y)).collect())
}
