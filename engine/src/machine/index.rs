//! A hash index over columns, for joins on equality.

use std::collections::HashMap;

use crate::column::Column;
use crate::value::Cell;

/// Rows by the values of some columns. Rows of one group keep the order in which they came.
#[derive(Clone, Debug, Default)]
pub(crate) struct Index {
    /// One map for each column: group so far and value to group. Only looked up, never walked.
    groups: Vec<HashMap<(u32, u64), u32>>,
    starts: Vec<u32>,
    rows: Vec<u32>,
}

impl Index {
    pub(crate) fn new(columns: &[&Column], rows: &[u32]) -> Self {
        let mut index = Self { groups: columns.iter().map(|_| HashMap::new()).collect(), ..Self::default() };
        let mut counts = vec![0_u32; columns.len()];
        let mut members: Vec<(u32, u32)> = vec![];
        'rows: for &row in rows {
            let mut group = 0;
            for (nth, column) in columns.iter().enumerate() {
                let Some(part) = bits(column.cell(row as usize)) else { continue 'rows };
                let next = counts[nth];
                group = *index.groups[nth].entry((group, part)).or_insert(next);
                counts[nth] += u32::from(group == next);
            }
            members.push((group, row));
        }
        let groups = counts.last().copied().unwrap_or(0) as usize;
        index.starts = vec![0; groups + 1];
        for &(group, _) in &members {
            index.starts[group as usize + 1] += 1;
        }
        for group in 0..groups {
            index.starts[group + 1] += index.starts[group];
        }
        let mut next = index.starts.clone();
        index.rows = vec![0; members.len()];
        for (group, row) in members {
            let at = &mut next[group as usize];
            index.rows[*at as usize] = row;
            *at += 1;
        }
        index
    }

    /// The rows whose columns hold these values; none where a value is unknown.
    pub(crate) fn rows(&self, values: impl Iterator<Item = Cell>) -> &[u32] {
        let mut group = 0;
        for (map, value) in self.groups.iter().zip(values) {
            match bits(value).and_then(|part| map.get(&(group, part))) {
                Some(&next) => group = next,
                None => return &[],
            }
        }
        let (start, end) = (self.starts[group as usize], self.starts[group as usize + 1]);
        &self.rows[start as usize..end as usize]
    }
}

/// A value as bits; values of different types never meet, since a join has one type.
pub(crate) fn bits(cell: Cell) -> Option<u64> {
    match cell {
        Cell::Unknown => None,
        // Minus zero equals zero.
        Cell::Number(number) => Some((number + 0.0).to_bits()),
        Cell::Text(symbol) => Some(u64::from(symbol.id())),
        Cell::Truth(truth) => Some(u64::from(truth)),
    }
}
