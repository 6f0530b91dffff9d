//! Areas in the order in which the paper chooses among them.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use crate::strips::{Block, Strips};

use super::order::area_key;
use super::taken::Seen;

/// An area in the order of choice. Among equal areas that start at the same corner, the higher comes first: as
/// areas are equal it is the narrower. So written, the order also puts an area before those inside it
/// when rounding makes them equal.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Candidate {
    area_key: u64,
    x0: Reverse<u32>,
    y0: Reverse<u32>,
    y1: u32,
    x1: u32,
    /// How far the taken rooms are known not to overlap it.
    pub(super) seen: Seen,
}

impl Candidate {
    pub(super) fn new(strips: &Strips, block: Block, seen: Seen) -> Self {
        let Block { x0, y0, x1, y1 } = block;
        Self { area_key: area_key(strips.rect(block).area()), x0: Reverse(x0), y0: Reverse(y0), y1, x1, seen }
    }

    pub(super) fn block(&self) -> Block {
        Block { x0: self.x0.0, y0: self.y0.0, x1: self.x1, y1: self.y1 }
    }
}

/// A queue for areas of which each that comes in is smaller than the last that went out. They wait unsorted in
/// classes of size; a class is sorted when its turn comes.
#[derive(Default)]
pub(super) struct LargestFirst {
    /// The areas of each class, from the largest class down.
    classes: Vec<Vec<Candidate>>,
    /// Class of the largest area, counted from zero area up.
    highest: u64,
    /// The class whose turn it is.
    current: usize,
    /// Its areas, the largest last.
    sorted: Vec<Candidate>,
    /// Those that came in after it was sorted.
    late: BinaryHeap<Candidate>,
}

/// Bits of an area's key within a class: there are 64 classes to a doubling of the area.
const CLASS_BITS: u32 = 34;

/// Areas in the last class may be of any small size.
const CLASSES: usize = 4096;

impl LargestFirst {
    /// Fills the queue, which must be empty.
    pub(super) fn fill(&mut self, areas: Vec<Candidate>) {
        let keys = areas.iter().map(|area| area.area_key >> CLASS_BITS);
        self.highest = keys.max().unwrap_or_default();
        self.classes.resize_with(CLASSES, Vec::new);
        self.current = 0;
        for area in areas {
            let class = self.class_of(&area);
            self.classes[class].push(area);
        }
        self.sort_current();
    }

    pub(super) fn push(&mut self, area: Candidate) {
        let class = self.class_of(&area);
        if class > self.current {
            self.classes[class].push(area);
        } else {
            self.late.push(area);
        }
    }

    pub(super) fn pop(&mut self) -> Option<Candidate> {
        while self.sorted.is_empty() && self.late.is_empty() {
            if self.current + 1 >= self.classes.len() {
                return None;
            }
            self.current += 1;
            self.sort_current();
        }
        if self.sorted.last() > self.late.peek() { self.sorted.pop() } else { self.late.pop() }
    }

    fn class_of(&self, area: &Candidate) -> usize {
        (self.highest.saturating_sub(area.area_key >> CLASS_BITS) as usize).min(CLASSES - 1)
    }

    fn sort_current(&mut self) {
        self.sorted = std::mem::take(&mut self.classes[self.current]);
        self.sorted.sort_unstable();
    }
}
