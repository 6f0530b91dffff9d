//! Blocks of a set of cells that no column more on a side, and no row more below, leaves in the set.

use super::cells::Cells;
use crate::strips::Block;

/// All maximal blocks: those that no row more above leaves in the set either; each once, by their upper row. There are
/// never more than cells.
pub(super) fn maximal_blocks(cells: &Cells) -> Vec<Block> {
    let mut blocks = Vec::new();
    let all = Block { x0: 0, y0: 0, x1: cells.columns(), y1: cells.rows() };
    hanging_blocks(cells, all, |block| {
        let above = Block { y0: block.y1, y1: block.y1 + 1, ..block };
        if block.y1 == cells.rows() || cells.first_missing(above).is_some() {
            blocks.push(block);
        }
    });
    blocks
}

/// The largest block of the set within `block`, the first of equal ones from below; `None` where there is no cell.
pub(super) fn largest_within(cells: &Cells, block: Block) -> Option<Block> {
    if cells.first_missing(block).is_none() {
        return Some(block);
    }
    let mut largest: Option<Block> = None;
    hanging_blocks(cells, block, |found| {
        if largest.is_none_or(|known| known.area() < found.area()) {
            largest = Some(found);
        }
    });
    largest
}

/// For each row the largest blocks that hang from it, within a block.
///
/// The rows are swept upwards with the histogram of free cells below each; a block ends where the histogram falls.
fn hanging_blocks(cells: &Cells, within: Block, mut found: impl FnMut(Block)) {
    let mut heights = vec![0_u32; (within.x1 - within.x0) as usize];
    for row in within.y0..within.y1 {
        for (column, height) in (within.x0..).zip(&mut heights) {
            *height = if cells.contains(column, row) { *height + 1 } else { 0 };
        }
        let mut open: Vec<(u32, u32)> = Vec::new();
        for column in within.x0..=within.x1 {
            let height = heights.get((column - within.x0) as usize).copied().unwrap_or(0);
            let mut start = column;
            while let Some((from, tall)) = open.pop_if(|(_, tall)| *tall > height) {
                start = from;
                found(Block { x0: from, y0: row + 1 - tall, x1: column, y1: row + 1 });
            }
            if height > 0 && open.last().is_none_or(|(_, tall)| *tall < height) {
                open.push((start, height));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_block_lies_in_the_set() {
        let mut cells = Cells::none(20, 20);
        cells.insert_block(Block { x0: 2, y0: 2, x1: 6, y1: 9 });
        cells.insert_block(Block { x0: 8, y0: 2, x1: 17, y1: 6 });
        let all = Block { x0: 0, y0: 0, x1: 20, y1: 20 };
        assert_eq!(largest_within(&cells, all), Some(Block { x0: 8, y0: 2, x1: 17, y1: 6 }));
        let part = Block { x0: 0, y0: 0, x1: 12, y1: 20 };
        assert_eq!(largest_within(&cells, part), Some(Block { x0: 2, y0: 2, x1: 6, y1: 9 }));
        assert_eq!(largest_within(&cells, Block { x0: 0, y0: 10, x1: 20, y1: 12 }), None);
    }
}
