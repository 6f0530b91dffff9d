//! Which inputs rows match together, and which none matches.

use std::cell::Cell;

use super::bits::Bits;
use super::region::{Region, regions};
use super::{Row, Table};

/// Regions that are looked at before the search gives up.
pub(crate) const MAX_REGIONS: usize = 100_000;

/// Words of sets that all searches in a table may go through: some tenths of a second.
const MAX_WORK: usize = 200_000_000;

/// For each input the regions that are in.
type Cut = Vec<Bits>;

pub(crate) struct Space {
    regions: Vec<Vec<Region>>,
    rows: Vec<Cut>,
    work: Cell<usize>,
}

/// What is left of some inputs when those of rows are taken away.
pub(crate) enum Left {
    Nothing,
    /// One text for each input, as `is below 3`; empty where every value will do.
    Example(Vec<String>),
    GaveUp,
}

impl Space {
    pub(crate) fn new(table: &Table) -> Self {
        let columns = table.given.len();
        let regions: Vec<Vec<Region>> =
            (0..columns).map(|column| regions(table.rows.iter().map(|row| &row.tests[column].0))).collect();
        let cut = |row: &Row| -> Cut {
            regions
                .iter()
                .zip(&row.tests)
                .map(|(regions, (test, _))| Bits::new(regions.len(), |at| regions[at].passes(test)))
                .collect()
        };
        let rows = table.rows.iter().map(cut).collect();
        Self { regions, rows, work: Cell::new(0) }
    }

    pub(crate) fn is_empty(&self, row: usize) -> bool {
        self.rows[row].iter().any(Bits::is_empty)
    }

    pub(crate) fn may_go_on(&self) -> bool {
        self.work.get() < MAX_WORK
    }

    pub(crate) fn both(&self, a: usize, b: usize) -> Option<Vec<String>> {
        if !self.meet(&self.rows[a], b) {
            return None;
        }
        let meet: Cut = self.rows[a].iter().zip(&self.rows[b]).map(|(a, b)| a.and(b)).collect();
        Some(self.example(&meet))
    }

    /// What is left of a row's inputs where others come before it.
    pub(crate) fn left_of(&self, row: usize, before: &[usize]) -> Left {
        self.left(self.rows[row].clone(), before)
    }

    pub(crate) fn gap(&self) -> Left {
        let all = self.regions.iter().map(|regions| Bits::new(regions.len(), |_| true)).collect();
        let rows: Vec<usize> = (0..self.rows.len()).collect();
        self.left(all, &rows)
    }

    fn meet(&self, part: &Cut, row: usize) -> bool {
        self.work.set(self.work.get() + part.iter().map(Bits::words).sum::<usize>());
        part.iter().zip(&self.rows[row]).all(|(a, b)| a.meets(b))
    }

    /// Takes row after row away; the parts still open wait with the row that is next for them.
    fn left(&self, all: Cut, rows: &[usize]) -> Left {
        let mut open: Vec<(Cut, usize)> = vec![(all, 0)];
        let mut looked_at = 0;
        while let Some((part, next)) = open.pop() {
            looked_at += 1;
            if looked_at > MAX_REGIONS || !self.may_go_on() {
                return Left::GaveUp;
            }
            match (next..rows.len()).find(|&at| self.meet(&part, rows[at])) {
                None => return Left::Example(self.example(&part)),
                Some(at) => {
                    let pieces = without(part, &self.rows[rows[at]]);
                    open.extend(pieces.into_iter().map(|piece| (piece, at + 1)));
                }
            }
        }
        Left::Nothing
    }

    fn example(&self, cut: &Cut) -> Vec<String> {
        let reads = |(regions, inside): (&Vec<Region>, &Bits)| match inside.first() {
            Some(first) if inside.count() < regions.len() => regions[first].reads.clone(),
            _ => String::new(),
        };
        self.regions.iter().zip(cut).map(reads).collect()
    }
}

/// The parts of a box outside of a row, none of which overlap.
fn without(mut part: Cut, row: &Cut) -> Vec<Cut> {
    let mut pieces = vec![];
    for (column, cell) in row.iter().enumerate() {
        let outside = part[column].without(cell);
        if !outside.is_empty() {
            let mut piece = part.clone();
            piece[column] = outside;
            pieces.push(piece);
        }
        part[column] = part[column].and(cell);
    }
    pieces
}
