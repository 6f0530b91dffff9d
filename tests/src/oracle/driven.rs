//! A route as the program tells it, read from its JSON.

use adit_planners::geometry::Point;
use serde_json::Value;

use super::body::Body;
use super::way::Way;

/// A route as told.
#[derive(Clone, Debug)]
pub struct Driven {
    /// What the program says it costs.
    pub cost: f64,
    /// The way that it says to drive.
    pub way: Way,
    /// What about its waypoints cannot be right.
    pub faults: Vec<String>,
    /// The answer itself.
    pub json: Value,
}

impl Driven {
    /// Reads an answer of `route --json`.
    #[track_caller]
    pub fn read(json: &Value, start: Point, body: &Body) -> Self {
        let cost = json["cost"].as_f64().unwrap_or_else(|| panic!("no cost in {json:#}"));
        let mut way = Way { points: vec![start], states: Vec::new() };
        for step in json["steps"].as_array().expect("steps").iter().filter(|step| step["kind"] == "room") {
            let (Some(x), Some(y)) = (step["x"].as_f64(), step["y"].as_f64()) else {
                panic!("no point in {step}")
            };
            let state =
                step["state"].as_str().and_then(|state| body.index(state)).expect("a state of the robot");
            way.points.push(Point::new(x, y));
            way.states.push(state);
        }
        Self { cost, way, faults: Vec::new(), json: json.clone() }
    }
}
