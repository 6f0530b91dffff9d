//! A navigation graph of Open-RMF: `nav_graphs/0.yaml`, as fleet adapters read it.

use super::building::degrees;
use super::{Door, Lane, LaneGraph, Level, Lift, Node, Properties, doors};
use crate::read::{At, Read};

/// The one graph of such a file.
const GRAPH: &str = "0";

pub(super) fn read(top: &At<'_>) -> Read<LaneGraph> {
    let mut graph =
        LaneGraph { name: top.name("building_name")?.unwrap_or_default(), ..LaneGraph::default() };
    graph.properties = top.rest(&["building_name", "levels", "doors", "lifts"]);
    let levels = top.need("levels")?.entries()?;
    let is_alone = levels.len() < 2;
    for (name, level) in &levels {
        let elevation = level.maybe_number("elevation")?.unwrap_or(0.0);
        graph.levels.push(Level { level: (*name).to_owned(), elevation, properties: Properties::new() });
        let first = graph.nodes.len();
        for (number, vertex) in level.list("vertices")?.iter().enumerate() {
            let id = if is_alone { number.to_string() } else { format!("{name}:{number}") };
            graph.nodes.push(node(vertex, id, name)?);
        }
        let count = graph.nodes.len() - first;
        for lane in level.list("lanes")? {
            let items = lane.items()?;
            let [from, to, rest @ ..] = items.as_slice() else { return Err(lane.wrong("[from, to, {…}]")) };
            let end = |of: &At<'_>| Ok(graph.nodes[first + of.index(count, "vertices")?].node.clone());
            let (from, to) = (end(from)?, end(to)?);
            let number = graph.lanes.len() as u32;
            let read = rest.first().map_or(Ok(Lane::default()), one_lane)?;
            let lane = if read.lane.is_empty() { number.to_string() } else { read.lane.clone() };
            graph.lanes.push(Lane {
                lane,
                from,
                to,
                graph: Some(GRAPH.to_owned()),
                number: Some(number),
                ..read
            });
        }
    }
    for (name, door) in top.object("doors")? {
        let ends = door.need("endpoints")?.items()?;
        let [from, to] = ends.as_slice() else { return Err(door.wrong("two `endpoints`")) };
        let level = door.need("map")?.text()?;
        let kind = door.name("type")?;
        graph.doors.push(Door { door: name.to_owned(), level, ends: [from.point()?, to.point()?], kind });
    }
    for (name, lift) in top.object("lifts")? {
        let position = lift.need("position")?;
        let size = lift.list("dims")?;
        graph.lifts.push(Lift {
            lift: name.to_owned(),
            at: position.point()?,
            yaw_degrees: degrees(
                position.items()?.get(2).map(|yaw| yaw.number()).transpose()?.unwrap_or(0.0),
            ),
            width: size.first().map(|size| size.number()).transpose()?,
            depth: size.get(1).map(|size| size.number()).transpose()?,
        });
    }
    doors::named(&mut graph);
    let graphs = [GRAPH.to_owned()];
    doors::rides(&mut graph, &graphs);
    graph.types_by_graph(&graphs);
    Ok(graph)
}

fn node(vertex: &At<'_>, id: String, level: &str) -> Read<Node> {
    const READ: [&str; 7] =
        ["id", "name", "lift", "is_parking_spot", "is_charger", "is_holding_point", "closed"];
    let mut node = Node::new(id, level, vertex.point()?);
    let items = vertex.items()?;
    let Some(given) = items.get(2) else { return Ok(node) };
    if let Some(id) = given.get("id") {
        node.node = id.id()?;
    }
    node.name = given.name("name")?;
    node.lift = given.name("lift")?;
    node.is_parking_spot = given.maybe_truth("is_parking_spot")?.unwrap_or(false);
    node.is_charger = given.maybe_truth("is_charger")?.unwrap_or(false);
    node.is_holding_point = given.maybe_truth("is_holding_point")?.unwrap_or(false);
    node.closed = given.maybe_truth("closed")?.unwrap_or(false);
    node.properties = given.rest(&READ);
    Ok(node)
}

/// A lane but for its ends; without an id where the file gives none.
fn one_lane(given: &At<'_>) -> Read<Lane> {
    const READ: [&str; 12] = [
        "demo_mock_lift_name",
        "id",
        "name",
        "door_name",
        "speed_limit",
        "orientation_constraint",
        "closed",
        "cost",
        "overridable",
        "penalty",
        "length",
        "speed_share",
    ];
    Ok(Lane {
        lane: given.get("id").map(|id| id.id()).transpose()?.unwrap_or_default(),
        name: given.name("name")?,
        door: given.name("door_name")?,
        lift: given.name("demo_mock_lift_name")?,
        speed_limit: given.maybe_number("speed_limit")?.filter(|limit| *limit > 0.0),
        speed_share: given.maybe_number("speed_share")?,
        orientation: given.name("orientation_constraint")?,
        closed: given.maybe_truth("closed")?.unwrap_or(false),
        cost: given.not_negative("cost")?,
        is_cost_fixed: given.maybe_truth("overridable")? == Some(false),
        penalty: given.not_negative("penalty")?,
        length: given.not_negative("length")?,
        properties: given.rest(&READ),
        ..Lane::default()
    })
}
