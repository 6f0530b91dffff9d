//! Distance from every cell to the nearest cell of a set, exact and in linear time: Meijster, Roerdink and
//! Hesselink, "A general algorithm for computing distance transforms in linear time" (2000).

use rayon::prelude::*;

/// For every cell, row by row, the squared gap between its closed square and that of the nearest cell of a set,
/// in cells: 0 for the cells of the set and for all that touch one. `u32::MAX` where the set is empty or further off.
///
/// # Arguments
/// `has` says of a column and a row whether the set has that cell.
pub(crate) fn squared_gaps(size: (usize, usize), has: impl Fn(usize, usize) -> bool) -> Vec<u32> {
    squared_gaps_by_rows(size, has, 1)
}

/// The same, for the cells of each so manieth row only, from the first one on; 0 in all others.
pub(crate) fn squared_gaps_by_rows(
    (columns, rows): (usize, usize),
    has: impl Fn(usize, usize) -> bool,
    every: usize,
) -> Vec<u32> {
    let mut set = Vec::with_capacity(columns * rows);
    for row in 0..rows {
        set.extend((0..columns).map(|column| has(column, row)));
    }
    if !set.contains(&true) {
        return vec![u32::MAX; columns * rows];
    }
    // Two squares k cells apart have a gap of k - 1. The distance of centres from a set in which every cell has
    // grown into its eight neighbours is just that.
    let vertical = vertical_distances((columns, rows), &set);
    let mut squared = vec![0; columns * rows];
    let lines = squared.par_chunks_mut(columns).zip(vertical.par_chunks(columns)).step_by(every);
    lines.for_each_init(Vec::new, |vertices, (line, vertical)| {
        // what is of the set hides whatever lies beyond it
        let mut from = 0;
        while from < columns {
            let zeros = vertical[from..].iter().take_while(|distance| **distance == 0).count();
            let between = vertical[from + zeros..].iter().take_while(|distance| **distance > 0).count();
            let first = (from + zeros).saturating_sub(1).max(from);
            let end = from + zeros + between;
            if between > 0 {
                let to = (end + 1).min(columns);
                lower_envelope(&vertical[first..to], &mut line[first..to], vertices);
            }
            from = end;
        }
    });
    squared
}

/// Distances along the column to the nearest cell of the grown set; more than any real one where there is none.
fn vertical_distances((columns, rows): (usize, usize), set: &[bool]) -> Vec<i32> {
    let far = (columns + rows) as i32;
    let mut distances = vec![far; columns * rows];
    let mut before = vec![far; columns];
    for (line, set) in distances.chunks_mut(columns).zip(set.chunks(columns)) {
        for (here, before) in line.iter_mut().zip(&before) {
            *here = (before + 1).min(far);
        }
        // grown along the row
        let mut free = 0;
        for part in set.chunk_by(|a, b| a == b) {
            let end = free + part.len();
            if part[0] {
                line[free.saturating_sub(1)..(end + 1).min(columns)].fill(0);
            }
            free = end;
        }
        before.copy_from_slice(line);
    }
    before.fill(far);
    for line in distances.chunks_mut(columns).rev() {
        for (here, above) in line.iter_mut().zip(&mut before) {
            let distance = (*above + 1).min(*here);
            *above = distance;
            // and here by one cell along the column
            *here = if distance < far { (distance - 1).max(0) } else { distance };
        }
    }
    distances
}

/// Squared distances along one row, given those along the columns: the lower envelope of parabolas.
fn lower_envelope(vertical: &[i32], squared: &mut [u32], vertices: &mut Vec<(usize, i64)>) {
    let value = |x: i64, i: usize| (x - i as i64).pow(2) + i64::from(vertical[i]).pow(2);
    vertices.clear();
    vertices.push((0, 0));
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
            let third = squared_gaps_by_rows((columns as usize, rows as usize), has, 3);
            let expected = gaps.iter().enumerate().map(|(cell, gap)| {
                if (cell / columns as usize).is_multiple_of(3) { *gap } else { 0 }
            });
            prop_assert_eq!(third, expected.collect::<Vec<_>>());
        }
    }
}
