//! Dijkstra's search over rooms and doors that keeps every arrival worth keeping.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use petgraph::graph::NodeIndex;
use petgraph::visit::EdgeRef;

use super::{Arrival, RouteGraph, Start, Tree, Walking, crossing};
use crate::geometry::Point;

/// An arrival is superfluous, too, where walking over from another one costs more by at most this share of its last
/// step. So no route costs more than this share above the least over the points that doors offer.
const TOLERANCE: f64 = 0.01;

impl RouteGraph {
    /// The least cost of every room from the start, with the door that it is entered by.
    ///
    /// Where rooms weigh no metres this is Dijkstra's algorithm, each room settled once. Where they do, a door is
    /// crossed at the point nearest to where its room was entered, at an end, or (a change) straight ahead, and
    /// costs are within one per cent of the least over those points.
    ///
    /// Equal costs: the room, then the door, of lower number. O(a d log(a d)) for a arrivals kept and d doors a room.
    pub fn tree(&self, start: &Start) -> Tree {
        Search::new(self, start).run(None)
    }

    /// Like [`RouteGraph::tree`], but stops as soon as the best way to one of `goals` is known (to the point `at`
    /// in it, where one is given).
    pub fn tree_until(&self, start: &Start, goals: &[usize], at: Option<Point>) -> Tree {
        Search::new(self, start).run(Some((goals, at)))
    }
}

struct Search<'g> {
    graph: &'g RouteGraph,
    tree: Tree,
    queue: BinaryHeap<Candidate>,
    /// Arrivals that wait in the queue, or have left it.
    found: Vec<Arrival>,
    /// For each edge of the graph the arrivals found over it.
    over: Vec<Vec<u32>>,
}

impl<'g> Search<'g> {
    fn new(graph: &'g RouteGraph, start: &Start) -> Self {
        let tree = Tree { arrivals: Vec::new(), of_room: vec![Vec::new(); graph.rooms().len()] };
        let over = vec![Vec::new(); graph.petgraph().edge_count()];
        let mut search = Self { graph, tree, queue: BinaryHeap::new(), found: Vec::new(), over };
        for &room in start.rooms.iter().filter(|&&room| graph.rooms()[room].walking != Walking::Unknown) {
            search.wait(Arrival {
                room,
                from: None,
                cost: 0.0,
                leg: 0.0,
                at: start.at,
                hops: 0,
                by_change: false,
            });
        }
        search
    }

    fn wait(&mut self, arrival: Arrival) -> u32 {
        let found = self.found.len() as u32;
        let door = arrival.from.map_or(0, |(_, door)| door);
        self.queue.push(Candidate { cost: arrival.cost, room: arrival.room as u32, door, found });
        self.found.push(arrival);
        found
    }

    fn run(mut self, goals: Option<(&[usize], Option<Point>)>) -> Tree {
        let mut best = f64::INFINITY;
        while let Some(Candidate { found, .. }) = self.queue.pop() {
            let arrival = self.found[found as usize];
            if arrival.cost >= best {
                break;
            }
            if self.is_superfluous(&arrival) {
                continue;
            }
            let index = self.tree.arrivals.len();
            self.tree.arrivals.push(arrival);
            self.tree.of_room[arrival.room].push(index);
            if let Some((rooms, at)) = goals
                && rooms.contains(&arrival.room)
            {
                let last = at.map_or(0.0, |at| arrival.at.distance(at) * self.per_m(arrival.room));
                best = best.min(arrival.cost + last);
            }
            self.leave(index, arrival);
        }
        self.tree
    }

    fn per_m(&self, room: usize) -> f64 {
        self.graph.rooms()[room].walking.per_m().unwrap_or(0.0)
    }

    fn is_superfluous(&self, arrival: &Arrival) -> bool {
        let per_m = self.per_m(arrival.room);
        let allowed = arrival.cost + TOLERANCE * arrival.leg;
        self.tree.of_room[arrival.room].iter().any(|&known| {
            let known = &self.tree.arrivals[known];
            // no way is shorter than its longer side: most arrivals are told apart without a root
            let aside = (known.at.x - arrival.at.x).abs().max((known.at.y - arrival.at.y).abs());
            known.cost + aside * per_m <= allowed
                && known.cost + known.at.distance(arrival.at) * per_m <= allowed
        })
    }

    /// Whether an arrival found over the same edge, settled or not, makes this one superfluous.
    fn is_foreseen(&self, edge: usize, arrival: &Arrival) -> bool {
        let per_m = self.per_m(arrival.room);
        self.over[edge].iter().any(|&found| {
            let known = &self.found[found as usize];
            known.cost + known.at.distance(arrival.at) * per_m <= arrival.cost
        })
    }

    /// Every way on from an arrival.
    fn leave(&mut self, index: usize, arrival: Arrival) {
        let graph = self.graph;
        let entered_by = arrival.from.map(|(_, door)| door);
        let just_changed = arrival.by_change;
        for edge in graph.petgraph().edges(NodeIndex::new(arrival.room)) {
            let door = &graph.doors()[*edge.weight() as usize];
            let Some(weight) = door.weight().filter(|_| Some(door.door) != entered_by) else { continue };
            let mut pass = |at: Point, leg: f64| {
                let next = Arrival {
                    room: edge.target().index(),
                    from: Some((index, door.door)),
                    cost: arrival.cost + leg + weight,
                    leg,
                    at,
                    hops: arrival.hops + 1,
                    by_change: door.is_change(),
                };
                if !self.is_superfluous(&next) && !self.is_foreseen(edge.id().index(), &next) {
                    let found = self.wait(next);
                    self.over[edge.id().index()].push(found);
                }
            };
            match graph.rooms()[arrival.room].walking.per_m() {
                None => pass(door.at, 0.0),
                Some(per_m) => {
                    let points = crossing::points(&door.crossing, arrival.at);
                    // one change of shape at a point is enough: a second one there would only shuffle rooms
                    for at in points.filter(|at| !(just_changed && door.is_change() && *at == arrival.at)) {
                        pass(at, arrival.at.distance(at) * per_m);
                    }
                }
            }
        }
    }
}

/// The cheapest first; then the room, then the door, of lower number, then the one found first.
#[derive(Clone, Copy, PartialEq)]
struct Candidate {
    cost: f64,
    room: u32,
    door: u32,
    found: u32,
}

impl Eq for Candidate {}

impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        let rest = |candidate: &Self| (candidate.room, candidate.door, candidate.found);
        other.cost.total_cmp(&self.cost).then_with(|| rest(other).cmp(&rest(self)))
    }
}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
