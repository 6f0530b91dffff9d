//! The search where all hardness lies on the doors, on flat arrays that are kept between edits and weighed in place.

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

use super::graph::RouteGraph;
use super::parts::{DoorIndex, RoomIndex, Start, Walking};
use crate::search::Csr;

/// Rooms and all their doors, shut ones too, for many searches.
#[derive(Clone, Debug)]
pub struct CompactGraph {
    /// For each room its doors: the next room and the door.
    leaving: Csr<(RoomIndex, DoorIndex)>,
    /// For each door what passing it weighs; infinity where it is shut.
    weights: Vec<f64>,
    keys: Vec<u32>,
}

/// The least-cost way into every room.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct CompactTree {
    costs: Vec<f64>,
    /// The room before, and the door passed last; [`nowhere`] at the start and where a room is not reached.
    before: Vec<(RoomIndex, DoorIndex)>,
    hops: Vec<u32>,
}

fn nowhere() -> (RoomIndex, DoorIndex) {
    (RoomIndex::end(), DoorIndex::end())
}

impl CompactTree {
    /// Total hardness on arrival; infinity where the room is not reached.
    pub fn cost(&self, room: RoomIndex) -> f64 {
        self.costs[room.index()]
    }

    /// The room before, and the door passed last; `None` at the start and where the room is not reached.
    pub fn before(&self, room: RoomIndex) -> Option<(RoomIndex, DoorIndex)> {
        Some(self.before[room.index()]).filter(|before| *before != nowhere())
    }

    pub fn hops(&self, room: RoomIndex) -> u32 {
        self.hops[room.index()]
    }
}

impl CompactGraph {
    /// The same graph; `None` where a room weighs its metres or is not entered.
    pub fn new(graph: &RouteGraph) -> Option<Self> {
        if graph.rooms().iter().any(|room| room.walking != Walking::OnDoors) {
            return None;
        }
        let leaving = graph.door_indices().zip(graph.doors()).flat_map(|(index, door)| {
            let there = (door.room1.index(), (door.room2, index));
            let back = (door.room2.index(), (door.room1, index));
            std::iter::once(there).chain((!door.one_way).then_some(back))
        });
        let leaving = Csr::new(graph.rooms().len(), leaving);
        let weights = graph.doors().iter().map(|door| door.weight().unwrap_or(f64::INFINITY)).collect();
        let keys = graph.doors().iter().map(|door| door.door).collect();
        Some(Self { leaving, weights, keys })
    }

    /// Gives a door another weight; `None` shuts it. What it was.
    pub fn reweigh(&mut self, door: DoorIndex, weight: Option<f64>) -> Option<f64> {
        let weight = weight.unwrap_or(f64::INFINITY);
        Some(std::mem::replace(&mut self.weights[door.index()], weight)).filter(|weight| weight.is_finite())
    }

    /// The least cost of every room from the start, as [`RouteGraph::tree`] finds it.
    pub fn tree(&self, start: &Start) -> CompactTree {
        let leaving = |room: RoomIndex| self.leaving.of(room.index()).iter().copied();
        let starts = start.rooms.iter().map(|entry| entry.room);
        let (weight, key) =
            (|door: DoorIndex| self.weights[door.index()], |door: DoorIndex| self.keys[door.index()]);
        search(self.leaving.len(), starts, leaving, weight, key)
    }
}

/// Dijkstra's search. Of ways of equal cost the one that enters by the door of lower key.
///
/// petgraph's, which says neither doors nor hops, takes 1.6 times as long on 1,000 rooms and 3 times on 10,000:
/// `cargo bench -p adit-planners --bench search` runs both.
///
/// # Arguments
/// `leaving` gives the doors out of a room: the next room and the door; `weight` what passing a door weighs,
/// infinity where it is shut; `key` its key, unique.
pub(super) fn search<I: Iterator<Item = (RoomIndex, DoorIndex)>>(
    rooms: usize,
    starts: impl Iterator<Item = RoomIndex>,
    leaving: impl Fn(RoomIndex) -> I,
    weight: impl Fn(DoorIndex) -> f64,
    key: impl Fn(DoorIndex) -> u32,
) -> CompactTree {
    let mut tree = CompactTree {
        costs: vec![f64::INFINITY; rooms],
        before: vec![nowhere(); rooms],
        hops: vec![0; rooms],
    };
    let mut settled = vec![false; rooms];
    let mut queue = BinaryHeap::with_capacity(rooms);
    // costs are not negative, so their bits are in the order of their values
    let place = |cost: f64, room: RoomIndex, door: u32| {
        let room = room.index() as u32;
        Reverse(u128::from(cost.to_bits()) << 64 | u128::from(room) << 32 | u128::from(door))
    };
    for start in starts {
        tree.costs[start.index()] = 0.0;
        queue.push(place(0.0, start, 0));
    }
    while let Some(Reverse(candidate)) = queue.pop() {
        let room = RoomIndex::from((candidate >> 32) as u32);
        if std::mem::replace(&mut settled[room.index()], true) {
            continue;
        }
        let cost = tree.cost(room);
        for (next, door) in leaving(room) {
            let to = next.index();
            if settled[to] {
                continue;
            }
            let (arrival, key_of_door) = (cost + weight(door), key(door));
            let is_lower = || tree.before(next).is_some_and(|(_, known)| key_of_door < key(known));
            let is_better = match arrival.total_cmp(&tree.costs[to]) {
                Ordering::Less => true,
                Ordering::Equal => arrival.is_finite() && is_lower(),
                Ordering::Greater => false,
            };
            if is_better {
                tree.costs[to] = arrival;
                tree.before[to] = (room, door);
                tree.hops[to] = tree.hops(room) + 1;
                queue.push(place(arrival, next, key_of_door));
            }
        }
    }
    tree
}
