//! All maximal rectangles of free cells, by a sweep from the top down.
//!
//! Each maximal rectangle stands on a support: the top of an obstacle, or the floor. From each level that
//! has supports, the runs of free columns just above it are followed upwards: the lowest obstacle over a run ends
//! one rectangle and splits the run in two; a part that stands on no support any more is given up, as a
//! rectangle further down contains it. Each rectangle is met once, each at the price of one look at the skyline.

use crate::skyline::Skyline;
use crate::strips::Block;

/// Merges intervals that come by ascending start, where they overlap or touch.
pub(crate) fn merge(intervals: impl IntoIterator<Item = (u32, u32)>, merged: &mut Vec<(u32, u32)>) {
    merged.clear();
    for (from, to) in intervals {
        match merged.last_mut() {
            Some((_, end)) if from <= *end => *end = to.max(*end),
            _ => merged.push((from, to)),
        }
    }
}

/// Working memory of the enumeration, to be used again.
pub(crate) struct MaximalBlocks {
    skyline: Skyline,
    supports: Vec<(u32, u32)>,
    runs: Vec<Run>,
}

/// Free columns above a level, free up to at least `since`.
struct Run {
    from: u32,
    to: u32,
    since: u32,
}

impl MaximalBlocks {
    pub(crate) fn new() -> Self {
        Self { skyline: Skyline::new(), supports: Vec::new(), runs: Vec::new() }
    }

    /// Calls `found` once for each maximal rectangle of `columns` x `rows` cells that meets no obstacle.
    /// Obstacles lie within the cells, are not empty, and may overlap.
    pub(crate) fn each(
        &mut self,
        columns: u32,
        rows: u32,
        obstacles: &[Block],
        mut found: impl FnMut(Block),
    ) {
        if columns == 0 || rows == 0 {
            return;
        }
        self.skyline.reset(columns, obstacles);
        while let Some(level) = self.skyline.next_top().map(|block| block.y1) {
            let tops = self.skyline.waiting().take_while(|block| block.y1 == level);
            merge(tops.map(|block| (block.x0, block.x1)), &mut self.supports);
            if level < rows {
                self.rise(level, rows, &mut found);
            }
            self.skyline.look_below(level);
        }
        merge([(0, columns)], &mut self.supports);
        self.rise(0, rows, &mut found);
    }

    /// Finds what stands on the supports at `level`; the skyline shows the view just above it.
    fn rise(&mut self, level: u32, rows: u32, found: &mut impl FnMut(Block)) {
        let uncovered = self.skyline.through(level);
        let mut done = 0;
        for i in 0..self.supports.len() {
            let (from, to) = self.supports[i];
            let start = from.max(done);
            if start < to {
                for (from, to) in self.skyline.gaps(start, to, uncovered) {
                    self.runs.push(Run { from, to, since: level });
                    done = to;
                }
            }
            while let Some(run) = self.runs.pop() {
                self.follow(&run, level, rows, found);
            }
        }
    }

    fn follow(&mut self, run: &Run, level: u32, rows: u32, found: &mut impl FnMut(Block)) {
        let lid = self.skyline.lowest(run.from, run.to);
        let top = lid.map_or(rows, |lid| lid.y0);
        if run.since < top {
            found(Block { x0: run.from, y0: level, x1: run.to, y1: top });
        }
        let Some(lid) = lid else { return };
        for (from, to) in [(run.from, lid.x0), (lid.x1, run.to)] {
            if from < to && self.is_supported(from, to) {
                self.runs.push(Run { from, to, since: top });
            }
        }
    }

    fn is_supported(&self, from: u32, to: u32) -> bool {
        let right_of = self.supports.partition_point(|support| support.1 <= from);
        self.supports.get(right_of).is_some_and(|support| support.0 < to)
    }
}
