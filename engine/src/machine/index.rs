//! A hash index over columns, for joins on equality.

use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};

use crate::column::Column;
use crate::value::Cell;

/// Rows by the values of some columns. Rows of one group keep the order in which they came.
#[derive(Clone, Debug, Default)]
pub(crate) struct Index {
    /// Group by the value in the first column, where those are whole numbers without wide gaps: then without `groups`.
    dense: Option<Vec<u32>>,
    /// One map for each column: group so far and value to group. Only looked up, never walked.
    groups: Vec<HashMap<(u32, u64), u32, BuildHasherDefault<Folded>>>,
    starts: Vec<u32>,
    rows: Vec<u32>,
}

impl Index {
    pub(crate) fn new(columns: &[&Column], rows: &[u32]) -> Self {
        let mut index =
            Self { groups: columns.iter().map(|_| HashMap::default()).collect(), ..Self::default() };
        if let [column, ..] = columns {
            index.dense = dense(column, rows);
        }
        let mut counts = vec![0_u32; columns.len()];
        let mut members: Vec<(u32, u32)> = vec![];
        'rows: for &row in rows {
            let mut group = 0;
            for (nth, column) in columns.iter().enumerate() {
                let Some(part) = bits(column.cell(row as usize)) else { continue 'rows };
                let next = counts[nth];
                group = match (&mut index.dense, nth) {
                    (Some(dense), 0) => {
                        let Some(place) = whole(column.cell(row as usize)).and_then(|at| dense.get_mut(at))
                        else {
                            continue 'rows;
                        };
                        if *place == NO_GROUP {
                            *place = next;
                        }
                        *place
                    }
                    _ => *index.groups[nth].entry((group, part)).or_insert(next),
                };
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
        let mut values = values;
        let mut groups = self.groups.iter();
        if let Some(dense) = &self.dense {
            groups.next();
            match values.next().and_then(whole).and_then(|at| dense.get(at)) {
                Some(&next) if next != NO_GROUP => group = next,
                _ => return &[],
            }
        }
        for (map, value) in groups.zip(values) {
            match bits(value).and_then(|part| map.get(&(group, part))) {
                Some(&next) => group = next,
                None => return &[],
            }
        }
        let (start, end) = (self.starts[group as usize], self.starts[group as usize + 1]);
        &self.rows[start as usize..end as usize]
    }
}

/// Of a value that no row has.
const NO_GROUP: u32 = u32::MAX;

/// Room for a group for each whole number up to the greatest in a column, where that is not much more than its rows.
fn dense(column: &Column, rows: &[u32]) -> Option<Vec<u32>> {
    let mut greatest = 0;
    for &row in rows {
        let cell = column.cell(row as usize);
        if cell != Cell::Unknown {
            greatest = greatest.max(whole(cell)?);
        }
    }
    (greatest < 8 * rows.len() + 64).then(|| vec![NO_GROUP; greatest + 1])
}

/// A value as a whole number, where it is one.
fn whole(cell: Cell) -> Option<usize> {
    match cell {
        Cell::Number(number) => {
            let cut = number as u32;
            (f64::from(cut).to_bits() == (number + 0.0).to_bits()).then_some(cut as usize)
        }
        Cell::Text(symbol) => Some(symbol.id() as usize),
        Cell::Unknown | Cell::Truth(_) => None,
    }
}

/// Hashes a few whole numbers by multiplying them into 128 bits and folding those: the default hash is made for
/// texts of strangers and takes longer than all else in a join.
#[derive(Clone, Copy, Debug, Default)]
struct Folded(u64);

impl Hasher for Folded {
    fn finish(&self) -> u64 {
        self.0
    }

    fn write(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.write_u64(u64::from(byte));
        }
    }

    fn write_u32(&mut self, number: u32) {
        self.write_u64(u64::from(number));
    }

    fn write_u64(&mut self, number: u64) {
        const ODD: u128 = 0x9e37_79b9_7f4a_7c15;
        let product = u128::from(self.0 ^ number ^ 0x2545_f491_4f6c_dd1d) * ODD;
        self.0 = (product as u64) ^ ((product >> 64) as u64);
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
