//! One vehicle and what is decided for it, without a broker and without a site.

use adit_fleet::driver::{Clock, Driver, Effect, World};
use adit_fleet::site::{Fleet, Route, Vehicle, Waypoint};
use adit_fleet::way::Margins;
use adit_fleet::wire;
use serde_json::{Value, json};

use crate::messages::fleet;

/// A vehicle that is to go to `gate`, and what follows of what it says.
pub struct Alone {
    pub driver: Driver,
    pub fleet: Fleet,
    /// What it says next.
    pub state: Value,
    pub doing: String,
    pub log: Vec<String>,
    pub orders: Vec<Value>,
    pub writes: Vec<(&'static str, Value)>,
    pub follows: Option<(u64, [f64; 2])>,
    seconds: f64,
}

impl Alone {
    pub fn new() -> Self {
        let fleet = fleet();
        let columns = ["doing", "battery", "localized", "errors", "connection"];
        let written = columns.map(|column| (column.to_owned(), Value::Null)).into();
        let row = Vehicle { goal: Some("gate".to_owned()), written, ..fleet.vehicles[0].clone() };
        let state = json!({
            "version": "2.1.0", "orderId": "", "orderUpdateId": 0, "lastNodeId": "", "lastNodeSequenceId": 0,
            "nodeStates": [], "edgeStates": [], "driving": false, "actionStates": [], "errors": [],
            "batteryState": {"batteryCharge": 80, "charging": false}, "operatingMode": "AUTOMATIC", "paused": false,
            "safetyState": {"eStop": "NONE", "fieldViolation": false},
            "agvPosition": {"x": 1.0, "y": 1.0, "theta": 0.0, "mapId": "m", "positionInitialized": true},
        });
        Self {
            driver: Driver::new(row),
            fleet,
            state,
            doing: String::new(),
            log: Vec::new(),
            orders: Vec::new(),
            writes: Vec::new(),
            follows: None,
            seconds: 0.0,
        }
    }

    /// It says its state, and a second goes by; what follows.
    pub fn says(&mut self) -> Vec<Effect> {
        self.driver.reported(wire::state(self.state.to_string().as_bytes()).unwrap());
        self.thinks()
    }

    pub fn thinks(&mut self) -> Vec<Effect> {
        self.seconds += 1.0;
        let clock = Clock { seconds: self.seconds, words: "2026-11-24T08:00:00.000Z".to_owned() };
        let margins = Margins { before: 0.3, ahead: 3.0 };
        let world = World {
            fleet: &self.fleet,
            margins: &margins,
            bridges: &[],
            areas: &[],
            bounds: Some([-20.0, -20.0, 20.0, 20.0]),
            map: "m",
            clock: &clock,
        };
        let effects = self.driver.think(&world);
        for effect in &effects {
            match effect {
                Effect::Say(words) => self.log.push(words.clone()),
                Effect::Send { topic: "order", message, .. } => self.orders.push(message.clone()),
                Effect::Follow { epoch, start, .. } => self.follows = Some((*epoch, *start)),
                Effect::Moved { at } => self.follows = self.follows.map(|(epoch, _)| (epoch, *at)),
                Effect::Write { column, value } => {
                    if *column == "doing" {
                        value.as_str().unwrap().clone_into(&mut self.doing);
                    }
                    self.writes.push((column, value.clone()));
                }
                _ => {}
            }
        }
        effects
    }

    /// The way that it asked for leads along these points.
    pub fn led(&mut self, points: &[[f64; 2]]) {
        let (epoch, [x, y]) = self.follows.unwrap();
        let waypoints = points.iter().map(|at| Waypoint {
            x: at[0],
            y: at[1],
            state: Some("LOW".to_owned()),
            clearance: Some(0.05),
            ..Waypoint::default()
        });
        let route = Route {
            status: "ok".to_owned(),
            start: format!("{x},{y}"),
            goal: "gate".to_owned(),
            waypoints: waypoints.collect(),
            ..Route::default()
        };
        self.driver.routed(epoch, route);
    }

    /// It takes its order, and stands at its first node.
    pub fn takes_its_order(&mut self) {
        let order = self.orders.last().unwrap().clone();
        for key in ["orderId", "orderUpdateId"] {
            self.state[key] = order[key].clone();
        }
        let nodes = order["nodes"].as_array().unwrap();
        self.state["lastNodeId"] = nodes[0]["nodeId"].clone();
        self.state["nodeStates"] =
            nodes[1..].iter().map(|node| json!({"sequenceId": node["sequenceId"]})).collect();
    }
}
