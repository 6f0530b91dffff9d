//! One layer: the rooms of a size.

use std::sync::Arc;

use super::ground::{Body, Ground};
use super::labels::{Label, Labels};
use super::pieces::Pieces;
use super::places::Places;
use super::record::State;
use crate::geometry::tolerance::SNAP_M;
use crate::geometry::{Convex, Segment};
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
