//! What a search leaves: the arrivals in each room, each with the one that it goes on from.

use super::RouteGraph;
use crate::geometry::Point;

/// A way into a room.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arrival {
    /// The room, by index.
    pub room: usize,
    /// The arrival in the room before, by index in [`Tree::arrivals`], and the door passed; `None` where the search
    /// began.
    pub from: Option<(usize, u32)>,
    /// Total hardness on arrival.
    pub cost: f64,
    /// Hardness of the way inside the room before, from its entry to the door; part of `cost`.
    pub leg: f64,
    /// Point of arrival.
    pub at: Point,
    /// Doors passed.
    pub hops: u32,
    /// Whether the last of them was a change of shape.
    pub by_change: bool,
}

/// Least-cost ways from one start.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Tree {
    /// Arrivals in the order of their cost.
    pub arrivals: Vec<Arrival>,
    /// For each room its arrivals, the cheapest first; none where it is not reached.
    pub of_room: Vec<Vec<usize>>,
}

impl Tree {
    /// The cheapest arrival in a room.
    pub fn best(&self, room: usize) -> Option<&Arrival> {
        self.of_room[room].first().map(|&arrival| &self.arrivals[arrival])
    }

    /// The best arrival at a point among the rooms that hold it: its index, and the hardness of the last way inside.
    pub fn best_at(&self, graph: &RouteGraph, rooms: &[usize], goal: Point) -> Option<(usize, f64)> {
        let arrivals = rooms.iter().flat_map(|&room| &self.of_room[room]);
        let reached = arrivals.map(|&index| {
            let arrival = &self.arrivals[index];
            let per_m = graph.rooms()[arrival.room].walking.per_m().unwrap_or(0.0);
            (index, arrival.at.distance(goal) * per_m)
        });
        let total = |(index, leg): &(usize, f64)| self.arrivals[*index].cost + leg;
        reached.min_by(|a, b| total(a).total_cmp(&total(b)).then(a.0.cmp(&b.0)))
    }

    /// The arrivals on the way to one of them, from the start on.
    pub fn way(&self, to: usize) -> Vec<&Arrival> {
        let mut way = vec![&self.arrivals[to]];
        while let Some((before, _)) = way.last().and_then(|arrival| arrival.from) {
            way.push(&self.arrivals[before]);
        }
        way.reverse();
        way
    }
}
