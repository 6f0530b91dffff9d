//! Routes as the service answers them; what is used of them.

use serde::Deserialize;

/// A route, or why there is none.
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
pub struct Route {
    pub status: String,
    #[serde(default)]
    pub start: String,
    #[serde(default)]
    pub goal: String,
    #[serde(default)]
    pub reason: Option<String>,
    #[serde(default)]
    pub cost: Option<f64>,
    #[serde(default)]
    pub distance: Option<f64>,
    /// Where no state fits at an end: the nearest point at which one does.
    #[serde(default)]
    pub nearest: Option<Nearest>,
    #[serde(default)]
    pub steps: Vec<Step>,
    #[serde(default)]
    pub waypoints: Vec<Waypoint>,
}

/// Where a robot fits instead of where it was to start or end.
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
pub struct Nearest {
    /// `start` or `goal`.
    pub end: String,
}

/// A room that is crossed, or a door that is passed.
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
pub struct Step {
    #[serde(default)]
    pub x: Option<f64>,
    #[serde(default)]
    pub y: Option<f64>,
    #[serde(default)]
    pub space: Option<String>,
    #[serde(default)]
    pub doorway: Option<String>,
}

/// Where the way bends, changes shape, starts or ends.
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
pub struct Waypoint {
    pub x: f64,
    pub y: f64,
    #[serde(default)]
    pub state: Option<String>,
    /// How the robot moves on the way there.
    #[serde(default)]
    pub action: Option<String>,
    /// In which direction it comes there, degrees counterclockwise from +x; none at the start.
    #[serde(default)]
    pub heading: Option<f64>,
    /// How the body lies on the way there, degrees.
    #[serde(default)]
    pub facing: Option<f64>,
    #[serde(default)]
    pub clearance: Option<f64>,
}

/// What whoever follows a route hears.
#[derive(Clone, Debug, Deserialize, PartialEq)]
pub struct Followed {
    pub follower: String,
    pub words: String,
    pub route: Route,
}

impl Route {
    /// Whether there is a way.
    pub fn leads(&self) -> bool {
        matches!(self.status.as_str(), "ok" | "same_room")
    }
}
