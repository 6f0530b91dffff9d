//! Changes of shape and turns: ways between rooms of two layers that lie over each other.

use std::sync::Arc;

use rayon::prelude::*;

use super::footprint::FACINGS;
use super::known::KnownLayers;
use super::layer::Placed;
use super::overlaps::{Change, Pair, Turn};
use super::record::{Crossing, Kind, State};

/// All changes of shape and turns between layers. The error is one sentence.
pub(super) fn changes(
    states: &[State],
    stack: &[Placed],
    known: &KnownLayers,
) -> Result<Vec<Crossing>, String> {
    let pairs = (0..stack.len()).flat_map(|from| (from + 1..stack.len()).map(move |to| (from, to)));
    let pairs: Vec<_> = pairs.filter(|&(from, to)| may_change(states, &stack[from], &stack[to])).collect();
    let of_layers = |&(from, to): &(usize, usize)| {
        let (from, to) = (&stack[from], &stack[to]);
        Pair { layers: [from, to].map(|placed| Arc::clone(&placed.layer)), turn: turn(from, to) }
    };
    let found = known.changes(&pairs.iter().map(of_layers).collect::<Vec<_>>())?;
    let of_pair = |(&(from, to), changes): (&(usize, usize), &Arc<Vec<Change>>)| {
        let first = [stack[from].first, stack[to].first];
        changes.iter().flat_map(|change| there_and_back(first, change)).collect::<Vec<_>>()
    };
    Ok(pairs.par_iter().zip(&found).flat_map_iter(of_pair).collect())
}

fn turn(from: &Placed, to: &Placed) -> Option<Turn> {
    let (one, other) = (from.facing?, to.facing?);
    let before = (from.state == to.state).then(|| turned_from(one, other))??;
    Some(if before == one { Turn::FromFirst } else { Turn::FromSecond })
}

/// Whether a robot may come from one layer into the other by changing its shape, or by turning to the next facing. A
/// disc faces nowhere, and so may become a body of any facing.
pub(super) fn may_change(states: &[State], a: &Placed, b: &Placed) -> bool {
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

fn there_and_back(first: [usize; 2], change: &Change) -> [Crossing; 2] {
    let [room1, room2] = [0, 1].map(|end| first[end] + change.rooms[end] as usize);
    let Change { across, at, width, .. } = *change;
    let crossing = |room1, room2| Crossing { kind: Kind::Change, room1, room2, across, at, width };
    [crossing(room1, room2), crossing(room2, room1)]
}
