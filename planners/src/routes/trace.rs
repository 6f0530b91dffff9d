//! From what a search found to the way, pulled tight.

use super::graph::RouteGraph;
use super::mesh::EPSILON;
use super::parts::{RoomIndex, Start};
use super::pull::{Chain, Link};
use super::taut::{Found, NO_NODE, Node};
use super::way::Way;
use crate::geometry::Point;

/// The way between a start and the goal's point, which may lie outside of the rooms.
///
/// # Arguments
/// `instead` is a node on the way, and one in its room by which the way comes there instead.
pub(super) fn trace(
    graph: &RouteGraph,
    nodes: &[Node],
    (start, goal): (&Start, Option<Point>),
    found: &Found,
    instead: Option<(u32, u32)>,
) -> Way {
    let (start_in, links) = links(graph, nodes, found, instead);
    let way = Chain { graph, start: start_in, links, goal: found.at }.pulled_tight();
    way.joined(graph, start.at, goal.unwrap_or(found.at))
}

/// The room and the point in it from which a way starts, and the doors that it passes.
fn links(
    graph: &RouteGraph,
    nodes: &[Node],
    found: &Found,
    mut instead: Option<(u32, u32)>,
) -> ((RoomIndex, Point), Vec<Link>) {
    let mut links = Vec::new();
    if let Some(exit) = found.change {
        links.push(Link::new(graph, exit.door, found.at, exit.to));
    }
    let (mut index, mut to) = (found.node, found.at);
    loop {
        if let Some((_, other)) = instead.take_if(|(own, _)| *own == index) {
            index = other;
        }
        let node = &nodes[index as usize];
        let before = (node.before != NO_NODE).then(|| &nodes[node.before as usize]);
        let is_new = before.is_some_and(|before| before.root.distance(node.root) > EPSILON);
        if before.is_some() && !node.bent {
            let door = node.door;
            let at = match graph[door].crossing.segment() {
                Some(segment) if !is_new => segment.passed_at(node.root, to),
                _ => node.root,
            };
            let link = Link::new(graph, door, at, node.room);
            let is_straight = link.is_straight && !(is_new && node.stop == door);
            links.push(Link { is_straight, ..link });
        }
        if before.is_none() {
            links.reverse();
            return ((node.room, node.root), links);
        }
        if is_new {
            to = node.root;
        }
        index = node.before;
    }
}
