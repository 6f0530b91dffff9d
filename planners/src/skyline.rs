//! A sweep from the top of a map downwards that knows, for any run of columns, the lowest obstacle above the
//! sweep line: what prime areas, concave corners and the fewest rooms are read off from.

mod tree;

use crate::strips::Block;

use tree::LowestTree;

/// Obstacles as blocks (overlapping ones allowed), seen from a line that only moves down. An obstacle is
/// admitted once the line has passed its top; for each column the admitted obstacle with the lowest bottom counts.
/// That one obstacle says both things about a column: it is covered at the line if that bottom is not above
/// the line, and else free up to that bottom.
pub(crate) struct Skyline {
    /// Obstacles by bottom, lowest first: an obstacle's place here is its rank.
    by_bottom: Vec<Block>,
    /// Ranks by top, highest first.
    by_top: Vec<u32>,
    admitted: usize,
    columns: u32,
    tree: LowestTree,
}

/// Obstacles of lower rank than this are meant.
pub(crate) type RankLimit = u32;

impl Skyline {
    /// A skyline without obstacles, to be filled by `reset`.
    pub(crate) fn new() -> Self {
        let tree = LowestTree::default();
        Self { by_bottom: Vec::new(), by_top: Vec::new(), admitted: 0, columns: 0, tree }
    }

    /// A skyline of these obstacles with the line at the top of the map.
    pub(crate) fn of(columns: u32, obstacles: &[Block]) -> Self {
        let mut skyline = Self::new();
        skyline.reset(columns, obstacles);
        skyline
    }

    /// Forgets everything and starts anew, keeping its memory.
    pub(crate) fn reset(&mut self, columns: u32, obstacles: &[Block]) {
        self.columns = columns;
        self.admitted = 0;
        self.by_bottom.clear();
        self.by_bottom.extend_from_slice(obstacles);
        self.by_bottom.sort_unstable_by_key(|b| (b.y0, b.x0, b.x1, b.y1));
        self.by_top.clear();
        self.by_top.extend(0..obstacles.len() as u32);
        let by_bottom = &self.by_bottom;
        self.by_top.sort_unstable_by_key(|&rank| {
            let b = by_bottom[rank as usize];
            (std::cmp::Reverse(b.y1), b.x0, rank)
        });
        self.tree.reset(columns);
    }

    /// The first of the obstacles that are not admitted yet.
    pub(crate) fn next_top(&self) -> Option<Block> {
        self.by_top.get(self.admitted).map(|&rank| self.by_bottom[rank as usize])
    }

    /// The obstacles that are not admitted yet, highest top first, and equal tops from left to right.
    pub(crate) fn waiting(&self) -> impl Iterator<Item = Block> + '_ {
        self.by_top[self.admitted..].iter().map(|&rank| self.by_bottom[rank as usize])
    }

    /// Moves the line to `y`, admitting obstacles whose top is above it: the view just above `y`.
    pub(crate) fn look_above(&mut self, y: u32) {
        self.admit(|top| top > y);
    }

    /// Moves the line to `y`, admitting obstacles whose top is on it too: the view just below `y`.
    pub(crate) fn look_below(&mut self, y: u32) {
        self.admit(|top| top >= y);
    }

    fn admit(&mut self, passed: impl Fn(u32) -> bool) {
        while let Some(block) = self.next_top().filter(|block| passed(block.y1)) {
            self.tree.lower(block.x0, block.x1, self.by_top[self.admitted]);
            self.admitted += 1;
        }
    }

    /// Ranks of obstacles whose bottom is at `y` or below: after `look_above(y)` they cover what is just above
    /// `y`; after `look_below(y)` they cover what is just above or just below.
    pub(crate) fn through(&self, y: u32) -> RankLimit {
        self.by_bottom.partition_point(|b| b.y0 <= y) as RankLimit
    }

    /// Ranks of obstacles whose bottom is below `y`: after `look_below(y)` they cover what is just below `y`.
    pub(crate) fn below(&self, y: u32) -> RankLimit {
        self.by_bottom.partition_point(|b| b.y0 < y) as RankLimit
    }

    /// The lowest admitted obstacle over any of the columns `from..to`, which must not be empty.
    pub(crate) fn lowest(&self, from: u32, to: u32) -> Option<Block> {
        self.by_bottom.get(self.tree.lowest(from, to) as usize).copied()
    }

    /// The obstacle of a rank within the limit that covers the column.
    pub(crate) fn cover(&self, column: u32, limit: RankLimit) -> Option<Block> {
        let rank = self.tree.at(column);
        (rank < limit).then(|| self.by_bottom[rank as usize])
    }

    /// The line at which the run of uncovered columns that holds `column` ends on the left.
    pub(crate) fn left_end(&self, column: u32, limit: RankLimit) -> u32 {
        self.tree.last_before(column, limit).map_or(0, |covered| covered + 1)
    }

    /// The line at which the run of uncovered columns that holds `column` ends on the right.
    pub(crate) fn right_end(&self, column: u32, limit: RankLimit) -> u32 {
        self.tree.first_after(column, limit).unwrap_or(self.columns)
    }

    /// The runs of uncovered columns that meet `from..to`, uncut, from left to right.
    pub(crate) fn gaps(&self, from: u32, to: u32, limit: RankLimit) -> impl Iterator<Item = (u32, u32)> + '_ {
        let mut column = from;
        std::iter::from_fn(move || {
            while column < to {
                if let Some(cover) = self.cover(column, limit) {
                    column = cover.x1;
                    continue;
                }
                let gap = (self.left_end(column, limit), self.right_end(column, limit));
                column = gap.1;
                return Some(gap);
            }
            None
        })
    }
}
