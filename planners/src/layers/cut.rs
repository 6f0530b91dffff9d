//! A layer's cells cut into rooms as in the paper: the largest maximal rectangle of what is left, again and again.

use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashSet};

use super::cells::Cells;
use super::labels::Labels;
use super::maximal::maximal_blocks;
use crate::strips::Block;

/// The rooms in the order in which they are cut: largest first, equal ones by (x0, y0, x1, y1). They are disjoint
/// and cover the cells.
pub(super) fn cut(cells: &Cells) -> Vec<Block> {
    Cutter::new(cells).rooms()
}

/// As [`cut`], but so that the cells of a room all have the same label.
pub(super) fn cut_along(cells: &Cells, labels: Option<&Labels>) -> Vec<Block> {
    let Some(labels) = labels else { return cut(cells) };
    let (rest, parts) = labels.split(cells);
    let mut rooms = cut(&rest);
    for (within, part) in parts {
        let moved = |room: Block| Block {
            x0: room.x0 + within.x0,
            y0: room.y0 + within.y0,
            x1: room.x1 + within.x0,
            y1: room.y1 + within.y0,
        };
        rooms.extend(cut(&part).into_iter().map(moved));
    }
    rooms.sort_unstable_by_key(|room| (Reverse(room.area()), *room));
    rooms
}

/// Candidates are cut down only when they come up. At any time every free block lies inside of some candidate, so
/// the first candidate that is wholly free is the largest free block.
struct Cutter {
    free: Cells,
    rooms: Vec<Block>,
    /// For each cell the room that took it, by its index.
    owner: Vec<u32>,
    queue: BinaryHeap<(u64, Reverse<Block>)>,
    queued: HashSet<Block>,
}

impl Cutter {
    fn new(cells: &Cells) -> Self {
        let count = cells.columns() as usize * cells.rows() as usize;
        let (free, owner) = (cells.clone(), vec![u32::MAX; count]);
        let queue = maximal_blocks(cells).into_iter().map(|block| (block.area(), Reverse(block))).collect();
        Self { free, rooms: Vec::new(), owner, queue, queued: HashSet::new() }
    }

    fn rooms(mut self) -> Vec<Block> {
        while let Some((_, Reverse(block))) = self.queue.pop() {
            match self.free.first_missing(block) {
                None => self.take(block),
                Some(cell) => self.cut_down(block, cell),
            }
        }
        self.rooms
    }

    fn take(&mut self, block: Block) {
        let columns = self.free.columns() as usize;
        for row in block.y0..block.y1 {
            let start = row as usize * columns;
            self.owner[start + block.x0 as usize..start + block.x1 as usize].fill(self.rooms.len() as u32);
        }
        self.free.remove_block(block);
        self.rooms.push(block);
    }

    /// Replaces a candidate by its parts beside the room that took one of its cells.
    fn cut_down(&mut self, block: Block, (column, row): (u32, u32)) {
        let owner = self.owner[row as usize * self.free.columns() as usize + column as usize];
        let room = self.rooms[owner as usize];
        for part in block.around(room) {
            // A free part that could grow lies inside of another candidate.
            let is_covered = self.free.first_missing(part).is_none() && self.free.is_extensible(part);
            if !is_covered && self.queued.insert(part) {
                self.queue.push((part.area(), Reverse(part)));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn drawn(rows: &[Vec<bool>]) -> Cells {
        let mut cells = Cells::none(rows[0].len() as u32, rows.len() as u32);
        for (y, row) in (0..).zip(rows) {
            for (x, _) in (0..).zip(row).filter(|(_, free)| **free) {
                cells.insert_block(Block { x0: x, y0: y, x1: x + 1, y1: y + 1 });
            }
        }
        cells
    }

    fn all_free_blocks(cells: &Cells) -> Vec<Block> {
        let mut blocks = Vec::new();
        for (x0, y0) in (0..cells.columns()).flat_map(|x| (0..cells.rows()).map(move |y| (x, y))) {
            for (x1, y1) in
                (x0 + 1..=cells.columns()).flat_map(|x| (y0 + 1..=cells.rows()).map(move |y| (x, y)))
            {
                let block = Block { x0, y0, x1, y1 };
                if cells.first_missing(block).is_none() {
                    blocks.push(block);
                }
            }
        }
        blocks
    }

    fn drawings() -> impl Strategy<Value = Vec<Vec<bool>>> {
        (1usize..11, 1usize..11).prop_flat_map(|(columns, rows)| {
            let cell = prop::bool::weighted(0.75);
            prop::collection::vec(prop::collection::vec(cell, columns), rows)
        })
    }

    proptest! {
        #[test]
        fn maximal_blocks_are_exactly_those_that_cannot_grow(rows in drawings()) {
            let cells = drawn(&rows);
            let mut found = maximal_blocks(&cells);
            found.sort_unstable();
            let all = all_free_blocks(&cells);
            let maximal: Vec<_> = all.into_iter().filter(|block| !cells.is_extensible(*block)).collect();
            prop_assert_eq!(found, maximal);
        }

        #[test]
        fn each_room_is_the_largest_block_of_what_is_left(rows in drawings()) {
            let mut left = drawn(&rows);
            for room in cut(&left) {
                let largest = all_free_blocks(&left).into_iter().max_by_key(|b| (b.area(), Reverse(*b)));
                prop_assert_eq!(Some(room), largest);
                left.remove_block(room);
            }
            prop_assert_eq!(left.count(), 0);
        }
    }
}
