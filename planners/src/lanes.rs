//! Lane graphs: nodes that vehicles drive between on lanes, as fleets are given them.
//!
//! Read from files of Open-RMF (a building, a site, a navigation graph), of Nav2's route server, of VDMA's LIF and of
//! topological navigation; written for Open-RMF, Nav2 and LIF.

mod building;
mod check;
mod doors;
mod doubts;
mod earth;
mod geojson;
mod lif;
mod nav_graph;
mod numbers;
mod read;
mod rmf_site;
mod tmap;
mod write;

use std::collections::BTreeMap;

use serde_json::{Map, Value};

use crate::geometry::Point;

pub use check::{Place, Wrong, refuse_wrong};
pub use read::{is_lane_graph, read_lane_graph};
pub use write::{Exported, Format, TooMany, write};

/// What a file says that has no column of its own, kept as it is.
pub type Properties = Map<String, Value>;

/// A vehicle of a file that tells no kinds of vehicles apart.
pub const ROBOT: &str = "robot";

/// A graph of nodes and lanes, with what stands about them in a building.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LaneGraph {
    pub name: String,
    pub levels: Vec<Level>,
    pub nodes: Vec<Node>,
    pub lanes: Vec<Lane>,
    pub doors: Vec<Door>,
    pub lifts: Vec<Lift>,
    pub walls: Vec<Wall>,
    pub vehicle_types: Vec<VehicleType>,
    pub uses: Vec<Use>,
    pub stations: Vec<Station>,
    pub loads: Vec<Load>,
    /// What the file says as a whole.
    pub properties: Properties,
    /// What was read otherwise than it stands there, or not at all, in sentences.
    pub notes: Vec<String>,
}

/// A floor of a building, or a layout.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Level {
    pub level: String,
    /// Metres above the ground.
    pub elevation: f64,
    pub properties: Properties,
}

/// Where vehicles turn off, stop and are sent to.
#[derive(Clone, Debug, PartialEq)]
#[expect(clippy::struct_excessive_bools, reason = "each is a column of its own")]
pub struct Node {
    pub node: String,
    pub name: Option<String>,
    pub level: String,
    pub at: Point,
    /// The lift in whose cabin it lies.
    pub lift: Option<String>,
    pub is_parking_spot: bool,
    pub is_charger: bool,
    pub is_holding_point: bool,
    pub closed: bool,
    /// Its place among all, or its number in a file that numbers them.
    pub number: Option<u32>,
    pub properties: Properties,
}

/// A way for vehicles from one node to another, in this direction.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lane {
    pub lane: String,
    pub name: Option<String>,
    pub from: String,
    pub to: String,
    /// The graph, and so the fleet, that it is of.
    pub graph: Option<String>,
    /// Metres, where it is not straight.
    pub length: Option<f64>,
    /// Metres a second.
    pub speed_limit: Option<f64>,
    /// Part of a vehicle's own speed, up to 1.
    pub speed_share: Option<f64>,
    /// What it costs beyond its length.
    pub penalty: Option<f64>,
    pub cost: Option<f64>,
    /// Whether `cost` is all that counts.
    pub is_cost_fixed: bool,
    /// How a vehicle has to look: `forward`, `backward`, or degrees.
    pub orientation: Option<String>,
    /// The doors that it leads through, by commas.
    pub door: Option<String>,
    /// The lift that it rides in.
    pub lift: Option<String>,
    /// What its file says that is done there.
    pub action: Option<String>,
    pub closed: bool,
    pub number: Option<u32>,
    pub properties: Properties,
}

impl Lane {
    /// The names of the doors that it leads through.
    pub fn doors(&self) -> impl Iterator<Item = &str> {
        self.door.iter().flat_map(|doors| doors.split(',').map(str::trim)).filter(|door| !door.is_empty())
    }
}

#[derive(Clone, Debug, PartialEq)]
pub struct Door {
    pub door: String,
    pub level: String,
    pub ends: [Point; 2],
    /// What its file calls its kind: `hinged`.
    pub kind: Option<String>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Lift {
    pub lift: String,
    pub at: Point,
    /// Counterclockwise from x.
    pub yaw_degrees: f64,
    /// Metres; `None` where the file does not say it.
    pub width: Option<f64>,
    pub depth: Option<f64>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Wall {
    pub level: String,
    pub ends: [Point; 2],
}

/// A kind of vehicles, all of one size.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct VehicleType {
    pub vehicle_type: String,
    /// The graph whose lanes it drives on; `None`: any.
    pub graph: Option<String>,
    /// Metres.
    pub height: Option<f64>,
    /// Metres a second.
    pub speed: Option<f64>,
}

/// What a file allows a vehicle type on a lane.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Use {
    pub lane: String,
    pub vehicle_type: String,
    /// Metres a second.
    pub max_speed: Option<f64>,
    /// The heights that a vehicle with its load may have, metres.
    pub min_height: Option<f64>,
    pub max_height: Option<f64>,
    pub rotation_allowed: Option<bool>,
    /// Whether it may drive without a load, and with one.
    pub unloaded: Option<bool>,
    pub loaded: Option<bool>,
    /// The sets of loads that it may carry, by commas; `None`: all.
    pub load_sets: Option<String>,
    pub properties: Properties,
}

/// Where vehicles do something at a node.
#[derive(Clone, Debug, PartialEq)]
pub struct Station {
    pub station: String,
    pub name: Option<String>,
    pub level: String,
    /// The nodes from which it is reached, by commas.
    pub nodes: String,
    pub properties: Properties,
}

/// A set of loads that a vehicle type may carry.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Load {
    pub vehicle_type: String,
    pub load: String,
}

impl Node {
    pub fn new(node: impl Into<String>, level: &str, at: Point) -> Self {
        Self {
            node: node.into(),
            name: None,
            level: level.to_owned(),
            at,
            lift: None,
            is_parking_spot: false,
            is_charger: false,
            is_holding_point: false,
            closed: false,
            number: None,
            properties: Properties::new(),
        }
    }

    /// Whether it is for a vehicle type: of LIF those that it lists, else any.
    pub fn is_for(&self, vehicle_type: &str) -> bool {
        let listed = self.properties.get("vehicleTypeNodeProperties").and_then(Value::as_array);
        let is_it = |of: &Value| of.get("vehicleTypeId").is_some_and(|id| id == vehicle_type);
        listed.is_none_or(|list| list.iter().any(is_it))
    }
}

impl LaneGraph {
    /// The nodes by id, for whoever asks for many.
    pub fn by_id(&self) -> BTreeMap<&str, &Node> {
        self.nodes.iter().map(|node| (node.node.as_str(), node)).collect()
    }

    pub fn node(&self, node: &str) -> Option<&Node> {
        self.nodes.iter().find(|known| known.node == node)
    }

    /// Gives each vehicle of a file that tells them apart by the graph they drive on a type.
    fn types_by_graph(&mut self, graphs: &[String]) {
        let called =
            |graph: &String| if graphs.len() < 2 { ROBOT.to_owned() } else { format!("graph {graph}") };
        let type_of = |graph: &String| VehicleType {
            vehicle_type: called(graph),
            graph: Some(graph.clone()),
            ..VehicleType::default()
        };
        self.vehicle_types = graphs.iter().map(type_of).collect();
        if graphs.is_empty() {
            self.vehicle_types.push(VehicleType { vehicle_type: ROBOT.to_owned(), ..VehicleType::default() });
        }
    }
}
