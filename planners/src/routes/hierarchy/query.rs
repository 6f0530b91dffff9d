//! The way of least weight between two rooms: up from both to where they meet, then down through all that arcs stand for.

use std::cell::RefCell;

use super::Hierarchy;
use super::metric::BY_DOOR;
use crate::routes::NONE;

/// What a search leaves behind for the next one on the same thread.
#[derive(Default)]
struct Buffers {
    /// For each depth of the chain up from the start, and from the goal, what leads there; infinite between searches.
    costs: [Vec<f64>; 2],
    /// The arc that leads there.
    arcs: [Vec<u32>; 2],
    /// Arcs and whether they are passed upwards, to be unfolded, the first one last.
    folded: Vec<(u32, bool)>,
    /// For each room the place of its last visit on the way, from 1; all zeros between searches.
    visits: Vec<u32>,
}

thread_local! {
    static BUFFERS: RefCell<Buffers> = RefCell::default();
}

impl Hierarchy {
    /// The doors of a way of least weight between two rooms, by index, each with the room behind it; `None` where no
    /// way leads there.
    pub fn doors(&self, start: usize, goal: usize) -> Option<Vec<(u32, u32)>> {
        BUFFERS.with_borrow_mut(|buffers| {
            let meeting = self.meet(start, goal, buffers);
            let doors = meeting.map(|meeting| {
                self.fold([start, goal], meeting, buffers);
                self.unfold(start, buffers)
            });
            for rank in [start, goal].map(|room| self.topology.rank[room]) {
                // what lies above a room of this depth is what was touched
                let touched = self.topology.depth[rank as usize] as usize + 1;
                for costs in &mut buffers.costs {
                    let touched = touched.min(costs.len());
                    costs[..touched].fill(f64::INFINITY);
                }
            }
            doors
        })
    }

    /// The rank at which a best way turns from up to down.
    fn meet(&self, start: usize, goal: usize, buffers: &mut Buffers) -> Option<u32> {
        let topology = &*self.topology;
        for (costs, arcs) in buffers.costs.iter_mut().zip(&mut buffers.arcs) {
            if costs.len() < topology.height {
                costs.resize(topology.height, f64::INFINITY);
                arcs.resize(topology.height, NONE);
            }
        }
        let [forth, back] = &mut buffers.costs;
        let [forth_arcs, back_arcs] = &mut buffers.arcs;
        let (mut one, mut two) = (topology.rank[start], topology.rank[goal]);
        let depth = |rank: u32| topology.depth[rank as usize] as usize;
        (forth[depth(one)], back[depth(two)]) = (0.0, 0.0);
        let (mut best, mut meeting) = (f64::INFINITY, None);
        let (up, down) = (&self.metric.up, &self.metric.down);
        loop {
            if one == two {
                let cost = forth[depth(one)] + back[depth(two)];
                if cost < best {
                    (best, meeting) = (cost, Some(one));
                }
            }
            let (is_one, is_two) = (one <= two, two <= one);
            if is_one {
                self.climb(one, best, up, forth, forth_arcs);
            }
            if is_two {
                self.climb(two, best, down, back, back_arcs);
            }
            let above = |rank: u32, is_moved: bool| if is_moved { topology.parent(rank) } else { Some(rank) };
            let (Some(next), Some(other)) = (above(one, is_one), above(two, is_two)) else { return meeting };
            (one, two) = (next, other);
        }
    }

    /// Goes up from a rank, unless what leads there is no better than what was found.
    fn climb(&self, rank: u32, best: f64, weights: &[f64], costs: &mut [f64], arcs: &mut [u32]) {
        let topology = &*self.topology;
        let cost = costs[topology.depth[rank as usize] as usize];
        if cost >= best {
            return;
        }
        let range = topology.arcs(rank);
        let begin = range.start as u32;
        let all = topology.depths[range.clone()].iter().zip(&weights[range]);
        for (arc, (&depth, weight)) in (begin..).zip(all) {
            let there = cost + weight;
            let known = &mut costs[depth as usize];
            if there < *known {
                *known = there;
                arcs[depth as usize] = arc;
            }
        }
    }

    /// The arcs from the start up to the meeting, and down to the goal.
    fn fold(&self, [start, goal]: [usize; 2], meeting: u32, buffers: &mut Buffers) {
        let topology = &*self.topology;
        let Buffers { arcs, folded, .. } = buffers;
        let chain = |arcs: &[u32], room: usize, folded: &mut Vec<(u32, bool)>, is_up: bool| {
            let (end, mut rank) = (topology.rank[room], meeting);
            while rank != end {
                let arc = arcs[topology.depth[rank as usize] as usize];
                folded.push((arc, is_up));
                rank = topology.tails[arc as usize];
            }
        };
        folded.clear();
        chain(&arcs[1], goal, folded, false);
        folded.reverse();
        chain(&arcs[0], start, folded, true);
    }

    /// The doors that folded arcs stand for, without loops that cost nothing.
    fn unfold(&self, start: usize, buffers: &mut Buffers) -> Vec<(u32, u32)> {
        let (topology, metric) = (&*self.topology, &self.metric);
        let Buffers { folded, visits, .. } = buffers;
        if visits.len() < topology.room.len() {
            visits.resize(topology.room.len(), 0);
        }
        let mut doors: Vec<(u32, u32)> = Vec::with_capacity(folded.len() * 4);
        visits[start] = 1;
        while let Some((arc, is_up)) = folded.pop() {
            let over = metric.over[arc as usize][usize::from(!is_up)];
            let (tail, head) = (topology.tails[arc as usize], topology.heads[arc as usize]);
            if over == BY_DOOR {
                let Some(door) = metric.door(topology, arc, is_up) else { continue };
                let room = topology.room[if is_up { head } else { tail } as usize];
                let visit = &mut visits[room as usize];
                if *visit == 0 {
                    doors.push((door, room));
                    *visit = doors.len() as u32 + 1;
                } else {
                    let kept = *visit as usize - 1;
                    for (_, left) in doors.drain(kept..) {
                        visits[left as usize] = 0;
                    }
                }
            } else if let (Some(near), Some(far)) =
                (topology.arc(over - 1, tail), topology.arc(over - 1, head))
            {
                let (first, last) = if is_up { (near, far) } else { (far, near) };
                folded.extend([(last, true), (first, false)]);
            }
        }
        visits[start] = 0;
        for (_, room) in &doors {
            visits[*room as usize] = 0;
        }
        doors
    }
}
