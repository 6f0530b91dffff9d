//! What was cut before, and is not cut again where it would be the same.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use rayon::prelude::*;

use super::ground::{Body, Ground};
use super::layer::{Layer, Size};
use super::overlaps::{Change, Pair, between};
use super::walls::Walls;
use crate::world::World;

/// What was cut for the last world. Where it is asked for again, only layers of sizes that are new are cut; where other areas
/// are named in the same world, what is free of walls is known.
#[derive(Default)]
pub struct KnownLayers(Mutex<Known>);

#[derive(Clone, Default)]
struct Known {
    /// Fingerprint of what is solid.
    solid: u64,
    walls: Option<Arc<Walls>>,
    grounds: Vec<(Body, Arc<Ground>)>,
    /// Fingerprint of the world.
    world: u64,
    layers: Vec<(Placeable, Arc<Layer>)>,
    changes: Vec<(Pair, Arc<Vec<Change>>)>,
    cut: usize,
}

/// A size, and where it can be.
#[derive(Clone)]
struct Placeable {
    size: Size,
    ground: Arc<Ground>,
}

impl PartialEq for Placeable {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.ground, &other.ground) && self.size == other.size
    }
}

impl KnownLayers {
    /// How many layers were cut, since it was made.
    pub fn cut(&self) -> usize {
        self.lock().cut
    }

    /// The layer of each size; equal sizes share one. The error is one sentence.
    pub(super) fn layers(&self, world: &World, sizes: &[Size]) -> Result<Vec<Arc<Layer>>, String> {
        // Cutting runs on other threads, and must not wait for a lock that is held meanwhile.
        let mut known = self.lock().clone();
        let solid = world.fingerprint_of_solid();
        if known.solid != solid {
            known = Known { solid, cut: known.cut, ..Known::default() };
        }
        let bodies: Vec<Body> = sizes.iter().map(|size| size.body.clone()).collect();
        let walls = Arc::clone(known.walls.get_or_insert_with(|| Arc::new(Walls::new(world))));
        let ground = |body: &Body| Ground::of(world, &walls, body);
        let (grounds, _) = completed(&mut known.grounds, &bodies, ground)?;
        let fingerprint = world.fingerprint();
        if known.world != fingerprint {
            known.layers.clear();
            known.world = fingerprint;
        }
        let sized = |(size, ground): (&Size, Arc<Ground>)| Placeable { size: size.clone(), ground };
        let wanted: Vec<Placeable> = sizes.iter().zip(grounds).map(sized).collect();
        let layer = |of: &Placeable| Layer::cut(world, Arc::clone(&of.ground), &of.size);
        let (layers, cut) = completed(&mut known.layers, &wanted, layer)?;
        known.cut += cut;
        *self.lock() = known;
        Ok(layers)
    }

    /// The changes of shape, or turns, between each two layers.
    pub(super) fn changes(&self, pairs: &[Pair]) -> Result<Vec<Arc<Vec<Change>>>, String> {
        let mut known = self.lock().changes.clone();
        let (changes, _) = completed(&mut known, pairs, |pair| Ok(between(pair)))?;
        self.lock().changes = known;
        Ok(changes)
    }

    /// A lock that is poisoned guards what was whole when it was put there.
    fn lock(&self) -> MutexGuard<'_, Known> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl std::fmt::Debug for KnownLayers {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "KnownLayers({} cut)", self.cut())
    }
}

/// All that is wanted, in its order, and how much of it was made: what is known is taken, and what is not wanted any more is
/// forgotten.
fn completed<K: Clone + PartialEq + Send + Sync, V: Send + Sync>(
    known: &mut Vec<(K, Arc<V>)>,
    wanted: &[K],
    make: impl Fn(&K) -> Result<V, String> + Sync,
) -> Result<(Vec<Arc<V>>, usize), String> {
    known.retain(|(one, _)| wanted.contains(one));
    let mut missing: Vec<&K> = Vec::new();
    for one in wanted {
        if !missing.contains(&one) && !known.iter().any(|(other, _)| other == one) {
            missing.push(one);
        }
    }
    let made = |one: &&K| Ok((K::clone(one), Arc::new(make(one)?)));
    let made = missing.par_iter().map(made).collect::<Result<Vec<_>, String>>()?;
    let count = made.len();
    known.extend(made);
    let of = |one: &K| known.iter().find(|(other, _)| other == one).map(|(_, made)| Arc::clone(made));
    Ok((wanted.iter().filter_map(of).collect(), count))
}
