//! Zones, which vehicles know from version 3.0 on.

use serde_json::{Map, Value, json};

use super::said::{Addressee, Blocking, object, radians};
use crate::site::ZoneMeaning;

/// All zones of a map.
#[derive(Clone, Debug, PartialEq)]
pub struct ZoneSet {
    pub id: String,
    pub map: String,
    pub zones: Vec<Zone>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Zone {
    pub id: String,
    /// Metres, in the frame of the map.
    pub corners: Vec<[f64; 2]>,
    pub meaning: ZoneMeaning,
}

impl Addressee {
    /// The zones as this vehicle reads them.
    pub fn zone_set(&self, set: &ZoneSet, number: u32, at: &str) -> Value {
        let mut message = self.head(number, at);
        let zones: Vec<Value> = set.zones.iter().map(|zone| Value::Object(zone.message(self))).collect();
        message.insert("zoneSet".to_owned(), json!({"mapId": set.map, "zoneSetId": set.id, "zones": zones}));
        Value::Object(message)
    }
}

impl Zone {
    fn message(&self, to: &Addressee) -> Map<String, Value> {
        let vertices: Vec<Value> = self.corners.iter().map(|[x, y]| json!({"x": x, "y": y})).collect();
        let (kind, said) = match &self.meaning {
            ZoneMeaning::Blocked => ("BLOCKED", json!({})),
            ZoneMeaning::SpeedLimit(speed) => ("SPEED_LIMIT", json!({"maximumSpeed": speed})),
            ZoneMeaning::Penalty(factor) => ("PENALTY", json!({"penaltyFactor": factor})),
            ZoneMeaning::Priority(factor) => ("PRIORITY", json!({"priorityFactor": factor})),
            ZoneMeaning::Directed(degrees, limit) => {
                ("DIRECTED", json!({"direction": radians(*degrees), "directedLimitation": limit}))
            }
            ZoneMeaning::Bidirected(degrees, limit) => {
                ("BIDIRECTED", json!({"direction": radians(*degrees), "bidirectedLimitation": limit}))
            }
            ZoneMeaning::LineGuided => ("LINE_GUIDED", json!({})),
            ZoneMeaning::Action(action, blocking) => {
                let blocking = blocking.as_deref().and_then(Blocking::read).unwrap_or(Blocking::Hard);
                let action = json!({"actionType": action, "blockingType": blocking.word(to.version)});
                ("ACTION", json!({"entryActions": [action], "duringActions": [], "exitActions": []}))
            }
        };
        let mut zone = object([
            ("zoneId", json!(self.id)),
            ("zoneType", json!(kind)),
            ("zoneDescriptor", json!(self.id)),
            ("vertices", json!(vertices)),
        ]);
        if let Value::Object(said) = said {
            zone.extend(said);
        }
        zone
    }
}
