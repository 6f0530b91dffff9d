//! A route graph of Nav2's route server: GeoJSON.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::Value;

use super::{Lane, LaneGraph, Level, Node, doors};
use crate::geometry::Point;
use crate::read::{At, Code, Read};

/// All nodes of a route graph are on one level.
pub(super) const LEVEL: &str = "map";

pub(super) fn read(top: &At<'_>) -> Read<LaneGraph> {
    let mut graph = LaneGraph { name: top.name("name")?.unwrap_or_default(), ..LaneGraph::default() };
    graph.properties = top.rest(&["name", "features", "type"]);
    if let Some(kind) = top.get("type").filter(|kind| kind.value != "FeatureCollection") {
        return Err(kind.wrong("`FeatureCollection`"));
    }
    let (mut others, mut nested, mut high) = (0, 0, 0);
    let mut drawn: Vec<(usize, Drawn)> = Vec::new();
    for feature in top.need("features")?.items()? {
        let (properties, geometry) = (feature.need("properties")?, feature.need("geometry")?);
        let kind = geometry.need("type")?.text()?;
        match kind.as_str() {
            "Point" => {
                let at = geometry.need("coordinates")?;
                graph.nodes.push(node(&properties, at.point()?)?);
                high += usize::from(at.value.get(2).and_then(Value::as_f64).is_some_and(|z| z != 0.0));
            }
            "MultiLineString" | "LineString" => {
                // Nav2 looks at the ends of an edge alone, so that there are files without
                if let Some(coordinates) = geometry.get("coordinates") {
                    let is_nested = is_nested(&coordinates);
                    nested += usize::from(is_nested != (kind == "MultiLineString"));
                    drawn.push((graph.lanes.len(), Drawn::read(&coordinates, is_nested)?));
                }
                graph.lanes.push(lane(&properties)?);
            }
            _ => others += 1,
        }
    }
    for node in &graph.nodes {
        if graph.levels.iter().all(|level| level.level != node.level) {
            graph.levels.push(Level { level: node.level.clone(), ..Level::default() });
        }
    }
    doors::named(&mut graph);
    bent(&mut graph, &drawn);
    tell_apart(&mut graph);
    if high > 0 {
        graph.notes.push(format!(
            "nodes that have a height, which is left out since a route graph lies on one level: {high}"
        ));
    }
    if others > 0 {
        graph.notes.push(format!(
            "features that are neither points nor lines, and are no part of the graph: {others}"
        ));
    }
    if nested > 0 {
        let all = graph.lanes.len();
        graph.notes.push(format!(
            "LineString and MultiLineString are mixed up at {nested} of {all} edges, which are read as they are nested"
        ));
    }
    graph.types_by_graph(&[]);
    Ok(graph)
}

/// Whether coordinates are a list of lines, whatever their type says: Nav2 does not look at them, so that there are such files.
fn is_nested(coordinates: &At<'_>) -> bool {
    let first = coordinates.value.get(0).and_then(|line| line.get(0));
    first.is_some_and(Value::is_array)
}

/// Gives edges whose id another has an id of their own; Nav2 reads such files, and there are some.
fn tell_apart(graph: &mut LaneGraph) {
    let mut taken: BTreeSet<String> = graph.lanes.iter().map(|lane| lane.lane.clone()).collect();
    let mut seen = BTreeSet::new();
    // one of these is free
    let copies = 2..=graph.lanes.len() + 2;
    for lane in &mut graph.lanes {
        if seen.insert(lane.lane.clone()) {
            continue;
        }
        let own =
            copies.clone().map(|copy| format!("{}#{copy}", lane.lane)).find(|id| taken.insert(id.clone()));
        let Some(own) = own else { continue };
        graph.notes.push(format!(
            "two edges have the id {}; the one from {} to {} is called {own}",
            lane.lane, lane.from, lane.to
        ));
        lane.lane = own;
    }
}

/// The line of an edge.
struct Drawn {
    /// Metres along it.
    length: f64,
    ends: [Point; 2],
}

/// Lengths of lines that are longer than straight ones. A line that lies elsewhere than its nodes is no way between them.
fn bent(graph: &mut LaneGraph, drawn: &[(usize, Drawn)]) {
    let mut elsewhere = Vec::new();
    let at: BTreeMap<&str, Point> = graph.nodes.iter().map(|node| (node.node.as_str(), node.at)).collect();
    for (lane, Drawn { length, ends: line }) in drawn {
        let lane = &mut graph.lanes[*lane];
        let ends = at.get(lane.from.as_str()).zip(at.get(lane.to.as_str()));
        let Some((from, to)) = ends else { continue };
        let straight = from.distance(*to);
        // an edge that leads back may be drawn as the one that leads there
        let off = |[one, other]: [Point; 2]| one.distance(*from).max(other.distance(*to));
        if off(*line).min(off([line[1], line[0]])) > FAR_M.max(FAR * straight) {
            elsewhere.push(lane.lane.clone());
            continue;
        }
        // a drawing's line ends near its nodes rather than at them
        if lane.length.is_none() && *length > 1.02 * straight + 0.05 {
            lane.length = Some(*length);
        }
    }
    if let Some(first) = elsewhere.first() {
        graph.notes.push(format!(
            "edges whose line begins or ends far from their nodes, so that they count as straight: {} (the first is {first})",
            elsewhere.len()
        ));
    }
}

/// So far from its node a line may end: metres, or a part of the straight line between both.
const FAR_M: f64 = 2.0;
const FAR: f64 = 0.5;

impl Drawn {
    fn read(coordinates: &At<'_>, is_nested: bool) -> Read<Self> {
        let lines = if is_nested { coordinates.items()? } else { vec![coordinates.clone()] };
        let (mut length, mut ends) = (0.0, None);
        for line in lines {
            let points = line.items()?.iter().map(At::point).collect::<Read<Vec<Point>>>()?;
            let [first, .., last] = points[..] else { return Err(line.wrong("two points or more")) };
            length += points.windows(2).map(|pair| pair[0].distance(pair[1])).sum::<f64>();
            ends = Some([ends.map_or(first, |[from, _]: [Point; 2]| from), last]);
        }
        let ends = ends.ok_or_else(|| coordinates.wrong("one line at least"))?;
        Ok(Self { length, ends })
    }
}

/// A number as an id; route graphs have whole ones.
fn number(id: &At<'_>) -> Option<u32> {
    id.value.as_u64().and_then(|number| u32::try_from(number).ok())
}

fn node(properties: &At<'_>, at: Point) -> Read<Node> {
    let id = properties.need("id")?;
    let mut node = Node::new(id.id()?, LEVEL, at);
    node.number = number(&id);
    node.properties = properties.rest(&["id", "metadata"]);
    let Some(metadata) = properties.get("metadata") else { return Ok(node) };
    metadata.entries()?;
    if let Some(id) = metadata.get("node") {
        node.node = id.id()?;
    }
    node.name = metadata.name("name")?;
    node.level = metadata.name("level")?.unwrap_or(node.level);
    node.lift = metadata.name("lift")?;
    node.closed = metadata.maybe_truth("closed")?.unwrap_or(false);
    node.is_parking_spot = metadata.maybe_truth("is_parking_spot")?.unwrap_or(false);
    node.is_charger = metadata.maybe_truth("is_charger")?.unwrap_or(false);
    node.is_holding_point = metadata.maybe_truth("is_holding_point")?.unwrap_or(false);
    let rest = metadata.rest(&[
        "node",
        "name",
        "level",
        "lift",
        "closed",
        "is_parking_spot",
        "is_charger",
        "is_holding_point",
    ]);
    if !rest.is_empty() {
        node.properties.insert("metadata".to_owned(), Value::Object(rest));
    }
    Ok(node)
}

fn lane(properties: &At<'_>) -> Read<Lane> {
    let id = properties.need("id")?;
    let mut lane = Lane {
        lane: id.id()?,
        number: number(&id),
        from: properties.need("startid")?.id()?,
        to: properties.need("endid")?.id()?,
        cost: properties.not_negative("cost")?,
        is_cost_fixed: properties.maybe_truth("overridable")? == Some(false),
        properties: properties.rest(&["id", "startid", "endid", "cost", "overridable", "metadata"]),
        ..Lane::default()
    };
    let Some(metadata) = properties.get("metadata") else { return Ok(lane) };
    metadata.entries()?;
    let text = |key: &str| metadata.get(key).map(|id| id.id()).transpose();
    lane.lane = text("lane")?.unwrap_or(lane.lane);
    lane.from = text("from")?.unwrap_or(lane.from);
    lane.to = text("to")?.unwrap_or(lane.to);
    lane.name = metadata.name("name")?;
    lane.graph = text("graph")?;
    lane.speed_share = metadata.get("speed_limit").map(|limit| share(&limit)).transpose()?;
    lane.speed_limit = metadata.get("abs_speed_limit").map(|limit| limit.positive()).transpose()?;
    lane.penalty = metadata.not_negative("penalty")?;
    lane.length = metadata.not_negative("length")?;
    lane.orientation = metadata.name("orientation")?;
    lane.door = metadata.name("door")?;
    lane.lift = metadata.name("lift")?;
    lane.action = metadata.name("action")?;
    lane.closed = metadata.maybe_truth("closed")?.unwrap_or(false);
    let mut rest = metadata.rest(&[
        "lane",
        "from",
        "to",
        "name",
        "graph",
        "speed_limit",
        "abs_speed_limit",
        "penalty",
        "length",
        "orientation",
        "door",
        "lift",
        "action",
        "closed",
    ]);
    // said in per cent, it is written so again
    if let Some(limit) =
        metadata.get("speed_limit").filter(|limit| limit.value.as_f64().is_some_and(|of| of > 1.0))
    {
        rest.insert("speed_limit".to_owned(), limit.value.clone());
    }
    if !rest.is_empty() {
        lane.properties.insert("metadata".to_owned(), Value::Object(rest));
    }
    Ok(lane)
}

/// A limit as a part of the full speed: some files have 0.85 for what others call 85.
fn share(limit: &At<'_>) -> Read<f64> {
    let number = limit.positive()?;
    let share = if number > 1.0 { number / 100.0 } else { number };
    if share <= 1.0 {
        return Ok(share);
    }
    Err(limit.problem(
        Code::WrongType,
        &format!("is {number}, expected a part of the speed up to 1, or up to 100 %"),
    ))
}
