//! One vehicle and what is decided for it, without a broker and without a site.

use adit_fleet::driver::{Clock, Driver, Effect, World};
use adit_fleet::site::{Fleet, Vehicle};
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
    pub writes: Vec<(&'static str, Value)>,
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
        Self { driver: Driver::new(row), fleet, state, writes: Vec::new(), seconds: 0.0 }
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
            map: "m",
            clock: &clock,
        };
        let effects = self.driver.think(&world);
        for effect in &effects {
            if let Effect::Write { column, value } = effect {
                self.writes.push((column, value.clone()));
            }
        }
        effects
    }
}
