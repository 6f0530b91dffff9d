//! A navigation graph for fleets of Open-RMF: YAML, a lane or vertex a line.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use serde_json::{Map, Value, json};

use super::{Exported, note};
use crate::lanes::{Lane, LaneGraph, Node};

pub(super) fn write(graph: &LaneGraph) -> Exported {
    let mut text = String::new();
    let quoted = |text: &str| Value::from(text).to_string();
    let _ = writeln!(text, "building_name: {}", quoted(&graph.name));
    // of a door at a point its file gave the name alone, which stands with its lanes
    let mut doors = graph.doors.iter().filter(|door| door.ends[0] != door.ends[1]).peekable();
    if doors.peek().is_some() {
        text.push_str("doors:\n");
        for door in doors {
            let ends = door.ends.map(|end| [end.x, end.y]);
            let value = json!({"map": door.level, "endpoints": ends, "type": door.kind});
            let _ = writeln!(text, "  {}: {value}", quoted(&door.door));
        }
    }
    if !graph.lifts.is_empty() {
        text.push_str("lifts:\n");
        for lift in &graph.lifts {
            let position = [lift.at.x, lift.at.y, lift.yaw_degrees.to_radians()];
            let mut value = json!({"position": position});
            if let (Some(width), Some(depth)) = (lift.width, lift.depth) {
                value["dims"] = json!([width, depth]);
            }
            let _ = writeln!(text, "  {}: {value}", quoted(&lift.lift));
        }
    }
    for (key, value) in &graph.properties {
        let _ = writeln!(text, "{}: {value}", quoted(key));
    }
    text.push_str("levels:\n");
    let is_alone = graph.levels.len() < 2;
    // across levels only lifts lead, and these are made of the nodes in their cabins
    let by_id = graph.by_id();
    let level_of = |id: &str| by_id.get(id).map(|node| node.level.as_str());
    let is_within = |lane: &&Lane| level_of(&lane.from) == level_of(&lane.to);
    let mut number = 0;
    for level in &graph.levels {
        let _ = writeln!(text, "  {}:", quoted(&level.level));
        if level.elevation.abs() > 0.0 {
            let _ = writeln!(text, "    elevation: {}", json!(level.elevation));
        }
        let nodes: Vec<&Node> = graph.nodes.iter().filter(|node| node.level == level.level).collect();
        let places: BTreeMap<&str, usize> =
            nodes.iter().enumerate().map(|(place, node)| (node.node.as_str(), place)).collect();
        let place = |id: &str| places.get(id).copied();
        let lanes = graph.lanes.iter().filter(is_within);
        let lanes: Vec<String> = lanes
            .filter_map(|lane| {
                let (from, to) = (place(&lane.from)?, place(&lane.to)?);
                let line = format!("    - {}", json!([from, to, of_lane(lane, number)]));
                number += 1;
                Some(line)
            })
            .collect();
        list(&mut text, "lanes", &lanes);
        let vertices = nodes.iter().enumerate().map(|(place, node)| {
            let own = if is_alone { place.to_string() } else { format!("{}:{place}", level.level) };
            format!("    - {}", json!([node.at.x, node.at.y, of_node(node, &own)]))
        });
        list(&mut text, "vertices", &vertices.collect::<Vec<_>>());
    }
    let notes = [
        note(graph, "an action of their own has no place in a navigation graph", |lane| lane.action.is_some()),
        note(graph, "they lead to another level and no lift rides there, and are left out", |lane| {
            level_of(&lane.from) != level_of(&lane.to) && lane.lift.is_none()
        }),
        (!graph.uses.is_empty()).then(|| {
            "which vehicle type may use which lane has no place in a navigation graph: Open-RMF has one for each fleet"
                .to_owned()
        }),
    ];
    Exported { text, notes: notes.into_iter().flatten().collect() }
}

fn list(text: &mut String, key: &str, lines: &[String]) {
    if lines.is_empty() {
        let _ = writeln!(text, "    {key}: []");
    } else {
        let _ = writeln!(text, "    {key}:\n{}", lines.join("\n"));
    }
}

fn of_node(node: &Node, own: &str) -> Map<String, Value> {
    let mut of = Map::new();
    of.insert("name".to_owned(), json!(node.name.as_deref().unwrap_or_default()));
    if node.node != own {
        of.insert("id".to_owned(), json!(node.node));
    }
    of.extend(node.lift.as_ref().map(|lift| ("lift".to_owned(), json!(lift))));
    let flags = [
        ("is_parking_spot", node.is_parking_spot),
        ("is_charger", node.is_charger),
        ("is_holding_point", node.is_holding_point),
        ("closed", node.closed),
    ];
    of.extend(flags.into_iter().filter(|(_, is_so)| *is_so).map(|(key, _)| (key.to_owned(), json!(true))));
    of.extend(node.properties.clone());
    of
}

fn of_lane(lane: &Lane, number: u32) -> Map<String, Value> {
    let text = |text: &Option<String>| text.as_ref().map(|text| json!(text));
    let real = |number: Option<f64>| number.map(|number| json!(number));
    let told = [
        ("id", (lane.lane != number.to_string()).then(|| json!(lane.lane))),
        ("name", text(&lane.name)),
        ("door_name", text(&lane.door)),
        ("demo_mock_lift_name", text(&lane.lift)),
        ("speed_limit", real(lane.speed_limit)),
        ("speed_share", real(lane.speed_share)),
        ("orientation_constraint", text(&lane.orientation)),
        ("closed", lane.closed.then(|| json!(true))),
        ("cost", real(lane.cost)),
        ("overridable", lane.is_cost_fixed.then(|| json!(false))),
        ("penalty", real(lane.penalty)),
        ("length", real(lane.length)),
    ];
    let mut of: Map<String, Value> =
        told.into_iter().filter_map(|(key, value)| Some((key.to_owned(), value?))).collect();
    of.extend(lane.properties.clone());
    of
}
