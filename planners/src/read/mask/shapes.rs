//! Cells of a mask as simple polygons that cover all of them.

use std::collections::BTreeSet;

use crate::geometry::Point;
use crate::geometry::outline::{outlines, simplified};
use crate::geometry::polygon::{self_crossing, to_geo};
use crate::search::grid::{around, beside};

/// How far a simplified outline may be from that of the cells, in cells: as far as cells were added about them.
const OFF: f64 = 1.0;

/// Polygons about the marked cells of a grid of `size` columns and rows, in cells. They cover every marked cell, with a cell
/// around it that may be added, and less than one cell more.
pub(super) fn of(
    marked: impl Iterator<Item = usize>,
    size: (usize, usize),
    may_be_added: impl Fn(usize) -> bool,
) -> Vec<Vec<Point>> {
    let marked: BTreeSet<usize> = marked.collect();
    let added = marked.iter().flat_map(|&cell| around(cell, size).map(|(cell, _)| cell));
    let added: BTreeSet<usize> =
        added.filter(|&cell| !marked.contains(&cell) && may_be_added(cell)).collect();
    let mut shapes = Vec::new();
    let mut left = vec![&marked | &added];
    while let Some(cells) = left.pop() {
        for part in parts(cells, size) {
            let rings = rings(&part, size);
            match (rings.iter().find(|ring| signed_area(ring) < 0.0), &*rings) {
                // an area has no holes: what is around one is cut in two through it
                (Some(hole), _) => {
                    let columns = || hole.iter().map(|corner| corner.x as usize);
                    let (first, last) = (columns().min().unwrap_or(0), columns().max().unwrap_or(0));
                    let cut = usize::midpoint(first, last);
                    let (one, other) = part.into_iter().partition(|cell| cell % size.0 < cut);
                    left.extend([one, other]);
                }
                (None, [ring]) => {
                    // at the edge of the map, and where it was cut, a part ends where marked cells end
                    let is_within = |cell: &usize| {
                        around(*cell, size).filter(|(next, _)| part.contains(next)).count() == 8
                    };
                    let is_padded = part.intersection(&marked).all(is_within);
                    shapes.push(polygon(ring, is_padded));
                }
                // one part over sides has one outer ring
                (None, _) => {}
            }
        }
    }
    shapes
}

/// The sets of cells that hang together over sides.
fn parts(mut cells: BTreeSet<usize>, size: (usize, usize)) -> Vec<BTreeSet<usize>> {
    let mut parts = Vec::new();
    while let Some(first) = cells.pop_first() {
        let (mut part, mut open) = (BTreeSet::from([first]), vec![first]);
        while let Some(cell) = open.pop() {
            for next in beside(cell, size).filter(|next| cells.contains(next)).collect::<Vec<_>>() {
                cells.remove(&next);
                part.insert(next);
                open.push(next);
            }
        }
        parts.push(part);
    }
    parts
}

/// The outlines of a part, looked at in the rectangle about it.
fn rings(part: &BTreeSet<usize>, (columns, _): (usize, usize)) -> Vec<Vec<Point>> {
    let (mut x, mut y) = ((usize::MAX, 0), (usize::MAX, 0));
    for cell in part {
        let (column, row) = (cell % columns, cell / columns);
        x = (x.0.min(column), x.1.max(column));
        y = (y.0.min(row), y.1.max(row));
    }
    let has = |column: usize, row: usize| part.contains(&((row + y.0) * columns + column + x.0));
    let rings = outlines(x.1 + 1 - x.0, y.1 + 1 - y.0, has);
    let by = Point::new(x.0 as f64, y.0 as f64);
    rings.into_iter().map(|ring| ring.into_iter().map(|corner| corner + by).collect()).collect()
}

fn signed_area(ring: &[Point]) -> f64 {
    geo::Area::signed_area(&to_geo(ring))
}

/// A ring with fewer corners; where there is not a cell more about all that it must cover, only those on straight lines go.
fn polygon(ring: &[Point], is_padded: bool) -> Vec<Point> {
    let exact = || simplified(ring, 1e-6);
    if !is_padded {
        return exact();
    }
    let fewer = simplified(ring, OFF);
    if fewer.len() < 3 || self_crossing(&fewer).is_some() { exact() } else { fewer }
}

#[cfg(test)]
mod tests {
    use geo::{Contains, Intersects};

    use super::*;

    fn cells(rows: &[&str]) -> (Vec<usize>, (usize, usize)) {
        let size = (rows[0].len(), rows.len());
        let text: Vec<u8> = rows.iter().rev().flat_map(|row| row.bytes()).collect();
        ((0..text.len()).filter(|&cell| text[cell] == b'#').collect(), size)
    }

    #[test]
    fn polygons_cover_every_cell_and_leave_a_hole_that_is_wide_enough() {
        let (marked, size) = cells(&[
            "..............",
            ".###########..",
            ".#.........#..",
            ".#.........#..",
            ".#.........#..",
            ".#.........#..",
            ".#.........##.",
            ".###########..",
            "..............",
        ]);
        let shapes = of(marked.iter().copied(), size, |_| true);
        assert!(shapes.len() > 1, "a ring is cut through its hole");
        let polygons: Vec<_> = shapes.iter().map(|shape| to_geo(shape)).collect();
        for cell in marked {
            let (x, y) = ((cell % size.0) as f64, (cell / size.0) as f64);
            let middle = geo::Point::new(x + 0.5, y + 0.5);
            assert!(polygons.iter().any(|polygon| polygon.contains(&middle)), "cell {x}, {y}");
        }
        let hole = geo::Point::new(6.0, 4.5);
        assert!(!polygons.iter().any(|polygon| polygon.intersects(&hole)));
    }

    #[test]
    fn a_slope_has_few_corners() {
        let rows: Vec<String> = (0..24)
            .map(|row| format!("..{:.<24}", "#".repeat(if row < 22 { row.max(2) - 2 } else { 0 })))
            .collect();
        let (marked, size) = cells(&rows.iter().map(String::as_str).collect::<Vec<_>>());
        let shapes = of(marked.into_iter(), size, |_| true);
        assert_eq!(shapes.len(), 1);
        assert!(shapes[0].len() < 9, "{:?}", shapes[0]);
    }
}
