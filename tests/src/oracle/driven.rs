//! A route as the program tells it, read from its JSON.

use adit_planners::geometry::Point;
use serde_json::Value;

use super::body::Body;
use super::space::Space;
use super::way::Way;

/// How far two tellings of one length or cost may differ, as a part of it: what JSON and sums lose.
const ROUNDING: f64 = 1e-6;
/// Degrees by which a heading may differ: they are told in hundredths.
const HEADING: f64 = 0.011;
/// Metres by which a clearance may differ.
const CLEARANCE: f64 = 1e-3;
/// Clearances above this are not looked at, metres: the judge measures no further.
const FAR: f64 = 0.25;

/// A route as told.
#[derive(Clone, Debug)]
pub struct Driven {
    /// What the program says it costs.
    pub cost: f64,
    /// The way that it says to drive: its waypoints.
    pub way: Way,
    /// The way room by room: its steps.
    pub steps: Way,
    /// The answer itself.
    pub json: Value,
}

impl Driven {
    /// Reads an answer of `route --json`.
    #[track_caller]
    pub fn read(json: &Value, start: Point, body: &Body) -> Self {
        let cost = json["cost"].as_f64().unwrap_or_else(|| panic!("no cost in {json:#}"));
        let rows = |name: &str| json[name].as_array().cloned().unwrap_or_default();
        let rooms: Vec<Value> = rows("steps").into_iter().filter(|step| step["kind"] == "room").collect();
        let steps = way(start, &rooms, body);
        let waypoints = rows("waypoints");
        let way = match waypoints.split_first() {
            Some((first, rest)) => way(point(first), rest, body),
            None => steps.clone(),
        };
        Self { cost, way, steps, json: json.clone() }
    }

    /// What its rows say that cannot be right.
    pub fn faults(&self, space: &Space) -> Vec<String> {
        let mut faults = self.faults_of_steps();
        let waypoints = self.json["waypoints"].as_array().map_or(&[][..], Vec::as_slice);
        let same = |said: f64, is: f64| (said - is).abs() <= ROUNDING * is.abs().max(1.0);
        let (mut distance, mut cost) = (0.0, 0.0);
        for (index, row) in waypoints.iter().enumerate() {
            let number = index + 1;
            let told = |name: &str| row[name].as_f64();
            if let Some(piece) = index.checked_sub(1).and_then(|index| self.way.pieces().nth(index)) {
                let length = piece.from.distance(piece.to);
                distance += length;
                cost += space.weigh(piece.state, piece.from, piece.to);
                if let Some(&next) = self.way.states.get(index).filter(|&&next| next != piece.state) {
                    cost += space.body().change(piece.state, next);
                }
                let heading = (piece.to.y - piece.from.y).atan2(piece.to.x - piece.from.x).to_degrees();
                let off = told("heading").map(|said| (said - heading + 180.0).rem_euclid(360.0) - 180.0);
                if length > 1e-3 && off.is_none_or(|off| off.abs() > HEADING) {
                    faults.push(format!("waypoint {number}: heads {}, is {heading}", row["heading"]));
                }
                let spare = space.spare(piece.state, piece.from, piece.to).max(0.0);
                let off = told("clearance").map(|said| said.min(FAR) - spare.min(FAR));
                if off.is_none_or(|off| off.abs() > CLEARANCE) {
                    faults.push(format!("waypoint {number}: clear by {}, is {spare}", row["clearance"]));
                }
                let state = &space.body().states[piece.state].name;
                if row["action"] != state.as_str() {
                    faults.push(format!("waypoint {number}: {} in state {state}", row["action"]));
                }
            }
            for (name, is) in [("waypoint", number as f64), ("distance", distance), ("cost", cost)] {
                if !told(name).is_some_and(|said| same(said, is)) {
                    faults.push(format!("waypoint {number}: {name} {}, is {is}", row[name]));
                }
            }
        }
        faults
    }

    fn faults_of_steps(&self) -> Vec<String> {
        let steps = self.json["steps"].as_array().map_or(&[][..], Vec::as_slice);
        let total: f64 = steps.iter().filter_map(|step| step["hardness"].as_f64()).sum();
        let last = steps.last().and_then(|step| step["cost"].as_f64()).unwrap_or(0.0);
        let wrong = |said: f64| (said - self.cost).abs() > ROUNDING * self.cost.max(1.0);
        let mut faults = Vec::new();
        if wrong(total) || wrong(last) {
            faults.push(format!("costs {}, its steps {total}, the last of them {last}", self.cost));
        }
        faults
    }
}

fn point(row: &Value) -> Point {
    let number = |name: &str| row[name].as_f64().unwrap_or_else(|| panic!("no {name} in {row}"));
    Point::new(number("x"), number("y"))
}

/// The way over rows that say where a piece ends, and in which state it is driven.
fn way(start: Point, rows: &[Value], body: &Body) -> Way {
    let state = |row: &Value| row["state"].as_str().and_then(|state| body.index(state));
    Way {
        points: std::iter::once(start).chain(rows.iter().map(point)).collect(),
        states: rows.iter().map(|row| state(row).unwrap_or_else(|| panic!("no state in {row}"))).collect(),
    }
}
