//! A site of Open-RMF's site editor: `site.json`.

use std::collections::BTreeMap;

use super::{Door, Lane, LaneGraph, Level, Lift, Node, Wall, doors};
use crate::geometry::Point;
use crate::read::{At, Code, Read};

/// Where anchors are, with their level.
type Anchors<'v> = BTreeMap<&'v str, (Point, String)>;

pub(super) fn read(top: &At<'_>) -> Read<LaneGraph> {
    let mut graph = LaneGraph::default();
    if let Some(properties) = top.get("properties") {
        graph.name = properties.name("name")?.unwrap_or_default();
    }
    let mut anchors = Anchors::new();
    let levels = top.need("levels")?.entries()?;
    for (_, level) in &levels {
        let properties = level.need("properties")?;
        let name = properties.need("name")?.text()?;
        let elevation = properties.maybe_number("elevation")?.unwrap_or(0.0);
        for (id, anchor) in level.object("anchors")? {
            anchors.insert(id, (position(&anchor)?, name.clone()));
        }
        graph.levels.push(Level { level: name, elevation, properties: super::Properties::new() });
    }
    // those of the whole site, on which lifts stand; what lies at one is on the lowest level
    let lowest = graph.levels.iter().min_by(|one, other| one.elevation.total_cmp(&other.elevation));
    if let Some(lowest) = lowest {
        for (id, anchor) in top.object("anchors")? {
            anchors.insert(id, (position(&anchor)?, lowest.level.clone()));
        }
    }
    let names =
        levels.iter().map(|(id, _)| *id).zip(graph.levels.iter().map(|level| level.level.clone())).collect();
    lifts(top, &mut graph, &mut anchors, &names)?;
    for ((_, level), name) in levels.iter().zip(graph.levels.iter().map(|level| level.level.clone())) {
        for (_, wall) in level.object("walls")? {
            graph.walls.push(Wall { level: name.clone(), ends: ends(&wall, &anchors)?.map(|(at, _)| *at) });
        }
        for (id, door) in level.object("doors")? {
            let ends = ends(&door, &anchors)?.map(|(at, _)| *at);
            let kind = door.get("kind").and_then(|kind| kind.value.as_object()?.keys().next().cloned());
            let door = door.name("name")?.unwrap_or_else(|| id.to_owned());
            graph.doors.push(Door { door, level: name.clone(), ends, kind });
        }
    }
    let graphs = navigation(top, &mut graph, &anchors)?;
    doors::cross(&mut graph);
    graph.types_by_graph(&graphs);
    Ok(graph)
}

fn position(anchor: &At<'_>) -> Read<Point> {
    if let Some(at) = anchor.get("Translate2D") {
        return at.point();
    }
    if let Some(categories) = anchor.get("CategorizedTranslate2D") {
        return match categories.get("General").or_else(|| categories.get("general")) {
            Some(at) => at.point(),
            None => Err(categories.wrong("a point as `General`")),
        };
    }
    match anchor.get("Pose3D") {
        Some(pose) => pose.need("trans")?.point(),
        None => Err(anchor.wrong("`Translate2D`, `CategorizedTranslate2D` or `Pose3D`")),
    }
}

/// The two anchors of something.
fn ends<'a>(of: &At<'_>, anchors: &'a Anchors<'_>) -> Read<[&'a (Point, String); 2]> {
    let list = of.need("anchors")?;
    let items = list.items()?;
    let [from, to] = items.as_slice() else { return Err(list.wrong("two anchors")) };
    Ok([anchor(from, anchors)?, anchor(to, anchors)?])
}

fn anchor<'a>(of: &At<'_>, anchors: &'a Anchors<'_>) -> Read<&'a (Point, String)> {
    let id = of.id()?;
    anchors.get(id.as_str()).ok_or_else(|| {
        of.problem(Code::Impossible, &format!("is {id}, and there is no anchor of this number"))
    })
}

/// Lifts stand between two anchors; those of their cabin lie in the frame of its middle.
///
/// # Arguments
/// `levels` are the names of levels by their numbers.
fn lifts<'v>(
    top: &At<'v>,
    graph: &mut LaneGraph,
    anchors: &mut Anchors<'v>,
    levels: &BTreeMap<&str, String>,
) -> Read<()> {
    for (_, lift) in top.object("lifts")? {
        let properties = lift.need("properties")?;
        let named = properties.need("name")?.text()?;
        let list = properties.need("reference_anchors")?;
        let items = list.items()?;
        let [left, right] = items.as_slice() else { return Err(list.wrong("two anchors")) };
        let (&(left, ref level), &(right, _)) = (anchor(left, anchors)?, anchor(right, anchors)?);
        let first = properties.get("initial_level").map(|number| number.id()).transpose()?;
        let level = first.and_then(|number| levels.get(number.as_str())).unwrap_or(level).clone();
        let at = Point::new(f64::midpoint(left.x, right.x), f64::midpoint(left.y, right.y));
        let yaw = (left.y - right.y).atan2(left.x - right.x) - std::f64::consts::FRAC_PI_2;
        for (id, cabin) in lift.object("cabin_anchors")? {
            let p = position(&cabin)?;
            let (sin, cos) = yaw.sin_cos();
            let there = Point::new(at.x + cos * p.x - sin * p.y, at.y + sin * p.x + cos * p.y);
            anchors.insert(id, (there, level.clone()));
            let mut node = Node::new(id, &level, there);
            node.lift = Some(named.clone());
            graph.nodes.push(node);
        }
        let cabin = properties.get("cabin").and_then(|cabin| cabin.get("Rect"));
        let size = |key| cabin.as_ref().map_or(Ok(None), |cabin| cabin.maybe_number(key));
        let (width, depth) = (size("width")?, size("depth")?);
        graph.lifts.push(Lift { lift: named, at, yaw_degrees: yaw.to_degrees(), width, depth });
    }
    Ok(())
}

/// Nodes and lanes; which graphs there are.
fn navigation(top: &At<'_>, graph: &mut LaneGraph, anchors: &Anchors<'_>) -> Read<Vec<String>> {
    let Some(guided) = top.get("navigation").and_then(|navigation| navigation.get("guided")) else {
        return Ok(Vec::new());
    };
    let mut names = BTreeMap::new();
    for (id, of) in guided.object("graphs")? {
        names.insert(id, of.name("name")?.unwrap_or_else(|| id.to_owned()));
    }
    let cabins = std::mem::take(&mut graph.nodes);
    let node = |graph: &mut LaneGraph, of: &At<'_>| -> Read<String> {
        let (id, (at, level)) = (of.id()?, anchor(of, anchors)?);
        if graph.node(&id).is_none() {
            let cabin = cabins.iter().find(|node| node.node == id);
            graph.nodes.push(cabin.cloned().unwrap_or_else(|| Node::new(&*id, level, *at)));
        }
        Ok(id)
    };
    for (id, lane) in guided.object("lanes")? {
        ends(&lane, anchors)?;
        let items = lane.need("anchors")?.items()?;
        let (from, to) = (node(graph, &items[0])?, node(graph, &items[1])?);
        let of = of_graphs(&lane, &names)?;
        let there = motion(lane.get("forward").as_ref())?;
        let is_both_ways = lane.get("reverse").is_none_or(|back| back.value != "Disable");
        let back = match lane.get("reverse").filter(|back| back.value.is_object()) {
            Some(back) => motion(Some(&back.get("Different").unwrap_or(back)))?,
            None => there.clone(),
        };
        for name in &of {
            let called = |way: &str| {
                let name = if of.len() < 2 { String::new() } else { format!("{name}:") };
                format!("{name}{id}{way}")
            };
            let graph_of = Some(name.clone());
            let there = Lane {
                lane: called(""),
                from: from.clone(),
                to: to.clone(),
                graph: graph_of.clone(),
                ..there.clone()
            };
            graph.lanes.push(there);
            if is_both_ways {
                let (from, to) = (to.clone(), from.clone());
                graph.lanes.push(Lane { lane: called(" back"), from, to, graph: graph_of, ..back.clone() });
            }
        }
    }
    for (_, location) in guided.object("locations")? {
        let id = node(graph, &location.need("anchor")?)?;
        let (name, tags) = (location.name("name")?, location.list("tags")?);
        let has = |tag: &str| tags.iter().any(|known| known.value == tag);
        let Some(node) = graph.nodes.iter_mut().find(|node| node.node == id) else { continue };
        node.name = name;
        (node.is_parking_spot, node.is_charger) = (has("ParkingSpot"), has("Charger"));
        node.is_holding_point = has("HoldingPoint");
    }
    Ok(names.into_values().collect())
}

/// The graphs that a lane is of, by name.
fn of_graphs(lane: &At<'_>, names: &BTreeMap<&str, String>) -> Read<Vec<String>> {
    let all = || names.values().cloned().collect();
    let Some(of) = lane.get("graphs") else { return Ok(all()) };
    let listed = |key| -> Read<Option<Vec<String>>> {
        let Some(list) = of.get(key) else { return Ok(None) };
        let name = |id: &At<'_>| {
            let number = id.id()?;
            let unknown = || {
                id.problem(Code::Impossible, &format!("is {number}, and there is no graph of this number"))
            };
            names.get(number.as_str()).cloned().ok_or_else(unknown)
        };
        list.items()?.iter().map(name).collect::<Read<Vec<_>>>().map(Some)
    };
    if let Some(only) = listed("Only")? {
        return Ok(only);
    }
    match listed("AllExcept")? {
        Some(except) => Ok(names.values().filter(|name| !except.contains(name)).cloned().collect()),
        None if of.value == "All" => Ok(all()),
        None => Err(of.wrong("`All`, `Only` or `AllExcept`")),
    }
}

/// What holds for driving along a lane in one direction.
fn motion(of: Option<&At<'_>>) -> Read<Lane> {
    let Some(of) = of else { return Ok(Lane::default()) };
    let speed_limit = of.maybe_number("speed_limit")?.filter(|limit| *limit > 0.0);
    let orientation = match of.get("orientation_constraint") {
        None => None,
        Some(constraint) => match constraint.value.as_str() {
            Some("None") => None,
            Some("Forwards") => Some("forward".to_owned()),
            Some("Backwards") => Some("backward".to_owned()),
            Some(_) => return Err(constraint.wrong("`None`, `Forwards`, `Backwards` or a yaw")),
            None => Some(constraint.value.to_string()),
        },
    };
    Ok(Lane {
        speed_limit,
        orientation,
        properties: of.rest(&["speed_limit", "orientation_constraint"]),
        ..Lane::default()
    })
}
