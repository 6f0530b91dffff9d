//! VDMA's Layout Interchange Format.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::{Map, Value, json};

use super::{Exported, note, note_heights, note_nodes};
use crate::lanes::{Lane, LaneGraph, Level, Node, Properties, Station, Use};

/// Where a file told no time: what is written depends on the graph alone.
const NO_TIME: &str = "1970-01-01T00:00:00Z";

pub(super) fn write(graph: &LaneGraph) -> Exported {
    let usual = object([
        ("projectIdentification", Some(json!(graph.name))),
        ("creator", Some(json!("Adit"))),
        ("exportTimestamp", Some(json!(NO_TIME))),
        ("lifVersion", Some(json!("1.0.0"))),
    ]);
    // other formats may have one, too, which says less
    let meta = match graph.properties.get("metaInformation") {
        Some(Value::Object(said)) if said.contains_key("lifVersion") => Value::Object(said.clone()),
        Some(Value::Object(said)) => with(said.clone(), &usual),
        _ => Value::Object(usual),
    };
    let layouts: Vec<Value> = graph.levels.iter().map(|level| layout(graph, level)).collect();
    let mut top = Map::from_iter([("metaInformation".to_owned(), meta)]);
    top.extend(
        graph.properties.clone().into_iter().filter(|(key, _)| key != "metaInformation" && key != "crs"),
    );
    top.insert("layouts".to_owned(), layouts.into());
    let text = serde_json::to_string_pretty(&top).unwrap_or_default() + "\n";
    Exported { text, notes: notes(graph) }
}

/// What of a graph LIF has no words for.
fn notes(graph: &LaneGraph) -> Vec<String> {
    let listed: BTreeSet<&str> = graph.uses.iter().map(|of| of.lane.as_str()).collect();
    let is_listed = |lane: &Lane| listed.contains(lane.lane.as_str());
    let notes = [
        note_nodes(graph, "that they are chargers has no place in LIF", |node| node.is_charger),
        note_nodes(graph, "that they are parking spots has no place in LIF", |node| node.is_parking_spot),
        note_nodes(graph, "that they are holding points has no place in LIF", |node| node.is_holding_point),
        note_nodes(graph, "that they are closed has no place in LIF", |node| node.closed),
        note_nodes(graph, "the lift in whose cabin they lie has no place in LIF", |node| node.lift.is_some()),
        note(graph, "a cost or penalty of their own has no place in LIF", |lane| {
            lane.cost.is_some() || lane.penalty.is_some()
        }),
        note(graph, "a share of a vehicle's own speed has no place in LIF", |lane| {
            lane.speed_share.is_some()
        }),
        note(graph, "their speed limit is left out, since LIF says it with each vehicle type", |lane| {
            lane.speed_limit.is_some() && is_listed(lane)
        }),
        // of a file of LIF it is that of its curve, which is written
        note(graph, "a length of their own has no place in LIF", |lane| {
            lane.length.is_some() && !is_listed(lane)
        }),
        note(graph, "an orientation of their own has no place in LIF", |lane| lane.orientation.is_some()),
        note(graph, "an action of their own has no place in LIF", |lane| lane.action.is_some()),
        note(graph, "that they are closed has no place in LIF", |lane| lane.closed),
        note(graph, "the doors and lifts that they lead through have no place in LIF", |lane| {
            lane.door.is_some() || lane.lift.is_some()
        }),
    ];
    notes.into_iter().flatten().chain(note_heights(graph, "LIF")).collect()
}

/// Adds what a file said besides, but for what is said already.
fn with(mut of: Map<String, Value>, properties: &Properties) -> Value {
    for (key, value) in properties {
        of.entry(key.clone()).or_insert_with(|| value.clone());
    }
    Value::Object(of)
}

/// What a file said of it; what is usual where it said nothing.
fn said_or(properties: &Properties, key: &str, usual: Value) -> Value {
    properties.get(key).cloned().unwrap_or(usual)
}

/// The entries that there are.
fn object<const N: usize>(entries: [(&str, Option<Value>); N]) -> Map<String, Value> {
    entries.into_iter().filter_map(|(key, value)| Some((key.to_owned(), value?))).collect()
}

fn layout(graph: &LaneGraph, level: &Level) -> Value {
    let here: Vec<&Node> = graph.nodes.iter().filter(|node| node.level == level.level).collect();
    let ids: BTreeSet<&str> = here.iter().map(|node| node.node.as_str()).collect();
    let types: Vec<&str> = graph.vehicle_types.iter().map(|of| of.vehicle_type.as_str()).collect();
    let nodes: Vec<Value> = here.iter().map(|node| of_node(node, &types)).collect();
    // one that leads to another layout stands in that of its start
    let lanes = graph.lanes.iter().filter(|lane| ids.contains(lane.from.as_str()));
    let mut uses: BTreeMap<&str, Vec<&Use>> = BTreeMap::new();
    for of in &graph.uses {
        uses.entry(of.lane.as_str()).or_default().push(of);
    }
    let of = |lane: &&Lane| uses.get(lane.lane.as_str()).map_or(&[][..], |uses| uses);
    let edges: Vec<Value> = lanes.map(|lane| of_lane(graph, lane, of(&lane))).collect();
    let stations = graph.stations.iter().filter(|station| station.level == level.level);
    let stations: Vec<Value> = stations.map(of_station).collect();
    let of = object([
        ("layoutId", Some(json!(level.level))),
        ("layoutVersion", Some(said_or(&level.properties, "layoutVersion", json!("1")))),
        ("nodes", Some(nodes.into())),
        ("edges", Some(edges.into())),
        ("stations", Some(stations.into())),
    ]);
    with(of, &level.properties)
}

fn of_node(node: &Node, types: &[&str]) -> Value {
    let all: Vec<Value> = types.iter().map(|id| json!({"vehicleTypeId": id})).collect();
    let of = object([
        ("nodeId", Some(json!(node.node))),
        ("nodeName", node.name.as_ref().map(|name| json!(name))),
        ("nodePosition", Some(json!({"x": node.at.x, "y": node.at.y}))),
        (
            "vehicleTypeNodeProperties",
            Some(said_or(&node.properties, "vehicleTypeNodeProperties", all.into())),
        ),
    ]);
    with(of, &node.properties)
}

fn of_lane(graph: &LaneGraph, lane: &Lane, uses: &[&Use]) -> Value {
    let said: Vec<Value> = if uses.is_empty() {
        let types = graph.vehicle_types.iter().filter(|of| of.graph.is_none() || of.graph == lane.graph);
        let of = |id: &String| {
            with(
                object([
                    ("vehicleTypeId", Some(json!(id))),
                    ("maxSpeed", lane.speed_limit.map(|limit| json!(limit))),
                    ("rotationAllowed", Some(json!(true))),
                ]),
                &Properties::new(),
            )
        };
        types.map(|known| of(&known.vehicle_type)).collect()
    } else {
        uses.iter().map(|of| of_use(of)).collect()
    };
    let of = object([
        ("edgeId", Some(json!(lane.lane))),
        ("edgeName", lane.name.as_ref().map(|name| json!(name))),
        ("startNodeId", Some(json!(lane.from))),
        ("endNodeId", Some(json!(lane.to))),
        ("vehicleTypeEdgeProperties", Some(said.into())),
    ]);
    with(of, &lane.properties)
}

fn of_use(of: &Use) -> Value {
    let real = |number: Option<f64>| number.map(|number| json!(number));
    let truth = |truth: Option<bool>| truth.map(|truth| json!(truth));
    let sets = of.load_sets.as_deref().map(|sets| sets.split(',').map(str::trim).collect::<Vec<_>>());
    let restriction = with(
        object([
            ("unloaded", truth(of.unloaded)),
            ("loaded", truth(of.loaded)),
            ("loadSetNames", sets.map(|sets| json!(sets))),
        ]),
        of.properties.get("loadRestriction").and_then(Value::as_object).unwrap_or(&Properties::new()),
    );
    let is_restricted = restriction.as_object().is_some_and(|of| !of.is_empty());
    let entries = object([
        ("vehicleTypeId", Some(json!(of.vehicle_type))),
        ("maxSpeed", real(of.max_speed)),
        ("minHeight", real(of.min_height)),
        ("maxHeight", real(of.max_height)),
        ("rotationAllowed", truth(of.rotation_allowed)),
        ("loadRestriction", is_restricted.then_some(restriction)),
    ]);
    with(entries, &of.properties)
}

fn of_station(station: &Station) -> Value {
    let nodes: Vec<&str> = station.nodes.split(',').map(str::trim).filter(|node| !node.is_empty()).collect();
    let of = object([
        ("stationId", Some(json!(station.station))),
        ("stationName", station.name.as_ref().map(|name| json!(name))),
        ("interactionNodeIds", Some(json!(nodes))),
    ]);
    with(of, &station.properties)
}
