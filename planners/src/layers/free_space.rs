//! The free space of a disc among everything solid, as cells: a cell is free when the whole closed cell keeps the
//! disc's radius from every wall. So a room of free cells is free throughout, and what is missed lies within a
//! cell's diagonal of the limit.

use super::cells::Cells;
use super::gap;
use super::lattice::Lattice;
use super::transform::squared_gaps;
use crate::geometry::tolerance::ROUNDING_M;
use crate::geometry::{Point, Rect, Segment, polygon};
use crate::strips::Block;
use crate::world::{Occupancy, Shape, World};

/// Everything solid in a world, ready to be asked for the free space of discs of several sizes.
pub(crate) struct Solid<'a> {
    world: &'a World,
    lattice: Lattice,
    pictured: Option<Pictured>,
}

/// Walls of an image on the lattice.
struct Pictured {
    walls: Cells,
    squared_gaps: Vec<u32>,
}

impl<'a> Solid<'a> {
    pub(crate) fn new(world: &'a World, lattice: Lattice) -> Self {
        let pictured = world.occupancy.as_ref().map(|occupancy| {
            let walls = resampled(occupancy, &lattice);
            let size = (walls.columns() as usize, walls.rows() as usize);
            let has = |column: usize, row: usize| walls.contains(column as u32, row as u32);
            Pictured { squared_gaps: squared_gaps(size, has), walls }
        });
        Self { world, lattice, pictured }
    }

    /// The cells that keep `keep` metres from every wall, from the edge and from the rectangles `low`; with a `keep`
    /// of 0, those that no wall overlaps.
    pub(crate) fn free_cells(&self, keep: f64, low: &[Rect]) -> Cells {
        let mut free = self.inside_of_edge(keep);
        if let Some(pictured) = &self.pictured {
            self.keep_from_image(pictured, keep, &mut free);
        }
        for obstacle in &self.world.obstacles {
            match &obstacle.shape {
                Shape::Rect(rect) => self.keep_from_rect(rect, keep, &mut free),
                Shape::Polygon(corners) => self.keep_from_polygon(corners, keep, &mut free),
            }
        }
        for rect in low {
            self.keep_from_rect(rect, keep, &mut free);
        }
        free
    }

    fn inside_of_edge(&self, keep: f64) -> Cells {
        let (lattice, bounds) = (&self.lattice, self.world.bounds);
        let keep = keep - ROUNDING_M;
        let inside_x = |c: &u32| lattice.x(*c) - bounds.x0 >= keep && bounds.x1 - lattice.x(*c + 1) >= keep;
        let inside_y = |r: &u32| lattice.y(*r) - bounds.y0 >= keep && bounds.y1 - lattice.y(*r + 1) >= keep;
        let columns = ends((0..lattice.columns()).filter(inside_x));
        let rows = ends((0..lattice.rows()).filter(inside_y));
        let mut free = Cells::none(lattice.columns(), lattice.rows());
        if let (Some((x0, x1)), Some((y0, y1))) = (columns, rows) {
            free.insert_block(Block { x0, y0, x1, y1 });
        }
        free
    }

    fn keep_from_image(&self, pictured: &Pictured, keep: f64, free: &mut Cells) {
        let limit = ((keep - ROUNDING_M) / self.lattice.side()).powi(2);
        let columns = self.lattice.columns();
        for row in 0..self.lattice.rows() {
            for column in 0..columns {
                let cell = row as usize * columns as usize + column as usize;
                let near = if keep > ROUNDING_M {
                    f64::from(pictured.squared_gaps[cell]) < limit
                } else {
                    pictured.walls.contains(column, row)
                };
                if near {
                    free.remove(column, row);
                }
            }
        }
    }

    fn keep_from_rect(&self, rect: &Rect, keep: f64, free: &mut Cells) {
        for row in self.lattice.rows_about(rect.y0 - keep, rect.y1 + keep) {
            for column in self.lattice.columns_about(rect.x0 - keep, rect.x1 + keep) {
                let cell = self.cell(column, row);
                let near = if keep > ROUNDING_M {
                    cell.gap(rect) < keep - ROUNDING_M
                } else {
                    let (dx, dy) = cell.axis_gaps(rect);
                    dx < -ROUNDING_M && dy < -ROUNDING_M
                };
                if near {
                    free.remove(column, row);
                }
            }
        }
    }

    fn keep_from_polygon(&self, corners: &[Point], keep: f64, free: &mut Cells) {
        for Segment { a, b } in polygon::sides(corners) {
            self.keep_from_segment(a, b, keep, free);
        }
        // What no edge comes near is either wholly inside or wholly outside: its centre tells.
        let bounds = Rect::around(corners.iter().copied());
        for row in self.lattice.rows_about(bounds.y0, bounds.y1) {
            let y = self.lattice.y(row) + self.lattice.side() / 2.0;
            for inside in polygon::spans(polygon::sides(corners), y) {
                for column in self.lattice.columns_about(inside[0], inside[1]) {
                    let x = self.lattice.x(column) + self.lattice.side() / 2.0;
                    if inside[0] < x && x < inside[1] {
                        free.remove(column, row);
                    }
                }
            }
        }
    }

    fn keep_from_segment(&self, a: Point, b: Point, keep: f64, free: &mut Cells) {
        for row in self.lattice.rows_about(a.y.min(b.y) - keep, a.y.max(b.y) + keep) {
            let band = (self.lattice.y(row) - keep, self.lattice.y(row + 1) + keep);
            let Some((low, high)) = x_range_in_band(a, b, band) else { continue };
            for column in self.lattice.columns_about(low - keep, high + keep) {
                let near = if keep > ROUNDING_M {
                    gap::to_segment(&self.cell(column, row), a, b) < keep - ROUNDING_M
                } else {
                    // An edge along a lattice line overlaps neither cell beside it.
                    gap::to_segment(&self.cell(column, row).grown(-ROUNDING_M), a, b) == 0.0
                };
                if near {
                    free.remove(column, row);
                }
            }
        }
    }

    fn cell(&self, column: u32, row: u32) -> Rect {
        self.lattice.rect(Block { x0: column, y0: row, x1: column + 1, y1: row + 1 })
    }
}

/// The range of x that the segment has between two heights; `None` where it does not come there.
fn x_range_in_band(a: Point, b: Point, (low, high): (f64, f64)) -> Option<(f64, f64)> {
    let (a, b) = if a.y <= b.y { (a, b) } else { (b, a) };
    if b.y < low || a.y > high {
        return None;
    }
    let at = |y: f64| if b.y > a.y { a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x) } else { a.x };
    let (x0, x1) = if b.y > a.y { (at(a.y.max(low)), at(b.y.min(high))) } else { (a.x, b.x) };
    Some((x0.min(x1), x0.max(x1)))
}

/// The lattice cells that a wall of the image overlaps. Where the lattice is the image's own these are its walls;
/// else a cell that is a wall in part is one.
fn resampled(occupancy: &Occupancy, lattice: &Lattice) -> Cells {
    let mut walls = Cells::none(lattice.columns(), lattice.rows());
    for rect in occupancy.rectangles() {
        let overlaps =
            |low: f64, high: f64, x0: f64, x1: f64| low < x1 - ROUNDING_M && x0 + ROUNDING_M < high;
        let columns = lattice.columns_about(rect.x0, rect.x1);
        let rows = lattice.rows_about(rect.y0, rect.y1);
        let columns = columns.filter(|&c| overlaps(lattice.x(c), lattice.x(c + 1), rect.x0, rect.x1));
        let rows = rows.filter(|&r| overlaps(lattice.y(r), lattice.y(r + 1), rect.y0, rect.y1));
        if let (Some((x0, x1)), Some((y0, y1))) = (ends(columns), ends(rows)) {
            walls.insert_block(Block { x0, y0, x1, y1 });
        }
    }
    walls
}

/// The first, and one past the last, of consecutive numbers.
fn ends(mut consecutive: impl DoubleEndedIterator<Item = u32>) -> Option<(u32, u32)> {
    let first = consecutive.next()?;
    Some((first, consecutive.next_back().unwrap_or(first) + 1))
}
