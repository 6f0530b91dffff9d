//! Boxes of the picture, to be asked whether one is free of them.

use std::collections::BTreeMap;

use super::frame::Block;

/// Side of a bucket of the grid.
const BUCKET: f64 = 48.0;
/// A box over more buckets than this is kept apart: walls can be as long as the map.
const MOST_BUCKETS: i64 = 256;

#[derive(Debug, Default)]
pub(super) struct Index {
    boxes: Vec<Block>,
    large: Vec<Block>,
    buckets: BTreeMap<(i64, i64), Vec<usize>>,
}

impl Index {
    pub fn add(&mut self, block: Block) {
        let (columns, rows) = (span(block.x, block.w), span(block.y, block.h));
        if (columns.1 - columns.0 + 1).saturating_mul(rows.1 - rows.0 + 1) > MOST_BUCKETS {
            self.large.push(block);
            return;
        }
        for cell in cells(columns, rows) {
            self.buckets.entry(cell).or_default().push(self.boxes.len());
        }
        self.boxes.push(block);
    }

    /// Whether no box of it overlaps this one, which should not be larger than a label.
    pub fn is_free(&self, block: &Block) -> bool {
        let near = cells(span(block.x, block.w), span(block.y, block.h));
        !self.large.iter().any(|other| other.overlaps(block))
            && near
                .filter_map(|cell| self.buckets.get(&cell))
                .flatten()
                .all(|&i| !self.boxes[i].overlaps(block))
    }
}

/// First and last bucket along one axis.
fn span(from: f64, length: f64) -> (i64, i64) {
    let bucket = |v: f64| (v / BUCKET).floor().clamp(-1e6, 1e6) as i64;
    (bucket(from), bucket(from + length))
}

fn cells(columns: (i64, i64), rows: (i64, i64)) -> impl Iterator<Item = (i64, i64)> {
    (columns.0..=columns.1).flat_map(move |column| (rows.0..=rows.1).map(move |row| (column, row)))
}
