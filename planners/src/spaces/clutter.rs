//! Loose things on the floor: table legs, bins, specks of a scan. They part no rooms.

use super::runs::touching;
use crate::world::Occupancy;

/// First and last column and row.
#[derive(Clone, Copy)]
struct Extent {
    columns: (usize, usize),
    rows: (usize, usize),
}

/// Frees what is solid, stands alone and is at most so large across, metres, along both axes. What touches the border of
/// the image stays: what it is part of may lie outside.
pub(super) fn clear_away(floor: &mut Occupancy, across: f64) {
    let (runs, of_run) = touching(floor, true, true);
    let none = Extent { columns: (usize::MAX, 0), rows: (usize::MAX, 0) };
    let mut things = vec![none; of_run.iter().max().map_or(0, |most| most + 1)];
    for (run, &thing) in runs.iter().zip(&of_run) {
        let Extent { columns, rows } = &mut things[thing];
        *columns = (columns.0.min(run.first), columns.1.max(run.end - 1));
        *rows = (rows.0.min(run.row), rows.1.max(run.row));
    }
    let is_loose = |(low, high): (usize, usize), count: usize| {
        low > 0 && high + 1 < count && (high + 1 - low) as f64 * floor.resolution <= across
    };
    let is_loose: Vec<bool> = things
        .iter()
        .map(|thing| is_loose(thing.columns, floor.columns) && is_loose(thing.rows, floor.rows))
        .collect();
    for (run, thing) in runs.iter().zip(of_run) {
        if is_loose[thing] {
            let row = run.row * floor.columns;
            floor.blocked[row + run.first..row + run.end].fill(false);
        }
    }
}
