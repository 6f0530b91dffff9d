//! All maximal blocks of a set of cells: those that no column or row more, on any side, leaves in the set.

use super::cells::Cells;
use crate::strips::Block;

/// The maximal blocks, each once, by their upper row. There are never more than cells.
///
/// The rows are swept upwards with the histogram of free cells below each; a block ends where the histogram falls.
pub(super) fn maximal_blocks(cells: &Cells) -> Vec<Block> {
    let (columns, rows) = (cells.columns(), cells.rows());
    let mut heights = vec![0u32; columns as usize];
    let mut blocks = Vec::new();
    for row in 0..rows {
        for (column, height) in (0..).zip(heights.iter_mut()) {
            *height = if cells.contains(column, row) { *height + 1 } else { 0 };
        }
        let mut open: Vec<(u32, u32)> = Vec::new();
        for column in 0..=columns {
            let height = heights.get(column as usize).copied().unwrap_or(0);
            let mut start = column;
            while let Some((from, tall)) = open.pop_if(|(_, tall)| *tall > height) {
                start = from;
                let block = Block { x0: from, y0: row + 1 - tall, x1: column, y1: row + 1 };
                if is_blocked_above(cells, block) {
                    blocks.push(block);
                }
            }
            if height > 0 && open.last().is_none_or(|(_, tall)| *tall < height) {
                open.push((start, height));
            }
        }
    }
    blocks
}

fn is_blocked_above(cells: &Cells, block: Block) -> bool {
    let above = Block { y0: block.y1, y1: block.y1 + 1, ..block };
    block.y1 == cells.rows() || cells.first_missing(above).is_some()
}
