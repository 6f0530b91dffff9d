//! Routes of least total hardness over rooms and doors.
//!
//! [petgraph](https://docs.rs/petgraph) holds the graph and is the reference that tests compare with. Its `dijkstra`
//! returns no predecessors and cannot tell two doors between the same rooms apart, so the search here is a loop of
//! our own over petgraph's edges that keeps, for each room, the door it was entered by and where.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use petgraph::graph::{DiGraph, NodeIndex};
use petgraph::visit::EdgeRef;

use crate::geometry::{Point, Rect};

mod blocked;
pub use blocked::{Blockage, blockage};

/// A room as the search sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RouteRoom {
    /// Its rectangle.
    pub rect: Rect,
    /// Hardness of a metre walked in it; `None` where all hardness lies on the doors (the paper's Table 6).
    pub hardness_per_m: Option<f64>,
}

/// A door as the search sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RouteDoor {
    /// Its key, unique.
    pub door: u32,
    /// Index of the first room.
    pub room1: usize,
    /// Index of the second room.
    pub room2: usize,
    /// Where it is crossed: a segment shared by both rooms, or the area in which a change of shape is possible.
    pub crossing: Rect,
    /// The point that stands for it where no distance in its rooms is weighed.
    pub at: Point,
    /// Hardness of passing it; `None`: unknown, so it is not passed.
    pub hardness: Option<f64>,
    /// Whether rules let a state through.
    pub passable: bool,
    /// Whether it leads from the first room to the second only.
    pub one_way: bool,
}

impl RouteDoor {
    /// The hardness of passing it, where it can be passed.
    pub fn weight(&self) -> Option<f64> {
        self.hardness.filter(|hardness| self.passable && !hardness.is_nan())
    }
}

/// Where a search begins.
#[derive(Clone, Debug, PartialEq)]
pub struct Start {
    /// Rooms that hold the start: one in the paper's modes, one for each state that fits there otherwise.
    pub rooms: Vec<usize>,
    /// The start point, metres.
    pub at: Point,
}

/// How the best route reaches a room.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arrival {
    /// The room before it and the door between; `None` in a room where the search began.
    pub from: Option<(usize, u32)>,
    /// Total hardness on arrival.
    pub cost: f64,
    /// Hardness of the way inside the room before, from its entry to the door; part of `cost`.
    pub leg: f64,
    /// Point of arrival.
    pub at: Point,
    /// Doors passed.
    pub hops: u32,
}

/// Rooms joined by the doors that can be passed.
#[derive(Clone, Debug)]
pub struct RouteGraph {
    rooms: Vec<RouteRoom>,
    doors: Vec<RouteDoor>,
    graph: DiGraph<(), u32>,
}

impl RouteGraph {
    /// The graph of all doors with a known hardness that are passable; other doors are kept for [`blockage`].
    pub fn new(rooms: Vec<RouteRoom>, doors: Vec<RouteDoor>) -> Self {
        let mut graph = DiGraph::with_capacity(rooms.len(), doors.len() * 2);
        for _ in &rooms {
            graph.add_node(());
        }
        for (index, door) in doors.iter().enumerate() {
            if door.weight().is_some() {
                let (a, b) = (NodeIndex::new(door.room1), NodeIndex::new(door.room2));
                graph.add_edge(a, b, index as u32);
                if !door.one_way {
                    graph.add_edge(b, a, index as u32);
                }
            }
        }
        Self { rooms, doors, graph }
    }

    /// The rooms, by index.
    pub fn rooms(&self) -> &[RouteRoom] {
        &self.rooms
    }

    /// The doors, passable or not.
    pub fn doors(&self) -> &[RouteDoor] {
        &self.doors
    }

    /// petgraph's graph of the passable doors; edge weights are indices into [`RouteGraph::doors`].
    pub fn petgraph(&self) -> &DiGraph<(), u32> {
        &self.graph
    }

    /// The least cost of every room from the start, with the door that it is entered by (Dijkstra).
    ///
    /// Where a room weighs its metres, each room keeps the best arrival and goes on from that point; a later
    /// arrival at another point is not kept, so costs are those of a drivable way, at least the optimum.
    /// Equal costs: the room, then the door, of lower number. O((rooms + doors) log doors).
    pub fn tree(&self, start: &Start) -> Vec<Option<Arrival>> {
        self.search(start, |_| false)
    }

    /// Like [`RouteGraph::tree`], but stops as soon as `goal` is settled; other rooms may be missing.
    pub fn tree_until(&self, start: &Start, goals: &[usize]) -> Vec<Option<Arrival>> {
        let mut left = goals.len();
        self.search(start, |room| {
            if goals.contains(&room) {
                left -= 1;
            }
            left == 0
        })
    }

    fn search(&self, start: &Start, mut stop: impl FnMut(usize) -> bool) -> Vec<Option<Arrival>> {
        let mut best: Vec<Option<Arrival>> = vec![None; self.rooms.len()];
        let mut settled = vec![false; self.rooms.len()];
        let mut queue = BinaryHeap::new();
        for &room in &start.rooms {
            best[room] = Some(Arrival { from: None, cost: 0.0, leg: 0.0, at: start.at, hops: 0 });
            queue.push(Candidate { cost: 0.0, room });
        }
        while let Some(Candidate { cost, room }) = queue.pop() {
            let Some(arrival) = best[room] else { continue };
            if settled[room] || cost > arrival.cost {
                continue;
            }
            settled[room] = true;
            if stop(room) {
                break;
            }
            for edge in self.graph.edges(NodeIndex::new(room)) {
                let next = edge.target().index();
                if settled[next] {
                    continue;
                }
                let candidate = self.pass(room, arrival, *edge.weight() as usize);
                if best[next].is_none_or(|known| better(candidate, known)) {
                    best[next] = Some(candidate);
                    queue.push(Candidate { cost: candidate.cost, room: next });
                }
            }
        }
        best
    }

    fn pass(&self, room: usize, arrival: Arrival, door: usize) -> Arrival {
        let door = &self.doors[door];
        let (at, leg) = match self.rooms[room].hardness_per_m {
            Some(per_m) => {
                let at = door.crossing.nearest_to(arrival.at);
                (at, arrival.at.distance(at) * per_m)
            }
            None => (door.at, 0.0),
        };
        let cost = arrival.cost + leg + door.hardness.unwrap_or(f64::INFINITY);
        Arrival { from: Some((room, door.door)), cost, leg, at, hops: arrival.hops + 1 }
    }

    /// Best arrival at a goal point among the rooms that hold it: the room's index, and the hardness of the
    /// last way inside it.
    pub fn arrival_at(
        &self,
        tree: &[Option<Arrival>],
        rooms: &[usize],
        goal: Point,
    ) -> Option<(usize, Arrival, f64)> {
        let reached = rooms.iter().filter_map(|&room| {
            let arrival = tree[room]?;
            let per_m = self.rooms[room].hardness_per_m.unwrap_or(0.0);
            Some((room, arrival, arrival.at.distance(goal) * per_m))
        });
        reached.min_by(|a, b| (a.1.cost + a.2).total_cmp(&(b.1.cost + b.2)).then(a.0.cmp(&b.0)))
    }
}

fn better(candidate: Arrival, known: Arrival) -> bool {
    match candidate.cost.total_cmp(&known.cost) {
        Ordering::Less => true,
        Ordering::Greater => false,
        Ordering::Equal => {
            known.from.is_some() && candidate.from.map(|(_, door)| door) < known.from.map(|(_, door)| door)
        }
    }
}

#[derive(Clone, Copy, PartialEq)]
struct Candidate {
    cost: f64,
    room: usize,
}

impl Eq for Candidate {}

impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        other.cost.total_cmp(&self.cost).then_with(|| other.room.cmp(&self.room))
    }
}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
