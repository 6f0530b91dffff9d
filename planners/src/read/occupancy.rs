//! From classified cells to walls: what is unknown, and which specks are noise.

use super::report::MapReport;
use super::salt::{Blob, LARGEST, Salt};
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

/// Frees the blobs of wall cells (joined over edges and corners) that are specks: those whose area is less than
/// `speck_area`, or, where that is not said, salt. A blob at the image's border stays whatever its size: what it is part
/// of may lie outside.
///
/// # Returns
/// The area freed, square metres, and what the image made us do.
pub(crate) fn drop_specks(walls: &mut Occupancy, speck_area: Option<f64>) -> (f64, Option<String>) {
    let cell_area = walls.resolution * walls.resolution;
    let (specks, note) = match speck_area {
        // a blob of exactly the area, as written in decimals, is not smaller than it
        Some(area) => (small_blobs(walls, area / cell_area - ROUNDING), None),
        None => salt(walls),
    };
    let freed = specks.iter().map(Vec::len).sum::<usize>() as f64 * cell_area;
    for cell in specks.into_iter().flatten() {
        walls.blocked[cell] = false;
    }
    (freed, note)
}

/// The blobs that are salt, and what the expert should know of the image's lone pixels.
fn salt(walls: &Occupancy) -> (Vec<Blob>, Option<String>) {
    let small = small_blobs(walls, LARGEST as f64 + 1.0 - ROUNDING);
    let lone = small.iter().filter(|blob| blob.len() == 1).count();
    match Salt::of(walls, small) {
        Salt::None => (Vec::new(), None),
        Salt::Things => {
            let area = 1.5 * walls.resolution * walls.resolution;
            let note = format!(
                "{lone} wall pixels stand alone, in groups as legs of furniture do: they are kept; \
                 `speck_area = {area:.4}` drops them"
            );
            (Vec::new(), Some(note))
        }
        Salt::Chance { share, specks } => {
            let pixels = specks.iter().map(Vec::len).sum::<usize>();
            let note = format!(
                "{lone} wall pixels, {:.2} % of the floor, stand alone and as evenly as chance strews them: they are taken for \
                 salt, {pixels} pixels with those of it that touch each other or a wall; `speck_area = 0` keeps all",
                share * 100.0
            );
            (specks, Some(note))
        }
    }
}

/// The blobs of fewer cells than `limit` that do not touch the border.
fn small_blobs(walls: &Occupancy, limit: f64) -> Vec<Blob> {
    if limit <= 1.0 {
        return Vec::new();
    }
    let mut seen = vec![false; walls.blocked.len()];
    let mut small = Vec::new();
    for start in 0..walls.blocked.len() {
        if !walls.blocked[start] || seen[start] {
            continue;
        }
        let (blob, at_border) = blob(walls, start, &mut seen);
        if !at_border && (blob.len() as f64) < limit {
            small.push(blob);
        }
    }
    small
}

/// The wall cells connected to `start`, and whether one is at the image's border.
fn blob(walls: &Occupancy, start: usize, seen: &mut [bool]) -> (Blob, bool) {
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
        let mut freed = |speck_area| drop_specks(&mut walls, Some(speck_area)).0.to_string();
        assert_eq!(freed(0.5), "0", "two cells joined at a corner are exactly 0.5 m²");
        assert_eq!(freed(0.51), "0.5");
        assert_eq!(walls.blocked.iter().filter(|&&b| b).count(), 5, "the border keeps its blobs");
    }
}
