//! Walls as an image has them: square cells.

use crate::geometry::{Point, Rect};

/// Walls as square cells, row 0 lowest (smallest y), column 0 leftmost.
#[derive(Clone, Debug, PartialEq)]
pub struct Occupancy {
    /// Lower left corner of cell (0, 0), map frame.
    pub origin: Point,
    /// Side of a cell, metres.
    pub resolution: f64,
    pub columns: usize,
    pub rows: usize,
    /// `columns * rows` cells, row by row; `true` is a wall.
    pub blocked: Vec<bool>,
}

impl Occupancy {
    pub fn is_blocked(&self, column: usize, row: usize) -> bool {
        self.blocked[row * self.columns + column]
    }

    /// Whether the cell in which the point lies is a wall. A point outside of the image is in none.
    pub fn is_blocked_at(&self, p: Point) -> bool {
        let (x, y) = ((p.x - self.origin.x) / self.resolution, (p.y - self.origin.y) / self.resolution);
        let inside = x >= 0.0 && y >= 0.0 && x < self.columns as f64 && y < self.rows as f64;
        inside && self.is_blocked(x as usize, y as usize)
    }

    pub fn cell(&self, column: usize, row: usize) -> Rect {
        self.block(column, row, column + 1, row + 1)
    }

    pub fn bounds(&self) -> Rect {
        self.block(0, 0, self.columns, self.rows)
    }

    /// The walls as disjoint rectangles: runs of cells in a row, merged with the same run in the rows above.
    /// Ordered by their lower edge, then their left one.
    pub fn rectangles(&self) -> Vec<Rect> {
        let mut done: Vec<[usize; 4]> = Vec::new();
        let mut open: Vec<[usize; 3]> = Vec::new();
        for row in 0..=self.rows {
            let runs = if row < self.rows { self.runs(row) } else { Vec::new() };
            let mut next = Vec::with_capacity(runs.len());
            let mut below = open.iter().peekable();
            for &[x0, x1] in &runs {
                while let Some(&[a, b, y0]) = below.next_if(|run| run[0] < x0) {
                    done.push([y0, a, b, row]);
                }
                match below.next_if(|run| run[0] == x0) {
                    Some(&[_, b, y0]) if b == x1 => next.push([x0, x1, y0]),
                    Some(&[a, b, y0]) => {
                        done.push([y0, a, b, row]);
                        next.push([x0, x1, row]);
                    }
                    None => next.push([x0, x1, row]),
                }
            }
            done.extend(below.map(|&[a, b, y0]| [y0, a, b, row]));
            open = next;
        }
        done.sort_unstable();
        done.into_iter().map(|[y0, x0, x1, y1]| self.block(x0, y0, x1, y1)).collect()
    }

    fn runs(&self, row: usize) -> Vec<[usize; 2]> {
        let cells = &self.blocked[row * self.columns..(row + 1) * self.columns];
        let mut runs = Vec::new();
        let mut start = None;
        for (column, &blocked) in cells.iter().chain([&false]).enumerate() {
            match (start, blocked) {
                (None, true) => start = Some(column),
                (Some(x0), false) => {
                    runs.push([x0, column]);
                    start = None;
                }
                _ => {}
            }
        }
        runs
    }

    fn block(&self, x0: usize, y0: usize, x1: usize, y1: usize) -> Rect {
        let at = |origin: f64, cells: usize| origin + cells as f64 * self.resolution;
        Rect::new(at(self.origin.x, x0), at(self.origin.y, y0), at(self.origin.x, x1), at(self.origin.y, y1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(rows: &[&str]) -> Occupancy {
        let blocked = rows.iter().rev().flat_map(|row| row.chars().map(|c| c == '#')).collect();
        let (columns, rows) = (rows[0].len(), rows.len());
        Occupancy { origin: Point::default(), resolution: 1.0, columns, rows, blocked }
    }

    #[test]
    fn equal_runs_of_neighbouring_rows_are_one_rectangle() {
        let walls = drawn(&[
            "##..#", //
            "##.##", //
            "#..##",
        ]);
        let rects = [
            Rect::new(0.0, 0.0, 1.0, 1.0),
            Rect::new(3.0, 0.0, 5.0, 2.0),
            Rect::new(0.0, 1.0, 2.0, 3.0),
            Rect::new(4.0, 2.0, 5.0, 3.0),
        ];
        assert_eq!(walls.rectangles(), rects);
    }

    #[test]
    fn the_rectangles_cover_exactly_the_walls() {
        let walls = drawn(&["#.#.#.##", ".#######", "####..#.", "#..##..#"]);
        let area: f64 = walls.rectangles().iter().map(Rect::area).sum();
        let blocked = walls.blocked.iter().filter(|&&b| b).count();
        assert!((area - blocked as f64).abs() < 1e-12);
    }
}
