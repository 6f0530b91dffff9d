//! Loose things on the floor: table legs, bins, specks of a scan. They part no rooms.

use crate::search::grid::around;
use crate::world::Occupancy;

/// Frees what is solid, stands alone and is at most so large across, metres, along both axes. What touches the border of
/// the image stays: what it is part of may lie outside.
pub(super) fn clear_away(floor: &mut Occupancy, across: f64) {
    let size = (floor.columns, floor.rows);
    let mut seen = vec![false; floor.blocked.len()];
    for start in 0..floor.blocked.len() {
        if !floor.blocked[start] || seen[start] {
            continue;
        }
        seen[start] = true;
        let mut thing = vec![start];
        let mut next = 0;
        while let Some(&cell) = thing.get(next) {
            next += 1;
            for (beside, _) in around(cell, size) {
                if floor.blocked[beside] && !seen[beside] {
                    seen[beside] = true;
                    thing.push(beside);
                }
            }
        }
        let columns = extent(thing.iter().map(|cell| cell % size.0));
        let rows = extent(thing.iter().map(|cell| cell / size.0));
        let touches = |(low, high): (usize, usize), count: usize| low == 0 || high + 1 == count;
        let is_wide = |(low, high): (usize, usize)| (high + 1 - low) as f64 * floor.resolution > across;
        if !touches(columns, size.0) && !touches(rows, size.1) && !is_wide(columns) && !is_wide(rows) {
            for cell in thing {
                floor.blocked[cell] = false;
            }
        }
    }
}

fn extent(values: impl Iterator<Item = usize>) -> (usize, usize) {
    values.fold((usize::MAX, 0), |(low, high), value| (low.min(value), high.max(value)))
}
