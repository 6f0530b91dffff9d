//! Sets of lattice cells, a bit a cell, and blocks of cells.

use crate::strips::Block;

/// A set of the cells of a lattice.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Cells {
    columns: u32,
    rows: u32,
    words_a_row: usize,
    words: Vec<u64>,
}

impl Cells {
    pub(super) fn none(columns: u32, rows: u32) -> Self {
        let words_a_row = (columns as usize).div_ceil(64);
        Self { columns, rows, words_a_row, words: vec![0; words_a_row * rows as usize] }
    }

    pub(super) fn columns(&self) -> u32 {
        self.columns
    }

    pub(super) fn rows(&self) -> u32 {
        self.rows
    }

    pub(super) fn contains(&self, column: u32, row: u32) -> bool {
        self.words[self.word(column, row)] >> (column % 64) & 1 == 1
    }

    pub(super) fn remove(&mut self, column: u32, row: u32) {
        let word = self.word(column, row);
        self.words[word] &= !(1 << (column % 64));
    }

    pub(super) fn insert_block(&mut self, block: Block) {
        for row in block.y0..block.y1 {
            for (word, mask) in self.masks(row, block.x0, block.x1) {
                self.words[word] |= mask;
            }
        }
    }

    pub(super) fn remove_block(&mut self, block: Block) {
        for row in block.y0..block.y1 {
            for (word, mask) in self.masks(row, block.x0, block.x1) {
                self.words[word] &= !mask;
            }
        }
    }

    /// The first cell of the block, by row and then column, that is not in the set.
    pub(super) fn first_missing(&self, block: Block) -> Option<(u32, u32)> {
        (block.y0..block.y1).find_map(|row| {
            let missing = |(word, mask): (usize, u64)| {
                let gap = !self.words[word] & mask;
                let column = (word - row as usize * self.words_a_row) as u32 * 64 + gap.trailing_zeros();
                (gap != 0).then_some((column, row))
            };
            self.masks(row, block.x0, block.x1).find_map(missing)
        })
    }

    /// Whether the block with a column or row more, on any side, is still in the set (given that the block is).
    pub(super) fn is_extensible(&self, block: Block) -> bool {
        let Block { x0, y0, x1, y1 } = block;
        let has = |x0, y0, x1, y1| self.first_missing(Block { x0, y0, x1, y1 }).is_none();
        x0 > 0 && has(x0 - 1, y0, x0, y1)
            || x1 < self.columns && has(x1, y0, x1 + 1, y1)
            || y0 > 0 && has(x0, y0 - 1, x1, y0)
            || y1 < self.rows && has(x0, y1, x1, y1 + 1)
    }

    /// The cells of this set, and those of `other` that touch one, over a side or a corner.
    pub(super) fn grown_within(&self, other: &Self) -> Self {
        let mut grown = self.clone();
        for row in 0..self.rows {
            for column in 0..self.columns {
                let beside = Block {
                    x0: column.saturating_sub(1),
                    y0: row.saturating_sub(1),
                    x1: (column + 2).min(self.columns),
                    y1: (row + 2).min(self.rows),
                };
                if other.contains(column, row) && self.meets(beside) {
                    grown.insert_block(Block { x0: column, y0: row, x1: column + 1, y1: row + 1 });
                }
            }
        }
        grown
    }

    /// Whether a cell of the block is in the set.
    fn meets(&self, block: Block) -> bool {
        (block.y0..block.y1)
            .any(|row| self.masks(row, block.x0, block.x1).any(|(word, mask)| self.words[word] & mask != 0))
    }

    pub(crate) fn count(&self) -> usize {
        self.words.iter().map(|word| word.count_ones() as usize).sum()
    }

    fn word(&self, column: u32, row: u32) -> usize {
        row as usize * self.words_a_row + (column / 64) as usize
    }

    /// The words of a row that hold the columns `x0..x1`, each with the mask of those columns.
    fn masks(&self, row: u32, x0: u32, x1: u32) -> impl Iterator<Item = (usize, u64)> + use<> {
        let start = row as usize * self.words_a_row;
        let (first, last) = (x0 / 64, if x1 > x0 { (x1 - 1) / 64 + 1 } else { x0 / 64 });
        (first..last).map(move |word| {
            let low = if word == first { u64::MAX << (x0 % 64) } else { u64::MAX };
            let high = if word + 1 == last { u64::MAX >> (63 - (x1 - 1) % 64) } else { u64::MAX };
            (start + word as usize, low & high)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_across_words_are_found_cell_by_cell() {
        let block = Block { x0: 3, y0: 1, x1: 131, y1: 4 };
        let mut cells = Cells::none(200, 5);
        cells.insert_block(block);
        assert_eq!(cells.count() as u64, block.area());
        assert_eq!(cells.first_missing(block), None);
        assert!(!cells.is_extensible(block));
        cells.remove(128, 2);
        assert_eq!(cells.first_missing(block), Some((128, 2)));
        assert!(cells.contains(127, 2) && !cells.contains(128, 2) && !cells.contains(131, 1));
        assert!(cells.is_extensible(Block { x0: 3, y0: 1, x1: 130, y1: 2 }));
        cells.remove_block(block);
        assert_eq!(cells.count(), 0);
    }
}
