//! Rooms by state: one layer of rooms for each state of each robot, and the crossings within and between them.
//!
//! A layer is the free space of a disc as wide as the state: the places of its centre. A state that has a length is a
//! body that cannot turn everywhere, and has a layer for each of eight facings, 22.5 degrees apart. Where the rooms of the
//! paper ask whether a rectangle is wide enough, here every point of a room is a point at which the state fits.

mod cells;
mod changes;
mod clearance;
mod cut;
mod footprint;
mod free_space;
mod gap;
mod headroom;
mod labels;
mod lattice;
mod layer;
mod maximal;
mod narrowest;
mod neighbours;
mod planner;
mod record;
mod slivers;
mod transform;

use crate::strips::Block;
use changes::changes;
use footprint::FACINGS;
use labels::{Label, Labels};
use layer::{Placed, Size};
use rayon::prelude::*;

use crate::geometry::Rect;
use crate::world::World;

pub(crate) use footprint::{STEP_DEGREES, body};
pub(crate) use free_space::Solid;
pub use headroom::{Headroom, headroom};
pub use lattice::{Lattice, MAX_CELLS};
pub use layer::KnownLayers;
pub use narrowest::{Narrowest, narrowest};
pub use planner::RoomsByState;
pub use record::{Crossing, Kind, Room, State};

#[derive(Clone, Debug, PartialEq)]
pub struct Layers {
    /// The cells in which they were cut.
    pub lattice: Lattice,
    /// By state, then as made: largest first.
    pub rooms: Vec<Room>,
    /// By (room1, room2); there is at most one from a room into another.
    pub crossings: Vec<Crossing>,
    /// Which room lies in which area of the world, both by index; by room.
    pub area_rooms: Vec<(usize, usize)>,
    /// Which room lies in which named door of the world, both by index; by room.
    pub door_rooms: Vec<(usize, usize)>,
}

/// Cuts one layer a state, or eight where it has a length. States of equal size that the same bridges block are
/// computed once, whatever robot they are of.
///
/// The side of a cell is the world's [`grid`](World::grid); where it has none, the image's resolution; for a vector
/// map the largest of 1, 2, 5 steps not above a seventh of the slimmest state's width.
///
/// Rooms are cut along the outlines of named areas: a cell, and so a room, lies in an area if its middle does. A named
/// door is a band of rooms one cell thick, and whoever passes it enters one of them.
///
/// # Returns
/// Within a layer the rooms are disjoint and free throughout. They cover the free space up to a cell's diagonal from
/// its limit, but for rooms one cell thin along the limit, dropped within two cells of a thicker one where that
/// separates nothing: so up to three cells' diagonals. Changes join layers of the same robot only; an
/// overlap one or two cells thin has none beside a thicker one of the same room. The error is one sentence.
///
/// # Complexity
/// Near-linear in the number of cells, times the number of states of different size.
pub fn cut_layers(world: &World, states: &[State]) -> Result<Layers, String> {
    cut_layers_anew(world, states, &KnownLayers::default())
}

/// As [`cut_layers`], taking those layers from `known` whose sizes have not changed since.
pub fn cut_layers_anew(world: &World, states: &[State], known: &KnownLayers) -> Result<Layers, String> {
    let lattice = Lattice::new(world.bounds, side(world, states)?)?;
    let mut layers = Vec::new();
    for (state, of) in states.iter().enumerate() {
        match of.length {
            None => layers.push((state, None)),
            Some(_) => layers.extend((0..FACINGS).map(|facing| (state, Some(facing)))),
        }
    }
    let sizes: Vec<Size> =
        layers.iter().map(|&(state, facing)| Size::of(world, &states[state], facing)).collect();
    let labels = Labels::new(world, lattice)?;
    let cut = known.layers(world, lattice, labels.as_ref(), &sizes);
    let mut first = 0;
    let mut stack = Vec::new();
    for ((state, facing), layer) in layers.into_iter().zip(cut) {
        let rooms = layer.rooms.len();
        stack.push(Placed { state, facing, first, layer });
        first += rooms;
    }
    let rooms = room_records(world, lattice, &stack);
    let mut crossings = doors(lattice, &stack);
    crossings.extend(changes(lattice, states, labels.as_ref(), &stack));
    crossings.par_sort_unstable_by_key(|crossing| (crossing.room1, crossing.room2));
    let members = |of: fn(&Label) -> &[usize]| match &labels {
        Some(labels) => members(labels, &stack, of),
        None => Vec::new(),
    };
    let (area_rooms, door_rooms) = (members(|label| &label.areas), members(|label| &label.doors));
    Ok(Layers { lattice, rooms, crossings, area_rooms, door_rooms })
}

fn side(world: &World, states: &[State]) -> Result<f64, String> {
    let is_length = |metres: f64| metres.is_finite() && metres > 0.0;
    for State { state, width, length, .. } in states {
        if !is_length(*width) {
            return Err(format!(
                "state `{state}` moves and is {width} m wide; a width is finite and more than 0"
            ));
        }
        if let Some(length) = length.filter(|length| !is_length(*length)) {
            return Err(format!("state `{state}` is {length} m long; a length is finite and more than 0"));
        }
    }
    let native = world.occupancy.as_ref().map(|cells| cells.resolution);
    let slimmest = states.iter().map(|state| state.length.unwrap_or(state.width).min(state.width));
    let slimmest = slimmest.fold(f64::INFINITY, f64::min);
    match world.grid.or(native) {
        Some(side) => Ok(side),
        None if slimmest.is_finite() => Ok(lattice::round_step(slimmest / 7.0)),
        None => Err("no state moves, so there is no layer to cut".to_owned()),
    }
}

fn room_records(world: &World, lattice: Lattice, stack: &[Placed]) -> Vec<Room> {
    let lowest = |rect: &Rect| {
        let above = world.bridges.iter().filter(|bridge| bridge.rect.overlaps(rect));
        above.map(|bridge| bridge.height).min_by(f64::total_cmp)
    };
    let of_layer = |placed: &Placed| {
        let facing = placed.facing.map(|facing| facing as f64 * STEP_DEGREES);
        let state = placed.state;
        let room = |&room: &Block| {
            let rect = lattice.rect(room);
            Room { state, facing, outline: rect.into(), height: lowest(&rect) }
        };
        placed.layer.rooms.iter().map(room).collect::<Vec<_>>()
    };
    stack.iter().flat_map(of_layer).collect()
}

/// For each room, by index, what of its label is asked for.
fn members(labels: &Labels, stack: &[Placed], of: fn(&Label) -> &[usize]) -> Vec<(usize, usize)> {
    let rooms = stack.iter().flat_map(|placed| &placed.layer.rooms).enumerate();
    rooms.flat_map(|(room, &block)| of(labels.of(block)).iter().map(move |&named| (room, named))).collect()
}

fn doors(lattice: Lattice, stack: &[Placed]) -> Vec<Crossing> {
    let of_layer = |placed: &Placed| {
        let Placed { layer, first, .. } = placed;
        let door = |(a, b): (u32, u32)| {
            let (a, b) = (a as usize, b as usize);
            let rect = lattice.rect(layer.rooms[a].clip(&layer.rooms[b]));
            Crossing { kind: Kind::Door, room1: first + a, room2: first + b, rect }
        };
        layer.beside.iter().copied().map(door).collect::<Vec<_>>()
    };
    stack.par_iter().map(of_layer).collect::<Vec<_>>().concat()
}
