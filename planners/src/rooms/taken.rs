//! The rooms taken so far, found by where they are.

use crate::strips::Block;

/// Disjoint blocks in buckets of neighbouring strips.
pub(super) struct Taken {
    shift: (u32, u32),
    buckets_across: usize,
    /// For each bucket its last entry.
    last: Vec<u32>,
    entries: Vec<Entry>,
}

struct Entry {
    block: Block,
    /// The entry before this one in the same bucket.
    before: u32,
}

/// How many entries had been made at some time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Default)]
pub(super) struct Seen(u32);

/// Entries are numbered from 1.
const NONE: u32 = 0;

impl Taken {
    /// Room for about `expected` blocks among so many strips.
    pub(super) fn new(columns: u32, rows: u32, expected: usize) -> Self {
        let side = ((expected as f64 * 4.0).sqrt() as u32).clamp(1, 1024);
        let shift = (shift_to(columns, side), shift_to(rows, side));
        let buckets_across = (columns >> shift.0) as usize + 1;
        let buckets_up = (rows >> shift.1) as usize + 1;
        Self { shift, buckets_across, last: vec![NONE; buckets_across * buckets_up], entries: Vec::new() }
    }

    pub(super) fn take(&mut self, block: Block) {
        let (x, y) = (self.columns_of(&block), self.rows_of(&block));
        for row in y.0..=y.1 {
            for column in x.0..=x.1 {
                let last = &mut self.last[row * self.buckets_across + column];
                self.entries.push(Entry { block, before: *last });
                *last = self.entries.len() as u32;
            }
        }
    }

    /// All blocks taken so far are seen.
    pub(super) fn seen(&self) -> Seen {
        Seen(self.entries.len() as u32)
    }

    /// Puts the taken blocks not yet seen that overlap `block` into `found`, each once; where one encloses it, maybe
    /// only that one.
    pub(super) fn overlapping(&self, block: Block, seen: Seen, found: &mut Vec<Block>) {
        found.clear();
        let (x, y) = (self.columns_of(&block), self.rows_of(&block));
        for row in y.0..=y.1 {
            for column in x.0..=x.1 {
                let mut at = self.last[row * self.buckets_across + column];
                while at > seen.0 {
                    let Entry { block: other, before } = &self.entries[at as usize - 1];
                    // Of the buckets that the two share, only the first one counts.
                    if other.overlaps(&block)
                        && (column == x.0 || column == (other.x0 >> self.shift.0) as usize)
                        && (row == y.0 || row == (other.y0 >> self.shift.1) as usize)
                    {
                        found.push(*other);
                        if other.encloses(&block) {
                            return;
                        }
                    }
                    at = *before;
                }
            }
        }
    }

    fn columns_of(&self, block: &Block) -> (usize, usize) {
        ((block.x0 >> self.shift.0) as usize, ((block.x1 - 1) >> self.shift.0) as usize)
    }

    fn rows_of(&self, block: &Block) -> (usize, usize) {
        ((block.y0 >> self.shift.1) as usize, ((block.y1 - 1) >> self.shift.1) as usize)
    }
}

fn shift_to(strips: u32, side: u32) -> u32 {
    (0..32).find(|shift| strips >> shift <= side).unwrap_or(0)
}
