//! A way from a start to a goal, leg by leg.

use super::cone::Segment;
use super::mesh::{EPSILON, NONE};
use super::pull::{Chain, Link};
use super::taut::{Found, Node};
use super::{RouteGraph, Start};
use crate::geometry::Point;

/// The straight way through one room, up to the door that is passed then.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leg {
    /// The room, by index.
    pub room: usize,
    pub from: Point,
    pub to: Point,
    /// Hardness of the way: metres times the room's hardness.
    pub hardness: f64,
    /// The door passed at its end, by index; `None` for the last leg.
    pub door: Option<usize>,
    /// Total hardness at its end, with the door's.
    pub cost: f64,
}

impl Leg {
    /// Metres.
    pub fn length(&self) -> f64 {
        self.from.distance(self.to)
    }
}

/// A way, pulled tight: from the start's point to the goal's.
#[derive(Clone, Debug, PartialEq)]
pub struct Way {
    /// At least one.
    pub legs: Vec<Leg>,
    /// Total hardness.
    pub cost: f64,
}

impl Way {
    /// The way through these doors, by index, each with where it is passed and the room behind it.
    pub(super) fn through(
        graph: &RouteGraph,
        (room, start): (usize, Point),
        doors: impl IntoIterator<Item = (usize, Point, usize)>,
        goal: Point,
    ) -> Self {
        let mut legs: Vec<Leg> = Vec::new();
        let (mut room, mut from, mut cost) = (room, start, 0.0);
        for (door, to, next) in doors {
            let hardness = walked(graph, room, from, to);
            cost += hardness + graph.passage(door).unwrap_or(0.0);
            legs.push(Leg { room, from, to, hardness, door: Some(door), cost });
            (room, from) = (next, to);
        }
        let hardness = walked(graph, room, from, goal);
        cost += hardness;
        legs.push(Leg { room, from, to: goal, hardness, door: None, cost });
        Self { legs, cost }
    }

    /// The way to what a search found, pulled tight.
    pub(super) fn of(graph: &RouteGraph, nodes: &[Node], start: &Start, found: &Found) -> Self {
        let (room, links) = links(graph, nodes, found);
        let chain = Chain { graph, start: (room, start.at), links, goal: found.at };
        chain.pulled_tight()
    }

    /// Metres.
    pub fn length(&self) -> f64 {
        self.legs.iter().map(Leg::length).sum()
    }
}

fn walked(graph: &RouteGraph, room: usize, from: Point, to: Point) -> f64 {
    let per_m = graph.per_m(room);
    if per_m > 0.0 { per_m * from.distance(to) } else { 0.0 }
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
