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

pub(super) struct Work<'a> {
    pub topology: &'a Topology,
    pub passing: &'a [[f64; 2]],
}

/// The arcs up from ranks next to each other.
pub(super) struct Slices<'a> {
    pub up: &'a mut [f64],
    pub down: &'a mut [f64],
    pub over: &'a mut [[u32; 2]],
    pub first: usize,
}

/// For each level what the best way to the rank there weighs so far, up and down, and over what it leads.
pub(super) struct Bests {
    up: Vec<f64>,
    down: Vec<f64>,
    over_up: Vec<u64>,
    over_down: Vec<u64>,
}

impl Bests {
    pub fn new(height: usize) -> Self {
        let (weights, over) = (vec![f64::INFINITY; height], vec![u64::from(BY_DOOR); height]);
        Self { up: weights.clone(), down: weights, over_up: over.clone(), over_down: over }
    }
}

/// So many levels are compared at once.
const LANES: usize = 4;

/// Takes ways that lead over a rank where they are better, level by level: those that weigh `near` and a weight more.
pub(super) fn take(bests: &mut [f64], overs: &mut [u64], weights: &[f64], near: f64, over: u64) {
    let (bests, last_bests) = bests.as_chunks_mut::<LANES>();
    let (overs, last_overs) = overs.as_chunks_mut::<LANES>();
    let (weights, last_weights) = weights.as_chunks::<LANES>();
    for ((bests, overs), weights) in bests.iter_mut().zip(overs).zip(weights) {
        // masks, not branches, and all written back: only so does the compiler compare several at once
        let (mut better, mut known) = (*bests, *overs);
        for lane in 0..LANES {
            let weight = near + weights[lane];
            let mask = u64::from(weight < bests[lane]).wrapping_neg();
            known[lane] = (over & mask) | (known[lane] & !mask);
            better[lane] = if weight < bests[lane] { weight } else { bests[lane] };
        }
        (*bests, *overs) = (better, known);
    }
    for ((best, known), weight) in last_bests.iter_mut().zip(last_overs).zip(last_weights) {
        let weight = near + weight;
        let is_better = weight < *best;
        *known = if is_better { over } else { *known };
        *best = if is_better { weight } else { *best };
    }
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
        let mut bests = Bests::new(if ranks.is_empty() { 0 } else { self.topology.height });
        for rank in ranks {
            self.arcs_up(rank, slices, &mut bests);
        }
    }

    /// Finds what the arcs up from a rank weigh, where those below it are known.
    pub fn arcs_up(&self, rank: u32, slices: &mut Slices<'_>, bests: &mut Bests) {
        let topology = self.topology;
        let arcs = topology.arcs(rank);
        if arcs.is_empty() {
            return;
        }
        for arc in arcs.clone() {
            let level = topology.levels[arc] as usize;
            [bests.up[level], bests.down[level]] = by_doors(self.passing, topology, arc as u32);
            (bests.over_up[level], bests.over_down[level]) = (u64::from(BY_DOOR), u64::from(BY_DOOR));
        }
        for &into in topology.arcs_into(rank) {
            let (into, below) = (into as usize, topology.tails[into as usize]);
            let (there, back) = (slices.down[into - slices.first], slices.up[into - slices.first]);
            if there == f64::INFINITY && back == f64::INFINITY {
                continue;
            }
            let (over, end) = (u64::from(below) + 1, topology.arcs(below).end);
            let mut arc = into + 1;
            while arc < end {
                let (level, run) = (topology.levels[arc] as usize, topology.runs[arc] as usize);
                let (levels, weights) = (level..level + run, arc - slices.first..arc - slices.first + run);
                let (up, down) = (&slices.up[weights.clone()], &slices.down[weights]);
                take(&mut bests.up[levels.clone()], &mut bests.over_up[levels.clone()], up, there, over);
                take(&mut bests.down[levels.clone()], &mut bests.over_down[levels], down, back, over);
                arc += run;
            }
        }
        for arc in arcs {
            let (at, level) = (arc - slices.first, topology.levels[arc] as usize);
            (slices.up[at], slices.down[at]) = (bests.up[level], bests.down[level]);
            slices.over[at] = [bests.over_up[level] as u32, bests.over_down[level] as u32];
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
