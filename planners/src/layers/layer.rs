//! One layer, and the layers that were cut before.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use rayon::prelude::*;
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

use super::dents::without_dents;
use super::footprint;
use super::grown::Moved;
use super::labels::{Label, Labels};
use super::pieces::Pieces;
use super::record::State;
use super::walls::Walls;
use crate::geometry::tolerance::SNAP_M;
use crate::geometry::{Convex, Rect, Segment};
use crate::search::Csr;
use crate::world::World;

/// Dents of free space up to so deep are no part of rooms, metres. A point in one is joined with them by a straight leg.
const DENT_M: f64 = 0.02;

/// What of a state decides its layer.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Size {
    width: f64,
    /// Length and facing; `None` for a disc.
    lies: Option<(f64, usize)>,
    /// Indices of the bridges that it does not pass.
    low: Vec<usize>,
    /// Indices of the areas that any part of it enters.
    whole: Vec<usize>,
}

impl Size {
    pub(super) fn of(world: &World, state: &State, facing: Option<usize>, whole: &[usize]) -> Self {
        let passes = |height: f64| state.height < height;
        let low = (0..world.bridges.len()).filter(|&bridge| !passes(world.bridges[bridge].height));
        Self { width: state.width, lies: state.length.zip(facing), low: low.collect(), whole: whole.into() }
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
    /// Where a body can turn to the next facing, in convex pieces; `None` for a disc.
    pub(super) turning: Option<Places>,
    pub(super) places: Places,
}

/// Convex pieces, found by where they are.
pub(super) struct Places {
    pieces: Vec<Convex>,
    index: RTree<GeomWithData<Rectangle<[f64; 2]>, u32>>,
}

impl Places {
    fn new(pieces: Vec<Convex>) -> Self {
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
    fn cut(world: &World, walls: &Walls, size: &Size) -> Result<Self, String> {
        let low: Vec<Rect> = size.low.iter().map(|&bridge| world.bridges[bridge].rect).collect();
        // what is free within a rounding is not free
        let (bounds, clearance) = (world.bounds, world.clearance + SNAP_M);
        let (free, turning) = match size.lies {
            None => {
                let keep = size.width / 2.0 + clearance;
                let solid = walls.about_discs(&low, bounds, [2.0 * keep, 2.0 * keep * Moved::most()]);
                (Moved::Disc(keep).free_space(bounds, &solid), None)
            }
            Some((length, facing)) => {
                let solid = walls.straight(&low);
                let body = footprint::body(length, size.width, clearance, facing);
                let sweep = footprint::sweep(length, size.width, clearance, facing);
                let turning = Moved::Body(sweep).free_space(bounds, &solid);
                (Moved::Body(body).free_space(bounds, &solid), Some(turning))
            }
        };
        let free = without_dents(&free, DENT_M);
        let turning = turning.map(|free| Pieces::of(&free, &[])).transpose()?;
        let robot = match size.lies {
            None => Moved::Disc(size.width / 2.0 + SNAP_M),
            Some((length, facing)) => Moved::Body(footprint::body(length, size.width, SNAP_M, facing)),
        };
        let labels = Labels::new(world, &size.whole, &robot);
        let Pieces { pieces: rooms, doors: beside } = Pieces::of(&free, &labels.lines())?;
        let neighbours = Csr::new(
            rooms.len(),
            beside.iter().flat_map(|&(a, b, side)| [(a as usize, (b, side)), (b as usize, (a, side))]),
        );
        let labels = rooms.iter().map(|room| labels.of(room)).collect();
        let turning = turning.map(|turning| Places::new(turning.pieces));
        let radius = size.lies.is_none().then_some(size.width / 2.0 + world.clearance);
        Ok(Self { radius, places: Places::new(rooms.clone()), rooms, labels, beside, neighbours, turning })
    }
}

pub(super) struct Placed {
    pub(super) state: usize,
    pub(super) facing: Option<usize>,
    /// The number of its first room.
    pub(super) first: usize,
    pub(super) layer: Arc<Layer>,
}

/// Layers that were cut before: those of the last world, by size. Where they are asked for again, only what has
/// another size than all of before is cut.
#[derive(Default)]
pub struct KnownLayers(Mutex<Known>);

#[derive(Default)]
struct Known {
    world: u64,
    layers: Vec<(Size, Arc<Layer>)>,
    cut: usize,
}

impl KnownLayers {
    /// How many layers were cut, since it was made.
    pub fn cut(&self) -> usize {
        self.lock().cut
    }

    /// The layer of each size; equal sizes share one. The error is one sentence.
    pub(super) fn layers(&self, world: &World, sizes: &[Size]) -> Result<Vec<Arc<Layer>>, String> {
        // Cutting runs on other threads, and must not wait for a lock that is held meanwhile.
        let mut known = std::mem::take(&mut *self.lock());
        let fingerprint = world.fingerprint();
        if known.world != fingerprint {
            known.layers.clear();
            known.world = fingerprint;
        }
        known.layers.retain(|(size, _)| sizes.contains(size));
        let mut missing: Vec<&Size> = Vec::new();
        for size in sizes {
            if !missing.contains(&size) && !known.layers.iter().any(|(other, _)| other == size) {
                missing.push(size);
            }
        }
        if !missing.is_empty() {
            let walls = Walls::new(world);
            let cut =
                |size: &&Size| Ok::<_, String>(((*size).clone(), Arc::new(Layer::cut(world, &walls, size)?)));
            let new: Vec<_> = missing.par_iter().map(cut).collect::<Result<_, _>>()?;
            known.cut += new.len();
            known.layers.extend(new);
        }
        let of = |size: &Size| known.layers.iter().find(|(other, _)| other == size);
        let layers = sizes.iter().filter_map(of).map(|(_, layer)| Arc::clone(layer)).collect();
        *self.lock() = known;
        Ok(layers)
    }

    /// A lock that is poisoned guards layers that were whole when they were put there.
    fn lock(&self) -> MutexGuard<'_, Known> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl std::fmt::Debug for KnownLayers {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "KnownLayers({} cut)", self.cut())
    }
}
