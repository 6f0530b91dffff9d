//! Convex pieces, found by where they are.

use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

use crate::geometry::{Convex, Rect};

pub(super) struct Places {
    pieces: Vec<Convex>,
    index: RTree<GeomWithData<Rectangle<[f64; 2]>, u32>>,
}

impl Places {
    pub(super) fn new(pieces: Vec<Convex>) -> Self {
        let place = |(number, piece): (u32, &Convex)| {
            let Rect { x0, y0, x1, y1 } = piece.bounds();
            GeomWithData::new(Rectangle::from_corners([x0, y0], [x1, y1]), number)
        };
        let index = RTree::bulk_load((0..).zip(&pieces).map(place).collect());
        Self { pieces, index }
    }

    /// What pieces have in common with one, by number.
    pub(super) fn common(&self, with: &Convex) -> Vec<(u32, Convex)> {
        let Rect { x0, y0, x1, y1 } = with.bounds();
        let near = self.index.locate_in_envelope_intersecting(AABB::from_corners([x0, y0], [x1, y1]));
        let shared =
            near.filter_map(|piece| Some((piece.data, with.common(&self.pieces[piece.data as usize])?)));
        let mut shared: Vec<_> = shared.collect();
        shared.sort_unstable_by_key(|(number, _)| *number);
        shared
    }
}
