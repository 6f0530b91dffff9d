//! What all arcs of a hierarchy weigh, from what the doors weigh: each arc the least of its doors and of the ways over one
//! rank below both of its ends.

use std::ops::Range;

use super::metric::{BY_DOOR, Metric, by_doors};
use super::topology::Topology;

/// So many ranks are worth a task of their own.
const TASK: u32 = 1_000;

impl Metric {
    /// Finds what all arcs weigh.
    pub fn customize(&mut self, topology: &Topology) {
        let Self { passing, up, down, over } = self;
        let ranks = 0..topology.room.len() as u32;
        Work { topology, passing }.customize(ranks, Slices { up, down, over, first: 0 });
    }
}

struct Work<'a> {
    topology: &'a Topology,
    passing: &'a [[f64; 2]],
}

/// The arcs up from ranks next to each other.
struct Slices<'a> {
    up: &'a mut [f64],
    down: &'a mut [f64],
    over: &'a mut [[u32; 2]],
    /// The number of the first arc.
    first: usize,
}

/// The best way to a rank so far, up and down.
#[derive(Clone, Copy)]
struct Best {
    up: f64,
    down: f64,
    over: [u32; 2],
}

impl Work<'_> {
    /// Ranks next to each other, with all that hangs below them. What hangs below none of both halves is done side by
    /// side.
    fn customize(&self, ranks: Range<u32>, mut slices: Slices<'_>) {
        let mut inner = ranks.clone();
        while inner.len() as u32 >= TASK {
            let middle = self.fork(&inner);
            if middle - inner.start >= TASK / 2 && inner.end - middle >= TASK / 2 {
                self.each(ranks.start..inner.start, &mut slices);
                let [begin, half, end] =
                    [inner.start, middle, inner.end].map(|rank| self.topology.arcs_before(rank));
                let (one, two) = slices.between(begin, half, end);
                rayon::join(
                    || self.customize(inner.start..middle, one),
                    || self.customize(middle..inner.end, two),
                );
                self.each(inner.end..ranks.end, &mut slices);
                return;
            }
            inner = self.largest(&inner);
        }
        self.each(ranks, &mut slices);
    }

    /// The ranks that nothing of these is above, the highest first.
    fn tops(&self, ranks: &Range<u32>) -> impl Iterator<Item = u32> {
        let next = |end: u32| (end > ranks.start).then(|| end - 1);
        std::iter::successors(next(ranks.end), move |&top| next(self.topology.lowest[top as usize]))
    }

    /// The rank next to the middle before which nothing hangs on what comes after it.
    fn fork(&self, ranks: &Range<u32>) -> u32 {
        let middle = u32::midpoint(ranks.start, ranks.end);
        let begins = self.tops(ranks).map(|top| self.topology.lowest[top as usize]);
        begins.min_by_key(|begin| begin.abs_diff(middle)).unwrap_or(ranks.start)
    }

    /// What hangs below the rank on which most hangs.
    fn largest(&self, ranks: &Range<u32>) -> Range<u32> {
        let below = self.tops(ranks).map(|top| self.topology.lowest[top as usize]..top);
        below.max_by_key(|below| below.len()).unwrap_or(ranks.start..ranks.start)
    }

    fn each(&self, ranks: Range<u32>, slices: &mut Slices<'_>) {
        let blank = Best { up: f64::INFINITY, down: f64::INFINITY, over: [BY_DOOR; 2] };
        let mut bests = if ranks.is_empty() { Vec::new() } else { vec![blank; self.topology.height] };
        for rank in ranks {
            self.arcs_up(rank, slices, &mut bests);
        }
    }

    /// Finds what the arcs up from a rank weigh, where those below it are known.
    fn arcs_up(&self, rank: u32, slices: &mut Slices<'_>, bests: &mut [Best]) {
        let topology = self.topology;
        let arcs = topology.arcs(rank);
        if arcs.is_empty() {
            return;
        }
        for arc in arcs.clone() {
            let [up, down] = by_doors(self.passing, topology, arc as u32);
            bests[topology.depths[arc] as usize] = Best { up, down, over: [BY_DOOR; 2] };
        }
        for &into in topology.arcs_into(rank) {
            let (into, below) = (into as usize, topology.tails[into as usize]);
            let (there, back) = (slices.down[into - slices.first], slices.up[into - slices.first]);
            if there == f64::INFINITY && back == f64::INFINITY {
                continue;
            }
            let over = below + 1;
            let beyond = into + 1..topology.arcs(below).end;
            let weights = beyond.start - slices.first..beyond.end - slices.first;
            let (ups, downs) = (&slices.up[weights.clone()], &slices.down[weights]);
            for ((&depth, &up), &down) in topology.depths[beyond].iter().zip(ups).zip(downs) {
                let best = &mut bests[depth as usize];
                let (up, down) = (there + up, back + down);
                if up < best.up {
                    (best.up, best.over[0]) = (up, over);
                }
                if down < best.down {
                    (best.down, best.over[1]) = (down, over);
                }
            }
        }
        for arc in arcs {
            let best = bests[topology.depths[arc] as usize];
            let at = arc - slices.first;
            (slices.up[at], slices.down[at], slices.over[at]) = (best.up, best.down, best.over);
        }
    }
}

impl Slices<'_> {
    /// The arcs of two halves next to each other.
    fn between(&mut self, begin: usize, half: usize, end: usize) -> (Slices<'_>, Slices<'_>) {
        let (from, to) = (begin - self.first, end - self.first);
        let at = half - begin;
        let (up, up2) = self.up[from..to].split_at_mut(at);
        let (down, down2) = self.down[from..to].split_at_mut(at);
        let (over, over2) = self.over[from..to].split_at_mut(at);
        (Slices { up, down, over, first: begin }, Slices { up: up2, down: down2, over: over2, first: half })
    }
}
