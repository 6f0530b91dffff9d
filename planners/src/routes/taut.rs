//! The search where rooms weigh their metres: any-angle, over doors as they are seen through one another.
//!
//! Within rooms of equal hardness a shortest way is straight but for bends about corners, so the search carries
//! what a corner sees: a node is a bend (its root) and the part of a door that is seen from it, as in Polyanya
//! (Cui, Harabor, Grastien: "Compromise-free pathfinding on a navigation mesh", IJCAI 2017). Where hardness changes a
//! way is refracted, and where the robot changes its shape it may do so at any point of the rim of the free space of
//! either state: there the search goes on from points of the segment, and [`super::pull`] slides them afterwards.

mod bounds;
mod changes;
mod missed;

use std::cmp::Ordering;
use std::collections::{BTreeMap, BinaryHeap, HashMap, HashSet};
use std::rc::Rc;

use fixedbitset::FixedBitSet;
use smallvec::SmallVec;

use super::cone::{Gap, Segment, View};
use super::cost::{hardly_less, hardly_more};
use super::graph::RouteGraph;
use super::mesh::{EPSILON, Exit, NONE};
use super::parts::{DoorIndex, Entry, Goal, RoomIndex, Start};
use super::turning::Turning;
use crate::geometry::{Point, Rect};

/// Points at which a way is refracted or a shape is changed lie at most so far apart, metres; they are slid
/// to the best place afterwards.
const APART_M: f64 = 0.5;

/// A strip along a wall may be entered so near to a goal, metres: the goal may lie in it.
const NEAR_M: f64 = 2.0;

/// A change so near to a point is one at the point, metres: thin ones may be left out beside others.
const CLOSE_M: f64 = 0.3;

/// Ways that cost more than the best by at most this share are looked for, too: sliding may turn their order about.
const SLACK: f64 = 0.03;

/// So many ways to a goal are pulled tight.
const MOST_WAYS: usize = 16;

/// So many of those that change their shape, or are refracted, at the same doors one after the other.
const MOST_ALIKE: usize = 4;

/// So many ways into a room, where ways to all are asked for.
const MOST_INTO_ROOM: usize = 4;

/// Where ways to so many goals are wanted, the search is led by where they lie: more lie in all directions.
const FEW: usize = 16;

/// No node, before the first.
pub(super) const NO_NODE: u32 = u32::MAX;

/// Points of a segment from which a search goes on.
type Points = SmallVec<[Point; 16]>;

/// A way into a room, up to what is seen of the door.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    /// The last bend.
    pub root: Point,
    /// Hardness up to the root, with what doors passed since then weigh.
    pub cost: f64,
    /// The node from which this one was found; [`NO_NODE`] at the start.
    pub before: u32,
    pub room: RoomIndex,
    /// The door by which it was entered; [`DoorIndex::end`] at the start.
    pub door: DoorIndex,
    /// The last door at which the way changed its shape or was refracted; [`DoorIndex::end`] before the first.
    pub stop: DoorIndex,
    /// Whether the way bent at the root without passing a door.
    pub bent: bool,
    /// What of the room is seen.
    pub view: View,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Found {
    pub node: u32,
    pub at: Point,
    pub cost: f64,
    /// A change of shape at the goal itself.
    pub change: Option<Exit>,
}

/// The nodes of a search, and what was reached.
pub(super) struct Outcome {
    pub nodes: Vec<Node>,
    /// For each goal some ways that cost least before they are pulled tight; the cheapest first.
    pub goals: Vec<Vec<Found>>,
    /// For each room some ways that cost least to its nearest point, of those that stopped last at the same door the best one,
    /// where that was asked for.
    pub rooms: Vec<Vec<Found>>,
    /// Nodes that were not gone on from, since others come to their rooms at a little less cost before ways are pulled tight.
    pub passed_over: Vec<u32>,
    /// Whether ways that cost more were not looked for.
    pub is_cut: bool,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Wanted {
    One,
    Goals,
    Rooms,
}

/// A goal in a room: where it is, and the hardness of a change of shape and of a leg that have to follow there.
#[derive(Clone, Copy)]
struct Target {
    goal: usize,
    /// The goal, or where the leg to it leaves the rooms.
    at: Option<Point>,
    change: Option<(Exit, f64)>,
    /// What that leg costs.
    leg: f64,
}

pub(super) struct Search<'g> {
    graph: &'g RouteGraph,
    turning: &'g Turning,
    goals: &'g [Goal],
    wanted: Wanted,
    /// The rooms from which ways lead to a goal only by doors at which ways turn back, and the rectangle about those doors.
    through: Option<(FixedBitSet, Rect)>,
    /// Whether a way may end anywhere in a room, not at a point alone.
    ends_in_rooms: bool,
    /// For each room the goals in it.
    targets: Vec<(RoomIndex, Target)>,
    /// The least hardness of a metre anywhere.
    least_per_m: f64,
    /// What arcs about corners save a way at most.
    saved_by_arcs: f64,
    /// What a way may cost before it is pulled tight and still be the best.
    most: f64,
    /// The same of ways to each goal, where those to all of a few are wanted.
    most_to: Vec<f64>,
    nodes: Vec<Node>,
    /// Goals that were seen, with where from.
    found: Vec<(usize, Found)>,
    queue: BinaryHeap<Candidate>,
    /// For each room points that are reached, with their costs: a room is convex, so from each of them every point
    /// of the room costs at most the way over.
    reached: Vec<Vec<(Point, f64)>>,
    /// The same of points at which a change of shape into the room was found, though it was not gone on from there yet.
    offered: Vec<Vec<(Point, f64)>>,
    /// For each end of a door the least cost of a way that bends there.
    bent: Vec<f64>,
    /// The same of ends about which one does not come from each room into each other one, by the rooms that belong together.
    bent_in_part: HashMap<(u32, RoomIndex), f64>,
    /// Roots from which a room was looked at already: the room, the point, and to which side.
    looked: HashSet<(RoomIndex, u64, u64, u8)>,
    /// Where the states end that lie between those of a change, from a room; found when first asked for.
    ends_of_sequences: HashMap<(DoorIndex, RoomIndex), Rc<[Segment]>>,
    /// How many ways to a goal were found that stop at the same doors.
    alike: HashMap<(usize, Vec<DoorIndex>), usize>,
    outcome: Outcome,
    /// Rooms into which shapes are changed on all sides of areas, not on gates only.
    freely: FixedBitSet,
}

impl<'g> Search<'g> {
    /// The best way from `start` to each goal; with [`Wanted::One`] to the one that costs least. Ways that cost more than the
    /// limit are not looked for.
    pub fn find(
        graph: &'g RouteGraph,
        start: &Start,
        goals: &'g [Goal],
        wanted: Wanted,
        limit: f64,
    ) -> Outcome {
        let mut outcome = Self::new(graph, goals, (wanted, limit), FixedBitSet::new()).run(start);
        outcome.look_for_missed(graph, start, goals, wanted, limit);
        outcome
    }

    fn new(
        graph: &'g RouteGraph,
        goals: &'g [Goal],
        (wanted, limit): (Wanted, f64),
        freely: FixedBitSet,
    ) -> Self {
        let mut targets = Vec::new();
        for (index, goal) in goals.iter().enumerate() {
            for &Entry { room, joint } in &goal.rooms {
                let at = joint.or(goal.at);
                let leg =
                    joint.zip(goal.at).map_or(0.0, |(joint, at)| graph.per_m(room) * joint.distance(at));
                targets.push((room, Target { goal: index, at, change: None, leg }));
                let Some(at) = at else { continue };
                for exit in graph.exits.changes_into(room) {
                    let door = &graph[exit.door];
                    if let Some(weight) = graph.passage(exit.door)
                        && door.crossing.area().is_some_and(|area| area.contains(at))
                    {
                        let change = Some((Exit { door: exit.door, to: room }, weight));
                        targets.push((exit.to, Target { goal: index, at: Some(at), change, leg }));
                    }
                }
            }
        }
        targets.sort_by_key(|(room, _)| *room);
        let rooms = graph.rooms().len();
        let kept = if wanted == Wanted::Rooms { rooms } else { 0 };
        let turning = graph.turning();
        let saved_by_arcs = graph.saved_by_arcs();
        let outcome = Outcome {
            nodes: Vec::new(),
            goals: vec![Vec::new(); goals.len()],
            rooms: vec![Vec::new(); kept],
            passed_over: Vec::new(),
            is_cut: false,
        };
        Self {
            graph,
            turning,
            goals,
            wanted,
            through: graph.leads_through(targets.iter().map(|(room, _)| *room)),
            ends_in_rooms: wanted == Wanted::Rooms || goals.iter().any(|goal| goal.at.is_none()),
            targets,
            least_per_m: graph.least_per_m(),
            saved_by_arcs,
            most: Self::slack(limit, saved_by_arcs),
            most_to: vec![f64::INFINITY; goals.len()],
            nodes: Vec::new(),
            found: Vec::new(),
            queue: BinaryHeap::new(),
            reached: vec![Vec::new(); rooms],
            offered: vec![Vec::new(); rooms],
            bent: vec![f64::INFINITY; turning.mesh.ends_count()],
            bent_in_part: HashMap::new(),
            looked: HashSet::new(),
            ends_of_sequences: HashMap::new(),
            alike: HashMap::new(),
            outcome,
            freely,
        }
    }

    fn run(mut self, start: &Start) -> Outcome {
        for &Entry { room, joint } in &start.rooms {
            if !self.graph.is_entered(room) {
                continue;
            }
            let root = joint.unwrap_or(start.at);
            self.push(Node {
                root,
                cost: joint.map_or(0.0, |joint| self.graph.per_m(room) * start.at.distance(joint)),
                before: NO_NODE,
                room,
                door: DoorIndex::end(),
                stop: DoorIndex::end(),
                bent: false,
                view: View::All,
            });
        }
        let mut missing = self.goals.len();
        let mut is_last = false;
        while let Some(candidate) = self.queue.pop() {
            if candidate.least > self.most {
                self.outcome.is_cut = true;
                break;
            }
            match candidate.what {
                What::Goal(found) => {
                    let (goal, found) = self.found[found as usize];
                    let known = &self.outcome.goals[goal];
                    missing -= usize::from(known.is_empty());
                    if known.len() < MOST_WAYS {
                        let alike = self.alike.entry((goal, self.stops_of(&found))).or_default();
                        *alike += 1;
                        if *alike <= MOST_ALIKE {
                            self.outcome.goals[goal].push(found);
                        }
                    }
                    let is_done = self.wanted == Wanted::One || missing == 0 && self.wanted == Wanted::Goals;
                    if is_done && !is_last {
                        let most = Self::slack(found.cost, self.saved_by_arcs) + self.slid(&found);
                        (self.most, is_last) = (self.most.min(most), true);
                    }
                }
                // some of the goals to which it may lead are found by now
                What::Node(index) if self.wanted == Wanted::Goals => {
                    match self.least_by(&self.nodes[index as usize]) {
                        Some(least) if least > candidate.least => {
                            self.queue.push(Candidate { least, ..candidate });
                        }
                        Some(_) => self.expand(index),
                        None => self.outcome.is_cut = true,
                    }
                }
                What::Node(index) => self.expand(index),
            }
        }
        let graph = self.graph;
        for (room, found) in graph.room_indices().zip(&mut self.outcome.rooms) {
            let most = least_of(found) + slid_in(graph, room);
            found.retain(|found| found.cost <= most);
        }
        self.outcome.nodes = self.nodes;
        self.outcome
    }

    fn push(&mut self, node: Node) {
        let Some(least) = self.least_by(&node) else {
            self.outcome.is_cut = true;
            return;
        };
        let index = self.nodes.len() as u32;
        self.nodes.push(node);
        self.queue.push(Candidate { least, what: What::Node(index) });
    }

    fn expand(&mut self, index: u32) {
        let node = self.nodes[index as usize];
        if self.is_superfluous(&node) {
            self.outcome.passed_over.push(index);
            return;
        }
        let side = match node.view {
            View::Through(_) => None,
            View::All => Some(0),
            View::Side { left, .. } => Some(1 + u8::from(left)),
        };
        let (x, y) = (node.root.x.to_bits(), node.root.y.to_bits());
        if side.is_some_and(|side| !self.looked.insert((node.room, x, y, side))) {
            self.outcome.passed_over.push(index);
            return;
        }
        let end = if node.bent { self.end_at(&node) } else { NONE };
        if end != NONE {
            let bent = self.bent_at(end, node.room);
            if *bent < hardly_less(node.cost) {
                self.outcome.passed_over.push(index);
                return;
            }
            *bent = node.cost;
        }
        self.remember(index, &node);
        self.arrive(index, &node);
        self.bend(index, &node);
        for exit in self.graph.exits.portals(node.room) {
            if exit.door != node.door || self.goes_along(&node, *exit) {
                self.pass(index, &node, *exit);
            }
        }
        for exit in self.graph.exits.changes(node.room) {
            if self.ends_in_rooms {
                self.arrive_by_change(index, &node, *exit);
            }
            self.change(index, &node, *exit);
        }
    }

    /// The least cost of a way that bends at an end in a room, or in one to which it may go on about that end.
    fn bent_at(&mut self, end: u32, room: RoomIndex) -> &mut f64 {
        match self.turning.part_of(end, room) {
            Some(part) => self.bent_in_part.entry((end, part)).or_insert(f64::INFINITY),
            None => &mut self.bent[end as usize],
        }
    }

    /// Whether a way that has just come out of a harder room may go along the door, and back in.
    fn goes_along(&self, node: &Node, exit: Exit) -> bool {
        node.stop == node.door
            && matches!(node.view, View::All)
            && self.graph.per_m(node.room) < self.graph.per_m(exit.to)
    }

    /// The end of a door at which a bent node bends: that of the door by which its room was entered.
    fn end_at(&self, node: &Node) -> u32 {
        if node.door == DoorIndex::end() {
            return NONE;
        }
        let ends = self.turning.mesh.ends(node.door);
        let Some(segment) = self.graph[node.door].crossing.segment() else { return NONE };
        match (ends, node.root.distance(segment.a) <= EPSILON) {
            ([end, _], true) | ([_, end], false) => end,
        }
    }

    /// Points at which nodes are compared.
    fn samples(node: &Node) -> ([Point; 4], usize) {
        match &node.view {
            View::Through(gap) => {
                let segment = gap.segment();
                ([segment.nearest_to(node.root), segment.a, segment.b, segment.at(0.5)], 4)
            }
            _ => ([node.root; 4], 1),
        }
    }

    /// Whether every point that the node sees of its door is reached at less cost.
    fn is_superfluous(&self, node: &Node) -> bool {
        let room = node.room;
        let per_m = self.graph.per_m(room);
        let (samples, count) = Self::samples(node);
        // what looks in all directions is needed once; what looks in some must give way to nothing that costs the same
        let yields_to_equal = node.view == View::All && node.before != NO_NODE;
        samples[..count].iter().all(|&p| {
            let cost = node.cost + per_m * node.root.distance(p);
            let limit = if yields_to_equal { hardly_more(cost) } else { hardly_less(cost) };
            self.is_cheaper_in(room, p, limit, per_m)
                || self.is_cheaper_by_a_change(room, p, hardly_less(cost), per_m)
        })
    }

    fn is_cheaper_in(&self, room: RoomIndex, p: Point, limit: f64, per_m: f64) -> bool {
        is_cheaper_from(&self.reached[room.index()], p, limit, per_m)
    }

    /// Whether walking in an easier state, and changing at the point or close to it, costs less.
    fn is_cheaper_by_a_change(&self, room: RoomIndex, p: Point, limit: f64, per_m: f64) -> bool {
        let graph = self.graph;
        graph.exits.changes_into(room).iter().any(|exit| {
            let from = exit.to;
            let easier = graph.per_m(from);
            let reached = &self.reached[from.index()];
            if easier > per_m || reached.is_empty() {
                return false;
            }
            let Some(area) = graph[exit.door].crossing.area() else { return false };
            // most changes are far away, or come too late, and that is told sooner than where exactly they are
            let Some(weight) = graph.passage(exit.door) else { return false };
            if !area.bounds().grown(CLOSE_M).contains(p)
                || !is_cheaper_from(reached, p, limit - weight, easier)
            {
                return false;
            }
            let near = area.nearest_to(p);
            let aside = near.distance(p);
            aside <= CLOSE_M && is_cheaper_from(reached, near, limit - weight - aside * per_m, easier)
        })
    }

    fn remember(&mut self, index: u32, node: &Node) {
        let room = node.room;
        let per_m = self.graph.per_m(room);
        let (samples, count) = Self::samples(node);
        for &p in &samples[..count] {
            let cost = node.cost + per_m * node.root.distance(p);
            if !self.is_cheaper_in(room, p, hardly_more(cost), per_m) {
                self.reached[room.index()].push((p, cost));
            }
        }
        let at = samples[0];
        let cost = node.cost + per_m * node.root.distance(at);
        self.arrive_in(room, Found { node: index, at, cost, change: None });
    }

    /// Keeps a way into a room, where ways to all rooms are asked for and it may be the best once it is pulled tight.
    fn arrive_in(&mut self, room: RoomIndex, found: Found) {
        let stop = self.stop_of(&found);
        if !self.is_news(room, stop, found.cost) {
            return;
        }
        let known = &self.outcome.rooms[room.index()];
        let same = known.iter().position(|known| self.stop_of(known) == stop);
        let costs_most = |one: &usize, other: &usize| known[*one].cost.total_cmp(&known[*other].cost);
        let is_full = known.len() == MOST_INTO_ROOM;
        let instead = same.or_else(|| (0..known.len()).max_by(costs_most).filter(|_| is_full));
        let known = &mut self.outcome.rooms[room.index()];
        match instead {
            Some(instead) => known[instead] = found,
            None => known.push(found),
        }
    }

    /// What sliding its last stop along may save a way.
    fn slid(&self, found: &Found) -> f64 {
        let is_straight = self.stop_of(found) == DoorIndex::end();
        let room = self.nodes[found.node as usize].room;
        if is_straight { 0.0 } else { slid_in(self.graph, room) }
    }

    /// The last door at which a way that was found stops.
    fn stop_of(&self, found: &Found) -> DoorIndex {
        found.change.map_or(self.nodes[found.node as usize].stop, |exit| exit.door)
    }

    /// All doors at which it stops, the last one first.
    fn stops_of(&self, found: &Found) -> Vec<DoorIndex> {
        let mut stops = vec![self.stop_of(found)];
        let mut index = found.node;
        while index != NO_NODE {
            let node = &self.nodes[index as usize];
            if stops.last() != Some(&node.stop) {
                stops.push(node.stop);
            }
            index = node.before;
        }
        stops
    }

    /// Whether ways to all rooms are asked for, and those into this one that are known leave a chance that one of this cost is
    /// the best when they are pulled tight.
    fn is_news(&self, room: RoomIndex, stop: DoorIndex, cost: f64) -> bool {
        let Some(known) = self.outcome.rooms.get(room.index()) else { return false };
        let best = least_of(known);
        if stop == DoorIndex::end() || best.is_infinite() {
            return cost < best;
        }
        let beaten = |known: &Found| known.cost <= cost && self.stop_of(known) == stop;
        cost < best + slid_in(self.graph, room)
            && !known.iter().any(beaten)
            && (known.len() < MOST_INTO_ROOM || known.iter().any(|known| cost < known.cost))
    }

    /// The goals in the room.
    fn arrive(&mut self, index: u32, node: &Node) {
        let first = self.targets.partition_point(|(room, _)| *room < node.room);
        let per_m = self.graph.per_m(node.room);
        for place in first..self.targets.len() {
            let (room, target) = self.targets[place];
            if room != node.room {
                break;
            }
            let at = target.at.unwrap_or_else(|| Self::samples(node).0[0]);
            if node.view.sees(node.root, at) {
                let weight = target.change.map_or(0.0, |(_, weight)| weight);
                let cost = node.cost + per_m * node.root.distance(at) + weight + target.leg;
                let change = target.change.map(|(exit, _)| exit);
                self.arrive_at(target.goal, Found { node: index, at, cost, change });
            }
        }
    }

    fn arrive_at(&mut self, goal: usize, found: Found) {
        if self.outcome.goals[goal].len() < MOST_WAYS {
            if self.wanted == Wanted::One || self.is_led() {
                let slid = self.targets.iter().map(|(room, _)| slid_in(self.graph, *room));
                let slid = slid.fold(self.slid(&found), f64::max);
                let limit = Self::slack(found.cost, self.saved_by_arcs) + slid;
                let most = if self.wanted == Wanted::One { &mut self.most } else { &mut self.most_to[goal] };
                *most = most.min(limit);
            }
            let what = What::Goal(self.found.len() as u32);
            self.found.push((goal, found));
            self.queue.push(Candidate { least: found.cost, what });
        }
    }

    /// The bends about the ends of the door through which the node sees.
    fn bend(&mut self, index: u32, node: &Node) {
        let View::Through(gap) = node.view else { return };
        let per_m = self.graph.per_m(node.room);
        for (end, root, left) in [(gap.left_end, gap.left, true), (gap.right_end, gap.right, false)] {
            if !self.turning.bends_at(end) {
                continue;
            }
            let cost = node.cost + per_m * node.root.distance(root);
            let view = View::Side { from: node.root, left };
            let bent = Node { root, cost, before: index, bent: true, view, ..*node };
            let least = *self.bent_at(end, node.room);
            if cost <= hardly_more(least) {
                self.push(bent);
            } else if cost <= least + self.saved_by_arcs {
                self.outcome.passed_over.push(self.nodes.len() as u32);
                self.nodes.push(bent);
            }
        }
    }

    /// Through a door, as far as it is seen.
    fn pass(&mut self, index: u32, node: &Node, exit: Exit) {
        let Exit { door, to: room } = exit;
        let Some(weight) = self.graph.passage(door) else { return };
        let here = self.graph.per_m(node.room);
        let Some(segment) = self.graph[door].crossing.segment() else { return };
        if self.is_entered_before(node, room) {
            return;
        }
        let is_same = self.graph.per_m(room).to_bits() == here.to_bits();
        let is_turned_at = self.graph.turns.contains(door.index());
        let next = |root: Point, way: f64, view: View| Node {
            root,
            cost: node.cost + way * here + weight,
            before: index,
            room,
            door,
            stop: if is_same { node.stop } else { door },
            bent: false,
            view,
        };
        if (!is_same || is_turned_at)
            && let Some(seen) = node.view.of_gate(node.root, segment)
        {
            let there = self.graph.per_m(room);
            for p in self.points(room, seen, node.root) {
                let next = Node { stop: door, ..next(p, node.root.distance(p), View::All) };
                if door != node.door || !self.is_cheaper_in(room, p, hardly_more(next.cost), there) {
                    self.push(next);
                }
            }
        }
        if !is_same {
            return;
        }
        let is_inside = !matches!(node.view, View::Through(_));
        if segment.is_in_line_with(node.root) {
            let near = segment.nearest_to(node.root);
            let way = near.distance(node.root);
            if way <= EPSILON && is_inside {
                self.push(next(node.root, 0.0, node.view));
            } else if node.view.sees(node.root, near) {
                // along a wall, and about the near end
                let ends = self.turning.mesh.ends(door);
                let end = if near.distance(segment.a) <= EPSILON { ends[0] } else { ends[1] };
                if self.turning.bends_at(end) {
                    self.push(next(near, way, View::All));
                }
            }
            return;
        }
        if node.view.is_through(segment) {
            return;
        }
        let Some(seen) = node.view.of(node.root, segment) else { return };
        if seen.length() > EPSILON || segment.length() <= EPSILON {
            let gap = Gap::new(node.root, segment, seen, self.turning.mesh.ends(door));
            self.push(next(node.root, 0.0, View::Through(gap)));
        }
    }

    /// Whether the straight line on which a node goes on came through a room before: it comes through a convex room once, but
    /// for rounding between doors that lie on nearly one line.
    fn is_entered_before(&self, node: &Node, room: RoomIndex) -> bool {
        let mut on = node;
        while matches!(on.view, View::Through(_)) && on.before != NO_NODE {
            on = &self.nodes[on.before as usize];
            if on.room == room {
                return true;
            }
        }
        false
    }

    fn targets_in(&self, room: RoomIndex) -> impl Iterator<Item = Target> {
        let first = self.targets.partition_point(|(of, _)| *of < room);
        self.targets[first..].iter().take_while(move |(of, _)| *of == room).map(|(_, target)| *target)
    }

    /// Points of a segment from which the search goes on into a room: the one nearest to the root, those nearest to
    /// goals in the room, the ends, and some between.
    fn points(&self, room: RoomIndex, seen: Segment, root: Point) -> Points {
        let length = seen.length();
        let mut points = Points::from_slice(&[seen.nearest_to(root)]);
        let is_among = |points: &[Point], p: Point| points.iter().any(|known| known.distance(p) <= EPSILON);
        for at in self.targets_in(room).filter_map(|target| target.at) {
            let foot = seen.nearest_to(at);
            if !is_among(&points, foot) {
                points.push(foot);
            }
        }
        let pieces = if length <= EPSILON { 0 } else { (length / APART_M).ceil().clamp(1.0, 64.0) as u32 };
        // these are apart from each other
        let others = points.len();
        for p in (0..=pieces).map(|piece| seen.at(f64::from(piece) / f64::from(pieces.max(1)))) {
            if !is_among(&points[..others], p) {
                points.push(p);
            }
        }
        points
    }
}

impl Outcome {
    /// Where a way that was found may come to one of its rooms otherwise: a node of its own, and the one that was passed over.
    /// What arcs about corners save is not known before ways are pulled tight, so one that lagged behind by no more may be better.
    pub fn otherwise(&self, graph: &RouteGraph, found: &Found) -> Vec<(u32, u32)> {
        let saved = graph.saved_by_arcs();
        // the rooms of the way, with their nodes and where each is left
        let mut own: Vec<Option<(u32, Point)>> = vec![None; graph.rooms().len()];
        let (mut index, mut to) = (found.node, found.at);
        while index != NO_NODE {
            let node = &self.nodes[index as usize];
            own[node.room.index()].get_or_insert((index, to));
            let door = crossing_of(graph, node);
            to = door.map_or(node.root, |door| door.passed_at(node.root, to));
            index = node.before;
        }
        // of those that come from one bend, the one that lags least
        let mut others: BTreeMap<(u64, u64), (f64, u32, u32)> = BTreeMap::new();
        for &other in &self.passed_over {
            let node = &self.nodes[other as usize];
            let Some((index, to)) = own[node.room.index()] else { continue };
            let mine = &self.nodes[index as usize];
            if mine.bend() == node.bend() {
                continue;
            }
            let cost = |node: &Node| node.cost + node.root.distance(to) * graph.per_m(node.room);
            let lag = cost(node) - cost(mine);
            let known = others.entry(node.bend()).or_insert((f64::INFINITY, index, other));
            if lag < known.0 {
                *known = (lag, index, other);
            }
        }
        others.into_values().filter(|(lag, ..)| *lag <= saved).map(|(_, own, other)| (own, other)).collect()
    }
}

/// What it costs at least to come into a room, by some ways.
fn least_of(known: &[Found]) -> f64 {
    known.iter().map(|known| known.cost).fold(f64::INFINITY, f64::min)
}

/// What sliding a stop along may save a way that ends in a room: half of how far apart stops are looked at.
fn slid_in(graph: &RouteGraph, room: RoomIndex) -> f64 {
    0.5 * APART_M * graph.per_m(room).max(0.0)
}

/// The segment of the door by which a node came into its room.
fn crossing_of(graph: &RouteGraph, node: &Node) -> Option<Segment> {
    if node.door == DoorIndex::end() { None } else { graph[node.door].crossing.segment() }
}

impl Node {
    /// Where it was bent last before it came to its root, or came to it.
    fn bend(&self) -> (u64, u64) {
        let at = match self.view {
            View::Side { from, .. } if self.bent => from,
            _ => self.root,
        };
        (at.x.to_bits(), at.y.to_bits())
    }
}

/// Whether a point is reached at less cost from one of some points of its room.
fn is_cheaper_from(points: &[(Point, f64)], p: Point, limit: f64, per_m: f64) -> bool {
    points.iter().any(|&(q, cost)| {
        let aside = (p.x - q.x).abs().max((p.y - q.y).abs());
        cost + aside * per_m < limit && cost + q.distance(p) * per_m < limit
    })
}

#[derive(Clone, Copy)]
enum What {
    Node(u32),
    /// By its place among those that were found.
    Goal(u32),
}

/// The cheapest first; then goals, then the node found first.
struct Candidate {
    least: f64,
    what: What,
}

impl Candidate {
    fn place(&self) -> (u8, u32) {
        match self.what {
            What::Goal(found) => (0, found),
            What::Node(index) => (1, index),
        }
    }
}

impl PartialEq for Candidate {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Candidate {}

impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        other.least.total_cmp(&self.least).then_with(|| other.place().cmp(&self.place()))
    }
}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
