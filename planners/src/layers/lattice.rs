//! The uniform lattice of cells in which all layers of a world are cut.

use crate::geometry::{Point, Rect};
use crate::strips::Block;

/// The most cells that a lattice may have.
pub const MAX_CELLS: f64 = 1e8;

/// A cell that lacks no more of its side is whole: a map of 93.7 m has 1874 cells of 5 cm, whatever the binary fractions
/// say.
const WHOLE: f64 = 1e-6;

/// Square cells from the environment's lower left corner. A remainder at the right or upper edge that is less
/// than a cell is not covered.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lattice {
    origin: Point,
    side: f64,
    columns: u32,
    rows: u32,
}

impl Lattice {
    /// The lattice over `bounds` with cells of `side` metres. The error is one sentence.
    pub fn new(bounds: Rect, side: f64) -> Result<Self, String> {
        if !(side.is_finite() && side > 0.0) {
            return Err(format!("a grid of {side:?} m has no cells"));
        }
        let cells = |length: f64| (length / side + WHOLE).floor();
        let (columns, rows) = (cells(bounds.dx()), cells(bounds.dy()));
        if columns * rows > MAX_CELLS {
            return Err(format!(
                "a grid of {side:?} m cuts {:.1} x {:.1} m into {:.0} million cells, more than {:.0} million; \
                 set a coarser `grid`",
                bounds.dx(),
                bounds.dy(),
                columns * rows / 1e6,
                MAX_CELLS / 1e6
            ));
        }
        if columns < 1.0 || rows < 1.0 {
            return Err(format!("a grid of {side:?} m is coarser than the map"));
        }
        let origin = Point::new(bounds.x0, bounds.y0);
        Ok(Self { origin, side, columns: columns as u32, rows: rows as u32 })
    }

    pub fn side(&self) -> f64 {
        self.side
    }

    pub fn columns(&self) -> u32 {
        self.columns
    }

    pub fn rows(&self) -> u32 {
        self.rows
    }

    /// The x of the line left of a column, metres.
    pub(super) fn x(&self, column: u32) -> f64 {
        self.origin.x + f64::from(column) * self.side
    }

    /// The y of the line under a row, metres.
    pub(super) fn y(&self, row: u32) -> f64 {
        self.origin.y + f64::from(row) * self.side
    }

    pub(super) fn centre(&self, column: u32, row: u32) -> Point {
        Point::new(self.x(column) + self.side / 2.0, self.y(row) + self.side / 2.0)
    }

    /// A block of cells in metres. Blocks that share a lattice line share the coordinate bit for bit.
    pub(super) fn rect(&self, r: Block) -> Rect {
        Rect::new(self.x(r.x0), self.y(r.y0), self.x(r.x1), self.y(r.y1))
    }

    /// The columns that meet the closed interval `low..=high`, and one more on each side where there is one.
    pub(super) fn columns_about(&self, low: f64, high: f64) -> std::ops::Range<u32> {
        about((low - self.origin.x) / self.side, (high - self.origin.x) / self.side, self.columns)
    }

    /// The rows that meet the closed interval `low..=high`, and one more on each side where there is one.
    pub(super) fn rows_about(&self, low: f64, high: f64) -> std::ops::Range<u32> {
        about((low - self.origin.y) / self.side, (high - self.origin.y) / self.side, self.rows)
    }
}

fn about(low: f64, high: f64, count: u32) -> std::ops::Range<u32> {
    // A cast from float saturates, so what lies outside becomes an end of the lattice.
    let first = ((low - 1.0).floor() as u32).min(count);
    let last = ((high + 2.0).floor() as u32).min(count);
    first..last.max(first)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lattice_covers_all_but_less_than_a_cell() {
        let lattice = Lattice::new(Rect::new(0.0, 0.0, 93.7, 41.13), 0.05).unwrap();
        assert_eq!((lattice.columns(), lattice.rows()), (1874, 822));
        assert!(Lattice::new(Rect::new(0.0, 0.0, 1e5, 1e5), 0.05).is_err());
    }
}
