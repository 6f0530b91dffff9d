//! Changes of shape and turns: ways between rooms of two layers that lie over each other.

use rayon::prelude::*;

use super::footprint::FACINGS;
use super::labels::Labels;
use super::lattice::Lattice;
use super::layer::{Layer, Placed};
use super::maximal::largest_within;
use super::record::{Crossing, Kind, State};
use crate::strips::Block;

/// An overlap not thicker than so many cells is left out beside a thicker one.
const THIN: u32 = 2;

/// All changes of shape and turns between layers.
///
/// # Arguments
/// `labels` tell what may be closed: no change stands for another one across a named door or the outline of an area.
pub(super) fn changes(
    lattice: Lattice,
    states: &[State],
    labels: Option<&Labels>,
    stack: &[Placed],
) -> Vec<Crossing> {
    let pairs = (0..stack.len()).flat_map(|from| (from + 1..stack.len()).map(move |to| (from, to)));
    let pairs: Vec<_> = pairs.filter(|&(from, to)| may_change(states, &stack[from], &stack[to])).collect();
    let of_pair = |&(from, to): &(usize, usize)| changes_between(lattice, labels, &stack[from], &stack[to]);
    pairs.par_iter().map(of_pair).collect::<Vec<_>>().concat()
}

/// Whether a robot may come from one layer into the other by changing its shape, or by turning to the next facing. A
/// disc faces nowhere, and so may become a body of any facing.
fn may_change(states: &[State], a: &Placed, b: &Placed) -> bool {
    let same_robot = states[a.state].robot == states[b.state].robot;
    same_robot
        && match (a.facing, b.facing) {
            (Some(from), Some(to)) if a.state == b.state => turned_from(from, to).is_some(),
            (Some(from), Some(to)) => from == to,
            _ => true,
        }
}

/// The one of two facings from which the other is the next one.
fn turned_from(a: usize, b: usize) -> Option<usize> {
    let next = |facing: usize| (facing + 1) % FACINGS;
    if next(a) == b {
        Some(a)
    } else if next(b) == a {
        Some(b)
    } else {
        None
    }
}

fn changes_between(lattice: Lattice, labels: Option<&Labels>, from: &Placed, to: &Placed) -> Vec<Crossing> {
    let turns = (from.state == to.state).then(|| from.facing.zip(to.facing)).flatten();
    let turning = turns.and_then(|(a, b)| turned_from(a, b)).and_then(|facing| {
        let first = if from.facing == Some(facing) { from } else { to };
        first.layer.turning.as_ref()
    });
    let overlap = |(a, b): (u32, u32)| {
        let common = from.layer.rooms[a as usize].clip(&to.layer.rooms[b as usize]);
        let common = turning.map_or(Some(common), |turning| largest_within(turning, common))?;
        Some(((a, b), common))
    };
    let overlaps: Vec<_> = from.layer.owners.over(&to.layer.owners).into_iter().filter_map(overlap).collect();
    let mut found = Vec::new();
    for &((a, b), common) in &overlaps {
        let layers = (&*from.layer, &*to.layer);
        if is_thin(&common) && has_thicker_beside(&overlaps, layers, labels, ((a, b), common)) {
            continue;
        }
        let (room1, room2) = (from.first + a as usize, to.first + b as usize);
        let (kind, rect) = (Kind::Change, lattice.rect(common));
        found.push(Crossing { kind, room1, room2, rect });
        found.push(Crossing { kind, room1: room2, room2: room1, rect });
    }
    found
}

fn is_thin(overlap: &Block) -> bool {
    (overlap.x1 - overlap.x0).min(overlap.y1 - overlap.y0) <= THIN
}

type Overlap = ((u32, u32), Block);

/// Whether the same room overlaps a neighbour of the other room, right beside this overlap and thicker than it: there
/// the robot may change as well, and go through the door between the neighbours, a few cells from here.
fn has_thicker_beside(
    overlaps: &[Overlap],
    layers: (&Layer, &Layer),
    labels: Option<&Labels>,
    ((a, b), here): Overlap,
) -> bool {
    let label = |block: &Block| labels.map(|labels| labels.number(block.x0, block.y0));
    let is_beside = |pair: (u32, u32)| {
        let found = overlaps.binary_search_by_key(&pair, |(pair, _)| *pair);
        found.is_ok_and(|at| {
            let other = &overlaps[at].1;
            !is_thin(other) && touch(other, &here) && label(other) == label(&here)
        })
    };
    layers.1.neighbours.of(b as usize).iter().any(|&other| is_beside((a, other)))
        || layers.0.neighbours.of(a as usize).iter().any(|&other| is_beside((other, b)))
}

/// Whether two disjoint blocks share a boundary of at least a cell's side.
fn touch(a: &Block, b: &Block) -> bool {
    let shared = |(a0, a1): (u32, u32), (b0, b1): (u32, u32)| i64::from(a1.min(b1)) - i64::from(a0.max(b0));
    let (dx, dy) = (shared((a.x0, a.x1), (b.x0, b.x1)), shared((a.y0, a.y1), (b.y0, b.y1)));
    dx.min(dy) == 0 && dx.max(dy) > 0
}
