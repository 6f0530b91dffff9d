//! The way of least weight between two rooms: up from both to where they meet, then down through all that arcs stand for.

use std::cell::RefCell;

use super::Hierarchy;
use super::customize::take;
use super::metric::BY_DOOR;
use crate::routes::parts::{DoorIndex, RoomIndex};

/// What a search leaves behind for the next one on the same thread.
#[derive(Default)]
struct Buffers {
    /// For each level of the chain up from the start, and from the goal, what leads there; infinite between searches.
    costs: [Vec<f64>; 2],
    /// The rank from which it leads up there.
    before: [Vec<u64>; 2],
    /// Arcs to be unfolded, each by the ranks that it leads from and to, the first one last.
    folded: Vec<(u32, u32)>,
    /// For each room the place of its last visit on the way, from 1; all zeros between searches.
    visits: Vec<u32>,
}

/// A door on a way.
#[derive(Clone, Copy, Debug)]
pub(in crate::routes) struct Passed {
    pub door: DoorIndex,
    /// The room behind it.
    pub room: RoomIndex,
    pub weight: f64,
}

thread_local! {
    static BUFFERS: RefCell<Buffers> = RefCell::default();
}

impl Hierarchy {
    /// The doors of a way of least weight between two rooms; `None` where no way leads there.
    pub(in crate::routes) fn doors(&self, start: RoomIndex, goal: RoomIndex) -> Option<Vec<Passed>> {
        let [start, goal] = [start, goal].map(RoomIndex::index);
        BUFFERS.with_borrow_mut(|buffers| {
            let meeting = self.meet(start, goal, buffers);
            let doors = meeting.map(|meeting| {
                self.fold([start, goal], meeting, buffers);
                self.unfold(start, buffers)
            });
            for (room, costs) in [start, goal].into_iter().zip(&mut buffers.costs) {
                // what is higher was touched
                let lowest = self.topology.level[self.topology.rank[room] as usize] as usize;
                costs[lowest..self.topology.height].fill(f64::INFINITY);
            }
            doors
        })
    }

    /// The rank at which a best way turns from up to down.
    fn meet(&self, start: usize, goal: usize, buffers: &mut Buffers) -> Option<u32> {
        let topology = &*self.topology;
        for (costs, before) in buffers.costs.iter_mut().zip(&mut buffers.before) {
            if costs.len() < topology.height {
                costs.resize(topology.height, f64::INFINITY);
                before.resize(topology.height, 0);
            }
        }
        let [forth, back] = &mut buffers.costs;
        let [before, after] = &mut buffers.before;
        let (mut one, mut two) = (topology.rank[start], topology.rank[goal]);
        let level = |rank: u32| topology.level[rank as usize] as usize;
        (forth[level(one)], back[level(two)]) = (0.0, 0.0);
        let (mut best, mut meeting) = (f64::INFINITY, None);
        let (up, down) = (&self.metric.up, &self.metric.down);
        loop {
            if one == two {
                let cost = forth[level(one)] + back[level(two)];
                if cost < best {
                    (best, meeting) = (cost, Some(one));
                }
            }
            let (is_one, is_two) = (one <= two, two <= one);
            if is_one {
                self.climb(one, best, up, forth, before);
            }
            if is_two {
                self.climb(two, best, down, back, after);
            }
            let above = |rank: u32, is_moved: bool| if is_moved { topology.parent(rank) } else { Some(rank) };
            let (Some(next), Some(other)) = (above(one, is_one), above(two, is_two)) else { return meeting };
            (one, two) = (next, other);
        }
    }

    /// Goes up from a rank, unless what leads there is no better than what was found.
    fn climb(&self, rank: u32, best: f64, weights: &[f64], costs: &mut [f64], before: &mut [u64]) {
        let topology = &*self.topology;
        let cost = costs[topology.level[rank as usize] as usize];
        if cost >= best {
            return;
        }
        let arcs = topology.arcs(rank);
        let mut arc = arcs.start;
        while arc < arcs.end {
            let (level, run) = (topology.levels[arc] as usize, topology.runs[arc] as usize);
            let levels = level..level + run;
            take(
                &mut costs[levels.clone()],
                &mut before[levels],
                &weights[arc..arc + run],
                cost,
                rank.into(),
            );
            arc += run;
        }
    }

    /// The arcs from the start up to the meeting, and down to the goal, as ranks.
    fn fold(&self, [start, goal]: [usize; 2], meeting: u32, buffers: &mut Buffers) {
        let topology = &*self.topology;
        let Buffers { before, folded, .. } = buffers;
        let chain = |before: &[u64], room: usize, folded: &mut Vec<(u32, u32)>, is_up: bool| {
            let (end, mut rank) = (topology.rank[room], meeting);
            while rank != end {
                let tail = before[topology.level[rank as usize] as usize] as u32;
                folded.push(if is_up { (tail, rank) } else { (rank, tail) });
                rank = tail;
            }
        };
        folded.clear();
        chain(&before[1], goal, folded, false);
        folded.reverse();
        chain(&before[0], start, folded, true);
    }

    /// The doors that folded arcs stand for, without loops that cost nothing.
    fn unfold(&self, start: usize, buffers: &mut Buffers) -> Vec<Passed> {
        let (topology, metric) = (&*self.topology, &self.metric);
        let Buffers { folded, visits, .. } = buffers;
        if visits.len() < topology.room.len() {
            visits.resize(topology.room.len(), 0);
        }
        let mut doors: Vec<Passed> = Vec::with_capacity(folded.len() * 8);
        visits[start] = 1;
        while let Some((from, to)) = folded.pop() {
            let is_up = from < to;
            let Some(arc) = topology.arc(from.min(to), from.max(to)) else { continue };
            let over = metric.over[arc as usize][usize::from(!is_up)];
            if over != BY_DOOR {
                folded.extend([(over - 1, to), (from, over - 1)]);
                continue;
            }
            let Some(door) = metric.door(topology, arc, is_up) else { continue };
            let room = topology.room[to as usize];
            let visit = &mut visits[room as usize];
            if *visit == 0 {
                let weight = metric.passed(topology, door, is_up);
                doors.push(Passed { door: door.into(), room: room.into(), weight });
                *visit = doors.len() as u32 + 1;
            } else {
                let kept = *visit as usize - 1;
                for left in doors.drain(kept..) {
                    visits[left.room.index()] = 0;
                }
            }
        }
        visits[start] = 0;
        for passed in &doors {
            visits[passed.room.index()] = 0;
        }
        doors
    }
}
