//! Routes of least total hardness over rooms and doors.
//!
//! [petgraph](https://docs.rs/petgraph) holds the graph and is the reference that tests compare with. Its `dijkstra`
//! returns no predecessors and cannot tell two doors between the same rooms apart, so the search here is a loop of
//! our own over petgraph's edges that keeps how each room was entered, by which door and where.
//!
//! Where a room weighs its metres, it matters where it was entered: the robot squats down just before the pipe, not
//! where it enters the corridor. So a room keeps every arrival that no other one makes superfluous. Rooms are convex:
//! an arrival is superfluous if walking over from another one costs no more.

mod blocked;
mod compact;
mod crossing;
mod lazy;
mod search;
mod tree;

use petgraph::graph::{DiGraph, NodeIndex};

use crate::geometry::{Point, Rect};

pub use blocked::{Blockage, blockage};
pub use compact::{CompactGraph, CompactTree, NONE};
pub use lazy::LazyRoute;
pub use tree::{Arrival, Tree};

/// A room as the search sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RouteRoom {
    /// Its rectangle.
    pub rect: Rect,
    /// What walking in it weighs.
    pub walking: Walking,
}

/// What walking in a room weighs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Walking {
    /// Nothing by itself: all hardness lies on the doors (the paper's Table 6).
    OnDoors,
    /// So much a metre.
    PerMetre(f64),
    /// Unknown: no route enters.
    Unknown,
}

impl Walking {
    /// Hardness of a metre, where metres are weighed.
    pub fn per_m(self) -> Option<f64> {
        match self {
            Self::PerMetre(hardness) => Some(hardness),
            Self::OnDoors | Self::Unknown => None,
        }
    }
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
    /// Whether it is an area in which the robot changes its shape, not a segment to pass.
    pub fn is_change(&self) -> bool {
        self.crossing.dx() > 0.0 && self.crossing.dy() > 0.0
    }

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
            let known = |room: usize| rooms[room].walking != Walking::Unknown;
            if door.weight().is_some() && known(door.room1) && known(door.room2) {
                let (a, b) = (NodeIndex::new(door.room1), NodeIndex::new(door.room2));
                graph.add_edge(a, b, index as u32);
                if !door.one_way {
                    graph.add_edge(b, a, index as u32);
                }
            }
        }
        Self { rooms, doors, graph }
    }

    /// Whether a route may pass the door, by index.
    fn is_open(&self, door: usize) -> bool {
        let known = |room: usize| self.rooms[room].walking != Walking::Unknown;
        let door = &self.doors[door];
        door.weight().is_some() && known(door.room1) && known(door.room2)
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
}
