//! One route, weighing no door before the search needs it.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::compact::{CompactGraph, NONE};

/// A route that was found by weighing as little as possible.
#[derive(Clone, Debug, PartialEq)]
pub struct LazyRoute {
    /// Total hardness; `None` where no route leads to the goal.
    pub cost: Option<f64>,
    /// The doors on the way, by index, from the start on.
    pub doors: Vec<u32>,
    /// Rooms settled before the goal.
    pub settled: usize,
    /// Doors that were weighed: those that lead out of the rooms settled before the goal.
    pub weighed: usize,
}

impl CompactGraph {
    /// The route of least hardness between two rooms. The weights that the graph has are not looked at.
    ///
    /// # Arguments
    /// `weigh` gives the weights of doors, by index, in their order; `None` is a door that cannot be passed. It is
    /// called for the doors out of a room when that room is settled, and for each door once.
    pub fn lazy_route(
        &self,
        start: usize,
        goal: usize,
        mut weigh: impl FnMut(&[u32]) -> Vec<Option<f64>>,
    ) -> LazyRoute {
        let rooms = self.rooms();
        let mut weights: Vec<Option<f64>> = vec![None; self.doors()];
        let mut is_weighed = vec![false; self.doors()];
        let (mut costs, mut before) = (vec![f64::INFINITY; rooms], vec![(NONE, NONE); rooms]);
        let mut is_settled = vec![false; rooms];
        let mut found = LazyRoute { cost: None, doors: Vec::new(), settled: 0, weighed: 0 };
        let mut queue = BinaryHeap::from([Reverse((0_u64, start as u32))]);
        costs[start] = 0.0;
        while let Some(Reverse((_, room))) = queue.pop() {
            let room = room as usize;
            if std::mem::replace(&mut is_settled[room], true) {
                continue;
            }
            if room == goal {
                found.cost = Some(costs[goal]);
                break;
            }
            found.settled += 1;
            let unweighed = |(_, door): &&(u32, u32)| !is_weighed[*door as usize];
            let new: Vec<u32> = self.leaving(room).iter().filter(unweighed).map(|(_, door)| *door).collect();
            for (door, weight) in new.iter().zip(weigh(&new)) {
                weights[*door as usize] = weight;
            }
            for door in &new {
                is_weighed[*door as usize] = true;
            }
            found.weighed += new.len();
            for &(next, door) in self.leaving(room) {
                let Some(weight) = weights[door as usize] else { continue };
                let (to, arrival) = (next as usize, costs[room] + weight);
                if !is_settled[to] && arrival < costs[to] {
                    costs[to] = arrival;
                    before[to] = (room as u32, door);
                    // costs are not negative, so their bits are in the order of their values
                    queue.push(Reverse((arrival.to_bits(), next)));
                }
            }
        }
        let mut at = if found.cost.is_some() { goal } else { start };
        while before[at].0 != NONE {
            found.doors.push(before[at].1);
            at = before[at].0 as usize;
        }
        found.doors.reverse();
        found
    }
}
