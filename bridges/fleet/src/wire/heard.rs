//! What vehicles say, whatever their version; only what is used of it.

use serde::de::DeserializeOwned;
use serde::{Deserialize, Deserializer};

/// Of whom a message says that it is; it may say nothing of that.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
struct Head {
    manufacturer: Option<String>,
    serial_number: Option<String>,
}

/// A state: where the vehicle is in its order, and how it is.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(rename_all = "camelCase")]
pub struct Report {
    #[serde(default, deserialize_with = "or_default")]
    pub version: String,
    #[serde(default, deserialize_with = "or_default")]
    pub order_id: String,
    #[serde(default, deserialize_with = "or_default")]
    pub order_update_id: u32,
    #[serde(default, deserialize_with = "or_default")]
    pub last_node_id: String,
    #[serde(default, deserialize_with = "or_default")]
    pub last_node_sequence_id: u32,
    #[serde(default, deserialize_with = "or_default")]
    pub node_states: Vec<Left>,
    #[serde(default, deserialize_with = "or_default")]
    pub edge_states: Vec<Left>,
    #[serde(default, alias = "agvPosition", alias = "mobileRobotPosition")]
    pub position: Option<Position>,
    pub driving: bool,
    #[serde(default, deserialize_with = "or_default")]
    pub paused: bool,
    #[serde(default, deserialize_with = "or_default")]
    pub new_base_request: bool,
    #[serde(default, deserialize_with = "or_default")]
    pub action_states: Vec<Done>,
    #[serde(default, deserialize_with = "or_default")]
    pub instant_action_states: Vec<Done>,
    #[serde(default, alias = "batteryState", alias = "powerSupply")]
    pub battery: Option<Battery>,
    #[serde(default, deserialize_with = "or_default")]
    pub operating_mode: String,
    #[serde(default, deserialize_with = "or_default")]
    pub errors: Vec<Fault>,
    #[serde(default, alias = "safetyState", deserialize_with = "or_default")]
    pub safety: Safety,
}

/// A node or an edge that is left of an order.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(rename_all = "camelCase")]
pub struct Left {
    pub sequence_id: u32,
}

#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(rename_all = "camelCase")]
pub struct Position {
    pub x: f64,
    pub y: f64,
    /// Radians.
    pub theta: f64,
    #[serde(default, deserialize_with = "or_default")]
    pub map_id: String,
    #[serde(alias = "positionInitialized")]
    pub localized: bool,
}

#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(rename_all = "camelCase")]
pub struct Done {
    pub action_id: String,
    pub action_status: String,
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(rename_all = "camelCase")]
pub struct Battery {
    /// Per cent.
    #[serde(alias = "batteryCharge", alias = "stateOfCharge")]
    pub charge: f64,
}

#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
#[serde(rename_all = "camelCase")]
pub struct Safety {
    /// How its emergency stop is released; `NONE` where it is not on.
    #[serde(default, alias = "eStop", alias = "activeEmergencyStop", deserialize_with = "or_default")]
    pub emergency_stop: String,
}

/// An error that a vehicle reports.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(rename_all = "camelCase")]
pub struct Fault {
    pub error_type: String,
    pub error_level: String,
    #[serde(default, deserialize_with = "or_default")]
    pub error_description: String,
    #[serde(default, deserialize_with = "or_default")]
    pub error_references: Vec<Reference>,
}

#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(rename_all = "camelCase")]
pub struct Reference {
    pub reference_key: String,
    pub reference_value: String,
}

/// Whether it is on the broker.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(rename_all = "camelCase")]
pub struct Connection {
    #[serde(default, deserialize_with = "or_default")]
    pub version: String,
    pub connection_state: Link,
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "SCREAMING_SNAKE_CASE")]
pub enum Link {
    Online,
    Offline,
    Hibernating,
    #[serde(alias = "CONNECTIONBROKEN")]
    ConnectionBroken,
}

/// What the maker says of the vehicle.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(rename_all = "camelCase")]
pub struct Factsheet {
    #[serde(default, alias = "physicalParameters")]
    pub body: Option<Body>,
}

/// Metres.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(rename_all = "camelCase")]
pub struct Body {
    #[serde(alias = "heightMax", alias = "maximumHeight")]
    pub height: f64,
    pub width: f64,
    pub length: f64,
}

impl Report {
    /// Whether something of an order is left to do.
    pub fn is_busy(&self) -> bool {
        !self.node_states.is_empty() || !self.edge_states.is_empty()
    }

    /// What became of an action; of instant ones 3.0 speaks apart.
    pub fn became_of(&self, action: &str) -> Option<&str> {
        let all = self.action_states.iter().chain(&self.instant_action_states);
        all.filter(|done| done.action_id == action).map(|done| done.action_status.as_str()).next()
    }

    /// Whether all actions of its order have ended.
    pub fn has_acted(&self) -> bool {
        self.action_states.iter().all(|done| matches!(done.action_status.as_str(), "FINISHED" | "FAILED"))
    }
}

impl Link {
    pub fn word(self) -> &'static str {
        match self {
            Self::Online => "online",
            Self::Offline => "offline",
            Self::Hibernating => "hibernating",
            Self::ConnectionBroken => "connection broken",
        }
    }
}

/// Of whom a message on the topics of this vehicle is instead, if it says so.
pub fn of_another(payload: &[u8], manufacturer: &str, serial: &str) -> Option<String> {
    // what cannot be read is said where it is read
    let head: Head = serde_json::from_slice(payload).ok()?;
    let (of, number) = (head.manufacturer.as_deref(), head.serial_number.as_deref());
    let is_it = of.is_none_or(|of| of == manufacturer) && number.is_none_or(|number| number == serial);
    (!is_it).then(|| format!("{}/{}", of.unwrap_or(manufacturer), number.unwrap_or(serial)))
}

/// Reads a state; a sentence where it is none.
pub fn state(payload: &[u8]) -> Result<Report, String> {
    let report: Report = read("state", payload)?;
    let finite = report
        .position
        .as_ref()
        .is_none_or(|at| [at.x, at.y, at.theta].iter().all(|v| v.is_finite() && v.abs() < 1e7));
    if finite {
        Ok(report)
    } else {
        Err("a state places the vehicle farther off than ten thousand kilometres".to_owned())
    }
}

/// Reads a connection message; a sentence where it is none.
pub fn connection(payload: &[u8]) -> Result<Connection, String> {
    read("connection message", payload)
}

/// Reads a factsheet; a sentence where it is none.
pub fn factsheet(payload: &[u8]) -> Result<Factsheet, String> {
    read("factsheet", payload)
}

fn read<T: DeserializeOwned>(what: &str, payload: &[u8]) -> Result<T, String> {
    serde_json::from_slice(payload).map_err(|error| format!("its {what} cannot be read: {error}"))
}

/// What is left out or null.
fn or_default<'de, D: Deserializer<'de>, T: Deserialize<'de> + Default>(input: D) -> Result<T, D::Error> {
    Option::deserialize(input).map(Option::unwrap_or_default)
}
