//! A vehicle that takes nothing on trust: what it is told is held against the published schemas and the text of VDA 5050.

use std::collections::BTreeMap;

use adit_fleet::wire::Version;
use adit_tests::shared;
use boon::{Compiler, SchemaIndex};
use serde_json::{Value, json};

/// A published schema.
pub struct Schema {
    compiled: boon::Schemas,
    top: SchemaIndex,
}

/// The schemas of a version.
pub struct Schemas {
    pub order: Schema,
    pub instant: Schema,
    /// From 3.0 on.
    pub zones: Option<Schema>,
}

pub fn schemas() -> Option<BTreeMap<&'static str, Schemas>> {
    let folder = shared("data/vda5050")?;
    let of = |version: &str, what: &str| {
        let text = std::fs::read_to_string(folder.join(version).join(format!("{what}.schema"))).unwrap();
        let (mut compiler, mut compiled) = (Compiler::new(), boon::Schemas::new());
        compiler.enable_format_assertions();
        compiler.add_resource("published.json", serde_json::from_str(&text).unwrap()).unwrap();
        let top = compiler.compile("published.json", &mut compiled).unwrap();
        Schema { compiled, top }
    };
    let both = |version: &str| Schemas {
        order: of(version, "order"),
        instant: of(version, "instantActions"),
        zones: (version == "schemas-3").then(|| of(version, "zoneSet")),
    };
    Some(BTreeMap::from([
        ("2.0.0", both("schemas-2.0.0")),
        ("2.1.0", both("schemas-2.1.0")),
        ("3.0.0", both("schemas-3")),
    ]))
}

pub fn expect_valid(schema: &Schema, message: &Value) {
    if let Err(error) = schema.compiled.validate(message, schema.top) {
        panic!("{error:#}\n{message:#}");
    }
}

/// Numbers of chance (splitmix64).
pub struct Chance(pub u64);

impl Chance {
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub fn below(&mut self, n: u64) -> u64 {
        self.next() % n
    }

    pub fn metres(&mut self) -> f64 {
        self.below(40_000) as f64 / 1000.0 - 20.0
    }
}

/// A vehicle that takes its orders as the text of VDA 5050 says, and what it holds of what it is told.
pub struct Judge<'a> {
    pub schemas: Option<&'a Schemas>,
    pub version: Version,
    pub order: String,
    pub update: u64,
    pub nodes: Vec<Value>,
    /// The stop at which it is.
    pub at: usize,
    pub actions: Vec<Value>,
    pub cancelled: Option<String>,
    pub point: [f64; 2],
}

impl<'a> Judge<'a> {
    pub fn new(version: Version, schemas: Option<&'a Schemas>, point: [f64; 2]) -> Self {
        Self {
            schemas,
            version,
            order: String::new(),
            update: 0,
            nodes: Vec::new(),
            at: 0,
            actions: Vec::new(),
            cancelled: None,
            point,
        }
    }

    pub fn hears(&mut self, topic: &str, message: &Value) {
        if topic == "instantActions" {
            if let Some(schemas) = self.schemas {
                expect_valid(&schemas.instant, message);
            }
            assert_eq!(message["actions"][0]["actionType"], "cancelOrder");
            self.cancelled = message["actions"][0]["actionId"].as_str().map(str::to_owned);
            self.nodes.truncate(self.at + 1);
            return;
        }
        if let Some(schemas) = self.schemas {
            expect_valid(&schemas.order, message);
        }
        assert_eq!(message["version"], self.version.full());
        let nodes = message["nodes"].as_array().unwrap();
        let edges = message["edges"].as_array().unwrap();
        assert_eq!(edges.len() + 1, nodes.len());
        let first = nodes[0]["sequenceId"].as_u64().unwrap();
        for (index, node) in nodes.iter().enumerate() {
            assert_eq!(node["sequenceId"], first + 2 * index as u64);
        }
        for (index, edge) in edges.iter().enumerate() {
            assert_eq!(edge["sequenceId"], first + 2 * index as u64 + 1);
            assert_eq!(
                edge["released"],
                nodes[index + 1]["released"],
                "an edge is released with the node to which it leads"
            );
            if self.version < Version::V3_0 {
                assert_eq!(
                    [&edge["startNodeId"], &edge["endNodeId"]],
                    [&nodes[index]["nodeId"], &nodes[index + 1]["nodeId"]]
                );
            }
        }
        let base = nodes.iter().take_while(|node| node["released"] == true).count();
        assert!(base > 0, "there is a base");
        assert!(nodes.iter().skip(base).all(|node| node["released"] == false), "a base, then a horizon");
        let update = message["orderUpdateId"].as_u64().unwrap();
        if message["orderId"] == self.order.as_str() {
            if update == self.update {
                return;
            }
            assert_eq!(update, self.update + 1);
            let stitch = self.nodes.iter().rposition(|node| node["released"] == true).unwrap();
            assert_eq!(nodes[0], self.nodes[stitch], "what was released is said again as it was");
            self.nodes.truncate(stitch);
        } else {
            assert_eq!((first, update), (0, 0), "a new order begins anew");
            assert!(
                self.cancelled.is_some() || self.nodes.len() <= self.at + 1,
                "the order of before was done"
            );
            let at = &nodes[0]["nodePosition"];
            let off =
                (at["x"].as_f64().unwrap() - self.point[0]).hypot(at["y"].as_f64().unwrap() - self.point[1]);
            assert!(off < 1e-6, "its first node is where the vehicle stands");
            (self.nodes, self.at, self.cancelled) = (Vec::new(), 0, None);
            message["orderId"].as_str().unwrap().clone_into(&mut self.order);
            self.actions = Vec::new();
        }
        self.update = update;
        self.nodes.extend(nodes.iter().cloned());
        // the stop that was released is said again with what is done there
        let released =
            nodes.iter().skip(usize::from(update > 0)).chain(edges).filter(|part| part["released"] == true);
        for action in released.flat_map(|part| part["actions"].as_array().unwrap()) {
            assert!(!self.actions.contains(&action["actionId"]), "actions have names of their own");
            self.actions.push(action["actionId"].clone());
        }
    }

    pub fn drives(&mut self) {
        if self.cancelled.is_none()
            && self.nodes.get(self.at + 1).is_some_and(|next| next["released"] == true)
        {
            self.at += 1;
        }
        if let Some(node) = self.nodes.get(self.at) {
            self.point = ["x", "y"].map(|axis| node["nodePosition"][axis].as_f64().unwrap());
        }
    }

    pub fn says(&self, chance: &mut Chance) -> Value {
        let left = |part: &Value| json!({"nodeId": "", "sequenceId": part["sequenceId"], "released": part["released"]});
        let nodes: Vec<Value> = self.nodes.iter().skip(self.at + 1).map(left).collect();
        let [position, localized] = match self.version {
            Version::V3_0 => ["mobileRobotPosition", "localized"],
            _ => ["agvPosition", "positionInitialized"],
        };
        let errors = match chance.below(8) {
            0 => json!([{"errorType": "obstacle", "errorLevel": "WARNING"}]),
            1 => json!([{"errorType": "motor", "errorLevel": "FATAL"}]),
            _ => json!([]),
        };
        let ended = self.cancelled.as_ref().map(|id| json!({"actionId": id, "actionStatus": "FINISHED"}));
        json!({
            "headerId": 0, "version": self.version.full(), "orderId": self.order, "orderUpdateId": self.update,
            "lastNodeId": self.nodes.get(self.at).map_or(Value::from(""), |node| node["nodeId"].clone()),
            "lastNodeSequenceId": 2 * self.at, "nodeStates": nodes, "edgeStates": null,
            position: {"x": self.point[0], "y": self.point[1], "theta": 0.0, "mapId": "m", localized: chance.below(9) > 0},
            "driving": chance.below(2) == 0, "newBaseRequest": chance.below(5) == 0,
            "actionStates": ended.into_iter().collect::<Vec<_>>(), "errors": errors, "operatingMode": "AUTOMATIC",
        })
    }
}
