//! Routes of least total hardness over rooms and doors.
//!
//! Where all hardness lies on the doors (the paper's Table 6), the search is Dijkstra's ([`Tree`]);
//! [petgraph](https://docs.rs/petgraph) holds the graph and is the reference that tests compare with. Its `dijkstra`
//! returns no predecessors and cannot tell two doors between the same rooms apart, so the loop is our own.
//!
//! Where rooms weigh their metres, a [`Way`] is measured as it is driven: from point to point, straight where nothing
//! is in the way. The search is any-angle over the mesh of rooms, and what it finds is pulled tight.

mod blocked;
mod compact;
mod cone;
mod gates;
mod lazy;
mod mesh;
mod on_doors;
mod pull;
mod taut;
mod way;

use std::cmp::Ordering;
use std::sync::OnceLock;

use petgraph::graph::{DiGraph, NodeIndex};

use crate::geometry::{Point, Rect};
use gates::Gate;
use mesh::Mesh;
use taut::{Outcome, Search, Wanted};

pub use blocked::{Blockage, blockage};
pub use compact::{CompactGraph, CompactTree, NONE};
pub use lazy::LazyRoute;
pub use on_doors::{Arrival, Tree};
pub use way::{Leg, Way};

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

/// Where a search may end.
#[derive(Clone, Debug, PartialEq)]
pub struct Goal {
    /// Rooms that hold it.
    pub rooms: Vec<usize>,
    /// The point; `None`: anywhere in one of the rooms.
    pub at: Option<Point>,
}

/// The ways from one start.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Ways {
    /// To each goal, in their order; `None` where it is not reached.
    pub goals: Vec<Option<Way>>,
    /// To each room, by index: to where it is reached first. Empty unless asked for.
    pub rooms: Vec<Option<Way>>,
}

/// What passing a door changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Passing {
    /// Nothing.
    Free,
    /// What a metre weighs, or it weighs something itself.
    Open,
    /// Nobody passes.
    Shut,
}

/// Rooms joined by doors.
#[derive(Clone, Debug)]
pub struct RouteGraph {
    rooms: Vec<RouteRoom>,
    doors: Vec<RouteDoor>,
    graph: DiGraph<(), u32>,
    mesh: Mesh,
    /// For each end of a door whether a way may bend there.
    bends: Vec<bool>,
    /// For each door what passing it changes.
    passing: Vec<Passing>,
    /// For each change, and both of its directions, where it may pay to begin it; found when first asked for.
    gates: Vec<[OnceLock<Box<[Gate]>>; 2]>,
}

impl RouteGraph {
    /// The graph of all doors with a known hardness that are passable; other doors are kept for [`blockage`].
    pub fn new(rooms: Vec<RouteRoom>, doors: Vec<RouteDoor>) -> Self {
        let mesh = Mesh::new(&rooms, &doors);
        let gates = vec![[OnceLock::new(), OnceLock::new()]; doors.len()];
        let (bends, passing) = (vec![false; mesh.ends_count()], Vec::new());
        let graph = DiGraph::default();
        let mut all = Self { rooms, doors, graph, mesh, bends, passing, gates };
        all.passing = (0..all.doors.len()).map(|door| all.passing_of(door)).collect();
        all.find_bends(&(0..all.doors.len()).collect::<Vec<_>>());
        all.join();
        all
    }

    /// Joins the rooms by the doors that can be passed.
    fn join(&mut self) {
        let mut graph = DiGraph::with_capacity(self.rooms.len(), self.doors.len() * 2);
        for _ in &self.rooms {
            graph.add_node(());
        }
        for (index, door) in self.doors.iter().enumerate().filter(|(index, _)| self.is_open(*index)) {
            let (a, b) = (NodeIndex::new(door.room1), NodeIndex::new(door.room2));
            graph.add_edge(a, b, index as u32);
            if !door.one_way {
                graph.add_edge(b, a, index as u32);
            }
        }
        self.graph = graph;
    }

    /// Weighs rooms and doors anew, by index; what is not named stays as it is.
    pub fn reweigh(
        &mut self,
        rooms: impl IntoIterator<Item = (usize, Walking)>,
        doors: impl IntoIterator<Item = (usize, Option<f64>, bool)>,
    ) {
        let orders: Vec<Ordering> = (0..self.doors.len()).map(|door| self.order(door)).collect();
        let mut is_other_price = false;
        for (room, walking) in rooms {
            self.rooms[room].walking = walking;
        }
        for (door, hardness, passable) in doors {
            let before = self.doors[door].weight();
            (self.doors[door].hardness, self.doors[door].passable) = (hardness, passable);
            is_other_price |= self.doors[door].is_change() && self.doors[door].weight() != before;
        }
        let changed: Vec<usize> =
            (0..self.doors.len()).filter(|&door| self.passing[door] != self.passing_of(door)).collect();
        let is_shut = |passing: Passing| passing == Passing::Shut;
        let mut is_joined_anew = false;
        for &door in &changed {
            let now = self.passing_of(door);
            is_joined_anew |= is_shut(now) != is_shut(self.passing[door]);
            self.passing[door] = now;
        }
        if is_joined_anew {
            self.join();
        }
        self.find_bends(&changed);
        // a gate hangs on which of two rooms is easier, on what is free beside it, and on the prices of changes
        let all = is_other_price || !changed.is_empty();
        for (door, before) in orders.into_iter().enumerate() {
            if all || before != self.order(door) {
                self.gates[door] = [OnceLock::new(), OnceLock::new()];
            }
        }
    }

    /// Finds about which ends of these doors a way may bend.
    fn find_bends(&mut self, doors: &[usize]) {
        let ends = doors.iter().flat_map(|&door| self.mesh.ends[door]).filter(|&end| end != mesh::NONE);
        let mut ends: Vec<u32> = ends.collect();
        ends.sort_unstable();
        ends.dedup();
        for end in ends {
            self.bends[end as usize] =
                self.mesh.bends(&self.rooms, &self.doors, end, |door| self.passing[door]);
        }
    }

    fn passing_of(&self, door: usize) -> Passing {
        if self.is_free(door) {
            Passing::Free
        } else if self.passage(door).is_some() {
            Passing::Open
        } else {
            Passing::Shut
        }
    }

    /// Which of a door's rooms is easier.
    fn order(&self, door: usize) -> Ordering {
        self.per_m(self.doors[door].room2).total_cmp(&self.per_m(self.doors[door].room1))
    }

    /// The best way to the goal that costs least, with that goal's index.
    ///
    /// Where rooms weigh metres, the way is the shortest one of its kind to within the rounding of numbers between
    /// points where hardness changes or a shape is changed, and those points are the best ones near the
    /// best of points at most half a metre apart.
    pub fn way(&self, start: &Start, goals: &[Goal]) -> Option<(usize, Way)> {
        if self.is_on_doors() {
            let all = self.ways(start, goals, false).goals.into_iter().enumerate();
            let ways = all.filter_map(|(goal, way)| Some((goal, way?)));
            return ways.min_by(|(_, one), (_, two)| one.cost.total_cmp(&two.cost));
        }
        let outcome = Search::find(self, start, goals, Wanted::One);
        let ways = (0..goals.len()).filter_map(|goal| Some((goal, self.best(&outcome, start, goal)?)));
        ways.min_by(|(_, one), (_, two)| one.cost.total_cmp(&two.cost))
    }

    /// The best of the ways to a goal that were found, pulled tight.
    fn best(&self, outcome: &Outcome, start: &Start, goal: usize) -> Option<Way> {
        let ways = outcome.goals[goal].iter().map(|found| Way::of(self, &outcome.nodes, start, found));
        ways.reduce(|best, way| {
            // of ways that cost the same to a rounding, the one that passes fewer doors
            let rounding = 1e-9 * best.cost;
            let is_better = way.cost < best.cost - rounding
                || way.cost <= best.cost + rounding && way.legs.len() < best.legs.len();
            if is_better { way } else { best }
        })
    }

    /// The best ways to all goals; and to all rooms, where asked for.
    pub fn ways(&self, start: &Start, goals: &[Goal], rooms: bool) -> Ways {
        if self.is_on_doors() {
            return self.tree(start).ways(self, start, goals, rooms);
        }
        let wanted = if rooms { Wanted::Rooms } else { Wanted::Goals };
        let outcome = Search::find(self, start, goals, wanted);
        let way = |found: &Option<taut::Found>| {
            found.as_ref().map(|found| Way::of(self, &outcome.nodes, start, found))
        };
        Ways {
            goals: (0..goals.len()).map(|goal| self.best(&outcome, start, goal)).collect(),
            rooms: outcome.rooms.iter().map(way).collect(),
        }
    }

    /// Whether no room weighs its metres.
    pub fn is_on_doors(&self) -> bool {
        !self.rooms.iter().any(|room| matches!(room.walking, Walking::PerMetre(_)))
    }

    /// For each room whether open doors join it with one of these.
    fn joined_with(&self, rooms: &[usize]) -> Vec<bool> {
        let mut joined = vec![false; self.rooms.len()];
        let mut waiting: Vec<usize> = rooms.iter().copied().filter(|&room| self.is_entered(room)).collect();
        while let Some(room) = waiting.pop() {
            if !std::mem::replace(&mut joined[room], true) {
                let open = |exit: &&mesh::Exit| self.is_open(exit.door as usize);
                let exits = self.mesh.portals.of(room).iter().chain(self.mesh.changes.of(room));
                waiting.extend(exits.filter(open).map(|exit| exit.to as usize));
            }
        }
        joined
    }

    /// Whether a route may pass the door, by index.
    fn is_open(&self, door: usize) -> bool {
        self.passage(door).is_some()
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
