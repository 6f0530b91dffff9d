//! What the fleet says to vehicles: orders and instant actions, as each version writes them.

use serde_json::{Map, Value, json};

use super::Version;

/// To whom, and by which version.
#[derive(Clone, Debug, PartialEq)]
pub struct Addressee {
    pub version: Version,
    pub manufacturer: String,
    pub serial: String,
}

/// What a vehicle is to drive: nodes and the edges between them, in turn.
#[derive(Clone, Debug, PartialEq)]
pub struct Order {
    pub id: String,
    pub update: u32,
    pub nodes: Vec<Node>,
    pub edges: Vec<Edge>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    pub id: String,
    pub sequence: u32,
    pub words: String,
    pub released: bool,
    /// Metres, in the frame of the map.
    pub at: [f64; 2],
    /// How the body lies there, degrees; `None`: as the vehicle likes.
    pub facing: Option<f64>,
    /// Metres by which it may pass beside the node; `None`: as exactly as it can.
    pub deviation: Option<f64>,
    pub map: String,
    pub actions: Vec<Action>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Edge {
    pub id: String,
    pub sequence: u32,
    pub words: String,
    pub released: bool,
    pub start: String,
    pub end: String,
    /// Metres per second.
    pub speed: Option<f64>,
    /// Metres.
    pub height: Option<f64>,
    /// How the body lies on the way, degrees, in the frame of the map.
    pub facing: Option<f64>,
    /// Metres.
    pub length: f64,
    /// Metres by which the vehicle's rim may leave the way to either side.
    pub corridor: Option<f64>,
    pub actions: Vec<Action>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Action {
    pub id: String,
    pub kind: String,
    pub words: String,
    pub blocking: Blocking,
    pub parameters: Vec<(String, Value)>,
}

/// What else a vehicle may do meanwhile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Blocking {
    /// It drives on, and does other things.
    None,
    /// It does other things, and stands.
    Soft,
    /// It drives on, and does nothing else; before 3.0 it stands.
    Single,
    /// It stands, and does nothing else.
    Hard,
}

/// Instant actions.
#[derive(Clone, Debug, PartialEq)]
pub struct Instant {
    pub actions: Vec<Action>,
}

impl Blocking {
    /// Reads `NONE`, `SOFT`, `SINGLE`, `HARD`.
    pub fn read(text: &str) -> Option<Self> {
        match text.to_uppercase().as_str() {
            "NONE" => Some(Self::None),
            "SOFT" => Some(Self::Soft),
            "SINGLE" => Some(Self::Single),
            "HARD" => Some(Self::Hard),
            _ => None,
        }
    }

    pub(super) fn word(self, version: Version) -> &'static str {
        match self {
            Self::None => "NONE",
            Self::Soft => "SOFT",
            Self::Single if version >= Version::V3_0 => "SINGLE",
            Self::Single | Self::Hard => "HARD",
        }
    }
}

impl Addressee {
    pub(super) fn head(&self, number: u32, at: &str) -> Map<String, Value> {
        object([
            ("headerId", json!(number)),
            ("timestamp", json!(at)),
            ("version", json!(self.version.full())),
            ("manufacturer", json!(self.manufacturer)),
            ("serialNumber", json!(self.serial)),
        ])
    }

    /// The order as this vehicle reads it.
    pub fn order(&self, order: &Order, number: u32, at: &str) -> Value {
        let mut message = self.head(number, at);
        message.insert("orderId".to_owned(), json!(order.id));
        message.insert("orderUpdateId".to_owned(), json!(order.update));
        let nodes = order.nodes.iter().map(|node| self.node(node)).collect();
        message.insert("nodes".to_owned(), Value::Array(nodes));
        let edges = order.edges.iter().map(|edge| self.edge(edge)).collect();
        message.insert("edges".to_owned(), Value::Array(edges));
        Value::Object(message)
    }

    /// Instant actions as this vehicle reads them.
    pub fn instant(&self, instant: &Instant, number: u32, at: &str) -> Value {
        let mut message = self.head(number, at);
        let mut actions: Vec<Value> =
            instant.actions.iter().map(|action| Value::Object(self.action(action))).collect();
        if self.version >= Version::V3_0 {
            for action in &mut actions {
                action["blockingType"] = json!("NONE");
            }
        }
        if self.version < Version::V3_0 {
            // the schema of 2.0 calls them `actions` with an `actionName`, its text `instantActions` with an `actionType`, and
            // vehicles of 2.x are written after either
            for action in &mut actions {
                let kind = action["actionType"].clone();
                action["actionName"] = kind;
            }
            message.insert("instantActions".to_owned(), Value::Array(actions.clone()));
        }
        message.insert("actions".to_owned(), Value::Array(actions));
        Value::Object(message)
    }

    fn node(&self, node: &Node) -> Value {
        let theta = node.facing.map(radians);
        let deviation = node.deviation.map(|metres| {
            if self.version >= Version::V3_0 {
                json!({"a": metres, "b": metres, "theta": 0.0})
            } else {
                json!(metres)
            }
        });
        let position = object([
            ("x", json!(node.at[0])),
            ("y", json!(node.at[1])),
            ("theta", json!(theta)),
            ("allowedDeviationXY", json!(deviation)),
            ("mapId", json!(node.map)),
        ]);
        Value::Object(object([
            ("nodeId", json!(node.id)),
            ("sequenceId", json!(node.sequence)),
            (self.of_words("node"), json!(node.words)),
            ("released", json!(node.released)),
            ("nodePosition", Value::Object(position)),
            ("actions", self.actions(&node.actions)),
        ]))
    }

    fn edge(&self, edge: &Edge) -> Value {
        let is_3 = self.version >= Version::V3_0;
        let [speed, height] =
            if is_3 { ["maximumSpeed", "maximumMobileRobotHeight"] } else { ["maxSpeed", "maxHeight"] };
        let ends = (!is_3).then_some([&edge.start, &edge.end]);
        let corridor = edge.corridor.filter(|_| self.version >= Version::V2_1).map(|metres| {
            let reference = if is_3 { "corridorReferencePoint" } else { "corridorRefPoint" };
            json!({"leftWidth": metres, "rightWidth": metres, reference: "CONTOUR"})
        });
        let turns = if is_3 { "reachOrientationBeforeEntering" } else { "rotationAllowed" };
        Value::Object(object([
            ("edgeId", json!(edge.id)),
            ("sequenceId", json!(edge.sequence)),
            (self.of_words("edge"), json!(edge.words)),
            ("released", json!(edge.released)),
            ("startNodeId", json!(ends.map(|ends| ends[0]))),
            ("endNodeId", json!(ends.map(|ends| ends[1]))),
            (speed, json!(edge.speed)),
            (height, json!(edge.height)),
            ("orientation", json!(edge.facing.map(radians))),
            ("orientationType", json!(edge.facing.map(|_| "GLOBAL"))),
            (turns, json!(edge.facing.map(|_| is_3))),
            ("length", json!(edge.length)),
            ("corridor", json!(corridor)),
            ("actions", self.actions(&edge.actions)),
        ]))
    }

    fn actions(&self, actions: &[Action]) -> Value {
        Value::Array(actions.iter().map(|action| Value::Object(self.action(action))).collect())
    }

    fn action(&self, action: &Action) -> Map<String, Value> {
        let parameters: Vec<Value> =
            action.parameters.iter().map(|(key, value)| json!({"key": key, "value": value})).collect();
        object([
            ("actionType", json!(action.kind)),
            ("actionId", json!(action.id)),
            (self.of_words("action"), json!(action.words)),
            ("blockingType", json!(action.blocking.word(self.version))),
            ("actionParameters", json!((!parameters.is_empty()).then_some(parameters))),
        ])
    }

    fn of_words(&self, what: &str) -> &'static str {
        match (what, self.version >= Version::V3_0) {
            ("node", false) => "nodeDescription",
            ("node", true) => "nodeDescriptor",
            ("edge", false) => "edgeDescription",
            ("edge", true) => "edgeDescriptor",
            (_, false) => "actionDescription",
            (_, true) => "actionDescriptor",
        }
    }
}

/// An object of what is there.
pub(super) fn object<const N: usize>(entries: [(&str, Value); N]) -> Map<String, Value> {
    let there = entries.into_iter().filter(|(_, value)| !value.is_null());
    there.map(|(key, value)| (key.to_owned(), value)).collect()
}

/// Degrees as an angle of at most half a turn to either side.
pub(super) fn radians(degrees: f64) -> f64 {
    ((degrees + 180.0).rem_euclid(360.0) - 180.0).to_radians()
}
