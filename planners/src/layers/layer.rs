//! One layer: the rooms of a size.

use std::sync::Arc;

use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

use super::ground::{Body, Ground};
use super::labels::{Label, Labels};
use super::pieces::Pieces;
use super::record::State;
use crate::geometry::tolerance::SNAP_M;
use crate::geometry::{Convex, Rect, Segment};
use crate::search::Csr;
use crate::world::World;

/// What of a state decides its layer.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Size {
    pub(super) body: Body,
    /// Indices of the areas that any part of it enters.
    whole: Vec<usize>,
}

impl Size {
    pub(super) fn of(world: &World, state: &State, facing: Option<usize>, whole: &[usize]) -> Self {
        Self { body: Body::of(world, state, facing), whole: whole.into() }
    }
}

/// The rooms of a size.
pub(super) struct Layer {
    pub(super) rooms: Vec<Convex>,
    /// By room.
    pub(super) labels: Vec<Label>,
    /// The pairs of rooms (a < b) that have a side in common, or a part of one; ordered.
    pub(super) beside: Vec<(u32, u32, Segment)>,
    /// The same, by room.
    pub(super) neighbours: Csr<(u32, Segment)>,
    /// How far a disc keeps from walls, metres; `None` for a body.
    pub(super) radius: Option<f64>,
    pub(super) ground: Arc<Ground>,
    pub(super) places: Places,
}

/// Convex pieces, found by where they are.
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

impl Layer {
    /// The error is one sentence.
    pub(super) fn cut(world: &World, ground: Arc<Ground>, size: &Size) -> Result<Self, String> {
        let Size { body, whole } = size;
        let labels = Labels::new(world, whole, &body.moved(SNAP_M));
        let Pieces { pieces: rooms, doors: beside } = Pieces::of(&ground.free, &labels.lines())?;
        let neighbours = Csr::new(
            rooms.len(),
            beside.iter().flat_map(|&(a, b, side)| [(a as usize, (b, side)), (b as usize, (a, side))]),
        );
        let labels = rooms.iter().map(|room| labels.of(room)).collect();
        let radius = body.lies.is_none().then_some(body.width / 2.0 + world.clearance);
        Ok(Self { radius, places: Places::new(rooms.clone()), rooms, labels, beside, neighbours, ground })
    }
}

pub(super) struct Placed {
    pub(super) state: usize,
    pub(super) facing: Option<usize>,
    /// The number of its first room.
    pub(super) first: usize,
    pub(super) layer: Arc<Layer>,
}
