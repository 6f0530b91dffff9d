//! What rooms leave of an area.

use crate::prime_areas::maximal::MaximalBlocks;
use crate::strips::Block;

/// So many holes are cut out one by one; more of them are better met by a sweep.
const FEW: usize = 3;

/// Cuts blocks out of a block, with working memory to be used again.
pub(super) struct Cutter {
    maximal: MaximalBlocks,
    x: Vec<u32>,
    y: Vec<u32>,
    holes: Vec<Block>,
    /// Maximal rectangles of what the holes so far have left.
    parts: Vec<Block>,
    /// What the present hole has left of those that it met.
    cut: Vec<Block>,
}

impl Cutter {
    pub(super) fn new() -> Self {
        let maximal = MaximalBlocks::new();
        let (x, y, holes, parts, cut) = (Vec::new(), Vec::new(), Vec::new(), Vec::new(), Vec::new());
        Self { maximal, x, y, holes, parts, cut }
    }

    /// Calls `part` for each maximal rectangle of what `holes` leave of the block.
    pub(super) fn cut(&mut self, block: Block, holes: &[Block], mut part: impl FnMut(Block)) {
        if holes.len() <= FEW {
            self.cut_one_by_one(block, holes);
            return self.parts.drain(..).for_each(part);
        }
        self.holes.clear();
        self.holes.extend(holes.iter().map(|hole| block.clip(hole)));
        lines(&mut self.x, self.holes.iter().flat_map(|hole| [hole.x0, hole.x1]), block.x0, block.x1);
        lines(&mut self.y, self.holes.iter().flat_map(|hole| [hole.y0, hole.y1]), block.y0, block.y1);
        let (x, y) = (&self.x, &self.y);
        for hole in &mut self.holes {
            let place = |lines: &[u32], line| lines.partition_point(|&other| other < line) as u32;
            *hole = Block {
                x0: place(x, hole.x0),
                y0: place(y, hole.y0),
                x1: place(x, hole.x1),
                y1: place(y, hole.y1),
            };
        }
        self.maximal.each(x.len() as u32 - 1, y.len() as u32 - 1, &self.holes, |found| {
            part(Block {
                x0: x[found.x0 as usize],
                y0: y[found.y0 as usize],
                x1: x[found.x1 as usize],
                y1: y[found.y1 as usize],
            });
        });
    }

    /// Leaves the maximal rectangles in `parts`.
    fn cut_one_by_one(&mut self, block: Block, holes: &[Block]) {
        self.parts.push(block);
        for hole in holes {
            self.cut.clear();
            self.parts.retain(|part| {
                let stays = !part.overlaps(hole);
                if !stays {
                    self.cut.extend(part.around(*hole));
                }
                stays
            });
            // What was left whole is maximal; what was cut may lie inside another part.
            for (i, part) in self.cut.iter().enumerate() {
                let holds = |(j, other): (usize, &Block)| other.encloses(part) && (other != part || j < i);
                let in_cut = self.cut.iter().enumerate().any(holds);
                if !in_cut && !self.parts.iter().any(|other| other.encloses(part)) {
                    self.parts.push(*part);
                }
            }
        }
    }
}

fn lines(lines: &mut Vec<u32>, of_holes: impl Iterator<Item = u32>, low: u32, high: u32) {
    lines.clear();
    lines.extend([low, high]);
    lines.extend(of_holes);
    lines.sort_unstable();
    lines.dedup();
}
