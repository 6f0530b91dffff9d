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

    pub(crate) fn contains(&self, column: u32, row: u32) -> bool {
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
        let all = (0..cells.rows()).flat_map(|row| (0..cells.columns()).map(move |column| (column, row)));
        assert_eq!(all.filter(|&(column, row)| cells.contains(column, row)).count(), 128 * 3);
        cells.remove(128, 2);
        assert!(cells.contains(127, 2) && !cells.contains(128, 2) && !cells.contains(131, 1));
    }
}
