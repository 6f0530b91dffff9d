//! Answers to "how do I get from here to there": from the kept routes, or computed where none is kept.

mod basis;
mod course;
mod ends;
mod json;
mod moment;
pub(crate) mod reason;
pub(crate) mod scene;
mod search;
mod steps;
mod taken;

use adit_db::Tx;
use adit_db::measure::Measures;
use adit_db::route::{Step, Waypoint};
use serde::Serialize;

use crate::error::{Code, Error, Nearest, Result};
use crate::words::suggest::{did_you_mean, listed};

pub(crate) use basis::{Basis, Ground};
pub(crate) use moment::Moment;

/// What became of the question. Never an empty answer without a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, utoipa::ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    /// There is a route.
    Ok,
    /// Start and goal lie in the same room: no door is passed.
    SameRoom,
    /// No route; the answer says why.
    NoRoute,
    /// The start is no place, space, room or point of the map.
    UnknownStart,
    /// The goal is no place, space, room or point of the map.
    UnknownGoal,
}

impl Status {
    /// What is wrong with the question; `None` where it has an answer.
    pub fn code(self) -> Option<Code> {
        match self {
            Self::UnknownStart => Some(Code::RouteUnknownStart),
            Self::UnknownGoal => Some(Code::RouteUnknownGoal),
            Self::Ok | Self::SameRoom | Self::NoRoute => None,
        }
    }
}

/// A route with its steps, or why there is none.
#[derive(Clone, Debug, PartialEq, Serialize, utoipa::ToSchema)]
pub struct Answer {
    /// What became of the question.
    pub status: Status,
    /// Whose route.
    pub robot: String,
    /// From where.
    pub start: String,
    /// Where to.
    pub goal: String,
    /// The state of the knowledge base that the answer rests on.
    pub generation: u64,
    /// Total hardness.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cost: Option<f64>,
    /// Metres; only where rooms weigh them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub distance: Option<f64>,
    /// What all of it takes of each measure that rules say: `seconds`, `joules`; none of which something on the way is not known.
    #[serde(skip_serializing_if = "Measures::is_empty")]
    pub measures: Measures,
    /// Why there is no route, or which name is unknown.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// Beside a start or goal that was refused, the nearest point from which ways lead on.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub nearest: Option<Nearest>,
    /// The points that were taken instead of a start or goal that would have been refused.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub taken: Vec<Nearest>,
    /// What is worth a look, in sentences.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub remarks: Vec<String>,
    /// The rows of `action_sequence`.
    pub steps: Vec<Step>,
    /// The rows of `waypoints`: where the way bends, changes shape, starts and ends.
    pub waypoints: Vec<Waypoint>,
}

impl Answer {
    /// What the way to its last waypoint takes.
    pub(crate) fn at_the_end(&self) -> Measures {
        self.waypoints.last().map(|point| point.measures.clone()).unwrap_or_default()
    }

    /// An answer of which no more is known than the question.
    pub(crate) fn blank(robot: &str, start: &str, goals: &[String], generation: u64) -> Self {
        Self {
            status: Status::Ok,
            robot: robot.to_owned(),
            start: start.to_owned(),
            goal: goals.join(" "),
            generation,
            cost: None,
            distance: None,
            measures: Measures::default(),
            reason: None,
            nearest: None,
            taken: Vec::new(),
            remarks: Vec::new(),
            steps: Vec::new(),
            waypoints: Vec::new(),
        }
    }
}

/// The robot that is meant, or the only one.
pub(crate) fn pick_robot(tx: &mut Tx<'_>, wanted: Option<&str>) -> Result<String> {
    let mut robots: Vec<String> = tx.states()?.into_iter().map(|state| state.robot).collect();
    robots.dedup();
    pick(&robots, wanted)
}

/// The robot of these that is meant, or the only one.
pub(crate) fn pick(robots: &[String], wanted: Option<&str>) -> Result<String> {
    match wanted {
        Some(name) if robots.iter().any(|robot| robot == name) => Ok(name.to_owned()),
        Some(name) => {
            let known = || robots.iter().map(String::as_str);
            let help = did_you_mean(name, known()).or_else(|| listed("robots", known()));
            Err(Error::said(Code::RouteUnknownRobot, format!("there is no robot `{name}`"), help))
        }
        None if robots.len() > 1 => {
            let message = format!("the site has several robots; say which one: {}", robots.join(", "));
            Err(Error::said(Code::RouteWhichRobot, message, None))
        }
        None => robots.first().cloned().ok_or_else(|| {
            Error::said(
                Code::RouteUnbuilt,
                "the site has no robot yet",
                Some("run `adit build` first; a site without a map has none".to_owned()),
            )
        }),
    }
}
