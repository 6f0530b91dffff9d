//! A body that is longer than wide, at one of a few facings, and while it turns from one to the next.
//!
//! A layer holds the points about which the body is free at exactly its facing: there it may move in any direction,
//! as a side-step does. It may turn only where all that it sweeps between two facings is free, which is a smaller
//! set of points, within the free space of both facings: so it is safe at either end of a turn and all the way.

use super::cells::Cells;
use super::free_space::x_range_in_band;
use crate::geometry::Point;
use crate::geometry::tolerance::ROUNDING_M;
use crate::strips::Block;

/// In how many ways a body can face. Half a turn shows it the same.
pub(super) const FACINGS: usize = 8;

/// Degrees from one facing to the next; counterclockwise from x.
pub(crate) const STEP_DEGREES: f64 = 180.0 / FACINGS as f64;

/// The points whose convex hull is the body, its length along the facing.
///
/// # Arguments
/// `clearance` is added on all four sides.
pub(crate) fn body(length: f64, width: f64, clearance: f64, facing: usize) -> Vec<Point> {
    let (radius, angles) = corners(length, width, clearance);
    let turned = |angle: f64| Point::towards(angle + radians(facing)) * radius;
    angles.map(turned).into()
}

/// Points whose convex hull holds all that the body sweeps while it turns to the next facing.
pub(super) fn sweep(length: f64, width: f64, clearance: f64, facing: usize) -> Vec<Point> {
    let (radius, angles) = corners(length, width, clearance);
    let half_step = STEP_DEGREES.to_radians() / 2.0;
    // Each corner moves on an arc, which lies inside of the chord and the tangents at its ends. The body at any
    // heading is the hull of its corners, so the hull of all arcs holds it.
    let arc = |angle: f64| {
        let from = angle + radians(facing);
        let apex = Point::towards(from + half_step) * (radius / half_step.cos());
        [Point::towards(from) * radius, apex, Point::towards(from + 2.0 * half_step) * radius]
    };
    angles.into_iter().flat_map(arc).collect()
}

/// The corners' distance from the middle, and their angles where the body faces along x.
fn corners(length: f64, width: f64, clearance: f64) -> (f64, [f64; 4]) {
    let (along, across) = (length / 2.0 + clearance, width / 2.0 + clearance);
    let angle = across.atan2(along);
    let half_turn = std::f64::consts::PI;
    (along.hypot(across), [angle, half_turn - angle, half_turn + angle, -angle])
}

fn radians(facing: usize) -> f64 {
    (facing as f64 * STEP_DEGREES).to_radians()
}

/// The cells of `free` about every point of which the hull of `outline` lies in `free`.
pub(super) fn fitting(free: &Cells, outline: &[Point], side: f64) -> Cells {
    let (columns, rows) = (i64::from(free.columns()), i64::from(free.rows()));
    let next_wall = next_walls(free);
    let kernel = kernel(outline, side);
    let mut fits = Cells::none(free.columns(), free.rows());
    let mut blocked = vec![false; columns as usize];
    for row in 0..rows {
        blocked.fill(false);
        for &(up, (first, last)) in &kernel {
            if !(0..rows).contains(&(row + up)) {
                blocked.fill(true);
                break;
            }
            let start = ((row + up) * columns) as usize;
            let walls = &next_wall[start..start + columns as usize];
            for (column, blocked) in (0..).zip(&mut blocked) {
                let from = column + first;
                *blocked |= from < 0 || from >= columns || i64::from(walls[from as usize]) <= column + last;
            }
        }
        insert_runs(&mut fits, row as u32, &blocked);
    }
    fits
}

/// Rows of cells, relative to the cell that the body's middle lies in, that the body may overlap: for each row its
/// first and last column.
///
/// With its middle anywhere in cell 0, the body overlaps cell (i, j) where the hull comes between i - 1 and i + 1
/// and between j - 1 and j + 1.
fn kernel(outline: &[Point], side: f64) -> Vec<(i64, (i64, i64))> {
    let span = |values: &mut dyn Iterator<Item = f64>| {
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
        (((low + ROUNDING_M) / side).floor() as i64, ((high - ROUNDING_M) / side).ceil() as i64)
    };
    let (lowest, highest) = span(&mut outline.iter().map(|p| p.y));
    let row = |up: i64| {
        let band = ((up - 1) as f64 * side + ROUNDING_M, (up + 1) as f64 * side - ROUNDING_M);
        // The hull's edges are among the segments between its points, and the others lie inside of it.
        let pairs = outline.iter().flat_map(|&a| outline.iter().map(move |&b| (a, b)));
        let ranges = pairs.filter_map(|(a, b)| x_range_in_band(a, b, band));
        (up, span(&mut ranges.flat_map(|(low, high)| [low, high])))
    };
    (lowest..=highest).map(row).collect()
}

/// For each cell the column of the first cell from it to the right that is not free; beyond the last column is a wall.
fn next_walls(free: &Cells) -> Vec<u32> {
    let (columns, rows) = (free.columns(), free.rows());
    let mut next = vec![0; columns as usize * rows as usize];
    for (row, line) in (0..rows).zip(next.chunks_exact_mut(columns as usize)) {
        let mut wall = columns;
        for column in (0..columns).rev() {
            if !free.contains(column, row) {
                wall = column;
            }
            line[column as usize] = wall;
        }
    }
    next
}

fn insert_runs(cells: &mut Cells, row: u32, blocked: &[bool]) {
    let mut column = 0;
    for run in blocked.chunk_by(|a, b| a == b) {
        let end = column + run.len() as u32;
        if !run[0] {
            cells.insert_block(Block { x0: column, y0: row, x1: end, y1: row + 1 });
        }
        column = end;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_body_along_the_lattice_takes_its_own_cells_and_one_more() {
        let kernel = kernel(&body(0.6, 0.3, 0.0, 0), 0.05);
        assert_eq!(kernel.len(), 7);
        assert!(kernel.iter().all(|(_, columns)| *columns == (-6, 6)));
    }

    #[test]
    fn a_quarter_turn_exchanges_length_and_width() {
        let turned = kernel(&body(0.6, 0.3, 0.0, FACINGS / 2), 0.05);
        assert_eq!(turned, kernel(&body(0.3, 0.6, 0.0, 0), 0.05));
    }

    #[test]
    fn a_sweep_holds_the_body_at_every_heading_between_two_facings() {
        let (length, width) = (0.7, 0.25);
        let hull = geo::ConvexHull::convex_hull(&geo::MultiPoint::from(
            sweep(length, width, 0.0, 3).iter().map(|p| (p.x, p.y)).collect::<Vec<_>>(),
        ));
        let (radius, angles) = corners(length, width, 0.0);
        for step in 0..=100 {
            let heading = (3.0 + f64::from(step) / 100.0) * STEP_DEGREES.to_radians();
            for angle in angles {
                let p = Point::towards(angle + heading) * (radius * (1.0 - 1e-9));
                assert!(geo::Intersects::intersects(&hull, &geo::Point::new(p.x, p.y)), "{p:?}");
            }
        }
    }
}
