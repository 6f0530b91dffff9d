//! The strips of an environment, and rectangles of whole strips: the paper's pair of binary strings, by where their ones
//! begin and end (Abou-Ali et al., "Isolation of free areas", Figure 4 and Table 2).

use crate::geometry::Rect;
use crate::world::World;

/// The lines that part the environment into strips: the distinct edges of everything in it, its own edge
/// included, ascending, in metres. Strip `i` of an axis lies between lines `i` and `i + 1`.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Strips {
    /// Lines between vertical strips.
    pub x: Vec<f64>,
    /// Lines between horizontal strips.
    pub y: Vec<f64>,
}

/// A rectangle of whole strips, or of cells of a lattice, from column `x0` up to but not including column `x1`, and
/// likewise in y. Ordered by (x0, y0, x1, y1).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Block {
    pub x0: u32,
    pub y0: u32,
    pub x1: u32,
    pub y1: u32,
}

impl Strips {
    /// The strips of a world: the edges of its obstacles (a polygon by its enclosing rectangle) and bridges,
    /// clipped to its bounds. What has no area within the bounds draws no line.
    pub fn of_world(world: &World) -> Self {
        let bridges = world.bridges.iter().map(|bridge| bridge.rect);
        Self::new(world.bounds, world.solid_rects().into_iter().chain(bridges))
    }

    /// The strips that `rects` make within `bounds`. Bounds without area, or not finite, have no strips.
    pub fn new(bounds: Rect, rects: impl IntoIterator<Item = Rect>) -> Self {
        Self::with_blocks(bounds, rects).0
    }

    /// The strips that `rects` make within `bounds`, and the block of each that has an area there, in their order.
    pub fn with_blocks(bounds: Rect, rects: impl IntoIterator<Item = Rect>) -> (Self, Vec<Block>) {
        if !(bounds.area() > 0.0 && bounds.area().is_finite()) {
            return (Self::default(), Vec::new());
        }
        let inside: Vec<_> = rects.into_iter().filter_map(|rect| rect.intersection(&bounds)).collect();
        let (x, columns) = lines((bounds.x0, bounds.x1), &inside, |rect| (rect.x0, rect.x1));
        let (y, rows) = lines((bounds.y0, bounds.y1), &inside, |rect| (rect.y0, rect.y1));
        let block = |(x, y): ((u32, u32), (u32, u32))| Block { x0: x.0, y0: y.0, x1: x.1, y1: y.1 };
        (Self { x, y }, columns.into_iter().zip(rows).map(block).collect())
    }

    pub fn columns(&self) -> u32 {
        self.x.len().saturating_sub(1) as u32
    }

    pub fn rows(&self) -> u32 {
        self.y.len().saturating_sub(1) as u32
    }

    /// The strips that `rect` covers wholly; `None` where it covers none. Exact for every rectangle that the
    /// strips were made from.
    pub fn block(&self, rect: Rect) -> Option<Block> {
        let (x0, x1) = covered(&self.x, rect.x0, rect.x1);
        let (y0, y1) = covered(&self.y, rect.y0, rect.y1);
        (x0 < x1 && y0 < y1).then_some(Block { x0, y0, x1, y1 })
    }

    /// The block's rectangle, in metres. The block must be one of these strips.
    pub fn rect(&self, block: Block) -> Rect {
        Rect::new(
            self.x[block.x0 as usize],
            self.y[block.y0 as usize],
            self.x[block.x1 as usize],
            self.y[block.y1 as usize],
        )
    }
}

impl Block {
    /// The up to four largest blocks of this one outside of a hole, which overlaps it, one on each side.
    pub(crate) fn around(self, hole: Self) -> impl Iterator<Item = Self> {
        let left = (hole.x0 > self.x0).then_some(Self { x1: hole.x0, ..self });
        let right = (hole.x1 < self.x1).then_some(Self { x0: hole.x1, ..self });
        let below = (hole.y0 > self.y0).then_some(Self { y1: hole.y0, ..self });
        let above = (hole.y1 < self.y1).then_some(Self { y0: hole.y1, ..self });
        [left, right, below, above].into_iter().flatten()
    }

    /// Whether the two share a cell.
    pub fn overlaps(&self, other: &Self) -> bool {
        self.x0 < other.x1 && other.x0 < self.x1 && self.y0 < other.y1 && other.y0 < self.y1
    }

    /// Whether `other` lies wholly inside.
    pub fn encloses(&self, other: &Self) -> bool {
        self.x0 <= other.x0 && other.x1 <= self.x1 && self.y0 <= other.y0 && other.y1 <= self.y1
    }

    /// What it shares with another one, which may be empty: of blocks beside each other their boundary.
    pub(crate) fn clip(&self, other: &Self) -> Self {
        Self {
            x0: other.x0.max(self.x0),
            y0: other.y0.max(self.y0),
            x1: other.x1.min(self.x1),
            y1: other.y1.min(self.y1),
        }
    }

    /// The block with its axes exchanged.
    pub(crate) fn transposed(&self) -> Self {
        Self { x0: self.y0, y0: self.x0, x1: self.y1, y1: self.x1 }
    }
}

/// The distinct edges along one axis, and for each rectangle the lines that its edges are.
fn lines(bounds: (f64, f64), rects: &[Rect], edges: fn(&Rect) -> (f64, f64)) -> (Vec<f64>, Vec<(u32, u32)>) {
    let ends = |i: usize, (low, high): (f64, f64)| [(low + 0.0, 2 * i), (high + 0.0, 2 * i + 1)];
    let mut sorted: Vec<_> = rects.iter().enumerate().flat_map(|(i, rect)| ends(i, edges(rect))).collect();
    sorted.extend(ends(rects.len(), bounds));
    sorted.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    let mut lines = Vec::with_capacity(sorted.len());
    let mut places = vec![(0, 0); rects.len() + 1];
    for (edge, end) in sorted {
        if lines.last() != Some(&edge) {
            lines.push(edge);
        }
        let (low, high) = &mut places[end / 2];
        *(if end % 2 == 0 { low } else { high }) = lines.len() as u32 - 1;
    }
    places.pop();
    (lines, places)
}

/// First strip and one after the last strip between `low` and `high`.
fn covered(lines: &[f64], low: f64, high: f64) -> (u32, u32) {
    let first = lines.partition_point(|&line| line < low);
    let end = lines.partition_point(|&line| line <= high);
    (first as u32, end.saturating_sub(1) as u32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_block_is_whole_strips() {
        let strips = Strips::new(Rect::new(0.0, 0.0, 10.0, 10.0), [Rect::new(2.0, 3.0, 5.0, 12.0)]);
        let block = strips.block(Rect::new(2.0, 0.0, 5.0, 3.0)).unwrap();
        assert_eq!(block, Block { x0: 1, y0: 0, x1: 2, y1: 1 });
        assert_eq!(strips.rect(block), Rect::new(2.0, 0.0, 5.0, 3.0));
    }

    #[test]
    fn what_covers_nothing_draws_no_line() {
        let bounds = Rect::new(0.0, 0.0, 10.0, 10.0);
        let flat = Rect::new(1.0, 1.0, 9.0, 1.0);
        let outside = Rect::new(10.0, 2.0, 12.0, 4.0);
        assert_eq!(Strips::new(bounds, [flat, outside]), Strips::new(bounds, []));
    }

    #[test]
    fn bounds_without_area_have_no_strips() {
        for bounds in [Rect::new(0.0, 0.0, 0.0, 5.0), Rect::new(0.0, 0.0, f64::NAN, 1.0)] {
            let strips = Strips::new(bounds, [Rect::new(0.0, 0.0, 1.0, 1.0)]);
            assert_eq!((strips.columns(), strips.rows()), (0, 0));
            assert_eq!(strips.block(Rect::new(0.0, 0.0, 1.0, 1.0)), None);
        }
    }
}
