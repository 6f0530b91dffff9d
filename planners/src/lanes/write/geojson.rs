//! A route graph for Nav2's route server.

use std::collections::BTreeMap;

use serde_json::{Map, Value, json};

use super::{Exported, TooMany, note_heights};
use crate::lanes::geojson::LEVEL;
use crate::lanes::numbers::distinct;
use crate::lanes::{Lane, LaneGraph, Node, Properties};

pub(super) fn write(graph: &LaneGraph) -> Result<Exported, TooMany> {
    let most = u32::from(u16::MAX);
    let too_many = || TooMany { nodes: graph.nodes.len(), lanes: graph.lanes.len() };
    let nodes: Vec<_> = graph.nodes.iter().map(|node| node.number).collect();
    let lanes: Vec<_> = graph.lanes.iter().map(|lane| lane.number).collect();
    let nodes = distinct(&nodes, most).ok_or_else(too_many)?;
    let lanes = distinct(&lanes, most).ok_or_else(too_many)?;
    let numbered = || graph.nodes.iter().zip(&nodes);
    let by_id: BTreeMap<&str, (&Node, &u32)> = numbered().map(|of| (of.0.node.as_str(), of)).collect();
    let mut top = json!({"type": "FeatureCollection", "name": graph.name});
    let mut in_order: Vec<(&Node, &u32)> = numbered().collect();
    in_order.sort_by_key(|(_, number)| **number);
    let mut features: Vec<Value> = in_order.iter().map(|(node, number)| of_node(node, **number)).collect();
    let mut in_order: Vec<(&Lane, &u32)> = graph.lanes.iter().zip(&lanes).collect();
    in_order.sort_by_key(|(_, number)| **number);
    for (lane, number) in in_order {
        let ends = by_id.get(lane.from.as_str()).zip(by_id.get(lane.to.as_str()));
        if let Some((&from, &to)) = ends {
            features.push(of_lane(lane, *number, from, to));
        }
    }
    if let Value::Object(top) = &mut top {
        top.extend(graph.properties.clone());
    }
    let mut text = head(&top);
    let lines: Vec<String> = features.iter().map(ToString::to_string).collect();
    text.push_str("  \"features\": [\n    ");
    text.push_str(&lines.join(",\n    "));
    text.push_str("\n  ]\n}\n");
    let walls = graph.walls.len() + graph.doors.len() + graph.lifts.len();
    let mut notes = Vec::new();
    if walls > 0 {
        notes.push(
            "walls, and where doors and lifts are, have no place in a route graph; lanes name their doors and lifts".to_owned(),
        );
    }
    notes.extend(note_heights(graph, "a route graph"));
    let count = |own: Vec<Option<u32>>, given: &[u32]| {
        own.into_iter().zip(given).filter(|(own, given)| own.is_some_and(|own| own != **given)).count()
    };
    let renumbered = [
        (count(graph.nodes.iter().map(|node| node.number).collect(), &nodes), "node"),
        (count(graph.lanes.iter().map(|lane| lane.number).collect(), &lanes), "edge"),
    ];
    for (count, what) in renumbered.into_iter().filter(|(count, _)| *count > 0) {
        let many = if count == 1 { "" } else { "s" };
        notes.push(format!(
            "{count} {what}{many}: another {what} has the same number, or it is above {most}, so that a free one is written; \
             what Adit calls them stands in `metadata`"
        ));
    }
    Ok(Exported { text, notes })
}

/// All but the features, key by key.
fn head(top: &Value) -> String {
    let lines = top.as_object().into_iter().flatten();
    let lines = lines.map(|(key, value)| format!("  {}: {value},\n", Value::from(key.as_str())));
    format!("{{\n{}", lines.collect::<String>())
}

/// What is told beside the columns of a file, with what it said itself.
fn metadata(properties: &Properties, told: Vec<(&str, Option<Value>)>) -> (Properties, Properties) {
    let mut rest = properties.clone();
    let mut metadata = match rest.remove("metadata") {
        Some(Value::Object(metadata)) => metadata,
        _ => Map::new(),
    };
    metadata.extend(told.into_iter().filter_map(|(key, value)| Some((key.to_owned(), value?))));
    (rest, metadata)
}

/// A share of the speed in the unit of its file, which may have per cent: the same number again where nobody changed it.
fn limit_as_said(lane: &Lane, share: f64) -> f64 {
    let said = lane.properties.get("metadata").and_then(|metadata| metadata.get("speed_limit")?.as_f64());
    match said {
        Some(said) if said > 1.0 && (said / 100.0 - share).abs() < 1e-12 => said,
        Some(said) if said > 1.0 => share * 100.0,
        _ => share,
    }
}

fn flag(is_so: bool) -> Option<Value> {
    is_so.then(|| Value::from(true))
}

fn of_node(node: &Node, number: u32) -> Value {
    let told = vec![
        ("node", (node.node != number.to_string()).then(|| json!(node.node))),
        ("name", node.name.as_ref().map(|name| json!(name))),
        ("level", (node.level != LEVEL).then(|| json!(node.level))),
        ("lift", node.lift.as_ref().map(|lift| json!(lift))),
        ("closed", flag(node.closed)),
        ("is_parking_spot", flag(node.is_parking_spot)),
        ("is_charger", flag(node.is_charger)),
        ("is_holding_point", flag(node.is_holding_point)),
    ];
    let (rest, metadata) = metadata(&node.properties, told);
    let mut properties = Map::from_iter([("id".to_owned(), json!(number))]);
    properties.extend(rest);
    if !metadata.is_empty() {
        properties.insert("metadata".to_owned(), Value::Object(metadata));
    }
    let geometry = json!({"type": "Point", "coordinates": [node.at.x, node.at.y]});
    json!({"type": "Feature", "properties": properties, "geometry": geometry})
}

fn of_lane(lane: &Lane, number: u32, from: (&Node, &u32), to: (&Node, &u32)) -> Value {
    let text = |text: &Option<String>| text.as_ref().map(|text| json!(text));
    let real = |number: Option<f64>| number.map(|number| json!(number));
    let id = |(node, number): (&Node, &u32)| (node.node != number.to_string()).then(|| json!(node.node));
    let told = vec![
        ("lane", (lane.lane != number.to_string()).then(|| json!(lane.lane))),
        ("from", id(from)),
        ("to", id(to)),
        ("name", text(&lane.name)),
        ("graph", text(&lane.graph)),
        ("speed_limit", lane.speed_share.map(|share| json!(limit_as_said(lane, share)))),
        ("abs_speed_limit", real(lane.speed_limit)),
        ("penalty", real(lane.penalty)),
        ("length", real(lane.length)),
        ("orientation", text(&lane.orientation)),
        ("door", text(&lane.door)),
        ("lift", text(&lane.lift)),
        ("action", text(&lane.action)),
        ("closed", flag(lane.closed)),
    ];
    let (rest, metadata) = metadata(&lane.properties, told);
    let mut properties = Map::from_iter([
        ("id".to_owned(), json!(number)),
        ("startid".to_owned(), json!(from.1)),
        ("endid".to_owned(), json!(to.1)),
    ]);
    properties.extend(real(lane.cost).map(|cost| ("cost".to_owned(), cost)));
    if lane.is_cost_fixed {
        properties.insert("overridable".to_owned(), json!(false));
    }
    properties.extend(rest);
    if !metadata.is_empty() {
        properties.insert("metadata".to_owned(), Value::Object(metadata));
    }
    let line = json!([[[from.0.at.x, from.0.at.y], [to.0.at.x, to.0.at.y]]]);
    json!({"type": "Feature", "properties": properties, "geometry": {"type": "MultiLineString", "coordinates": line}})
}
