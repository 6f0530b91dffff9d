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
    /// How many groups there are by the first column, by the first two, and so on.
    counts: Vec<u32>,
    spans: Vec<Span>,
    rows: Vec<u32>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Span {
    start: u32,
    len: u32,
    room: u32,
}

impl Span {
    const fn rows(self) -> std::ops::Range<usize> {
        self.start as usize..(self.start + self.len) as usize
    }
}

impl Index {
    /// An index over so many columns for rows that come and go.
    pub(crate) fn empty(columns: usize) -> Self {
        let groups = (0..columns).map(|_| HashMap::default()).collect();
        Self { groups, counts: vec![0; columns], ..Self::default() }
    }

    pub(crate) fn new(columns: &[&Column], rows: &[u32]) -> Self {
        let mut index = Self::empty(columns.len());
        if let [column, ..] = columns {
            index.dense = dense(column, rows);
        }
        let mut members: Vec<(u32, u32)> = vec![];
        for &row in rows {
            let group = index.make(columns.iter().map(|column| column.cell(row as usize)));
            members.extend(group.map(|group| (group, row)));
        }
        index.spans = vec![Span::default(); index.counts.last().copied().unwrap_or(0) as usize];
        for &(group, _) in &members {
            index.spans[group as usize].room += 1;
        }
        let mut start = 0;
        for span in &mut index.spans {
            span.start = start;
            start += span.room;
        }
        index.rows = vec![0; members.len()];
        for (group, row) in members {
            let span = &mut index.spans[group as usize];
            index.rows[span.rows().end] = row;
            span.len += 1;
        }
        index
    }

    /// The group of these values, made where there is none; `None` where a value is unknown.
    fn make(&mut self, values: impl Iterator<Item = Cell>) -> Option<u32> {
        let mut group = 0;
        for (nth, cell) in values.enumerate() {
            // A join has one type, so values of two types never meet.
            let part = cell.bits()?;
            let next = self.counts[nth];
            group = match (&mut self.dense, nth) {
                (Some(dense), 0) => {
                    let place = whole(cell).and_then(|at| dense.get_mut(at))?;
                    if *place == NO_GROUP {
                        *place = next;
                    }
                    *place
                }
                _ => *self.groups[nth].entry((group, part)).or_insert(next),
            };
            self.counts[nth] += u32::from(group == next);
        }
        Some(group)
    }

    fn find(&self, mut values: impl Iterator<Item = Cell>) -> Option<u32> {
        let mut group = 0;
        let mut groups = self.groups.iter();
        if let Some(dense) = &self.dense {
            groups.next();
            let next = values.next().and_then(whole).and_then(|at| dense.get(at));
            group = *next.filter(|&&next| next != NO_GROUP)?;
        }
        for (map, value) in groups.zip(values) {
            group = *map.get(&(group, value.bits()?))?;
        }
        Some(group)
    }

    /// The rows whose columns hold these values; none where a value is unknown.
    pub(crate) fn rows(&self, values: impl Iterator<Item = Cell>) -> &[u32] {
        self.find(values).map_or(&[], |group| &self.rows[self.spans[group as usize].rows()])
    }

    /// Takes in a row with these values, in its place among the others of its group; `false` where one is unknown. Of
    /// an index that was [`empty`](Self::empty).
    pub(crate) fn insert(&mut self, row: u32, values: impl Iterator<Item = Cell>) -> bool {
        let Some(group) = self.make(values) else { return false };
        self.spans.resize(self.spans.len().max(group as usize + 1), Span::default());
        let span = &mut self.spans[group as usize];
        if span.len == span.room {
            let start = self.rows.len();
            self.rows.extend_from_within(span.rows());
            (span.start, span.room) = (start as u32, (2 * span.room).max(2));
            self.rows.resize(start + span.room as usize, 0);
        }
        let at = self.rows[span.rows()].partition_point(|&other| other < row);
        span.len += 1;
        let rows = &mut self.rows[span.rows()];
        rows.copy_within(at..rows.len() - 1, at + 1);
        rows[at] = row;
        true
    }

    pub(crate) fn remove(&mut self, row: u32, values: impl Iterator<Item = Cell>) {
        let Some(group) = self.find(values) else { return };
        let span = &mut self.spans[group as usize];
        let rows = &mut self.rows[span.rows()];
        if let Ok(at) = rows.binary_search(&row) {
            rows.copy_within(at + 1.., at);
            span.len -= 1;
        }
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
