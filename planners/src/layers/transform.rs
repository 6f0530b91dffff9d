//! Distance from every cell to the nearest cell of a set, exact and in linear time: Meijster, Roerdink and
//! Hesselink, "A general algorithm for computing distance transforms in linear time" (2000).

use rayon::prelude::*;

/// For every cell, row by row, the squared gap between its closed square and that of the nearest cell of a set,
/// in cells: 0 for the cells of the set and for all that touch one. `u32::MAX` where the set is empty or further off.
///
/// # Arguments
/// `has` says of a column and a row whether the set has that cell.
pub(crate) fn squared_gaps((columns, rows): (usize, usize), has: impl Fn(usize, usize) -> bool) -> Vec<u32> {
    let set: Vec<bool> = (0..rows)
        .flat_map(|row| (0..columns).map(move |column| (column, row)))
        .map(|(x, y)| has(x, y))
        .collect();
    if !set.contains(&true) {
        return vec![u32::MAX; columns * rows];
    }
    // Two squares k cells apart have a gap of k - 1. The distance of centres from a set in which every cell has
    // grown into its eight neighbours is just that.
    let vertical = vertical_distances((columns, rows), &set);
    let mut squared = vec![0; columns * rows];
    let lines = squared.par_chunks_mut(columns).zip(vertical.par_chunks(columns));
    lines.for_each(|(line, vertical)| lower_envelope(vertical, line));
    squared
}

/// Distances along the column to the nearest cell of the grown set; more than any real one where there is none.
fn vertical_distances((columns, rows): (usize, usize), set: &[bool]) -> Vec<i32> {
    let far = (columns + rows) as i32;
    let mut distances = vec![far; columns * rows];
    for (row, line) in set.chunks(columns).enumerate() {
        for column in 0..columns {
            let beside = &line[column.saturating_sub(1)..(column + 2).min(columns)];
            let below = if row > 0 { distances[(row - 1) * columns + column] + 1 } else { far };
            distances[row * columns + column] = if beside.contains(&true) { 0 } else { below.min(far) };
        }
    }
    for row in (0..rows.saturating_sub(1)).rev() {
        for column in 0..columns {
            let above = distances[(row + 1) * columns + column] + 1;
            let here = &mut distances[row * columns + column];
            *here = above.min(*here);
        }
    }
    // grown along the row so far, and by one cell along the column here
    for distance in distances.iter_mut().filter(|distance| **distance < far) {
        *distance = (*distance - 1).max(0);
    }
    distances
}

/// Squared distances along one row, given those along the columns: the lower envelope of parabolas.
fn lower_envelope(vertical: &[i32], squared: &mut [u32]) {
    let value = |x: i64, i: usize| (x - i as i64).pow(2) + i64::from(vertical[i]).pow(2);
    let mut vertices: Vec<(usize, i64)> = vec![(0, 0)];
    for u in 1..vertical.len() {
        while vertices.last().is_some_and(|&(i, from)| value(from, i) > value(from, u)) {
            vertices.pop();
        }
        let Some(&(i, _)) = vertices.last() else {
            vertices.push((u, 0));
            continue;
        };
        let (first, second) = (i as i64, u as i64);
        let apart = value(second, u) - value(first, i) + second.pow(2) - first.pow(2);
        let from = 1 + apart.div_euclid(2 * (second - first));
        if from < vertical.len() as i64 {
            vertices.push((u, from));
        }
    }
    for x in (0..vertical.len()).rev() {
        while vertices.len() > 1 && vertices.last().is_some_and(|&(_, from)| from > x as i64) {
            vertices.pop();
        }
        if let Some(&(i, _)) = vertices.last() {
            squared[x] = u32::try_from(value(x as i64, i)).unwrap_or(u32::MAX);
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn gaps_equal_those_to_every_cell(
            columns in 1u32..40, rows in 1u32..40, walls in prop::collection::vec((0u32..40, 0u32..40), 1..12)
        ) {
            let walls: Vec<_> = walls.into_iter().map(|(x, y)| (x % columns, y % rows)).collect();
            let has = |column: usize, row: usize| walls.contains(&(column as u32, row as u32));
            let gaps = squared_gaps((columns as usize, rows as usize), has);
            let apart = |a: u32, b: u32| a.abs_diff(b).saturating_sub(1).pow(2);
            for (i, &gap) in gaps.iter().enumerate() {
                let (x, y) = (i as u32 % columns, i as u32 / columns);
                let naive = walls.iter().map(|&(a, b)| apart(x, a) + apart(y, b)).min();
                prop_assert_eq!(Some(gap), naive);
            }
        }
    }
}
