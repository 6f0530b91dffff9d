//! From classified cells to walls: what is unknown, and which specks are noise.

use super::report::MapReport;
use super::settings::Unknown;
use crate::geometry::tolerance::ROUNDING;
use crate::search::grid::around;
use crate::world::Occupancy;

/// What an image says about a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Cell {
    Free,
    Wall,
    Unknown,
}

/// The areas in the file, square metres.
pub(crate) fn count(cells: &[Cell], resolution: f64, unknown: Unknown) -> MapReport {
    let area = |kind| cells.iter().filter(|&&cell| cell == kind).count() as f64 * resolution * resolution;
    let unknown_in_file = area(Cell::Unknown);
    let gained = if unknown == Unknown::Free { unknown_in_file } else { 0.0 };
    MapReport { free_in_file: area(Cell::Free), unknown_in_file, unknown: gained, ..MapReport::default() }
}

pub(crate) fn walls(cells: &[Cell], unknown: Unknown) -> Vec<bool> {
    let is_wall = |&cell: &Cell| match cell {
        Cell::Wall => true,
        Cell::Free => false,
        Cell::Unknown => unknown == Unknown::Wall,
    };
    cells.iter().map(is_wall).collect()
}

/// Frees the blobs of wall cells (joined over edges and corners) whose area is less than `speck_area`. A blob at
/// the image's border stays whatever its size: what it is part of may lie outside.
///
/// # Returns
/// The area freed, square metres.
pub(crate) fn drop_specks(walls: &mut Occupancy, speck_area: f64) -> f64 {
    let cell_area = walls.resolution * walls.resolution;
    // a blob of exactly the area, as written in decimals, is not smaller than it
    let limit = speck_area / cell_area - ROUNDING;
    if limit <= 1.0 {
        return 0.0;
    }
    let mut seen = vec![false; walls.blocked.len()];
    let mut freed = 0;
    for start in 0..walls.blocked.len() {
        if !walls.blocked[start] || seen[start] {
            continue;
        }
        let (blob, at_border) = blob(walls, start, &mut seen);
        if !at_border && (blob.len() as f64) < limit {
            freed += blob.len();
            for cell in blob {
                walls.blocked[cell] = false;
            }
        }
    }
    freed as f64 * cell_area
}

/// The wall cells connected to `start`, and whether one is at the image's border.
fn blob(walls: &Occupancy, start: usize, seen: &mut [bool]) -> (Vec<usize>, bool) {
    let mut blob = vec![start];
    let mut at_border = false;
    let mut next = 0;
    seen[start] = true;
    while let Some(&cell) = blob.get(next) {
        next += 1;
        let (column, row) = (cell % walls.columns, cell / walls.columns);
        at_border |= column == 0 || row == 0 || column + 1 == walls.columns || row + 1 == walls.rows;
        for (neighbour, _) in around(cell, (walls.columns, walls.rows)) {
            if walls.blocked[neighbour] && !std::mem::replace(&mut seen[neighbour], true) {
                blob.push(neighbour);
            }
        }
    }
    (blob, at_border)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Point;

    #[test]
    fn small_blobs_inside_go_and_those_at_the_border_stay() {
        let rows = ["#......", "..#....", "...#...", ".....##", ".##...."];
        let blocked: Vec<bool> = rows.iter().rev().flat_map(|row| row.chars().map(|c| c == '#')).collect();
        let origin = Point::default();
        let mut walls = Occupancy { origin, resolution: 0.5, columns: 7, rows: 5, blocked };
        let mut freed = |speck_area| drop_specks(&mut walls, speck_area).to_string();
        assert_eq!(freed(0.5), "0", "two cells joined at a corner are exactly 0.5 m²");
        assert_eq!(freed(0.51), "0.5");
        assert_eq!(walls.blocked.iter().filter(|&&b| b).count(), 5, "the border keeps its blobs");
    }
}
