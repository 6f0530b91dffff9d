//! Dijkstra's search where all hardness lies on the doors, and what it leaves.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use petgraph::graph::NodeIndex;
use petgraph::visit::EdgeRef;

use super::{Goal, RouteGraph, Start, Way, Ways};
use crate::geometry::Point;

/// The best way into a room.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arrival {
    /// The room before and the door passed, both by index; `None` where the search began.
    pub from: Option<(usize, usize)>,
    /// Total hardness on arrival.
    pub cost: f64,
    /// Doors passed.
    pub hops: u32,
}

/// Least-cost ways from one start.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Tree {
    /// For each room the best arrival; `None` where it is not reached.
    pub rooms: Vec<Option<Arrival>>,
}

impl RouteGraph {
    /// The least cost of every room from the start, with the door that it is entered by; what walking in a room weighs
    /// is not looked at.
    ///
    /// Equal costs: the room, then the door, of lower number. O((rooms + doors) log rooms).
    pub fn tree(&self, start: &Start) -> Tree {
        let mut tree = Tree { rooms: vec![None; self.rooms().len()] };
        let mut queue = BinaryHeap::new();
        for &room in start.rooms.iter().filter(|&&room| self.is_entered(room)) {
            queue.push(Candidate { room, door: 0, arrival: Arrival { from: None, cost: 0.0, hops: 0 } });
        }
        while let Some(Candidate { room, arrival, .. }) = queue.pop() {
            if tree.rooms[room].is_some() {
                continue;
            }
            tree.rooms[room] = Some(arrival);
            for edge in self.petgraph().edges(NodeIndex::new(room)) {
                let (door, next) = (*edge.weight() as usize, edge.target().index());
                if let Some(weight) = self.passage(door)
                    && tree.rooms[next].is_none()
                {
                    let cost = arrival.cost + weight;
                    let arrival = Arrival { from: Some((room, door)), cost, hops: arrival.hops + 1 };
                    queue.push(Candidate { room: next, door: self.doors()[door].door, arrival });
                }
            }
        }
        tree
    }
}

impl Tree {
    /// The ways to goals, and to all rooms where asked for: from door to door.
    pub(super) fn ways(&self, graph: &RouteGraph, start: &Start, goals: &[Goal], rooms: bool) -> Ways {
        let goals = goals.iter().map(|goal| {
            let reached = goal.rooms.iter().filter_map(|&room| Some((room, self.rooms[room]?)));
            let best = reached.min_by(|(_, one), (_, two)| one.cost.total_cmp(&two.cost));
            best.map(|(room, _)| self.way(graph, start, room, goal.at))
        });
        let way = |room: usize| self.rooms[room].map(|_| self.way(graph, start, room, None));
        let count = if rooms { self.rooms.len() } else { 0 };
        Ways { goals: goals.collect(), rooms: (0..count).map(way).collect() }
    }

    fn way(&self, graph: &RouteGraph, start: &Start, to: usize, goal: Option<Point>) -> Way {
        let (mut room, mut doors) = (to, Vec::new());
        while let Some((before, door)) = self.rooms[room].and_then(|arrival| arrival.from) {
            doors.push((door, graph.doors()[door].at, room));
            room = before;
        }
        doors.reverse();
        let end = goal.unwrap_or_else(|| doors.last().map_or(start.at, |(_, at, _)| *at));
        Way::through(graph, (room, start.at), doors, end)
    }
}

/// The cheapest first; then the room, then the door, of lower number.
struct Candidate {
    room: usize,
    door: u32,
    arrival: Arrival,
}

impl PartialEq for Candidate {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Candidate {}

impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        let rest = |candidate: &Self| (candidate.room, candidate.door);
        other.arrival.cost.total_cmp(&self.arrival.cost).then_with(|| rest(other).cmp(&rest(self)))
    }
}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
