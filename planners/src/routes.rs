//! Routes of least total hardness over rooms and doors.
//!
//! Where all hardness lies on the doors (the paper's Table 6), the search is Dijkstra's ([`Tree`]), or goes up and down a
//! hierarchy of rooms where one was [prepared](RouteGraph::prepare);
//! [petgraph](https://docs.rs/petgraph), which the graph can be [handed to](RouteGraph::petgraph), is the reference that
//! tests compare with. Its `dijkstra` returns no predecessors, cannot tell two doors between the same rooms apart and is
//! slower (`cargo bench -p adit-planners --bench routes` has both), so the loop is our own.
//!
//! Where rooms weigh their metres, a [`Way`] is measured as it is driven: from point to point, straight where nothing
//! is in the way. The search is any-angle over the mesh of rooms, and what it finds is pulled tight.

mod blocked;
mod by_hierarchy;
mod closed;
mod compact;
mod cone;
mod gates;
mod hierarchy;
mod lazy;
mod mesh;
mod on_doors;
mod pull;
mod taut;
mod way;

use std::cmp::Ordering;
use std::sync::OnceLock;

use petgraph::graph::{DiGraph, NodeIndex};

use crate::geometry::tolerance::ROUNDING;
use crate::geometry::{Point, Rect};
use closed::Cut;
use gates::Gate;
use hierarchy::Hierarchy;
use mesh::Mesh;
use taut::{Outcome, Search, Wanted};

pub use blocked::{Blockage, blockage};
pub use closed::Closed;
pub use compact::{CompactGraph, CompactTree, NONE};
pub use lazy::LazyRoute;
pub use on_doors::{Arrival, Tree};
pub use way::{Leg, Way};

/// A room as the search sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RouteRoom {
    pub rect: Rect,
    pub walking: Walking,
}

impl RouteRoom {
    fn is_measured(&self) -> bool {
        matches!(self.walking, Walking::PerMetre(_))
    }
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
    /// How many rooms weigh their metres.
    measured: usize,
    hierarchy: Option<Hierarchy>,
    mesh: Mesh,
    /// For each end of a door whether a way may bend there.
    bends: Vec<bool>,
    /// For each door what passing it changes.
    passing: Vec<Passing>,
    /// For each change, and both of its directions, where it may pay to begin it; found when first asked for.
    gates: Vec<[OnceLock<Box<[Gate]>>; 2]>,
    /// Boundaries that nobody crosses.
    closed: Vec<Closed>,
    /// The rooms cut along them; found when first asked for.
    cut: OnceLock<Box<Cut>>,
    /// Boundaries along which these rooms are cut already.
    walls: Vec<Rect>,
}

impl RouteGraph {
    /// The graph of all doors with a known hardness that are passable; other doors are kept for [`blockage`].
    pub fn new(rooms: Vec<RouteRoom>, doors: Vec<RouteDoor>) -> Self {
        let mesh = Mesh::new(&rooms, &doors);
        let gates = vec![[OnceLock::new(), OnceLock::new()]; doors.len()];
        let (bends, passing) = (vec![false; mesh.ends_count()], Vec::new());
        let measured = rooms.iter().filter(|room| room.is_measured()).count();
        let mut all = Self {
            rooms,
            doors,
            measured,
            hierarchy: None,
            mesh,
            bends,
            passing,
            gates,
            closed: Vec::new(),
            cut: OnceLock::new(),
            walls: Vec::new(),
        };
        all.passing = (0..all.doors.len()).map(|door| all.passing_of(door)).collect();
        all.find_bends(&(0..all.doors.len()).collect::<Vec<_>>());
        all
    }

    /// Makes [`way`](Self::way) quick between any two rooms, where all hardness lies on the doors; elsewhere it does
    /// nothing. What is prepared follows [`reweigh`](Self::reweigh), and clones share what does not hang on weights.
    ///
    /// It takes about half a second for 100,000 doors.
    pub fn prepare(&mut self) {
        if self.hierarchy.is_none() && self.is_on_doors() {
            let passing = (0..self.doors.len()).map(|door| self.passing_both_ways(door)).collect();
            let at = self.rooms.iter().map(|room| room.rect.centre()).collect();
            let door = |door: &RouteDoor| hierarchy::Door { rooms: [door.room1, door.room2], key: door.door };
            let doors: Vec<_> = self.doors.iter().map(door).collect();
            self.hierarchy = Some(Hierarchy::new(at, &doors, passing));
        }
    }

    /// What passing a door weighs from its first room and from its second; infinite where it is not passed.
    fn passing_both_ways(&self, door: usize) -> [f64; 2] {
        let weight = self.passage(door).unwrap_or(f64::INFINITY);
        [weight, if self.doors[door].one_way { f64::INFINITY } else { weight }]
    }

    /// Weighs rooms and doors anew, by index; what is not named stays as it is.
    ///
    /// Where all hardness lies on the doors, and no room comes to weigh or to be entered otherwise, it takes as long as
    /// there are doors named, and ways that lead through them.
    pub fn reweigh(
        &mut self,
        rooms: impl IntoIterator<Item = (usize, Walking)>,
        doors: impl IntoIterator<Item = (usize, Option<f64>, bool)>,
    ) {
        let (rooms, doors) = (rooms.into_iter().collect::<Vec<_>>(), doors.into_iter().collect::<Vec<_>>());
        self.reweigh_cut(&rooms, &doors);
        let was_on_doors = self.is_on_doors();
        let (mut touched, mut orders, mut is_other_price) = (Vec::new(), Vec::new(), false);
        let rooms: Vec<(usize, Walking)> =
            rooms.into_iter().filter(|(room, walking)| self.rooms[*room].walking != *walking).collect();
        if !rooms.is_empty() {
            touched = (0..self.doors.len()).collect();
            orders = touched.iter().map(|&door| self.order(door)).collect();
        }
        for (room, walking) in rooms {
            let room = &mut self.rooms[room];
            self.measured -= usize::from(room.is_measured());
            room.walking = walking;
            self.measured += usize::from(room.is_measured());
        }
        let is_all = !touched.is_empty();
        for (door, hardness, passable) in doors {
            let before = self.doors[door].weight();
            (self.doors[door].hardness, self.doors[door].passable) = (hardness, passable);
            is_other_price |= self.doors[door].is_change() && self.doors[door].weight() != before;
            if !is_all {
                touched.push(door);
            }
        }
        let changed: Vec<usize> =
            touched.iter().copied().filter(|&door| self.passing[door] != self.passing_of(door)).collect();
        for &door in &changed {
            self.passing[door] = self.passing_of(door);
        }
        self.find_bends(&changed);
        self.reweigh_hierarchy(&touched);
        if was_on_doors && self.is_on_doors() {
            return;
        }
        // a gate hangs on which of two rooms is easier, on what is free beside it, and on the prices of changes
        if is_other_price || !changed.is_empty() {
            self.gates.fill_with(Default::default);
        } else {
            for (door, before) in orders.into_iter().enumerate() {
                if before != self.order(door) {
                    self.gates[door] = Default::default();
                }
            }
        }
    }

    /// Weighs these doors, by index, anew where ways between any two rooms are prepared.
    fn reweigh_hierarchy(&mut self, doors: &[usize]) {
        let Some(mut hierarchy) = self.hierarchy.take() else { return };
        hierarchy.reweigh(doors.iter().map(|&door| (door as u32, self.passing_both_ways(door))));
        self.hierarchy = Some(hierarchy);
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
    ///
    /// Where all hardness lies on the doors, and ways are [prepared](Self::prepare), nothing is looked at but what lies
    /// above start and goal in the hierarchy; elsewhere [`tree`](Self::tree) finds the way. Both cost the same; where
    /// several ways do, they may give different ones.
    pub fn way(&self, start: &Start, goals: &[Goal]) -> Option<(usize, Way)> {
        if let Some(hierarchy) = self.hierarchy.as_ref().filter(|_| self.is_on_doors()) {
            return self.way_by(hierarchy, start, goals);
        }
        if self.is_on_doors() {
            let all = self.ways(start, goals, false).goals.into_iter().enumerate();
            let ways = all.filter_map(|(goal, way)| Some((goal, way?)));
            return ways.min_by(|(_, one), (_, two)| one.cost.total_cmp(&two.cost));
        }
        if let Some(cut) = self.cut() {
            return cut.way(start, goals);
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
            let rounding = ROUNDING * best.cost;
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
        if let Some(cut) = self.cut() {
            return cut.ways(start, goals, rooms);
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
        self.measured == 0
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

    pub fn rooms(&self) -> &[RouteRoom] {
        &self.rooms
    }

    /// The doors, passable or not.
    pub fn doors(&self) -> &[RouteDoor] {
        &self.doors
    }

    /// The passable doors as petgraph has a graph, for any of its algorithms; edge weights are indices into
    /// [`RouteGraph::doors`].
    pub fn petgraph(&self) -> DiGraph<(), u32> {
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
        graph
    }
}
