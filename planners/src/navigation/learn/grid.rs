//! Cells of a plane by whole numbers, and bits for those of a window.

use fixedbitset::FixedBitSet;

use crate::geometry::{Point, Rect, Segment};

/// The side of a cell, metres.
pub(super) const GRAIN_M: f64 = 0.05;

/// A cell by column and row; that of 0, 0 has its lower left corner in the origin.
pub(super) type Cell = (i32, i32);

pub(super) fn cell_of(p: Point) -> Cell {
    ((p.x / GRAIN_M).floor() as i32, (p.y / GRAIN_M).floor() as i32)
}

pub(super) fn middle_of((column, row): Cell) -> Point {
    Point::new((f64::from(column) + 0.5) * GRAIN_M, (f64::from(row) + 0.5) * GRAIN_M)
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Window {
    low: Cell,
    columns: i32,
    rows: i32,
}

impl Window {
    /// The cells about a rectangle.
    pub fn around(r: &Rect) -> Self {
        let (low, high) = (cell_of(Point::new(r.x0, r.y0)), cell_of(Point::new(r.x1, r.y1)));
        Self { low, columns: high.0 - low.0 + 1, rows: high.1 - low.1 + 1 }
    }

    /// The smallest window with the cells of both, larger by so many cells where it has to grow.
    pub fn with(&self, other: &Self, spare: i32) -> Self {
        if self.columns == 0 {
            return *other;
        }
        let grown = |low: i32, count: i32, other_low: i32, other_count: i32| {
            let new_low = if other_low < low { other_low - spare } else { low };
            let high = if other_low + other_count > low + count {
                other_low + other_count + spare
            } else {
                low + count
            };
            (new_low, high - new_low)
        };
        let (x, columns) = grown(self.low.0, self.columns, other.low.0, other.columns);
        let (y, rows) = grown(self.low.1, self.rows, other.low.1, other.rows);
        Self { low: (x, y), columns, rows }
    }

    /// The place of a cell among those of the window.
    pub fn index(&self, (column, row): Cell) -> Option<usize> {
        let (x, y) = (column - self.low.0, row - self.low.1);
        let is_inside = (0..self.columns).contains(&x) && (0..self.rows).contains(&y);
        is_inside.then(|| y as usize * self.columns as usize + x as usize)
    }

    pub fn cell(&self, index: usize) -> Cell {
        let columns = self.columns.max(1) as usize;
        (self.low.0 + (index % columns) as i32, self.low.1 + (index / columns) as i32)
    }

    pub fn len(&self) -> usize {
        self.columns as usize * self.rows as usize
    }
}

#[derive(Clone, Debug, Default)]
pub(super) struct Cells {
    pub window: Window,
    bits: FixedBitSet,
}

impl Cells {
    pub fn none(window: Window) -> Self {
        Self { window, bits: FixedBitSet::with_capacity(window.len()) }
    }

    pub fn has(&self, cell: Cell) -> bool {
        self.window.index(cell).is_some_and(|index| self.bits.contains(index))
    }

    /// Takes a cell in.
    ///
    /// # Returns
    /// Whether it is new; a cell outside of the window is not.
    pub fn take(&mut self, cell: Cell) -> bool {
        self.window.index(cell).is_some_and(|index| !self.bits.put(index))
    }

    /// All of them, row by row.
    pub fn iter(&self) -> impl Iterator<Item = Cell> + '_ {
        self.bits.ones().map(|index| self.window.cell(index))
    }

    /// The same cells in a larger window.
    pub fn moved(&self, window: Window) -> Self {
        let mut moved = Self::none(window);
        for cell in self.iter() {
            moved.take(cell);
        }
        moved
    }

    /// Takes every cell that a segment touches, so that no way from side to side of a cell leads across it.
    pub fn draw(&mut self, segment: &Segment) {
        for cell in touched(segment.a, segment.b) {
            self.take(cell);
        }
    }
}

/// The cells that the way between two points passes, in order; each shares a side with the next.
pub(super) fn touched(a: Point, b: Point) -> impl Iterator<Item = Cell> {
    let (mut at, last) = (cell_of(a), cell_of(b));
    let (dx, dy) = (b.x - a.x, b.y - a.y);
    // shares of the way at which the next column, and the next row begins
    let first = |from: f64, d: f64, cell: i32| {
        let line = f64::from(cell + i32::from(d > 0.0)) * GRAIN_M;
        if d == 0.0 { f64::INFINITY } else { (line - from) / d }
    };
    let (mut next_x, mut next_y) = (first(a.x, dx, at.0), first(a.y, dy, at.1));
    let (step_x, step_y) = ((GRAIN_M / dx).abs(), (GRAIN_M / dy).abs());
    let count = at.0.abs_diff(last.0) + at.1.abs_diff(last.1);
    std::iter::once(at).chain((0..count).map(move |_| {
        let is_column = at.1 == last.1 || (at.0 != last.0 && next_x < next_y);
        if is_column {
            (at.0, next_x) = (at.0 + (last.0 - at.0).signum(), next_x + step_x);
        } else {
            (at.1, next_y) = (at.1 + (last.1 - at.1).signum(), next_y + step_y);
        }
        at
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cells_of_a_way_lead_side_by_side_from_its_begin_to_its_end() {
        let ends =
            [(0.02, 0.03, 0.97, 0.41), (0.9, 0.9, 0.1, -0.5), (0.0, 0.0, 0.0, 0.3), (0.5, 0.5, 0.5, 0.5)];
        for (x0, y0, x1, y1) in ends {
            let (a, b) = (Point::new(x0, y0), Point::new(x1, y1));
            let cells: Vec<Cell> = touched(a, b).collect();
            assert_eq!((cells[0], cells[cells.len() - 1]), (cell_of(a), cell_of(b)));
            for pair in cells.windows(2) {
                assert_eq!(pair[0].0.abs_diff(pair[1].0) + pair[0].1.abs_diff(pair[1].1), 1);
            }
            for cell in &cells {
                assert!(Segment::new(a, b).distance(middle_of(*cell)) <= 0.75 * GRAIN_M);
            }
        }
    }

    #[test]
    fn a_window_grows_and_keeps_its_cells() {
        let mut cells = Cells::none(Window::around(&Rect::new(0.0, 0.0, 1.0, 1.0)));
        assert!(cells.take((3, 4)) && !cells.take((3, 4)) && !cells.take((-1, 0)));
        let larger = cells.window.with(&Window::around(&Rect::new(-1.0, 0.0, 0.5, 0.5)), 2);
        let cells = cells.moved(larger);
        assert!(cells.has((3, 4)) && cells.window.index((-20, 0)).is_some());
        assert_eq!(cells.iter().collect::<Vec<_>>(), [(3, 4)]);
    }
}
