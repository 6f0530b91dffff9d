//! Which lanes lead through which doors, where the file leaves it to the drawing; and rides between levels.

use std::collections::{BTreeMap, BTreeSet};

use super::{Door, Lane, LaneGraph, Lift, Node};
use crate::geometry::{Point, Segment};

/// Names the doors on each lane that has none by name: those that it crosses.
pub(super) fn cross(graph: &mut LaneGraph) {
    let LaneGraph { lanes, doors, nodes, .. } = graph;
    let by_id: BTreeMap<&str, &Node> = nodes.iter().map(|node| (node.node.as_str(), node)).collect();
    for lane in lanes.iter_mut().filter(|lane| lane.door.is_none()) {
        let ends = by_id.get(lane.from.as_str()).zip(by_id.get(lane.to.as_str()));
        let Some((from, to)) = ends else { continue };
        if from.level != to.level {
            continue;
        }
        let crossed =
            doors.iter().filter(|door| door.level == from.level && do_cross([from.at, to.at], door.ends));
        let names: Vec<&str> = crossed.map(|door| door.door.as_str()).collect();
        lane.door = (!names.is_empty()).then(|| names.join(", "));
    }
}

/// Adds the doors and lifts that lanes and nodes name and the file does not place, so that they can be closed: each in the middle
/// of the first lane that leads through it, or at the first node in it.
pub(super) fn named(graph: &mut LaneGraph) {
    let LaneGraph { lanes, doors, lifts, nodes, .. } = graph;
    let by_id: BTreeMap<&str, &Node> = nodes.iter().map(|node| (node.node.as_str(), node)).collect();
    let mut known: BTreeSet<String> = doors.iter().map(|door| door.door.clone()).collect();
    let mut known_lifts: BTreeSet<String> = lifts.iter().map(|lift| lift.lift.clone()).collect();
    let mut lift = |name: &Option<String>, at: Point| {
        if let Some(name) = name
            && known_lifts.insert(name.clone())
        {
            lifts.push(Lift { lift: name.clone(), at, yaw_degrees: 0.0, width: None, depth: None });
        }
    };
    for node in nodes.iter() {
        lift(&node.lift, node.at);
    }
    for lane in lanes.iter() {
        let ends = by_id.get(lane.from.as_str()).zip(by_id.get(lane.to.as_str()));
        let Some((from, to)) = ends else { continue };
        let middle = Point::new(f64::midpoint(from.at.x, to.at.x), f64::midpoint(from.at.y, to.at.y));
        lift(&lane.lift, middle);
        for name in lane.doors() {
            if known.insert(name.to_owned()) {
                let (door, level) = (name.to_owned(), from.level.clone());
                doors.push(Door { door, level, ends: [middle, middle], kind: None });
            }
        }
    }
}

fn do_cross([a, b]: [Point; 2], [c, d]: [Point; 2]) -> bool {
    a != b && c != d && Segment { a, b }.meets(&Segment { a: c, b: d })
}

/// Adds a ride for each two levels at which nodes lie in the cabin of one lift, both ways; `graphs` are those that vehicles
/// drive on, of whose lanes one ends in the cabin at either level.
pub(super) fn rides(graph: &mut LaneGraph, graphs: &[String]) {
    let mut rides = Vec::new();
    let in_cabins: Vec<_> = graph.nodes.iter().filter(|node| node.lift.is_some()).collect();
    for of in graphs {
        let is_served = |id: &str| {
            graph
                .lanes
                .iter()
                .any(|lane| lane.graph.as_ref() == Some(of) && (lane.from == id || lane.to == id))
        };
        for one in &in_cabins {
            for other in &in_cabins {
                if one.lift != other.lift
                    || one.level == other.level
                    || !is_served(&one.node)
                    || !is_served(&other.node)
                {
                    continue;
                }
                let lift = one.lift.clone().unwrap_or_default();
                let name = format!("{lift} {} to {}", one.level, other.level);
                let lane = if graphs.len() < 2 { name } else { format!("{of}:{name}") };
                let ride = Lane {
                    lane,
                    from: one.node.clone(),
                    to: other.node.clone(),
                    graph: Some(of.clone()),
                    lift: Some(lift),
                    ..Lane::default()
                };
                if rides.iter().all(|known: &Lane| known.lane != ride.lane) {
                    rides.push(ride);
                }
            }
        }
    }
    graph.lanes.extend(rides);
}
