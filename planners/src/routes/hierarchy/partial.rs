//! What arcs weigh after some doors were weighed anew: only those are looked at whose way has become another.
//!
//! Arcs are looked at from below. Where a way under an arc has become easier, the arc takes it; only where the way that it
//! is made of has become harder are all the others compared again. The result is what
//! [`Metric::customize`] finds, to the bit.

use std::cell::RefCell;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::metric::{BY_DOOR, Metric, Over, by_doors};
use super::topology::Topology;

/// Where more than one of so many arcs is touched, weighing all is quicker.
const TOUCHED_OF: usize = 12;

thread_local! {
    /// For each arc its place among the touched ones, from 1. All zeros between calls.
    static PLACES: RefCell<Vec<u32>> = const { RefCell::new(Vec::new()) };
}

/// An arc that may weigh something else.
struct Touched {
    arc: u32,
    /// What it weighed before.
    before: [Over; 2],
    /// Whether all ways have to be compared again, up and down.
    is_lost: [bool; 2],
}

struct Update<'a> {
    topology: &'a Topology,
    metric: &'a mut Metric,
    touched: Vec<Touched>,
    waiting: BinaryHeap<Reverse<u32>>,
    places: &'a mut [u32],
}

impl Metric {
    /// Weighs doors anew, by index; whether that came to pass. It did not where so many arcs were touched that all
    /// have to be weighed.
    pub fn reweigh(&mut self, topology: &Topology, doors: &[(u32, [f64; 2])]) -> bool {
        for &(door, passing) in doors {
            self.passing[door as usize] = passing;
        }
        if doors.len() > self.passing.len() / TOUCHED_OF {
            return false;
        }
        PLACES.with_borrow_mut(|places| {
            if places.len() < self.up.len() {
                places.resize(self.up.len(), 0);
            }
            let waiting = BinaryHeap::new();
            let mut update = Update { topology, metric: self, touched: Vec::new(), waiting, places };
            let is_done = update.run(doors);
            let Update { touched, .. } = update;
            for of in touched {
                places[of.arc as usize] = 0;
            }
            is_done
        })
    }
}

impl Update<'_> {
    fn run(&mut self, doors: &[(u32, [f64; 2])]) -> bool {
        for &(door, _) in doors {
            let arc = self.topology.arc_of[door as usize];
            if arc < self.topology.heads.len() as u32 {
                let now = by_doors(&self.metric.passing, self.topology, arc);
                for (way, weight) in now.into_iter().enumerate() {
                    self.offer(arc, way, Over { weight, over: BY_DOOR });
                }
            }
        }
        let most = self.metric.up.len() / TOUCHED_OF;
        while let Some(Reverse(arc)) = self.waiting.pop() {
            if self.touched.len() > most.max(1_000) {
                return false;
            }
            self.settle(arc);
        }
        true
    }

    /// Tells an arc what a way under it now weighs.
    fn offer(&mut self, arc: u32, way: usize, offered: Over) {
        let now = self.metric.get(arc);
        let is_lost = now[way].over == offered.over && offered.weight > now[way].weight;
        if !is_lost && !offered.is_better(now[way]) {
            return;
        }
        let place = &mut self.places[arc as usize];
        if *place == 0 {
            self.touched.push(Touched { arc, before: now, is_lost: [false; 2] });
            *place = self.touched.len() as u32;
            self.waiting.push(Reverse(arc));
        }
        if is_lost {
            self.touched[*place as usize - 1].is_lost[way] = true;
        } else {
            let mut now = now;
            now[way] = offered;
            self.metric.set(arc, now);
        }
    }

    /// Finds what an arc weighs where all below it is known, and tells those above.
    fn settle(&mut self, arc: u32) {
        let place = self.places[arc as usize] as usize - 1;
        let Touched { before, is_lost, .. } = self.touched[place];
        if is_lost[0] || is_lost[1] {
            let all = self.compared(arc);
            self.metric.set(arc, all);
        }
        let now = self.metric.get(arc);
        for (way, (before, now)) in before.into_iter().zip(now).enumerate() {
            if before.weight.to_bits() != now.weight.to_bits() {
                self.tell(arc, way, now.weight);
            }
        }
    }

    /// The best of all ways under an arc.
    fn compared(&self, arc: u32) -> [Over; 2] {
        let (topology, metric) = (self.topology, &*self.metric);
        let (tail, head) = (topology.tails[arc as usize], topology.heads[arc as usize]);
        let mut best = by_doors(&metric.passing, topology, arc).map(|weight| Over { weight, over: BY_DOOR });
        for &into in topology.arcs_into(tail) {
            let below = topology.tails[into as usize];
            let Some(beyond) = topology.arc(below, head) else { continue };
            let (into, beyond, over) = (into as usize, beyond as usize, below + 1);
            let up = Over { weight: metric.down[into] + metric.up[beyond], over };
            let down = Over { weight: metric.down[beyond] + metric.up[into], over };
            for (best, way) in best.iter_mut().zip([up, down]) {
                if way.weight < best.weight {
                    *best = way;
                }
            }
        }
        best
    }

    /// Tells the arcs between an arc's head and the other heads of its tail what leads over that tail.
    fn tell(&mut self, arc: u32, way: usize, weight: f64) {
        let topology = self.topology;
        let (tail, head) = (topology.tails[arc as usize], topology.heads[arc as usize]);
        for other in topology.arcs(tail) {
            let beyond = topology.heads[other];
            if beyond == head {
                continue;
            }
            // up from the tail to this head: the way comes down to the tail from the other one
            let along = if way == 0 { self.metric.down[other] } else { self.metric.up[other] };
            let Some(above) = topology.arc(head.min(beyond), head.max(beyond)) else { continue };
            let is_up = (way == 0) == (beyond < head);
            self.offer(above, usize::from(!is_up), Over { weight: weight + along, over: tail + 1 });
        }
    }
}
