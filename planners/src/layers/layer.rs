//! One layer, and the layers that were cut before.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use rayon::prelude::*;

use super::cells::Cells;
use super::free_space::Solid;
use super::labels::Labels;
use super::lattice::Lattice;
use super::neighbours::{Owners, by_room};
use super::record::State;
use super::{cut, footprint, slivers};
use crate::geometry::Rect;
use crate::search::Csr;
use crate::strips::Block;
use crate::world::World;

/// What of a state decides its layer.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Size {
    width: f64,
    /// Length and facing; `None` for a disc.
    lies: Option<(f64, usize)>,
    /// Indices of the bridges that it does not pass.
    low: Vec<usize>,
}

impl Size {
    pub(super) fn of(world: &World, state: &State, facing: Option<usize>) -> Self {
        let passes = |height: f64| state.height < height;
        let low = (0..world.bridges.len()).filter(|&bridge| !passes(world.bridges[bridge].height));
        Self { width: state.width, lies: state.length.zip(facing), low: low.collect() }
    }
}

/// The rooms of a size.
pub(super) struct Layer {
    pub(super) rooms: Vec<Block>,
    pub(super) owners: Owners,
    /// The pairs of rooms (a < b) that have a common boundary; ordered.
    pub(super) beside: Vec<(u32, u32)>,
    /// The same, by room.
    pub(super) neighbours: Csr<u32>,
    /// Where a body can turn to the next facing; `None` for a disc.
    pub(super) turning: Option<Cells>,
}

impl Layer {
    fn cut(
        world: &World,
        solid: &Solid<'_>,
        (lattice, labels): (Lattice, Option<&Labels>),
        size: &Size,
    ) -> Self {
        let low: Vec<Rect> = size.low.iter().map(|&bridge| world.bridges[bridge].rect).collect();
        let extent = size.lies.map_or(size.width, |(length, _)| length.max(size.width));
        let (free, turning) = match size.lies {
            // what is longer than the map fits nowhere, whatever its outline
            _ if extent > world.bounds.dx().hypot(world.bounds.dy()) => {
                let nowhere = Cells::none(lattice.columns(), lattice.rows());
                (nowhere.clone(), size.lies.map(|_| nowhere))
            }
            None => (solid.free_cells(size.width / 2.0 + world.clearance, &low), None),
            Some((length, facing)) => {
                let open = solid.free_cells(0.0, &low);
                let body = footprint::body(length, size.width, world.clearance, facing);
                let sweep = footprint::sweep(length, size.width, world.clearance, facing);
                let fitting = |outline| footprint::fitting(&open, outline, lattice.side());
                (fitting(&body), Some(fitting(&sweep)))
            }
        };
        let rooms = slivers::drop_slivers(&free, &cut::cut_along(&free, labels), labels);
        let owners = Owners::new(lattice.columns(), lattice.rows(), &rooms);
        let beside = owners.beside();
        let neighbours = by_room(rooms.len(), &beside);
        Self { rooms, owners, beside, neighbours, turning }
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
    lattice: Option<Lattice>,
    layers: Vec<(Size, Arc<Layer>)>,
    cut: usize,
}

impl KnownLayers {
    /// How many layers were cut, since it was made.
    pub fn cut(&self) -> usize {
        self.lock().cut
    }

    /// The layer of each size; equal sizes share one.
    pub(super) fn layers(
        &self,
        world: &World,
        lattice: Lattice,
        labels: Option<&Labels>,
        sizes: &[Size],
    ) -> Vec<Arc<Layer>> {
        // Cutting runs on other threads, and must not wait for a lock that is held meanwhile.
        let mut known = std::mem::take(&mut *self.lock());
        let fingerprint = world.fingerprint();
        if (known.world, known.lattice) != (fingerprint, Some(lattice)) {
            known.layers.clear();
            (known.world, known.lattice) = (fingerprint, Some(lattice));
        }
        known.layers.retain(|(size, _)| sizes.contains(size));
        let mut missing: Vec<&Size> = Vec::new();
        for size in sizes {
            if !missing.contains(&size) && !known.layers.iter().any(|(other, _)| other == size) {
                missing.push(size);
            }
        }
        if !missing.is_empty() {
            let solid = Solid::new(world, lattice);
            let cut = |size: &&Size| {
                ((*size).clone(), Arc::new(Layer::cut(world, &solid, (lattice, labels), size)))
            };
            let new: Vec<_> = missing.par_iter().map(cut).collect();
            known.cut += new.len();
            known.layers.extend(new);
        }
        let of = |size: &Size| known.layers.iter().find(|(other, _)| other == size);
        let layers = sizes.iter().filter_map(of).map(|(_, layer)| Arc::clone(layer)).collect();
        *self.lock() = known;
        layers
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
