//! What arcs weigh after some doors were weighed anew: only those are looked at whose way has become another.
//!
//! Arcs are looked at from below. Where a way under an arc has become easier, the arc takes it; only where the way that it
//! is made of has become harder are all the others compared again. The result is what
//! [`Metric::customize`] finds, to the bit.

use std::cell::RefCell;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::customize::{Bests, Slices, Work};
use super::metric::{BY_DOOR, Metric, Over, by_doors};
use super::topology::Topology;

/// Where more than one of so many doors is weighed anew, weighing all is quicker.
const DOORS_OF: usize = 50;

/// What an offer to an arc takes, in ways under arcs that weighing all compares in the same time.
const OFFER: usize = 20;

/// What it takes to look for one way under an arc.
const LOOK: usize = 60;

/// What it takes to compare, over one arc into a rank, all arcs up from it again.
const ALL: usize = 100;

/// From so many arcs up from one rank on, comparing the ways under all of its arcs is quicker.
const ALL_FROM: usize = 3;

thread_local! {
    /// For each arc its place among the touched ones, from 1. All zeros between calls.
    static PLACES: RefCell<Vec<u32>> = const { RefCell::new(Vec::new()) };
}

/// An arc that may weigh something else.
struct Touched {
    arc: u32,
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
    bests: Option<Bests>,
    /// What has been done, measured by what weighing all compares.
    work: usize,
}

impl Metric {
    /// Weighs doors anew, by index; whether that came to pass. It did not where so many arcs were touched that all
    /// have to be weighed.
    pub fn reweigh(&mut self, topology: &Topology, doors: &[(u32, [f64; 2])]) -> bool {
        for &(door, passing) in doors {
            self.passing[door as usize] = passing;
        }
        if doors.len() > self.passing.len() / DOORS_OF + 1 {
            return false;
        }
        PLACES.with_borrow_mut(|places| {
            if places.len() < self.up.len() {
                places.resize(self.up.len(), 0);
            }
            let waiting = BinaryHeap::new();
            let mut update =
                Update { topology, metric: self, touched: Vec::new(), waiting, places, bests: None, work: 0 };
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
            if arc < self.topology.tails.len() as u32 {
                let now = by_doors(&self.metric.passing, self.topology, arc);
                for (way, weight) in now.into_iter().enumerate() {
                    self.offer(arc, way, Over { weight, over: BY_DOOR });
                }
            }
        }
        let most = self.topology.triangles / 2 + 10_000;
        let mut arcs = Vec::new();
        while let Some(Reverse(arc)) = self.waiting.pop() {
            if self.work > most {
                return false;
            }
            arcs.clear();
            arcs.push(arc);
            let tail = self.topology.tails[arc as usize];
            while let Some(&Reverse(next)) = self.waiting.peek()
                && self.topology.tails[next as usize] == tail
            {
                self.waiting.pop();
                arcs.push(next);
            }
            self.settle(&arcs);
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

    /// Finds what the touched arcs up from a rank weigh, where all below it is known, and tells those above.
    fn settle(&mut self, arcs: &[u32]) {
        let place = |update: &Self, arc: u32| update.places[arc as usize] as usize - 1;
        let is_lost = |update: &Self, arc: u32| update.touched[place(update, arc)].is_lost.contains(&true);
        let lost: Vec<u32> = arcs.iter().copied().filter(|&arc| is_lost(self, arc)).collect();
        let tail = self.topology.tails[arcs[0] as usize];
        let into = self.topology.arcs_into(tail).len();
        if lost.len() < ALL_FROM {
            self.work += into * lost.len() * LOOK;
            for arc in lost {
                let all = self.compared(arc);
                self.metric.set(arc, all);
            }
        } else {
            self.work += into * ALL;
            let Metric { passing, up, down, over } = &mut *self.metric;
            let mut slices = Slices { up, down, over, first: 0 };
            let height = self.topology.height;
            let bests = self.bests.get_or_insert_with(|| Bests::new(height));
            let work = Work { topology: self.topology, passing };
            work.arcs_up(tail, &mut slices, bests);
        }
        for &arc in arcs {
            let before = self.touched[place(self, arc)].before;
            let is_other =
                |way: usize| before[way].weight.to_bits() != self.metric.get(arc)[way].weight.to_bits();
            let is_other = [is_other(0), is_other(1)];
            if is_other.contains(&true) {
                self.tell(arc, is_other);
            }
        }
    }

    /// The best of all ways under an arc.
    fn compared(&self, arc: u32) -> [Over; 2] {
        let (topology, metric) = (self.topology, &*self.metric);
        let (tail, head) = (topology.tails[arc as usize], topology.heads()[arc as usize]);
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

    /// Tells the arcs between an arc's head and the other heads of its tail what now leads over that tail.
    ///
    /// # Arguments
    /// `is_other` says whether what leads up the arc, and down, has another weight.
    fn tell(&mut self, arc: u32, is_other: [bool; 2]) {
        let topology = self.topology;
        let (tail, head) = (topology.tails[arc as usize], topology.heads()[arc as usize]);
        let (up, down) = (self.metric.up[arc as usize], self.metric.down[arc as usize]);
        let over = tail + 1;
        let arcs = topology.arcs(tail);
        self.work += arcs.len() * OFFER;
        for other in arcs.start..arc as usize {
            let beyond = topology.heads()[other];
            let Some(above) = topology.arc(beyond, head) else { continue };
            if is_other[0] {
                self.offer(above, 0, Over { weight: self.metric.down[other] + up, over });
            }
            if is_other[1] {
                self.offer(above, 1, Over { weight: down + self.metric.up[other], over });
            }
        }
        // the head leads to all that lies above it here, in the same order
        let mut run = topology.arcs(head).start;
        for other in arc as usize + 1..arcs.end {
            let level = topology.levels[other];
            while topology.levels[run] + topology.runs[run] <= level {
                run += topology.runs[run] as usize;
            }
            let above = run as u32 + level - topology.levels[run];
            if is_other[0] {
                self.offer(above, 1, Over { weight: self.metric.down[other] + up, over });
            }
            if is_other[1] {
                self.offer(above, 0, Over { weight: down + self.metric.up[other], over });
            }
        }
    }
}
