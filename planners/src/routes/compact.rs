//! The search where all hardness lies on the doors, on flat arrays that are kept between edits and weighed in place.

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

use super::{RouteGraph, Walking};

/// No room, no door.
pub const NONE: u32 = u32::MAX;

/// Rooms and all their doors, shut ones too, for many searches.
#[derive(Clone, Debug)]
pub struct CompactGraph {
    /// For each room where its doors begin in `leaving`.
    begins: Vec<u32>,
    /// The next room and the door, by index.
    leaving: Vec<(u32, u32)>,
    /// For each door what passing it weighs; infinity where it is shut.
    weights: Vec<f64>,
    keys: Vec<u32>,
}

/// The least-cost way into every room, by index.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct CompactTree {
    /// Total hardness on arrival; infinity where a room is not reached.
    pub costs: Vec<f64>,
    /// The room before; [`NONE`] at the start and where a room is not reached.
    pub before: Vec<u32>,
    /// The door passed last.
    pub doors: Vec<u32>,
    /// Doors passed.
    pub hops: Vec<u32>,
}

impl CompactGraph {
    /// The same graph; `None` where a room weighs its metres or is not entered.
    pub fn new(graph: &RouteGraph) -> Option<Self> {
        if graph.rooms().iter().any(|room| room.walking != Walking::OnDoors) {
            return None;
        }
        let mut begins = vec![0_u32; graph.rooms().len() + 1];
        for door in graph.doors() {
            begins[door.room1 + 1] += 1;
            begins[door.room2 + 1] += u32::from(!door.one_way);
        }
        for room in 1..begins.len() {
            begins[room] += begins[room - 1];
        }
        let mut next = begins.clone();
        let mut leaving = vec![(NONE, NONE); *begins.last()? as usize];
        for (index, door) in graph.doors().iter().enumerate() {
            let mut leave = |from: usize, to: usize| {
                leaving[next[from] as usize] = (to as u32, index as u32);
                next[from] += 1;
            };
            leave(door.room1, door.room2);
            if !door.one_way {
                leave(door.room2, door.room1);
            }
        }
        let weights = graph.doors().iter().map(|door| door.weight().unwrap_or(f64::INFINITY)).collect();
        let keys = graph.doors().iter().map(|door| door.door).collect();
        Some(Self { begins, leaving, weights, keys })
    }

    pub(super) fn rooms(&self) -> usize {
        self.begins.len() - 1
    }

    pub(super) fn doors(&self) -> usize {
        self.keys.len()
    }

    /// The doors out of a room: the next room and the door, by index.
    pub(super) fn leaving(&self, room: usize) -> &[(u32, u32)] {
        &self.leaving[self.begins[room] as usize..self.begins[room + 1] as usize]
    }

    /// Gives a door, by index, another weight; `None` shuts it. What it was.
    pub fn reweigh(&mut self, door: usize, weight: Option<f64>) -> Option<f64> {
        let weight = weight.unwrap_or(f64::INFINITY);
        Some(std::mem::replace(&mut self.weights[door], weight)).filter(|weight| weight.is_finite())
    }

    /// The least cost of every room from these, as [`RouteGraph::tree`] finds it.
    pub fn tree(&self, starts: &[usize]) -> CompactTree {
        let rooms = self.rooms();
        let mut tree = CompactTree {
            costs: vec![f64::INFINITY; rooms],
            before: vec![NONE; rooms],
            doors: vec![NONE; rooms],
            hops: vec![0; rooms],
        };
        let mut settled = vec![false; rooms];
        let mut queue = BinaryHeap::with_capacity(rooms);
        // costs are not negative, so their bits are in the order of their values
        let place = |cost: f64, room: u32, door: u32| {
            Reverse(u128::from(cost.to_bits()) << 64 | u128::from(room) << 32 | u128::from(door))
        };
        for &start in starts {
            tree.costs[start] = 0.0;
            queue.push(place(0.0, start as u32, 0));
        }
        while let Some(Reverse(candidate)) = queue.pop() {
            let room = (candidate >> 32) as u32 as usize;
            if std::mem::replace(&mut settled[room], true) {
                continue;
            }
            let cost = tree.costs[room];
            for &(next, door) in self.leaving(room) {
                let (to, arrival) = (next as usize, cost + self.weights[door as usize]);
                let key = self.keys[door as usize];
                let known = tree.costs[to];
                let is_lower = || tree.doors[to] != NONE && key < self.keys[tree.doors[to] as usize];
                let is_better = match arrival.total_cmp(&known) {
                    Ordering::Less => true,
                    Ordering::Equal => is_lower(),
                    Ordering::Greater => false,
                };
                if !settled[to] && arrival.is_finite() && is_better {
                    tree.costs[to] = arrival;
                    tree.before[to] = room as u32;
                    tree.doors[to] = door;
                    tree.hops[to] = tree.hops[room] + 1;
                    queue.push(place(arrival, next, key));
                }
            }
        }
        tree
    }
}
