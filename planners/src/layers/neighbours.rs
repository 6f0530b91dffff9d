//! Which rooms lie beside each other in a layer, and which of two layers over each other.

use crate::search::Csr;
use crate::strips::Block;

const NOBODY: u32 = u32::MAX;

/// The room of each cell of one layer.
pub(super) struct Owners {
    columns: usize,
    owners: Vec<u32>,
}

impl Owners {
    /// Draws the rooms of a layer, which are disjoint, by their index.
    pub(super) fn new(columns: u32, rows: u32, rooms: &[Block]) -> Self {
        let columns = columns as usize;
        let mut owners = vec![NOBODY; columns * rows as usize];
        for (index, room) in (0..).zip(rooms) {
            for row in room.y0..room.y1 {
                let start = row as usize * columns;
                owners[start + room.x0 as usize..start + room.x1 as usize].fill(index);
            }
        }
        Self { columns, owners }
    }

    /// The pairs (a < b) of rooms that share a boundary of at least a cell's side; ordered.
    pub(super) fn beside(&self) -> Vec<(u32, u32)> {
        let right = self.owners.chunks_exact(self.columns).flat_map(|row| row.iter().zip(&row[1..]));
        let above = self.owners.iter().zip(self.owners.get(self.columns..).unwrap_or(&[]));
        distinct(right.chain(above).filter(|(a, b)| a != b).map(|(&a, &b)| (a.min(b), a.max(b))))
    }

    /// The pairs (room of this layer, room of the other) that share a cell; ordered.
    pub(super) fn over(&self, other: &Self) -> Vec<(u32, u32)> {
        distinct(self.owners.iter().zip(&other.owners).map(|(&a, &b)| (a, b)))
    }
}

/// For each of so many rooms those beside it.
pub(super) fn by_room(rooms: usize, beside: &[(u32, u32)]) -> Csr<u32> {
    Csr::new(rooms, beside.iter().flat_map(|&(a, b)| [(a as usize, b), (b as usize, a)]))
}

fn distinct(pairs: impl Iterator<Item = (u32, u32)>) -> Vec<(u32, u32)> {
    let mut last = (NOBODY, NOBODY);
    let is_new = |pair: &(u32, u32)| {
        let is_new = *pair != last;
        last = *pair;
        is_new
    };
    let mut pairs: Vec<_> = pairs.filter(|&(a, b)| a != NOBODY && b != NOBODY).filter(is_new).collect();
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}
