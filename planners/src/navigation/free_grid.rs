//! Where the middle of a robot can be, as cells of a grid.

use fixedbitset::FixedBitSet;

use crate::geometry::{Point, Rect, Segment};
use crate::rim::Rim;
use crate::search::grid::{around, least_cost, least_costs};

/// A cell is free if its middle is.
#[derive(Clone, Debug)]
pub(super) struct FreeGrid {
    origin: Point,
    grain: f64,
    columns: usize,
    rows: usize,
    free: FixedBitSet,
}

impl FreeGrid {
    /// A grid over a window, all free.
    pub fn new(window: Rect, grain: f64) -> Self {
        let count = |extent: f64| (extent / grain).ceil().max(0.0) as usize + 1;
        let (columns, rows) = (count(window.dx()), count(window.dy()));
        let mut free = FixedBitSet::with_capacity(columns * rows);
        free.insert_range(..);
        Self { origin: Point::new(window.x0, window.y0), grain, columns, rows, free }
    }

    /// Takes away where a robot is [nearer](Rim::distance) than `reach` to a segment.
    pub fn block(&mut self, rim: &Rim, segment: &Segment, reach: f64) {
        let (a, b) = (segment.a, segment.b);
        let about = reach + rim.core_m();
        let first = |low: f64, origin: f64| ((low - about - origin) / self.grain).floor().max(0.0) as usize;
        let last = |high: f64, origin: f64, count: usize| {
            let index = ((high + about - origin) / self.grain).ceil();
            if index < 0.0 { 0 } else { (index as usize + 1).min(count) }
        };
        let columns = first(a.x.min(b.x), self.origin.x)..last(a.x.max(b.x), self.origin.x, self.columns);
        let rows = first(a.y.min(b.y), self.origin.y)..last(a.y.max(b.y), self.origin.y, self.rows);
        for row in rows {
            for column in columns.clone() {
                let cell = row * self.columns + column;
                if self.free.contains(cell) && rim.distance(self.at(cell), segment) < reach {
                    self.free.remove(cell);
                }
            }
        }
    }

    /// Takes away the cells for which the test says no.
    pub fn keep(&mut self, is_kept: impl Fn(Point) -> bool) {
        for cell in 0..self.columns * self.rows {
            if self.free.contains(cell) && !is_kept(self.at(cell)) {
                self.free.remove(cell);
            }
        }
    }

    pub fn at(&self, cell: usize) -> Point {
        let (column, row) = (cell % self.columns, cell / self.columns);
        Point::new(self.origin.x + column as f64 * self.grain, self.origin.y + row as f64 * self.grain)
    }

    /// The nearest free cell up to a distance that passes a test.
    pub fn nearest(&self, p: Point, within: f64, passes: impl Fn(Point) -> bool) -> Option<usize> {
        let index = |value: f64, origin: f64| ((value - origin) / self.grain).round();
        let (column, row) = (index(p.x, self.origin.x) as isize, index(p.y, self.origin.y) as isize);
        let far = (within / self.grain).ceil() as isize;
        let mut found: Vec<(f64, usize)> = Vec::new();
        for dy in -far..=far {
            for dx in -far..=far {
                let cell = self.cell(column + dx, row + dy).filter(|cell| self.free.contains(*cell));
                found.extend(cell.map(|cell| (p.distance(self.at(cell)), cell)));
            }
        }
        found.retain(|(distance, _)| *distance <= within);
        found.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        found.into_iter().map(|(_, cell)| cell).find(|&cell| passes(self.at(cell)))
    }

    /// Cells that are joined have the same number; those that are not free have none.
    pub fn parts(&self) -> Vec<Option<u32>> {
        let mut parts = vec![None; self.columns * self.rows];
        let mut count = 0;
        let mut open = Vec::new();
        for seed in self.free.ones() {
            if parts[seed].is_some() {
                continue;
            }
            parts[seed] = Some(count);
            open.push(seed);
            while let Some(cell) = open.pop() {
                for (next, _) in self.neighbours(cell) {
                    if parts[next].is_none() {
                        parts[next] = Some(count);
                        open.push(next);
                    }
                }
            }
            count += 1;
        }
        parts
    }

    /// The shortest way from cell to cell (A*), by the middles of the cells.
    pub fn path(&self, from: usize, to: usize) -> Option<Vec<Point>> {
        let (goal_x, goal_y) = (to % self.columns, to / self.columns);
        let left = |cell: usize| {
            least_cost((cell % self.columns).abs_diff(goal_x), (cell / self.columns).abs_diff(goal_y))
        };
        let found = least_costs(self.columns * self.rows, from, Some(to), left, |cell| self.neighbours(cell));
        found.cost(to)?;
        Some(found.way(to).into_iter().map(|cell| self.at(cell)).collect())
    }

    fn cell(&self, column: isize, row: isize) -> Option<usize> {
        let (column, row) = (usize::try_from(column).ok()?, usize::try_from(row).ok()?);
        (column < self.columns && row < self.rows).then(|| row * self.columns + column)
    }

    fn neighbours(&self, cell: usize) -> impl Iterator<Item = (usize, u32)> {
        around(cell, (self.columns, self.rows)).filter(|(next, _)| self.free.contains(*next))
    }
}
