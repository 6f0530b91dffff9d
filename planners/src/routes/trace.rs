//! From what a search found to the way, pulled tight.

use super::cone::Segment;
use super::graph::RouteGraph;
use super::mesh::{EPSILON, NONE};
use super::parts::Start;
use super::pull::{Chain, Link};
use super::taut::{Found, Node};
use super::way::Way;

pub(super) fn trace(graph: &RouteGraph, nodes: &[Node], start: &Start, found: &Found) -> Way {
    let (room, links) = links(graph, nodes, found);
    Chain { graph, start: (room, start.at), links, goal: found.at }.pulled_tight()
}

/// The room in which a way starts, and the doors that it passes.
fn links(graph: &RouteGraph, nodes: &[Node], found: &Found) -> (usize, Vec<Link>) {
    let mut links = Vec::new();
    if let Some(exit) = found.change {
        links.push(Link::new(graph, exit.door as usize, found.at, exit.to as usize));
    }
    let (mut index, mut to) = (found.node, found.at);
    loop {
        let node = &nodes[index as usize];
        let before = (node.before != NONE).then(|| &nodes[node.before as usize]);
        let is_new = before.is_some_and(|before| before.root.distance(node.root) > EPSILON);
        if before.is_some() && !node.bent {
            let door = node.door as usize;
            let segment = Segment::of(&graph.doors()[door].crossing);
            let is_here = is_new || graph.doors()[door].is_change();
            let at = if is_here { node.root } else { segment.passed_at(node.root, to) };
            links.push(Link::new(graph, door, at, node.room as usize));
        }
        if before.is_none() {
            links.reverse();
            return (node.room as usize, links);
        }
        if is_new {
            to = node.root;
        }
        index = node.before;
    }
}
