//! Cells that touch, found by the runs in which they lie along rows.

use petgraph::unionfind::UnionFind;

use crate::world::Occupancy;

/// Cells of a row, from `first` up to before `end`, all blocked or all free.
#[derive(Clone, Copy)]
pub(super) struct Run {
    pub row: usize,
    pub first: usize,
    pub end: usize,
}

/// The runs of a floor's blocked or free cells, row by row; and of each the number of its set of runs that touch, from 0 by
/// their first cells.
///
/// # Arguments
/// `corners` is whether cells touch that share a corner only.
pub(super) fn touching(floor: &Occupancy, blocked: bool, corners: bool) -> (Vec<Run>, Vec<usize>) {
    let mut runs: Vec<Run> = Vec::new();
    let mut before = 0..0;
    let mut touch: Vec<(usize, usize)> = Vec::new();
    let reach = usize::from(corners);
    for (row, cells) in floor.blocked.chunks(floor.columns).enumerate() {
        let from = runs.len();
        let mut below = before.start;
        let mut column = 0;
        for part in cells.chunk_by(|a, b| a == b) {
            let (first, end) = (column, column + part.len());
            column = end;
            if part[0] != blocked {
                continue;
            }
            while below < before.end && runs[below].end + reach <= first {
                below += 1;
            }
            let mut other = below;
            while other < before.end && runs[other].first < end + reach {
                touch.push((other, runs.len()));
                other += 1;
            }
            runs.push(Run { row, first, end });
        }
        before = from..runs.len();
    }
    let mut sets = UnionFind::<usize>::new(runs.len());
    for (one, other) in touch {
        sets.union(one, other);
    }
    let roots = sets.into_labeling();
    let (mut numbers, mut next) = (vec![usize::MAX; runs.len()], 0);
    let number = |root: usize| {
        if numbers[root] == usize::MAX {
            numbers[root] = next;
            next += 1;
        }
        numbers[root]
    };
    let of_run = roots.into_iter().map(number).collect();
    (runs, of_run)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::geometry::Point;
    use crate::search::grid::{around, beside};

    proptest! {
        #[test]
        fn sets_of_runs_are_those_of_cells_that_touch(
            columns in 1_usize..9, cells in prop::collection::vec(any::<bool>(), 1..60), corners in any::<bool>()
        ) {
            let rows = cells.len().div_ceil(columns);
            let mut blocked = cells;
            blocked.resize(columns * rows, false);
            let floor = Occupancy { origin: Point::default(), resolution: 1.0, columns, rows, blocked };
            let (runs, of_run) = touching(&floor, true, corners);
            let mut of_cell = vec![None; floor.blocked.len()];
            for (run, of) in runs.iter().zip(of_run) {
                of_cell[run.row * columns + run.first..run.row * columns + run.end].fill(Some(of));
            }
            let mut expected = vec![None; floor.blocked.len()];
            let mut next = 0;
            for start in 0..expected.len() {
                if !floor.blocked[start] || expected[start].is_some() {
                    continue;
                }
                let mut open = vec![start];
                while let Some(cell) = open.pop() {
                    expected[cell] = Some(next);
                    let near: Vec<usize> = if corners {
                        around(cell, (columns, rows)).map(|(near, _)| near).collect()
                    } else {
                        beside(cell, (columns, rows)).collect()
                    };
                    open.extend(near.into_iter().filter(|&near| floor.blocked[near] && expected[near].is_none()));
                }
                next += 1;
            }
            prop_assert_eq!(of_cell, expected);
        }
    }
}
