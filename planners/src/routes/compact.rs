//! The search where all hardness lies on the doors, on flat arrays that are kept between edits and weighed in place.

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

use super::graph::RouteGraph;
use super::parts::Walking;
use crate::search::Csr;

/// No room, no door.
pub const NONE: u32 = u32::MAX;

/// Rooms and all their doors, shut ones too, for many searches.
#[derive(Clone, Debug)]
pub struct CompactGraph {
    /// For each room its doors: the next room and the door, by index.
    leaving: Csr<(u32, u32)>,
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
    pub hops: Vec<u32>,
}

impl CompactGraph {
    /// The same graph; `None` where a room weighs its metres or is not entered.
    pub fn new(graph: &RouteGraph) -> Option<Self> {
        if graph.rooms().iter().any(|room| room.walking != Walking::OnDoors) {
            return None;
        }
        let leaving = graph.doors().iter().enumerate().flat_map(|(index, door)| {
            let there = (door.room1, (door.room2 as u32, index as u32));
            let back = (door.room2, (door.room1 as u32, index as u32));
            std::iter::once(there).chain((!door.one_way).then_some(back))
        });
        let leaving = Csr::new(graph.rooms().len(), leaving);
        let weights = graph.doors().iter().map(|door| door.weight().unwrap_or(f64::INFINITY)).collect();
        let keys = graph.doors().iter().map(|door| door.door).collect();
        Some(Self { leaving, weights, keys })
    }

    /// Gives a door, by index, another weight; `None` shuts it. What it was.
    pub fn reweigh(&mut self, door: usize, weight: Option<f64>) -> Option<f64> {
        let weight = weight.unwrap_or(f64::INFINITY);
        Some(std::mem::replace(&mut self.weights[door], weight)).filter(|weight| weight.is_finite())
    }

    /// The least cost of every room from these, as [`RouteGraph::tree`] finds it.
    pub fn tree(&self, starts: &[usize]) -> CompactTree {
        let leaving = |room: usize| self.leaving.of(room).iter().copied();
        let starts = starts.iter().copied();
        search(self.leaving.len(), starts, leaving, |door| self.weights[door], |door| self.keys[door])
    }
}

/// Dijkstra's search. Of ways of equal cost the one that enters by the door of lower key.
///
/// petgraph's, which says neither doors nor hops, takes 1.6 times as long on 1,000 rooms and 3 times on 10,000:
/// `cargo bench -p adit-planners --bench search` runs both.
///
/// # Arguments
/// `leaving` gives the doors out of a room: the next room and the door, by index; `weight` what passing a door weighs,
/// infinity where it is shut; `key` its key, unique.
pub(super) fn search<I: Iterator<Item = (u32, u32)>>(
    rooms: usize,
    starts: impl Iterator<Item = usize>,
    leaving: impl Fn(usize) -> I,
    weight: impl Fn(usize) -> f64,
    key: impl Fn(usize) -> u32,
) -> CompactTree {
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
    for start in starts {
        tree.costs[start] = 0.0;
        queue.push(place(0.0, start as u32, 0));
    }
    while let Some(Reverse(candidate)) = queue.pop() {
        let room = (candidate >> 32) as u32 as usize;
        if std::mem::replace(&mut settled[room], true) {
            continue;
        }
        let cost = tree.costs[room];
        for (next, door) in leaving(room) {
            let to = next as usize;
            if settled[to] {
                continue;
            }
            let (arrival, key_of_door) = (cost + weight(door as usize), key(door as usize));
            let is_lower = || tree.doors[to] != NONE && key_of_door < key(tree.doors[to] as usize);
            let is_better = match arrival.total_cmp(&tree.costs[to]) {
                Ordering::Less => true,
                Ordering::Equal => arrival.is_finite() && is_lower(),
                Ordering::Greater => false,
            };
            if is_better {
                tree.costs[to] = arrival;
                tree.before[to] = room as u32;
                tree.doors[to] = door;
                tree.hops[to] = tree.hops[room] + 1;
                queue.push(place(arrival, next, key_of_door));
            }
        }
    }
    tree
}
