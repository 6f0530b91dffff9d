//! Rooms by state: one layer of rooms for each state of each robot, and the crossings within and between them.
//!
//! A layer is the free space of a disc as wide as the state: the places of its centre. A state that has a length is a
//! body that cannot turn everywhere, and has a layer for each of eight facings, 22.5 degrees apart. Where the rooms of the
//! paper ask whether a rectangle is wide enough, here every point of a room is a point at which the state fits.

mod cells;
mod changes;
mod clearance;
mod dents;
mod footprint;
mod free_space;
mod gap;
mod ground;
mod grown;
mod headroom;
mod known;
mod labels;
mod lattice;
mod layer;
mod narrowest;
mod overlaps;
mod pieces;
mod places;
mod planner;
mod record;
mod traced;
mod transform;
mod walls;

use changes::{changes, may_change};
use footprint::FACINGS;
use labels::Label;
use layer::{Placed, Size};

use rayon::prelude::*;

use crate::geometry::Convex;
use crate::geometry::polygon::sides;
use crate::rooms::outline::shared;
use crate::world::World;

pub(crate) use footprint::{STEP_DEGREES, body};
pub(crate) use free_space::Solid;
pub use headroom::{Headroom, headroom};
pub use known::KnownLayers;
pub use lattice::{Lattice, MAX_CELLS};
pub use narrowest::{Narrowest, narrowest};
pub use planner::RoomsByState;
pub use record::{Crossing, Kind, Room, State};
pub(crate) use transform::{squared_gaps, squared_gaps_by_rows};

/// Passages from state to state that a floor may have: some gigabyte.
const PASSAGES: usize = 2_000_000;

#[derive(Clone, Debug, PartialEq)]
pub struct Layers {
    /// By state, then as made: largest first.
    pub rooms: Vec<Room>,
    /// By (room1, room2); there is at most one from a room into another.
    pub crossings: Vec<Crossing>,
    /// Which room lies in which area of the world, both by index; by room.
    pub area_rooms: Vec<(usize, usize)>,
    /// Which room lies in which named door of the world, both by index; by room.
    pub door_rooms: Vec<(usize, usize)>,
}

impl Layers {
    /// The area in which a shape is changed.
    pub fn area(&self, change: &Crossing) -> Convex {
        let [one, other] = [change.room1, change.room2].map(|room| &self.rooms[room].outline);
        shared(one, other, change.across.bounds())
    }
}

/// Cuts one layer a state, or eight where it has a length. States of equal size that the same bridges block are
/// computed once, whatever robot they are of.
///
/// A layer is everything solid grown by the state, taken from the floor: exactly along walls; about corners a disc's arc is
/// drawn around by tangents a quarter of a turn apart, and exactly where something else is near, or where it dips into a gap
/// that it does not pass. An image's walls are made straight where that closes no gap that a disc passes, outwards by at most a
/// cell.
///
/// Rooms are cut along the outlines of named areas; of those that are entered by any part of the robot, along the outline of
/// where its middle then is. A named door is a band of rooms, and whoever passes it enters one of them.
///
/// # Returns
/// Within a layer the rooms are convex, disjoint and free throughout, and cover the free space as it was drawn but for dents of up
/// to 2 cm. Changes join layers of the same robot only; an overlap thinner than 10 cm has none beside a thicker one of the same room. The
/// error is one sentence.
///
/// # Complexity
/// O(n log n) in the number of corners of walls, times the number of states of different size.
pub fn cut_layers(world: &World, states: &[State]) -> Result<Layers, String> {
    cut_layers_anew(world, states, &[], &KnownLayers::default())
}

/// As [`cut_layers`], taking those layers from `known` whose sizes have not changed since.
///
/// # Arguments
/// `whole` are the areas, by number, that are entered by any part of the robot; others are by its middle.
pub fn cut_layers_anew(
    world: &World,
    states: &[State],
    whole: &[usize],
    known: &KnownLayers,
) -> Result<Layers, String> {
    check(states)?;
    let mut layers = Vec::new();
    for (state, of) in states.iter().enumerate() {
        match of.length {
            None => layers.push((state, None)),
            Some(_) => layers.extend((0..FACINGS).map(|facing| (state, Some(facing)))),
        }
    }
    let sizes: Vec<Size> =
        layers.iter().map(|&(state, facing)| Size::of(world, &states[state], facing, whole)).collect();
    let cut = known.layers(world, &sizes)?;
    let mut first = 0;
    let mut stack = Vec::new();
    for ((state, facing), layer) in layers.into_iter().zip(cut) {
        let rooms = layer.rooms.len();
        stack.push(Placed { state, facing, first, layer });
        first += rooms;
    }
    check_passages(states, &stack)?;
    let mut crossings = changes(states, &stack, known)?;
    crossings.reserve_exact(stack.iter().map(|placed| placed.layer.beside.len()).sum());
    crossings.extend(stack.iter().flat_map(doors));
    crossings.par_sort_unstable_by_key(|crossing| (crossing.room1, crossing.room2));
    let members = |of: fn(&Label) -> &[usize]| {
        let labels = stack.iter().flat_map(|placed| &placed.layer.labels).enumerate();
        labels.flat_map(|(room, label)| of(label).iter().map(move |&named| (room, named))).collect()
    };
    let (area_rooms, door_rooms) = (members(|label| &label.areas), members(|label| &label.doors));
    let rooms = stack.iter().flat_map(|placed| rooms(world, placed)).collect();
    Ok(Layers { rooms, crossings, area_rooms, door_rooms })
}

/// Free space for a point where walls are made straight, and for what keeps the world's clearance; square metres.
pub(crate) fn free_areas(world: &World) -> [f64; 2] {
    let solid = walls::Walls::new(world).straight(&[]);
    [0.0, world.clearance].map(|keep| {
        let free = grown::Moved::Disc(keep).free_space(world.bounds, &solid);
        free.iter().flat_map(|ring| sides(ring)).map(|side| side.a.cross(side.b)).sum::<f64>() / 2.0
    })
}

fn check(states: &[State]) -> Result<(), String> {
    let is_length = |metres: f64| metres.is_finite() && metres > 0.0;
    for State { state, height, width, length, .. } in states {
        if !is_length(*width) {
            return Err(format!(
                "state `{state}` moves and is {width} m wide; a width is finite and more than 0"
            ));
        }
        if !is_length(*height) {
            return Err(format!(
                "state `{state}` moves and is {height} m high; a height is finite and more than 0"
            ));
        }
        if let Some(length) = length.filter(|length| !is_length(*length)) {
            return Err(format!("state `{state}` is {length} m long; a length is finite and more than 0"));
        }
    }
    if states.is_empty() { Err("no state moves, so there is no layer to cut".to_owned()) } else { Ok(()) }
}

/// Refuses what would take minutes and gigabytes, before it does: passages from state to state grow with the square of the
/// states of one robot. There are about as many as rooms of the two layers of each pair.
fn check_passages(states: &[State], stack: &[Placed]) -> Result<(), String> {
    let rooms = |placed: &Placed| placed.layer.rooms.len();
    let pairs =
        (0..stack.len()).flat_map(|from| (from + 1..stack.len()).map(move |to| (&stack[from], &stack[to])));
    let pairs = pairs.filter(|(from, to)| may_change(states, from, to));
    let passages: usize = pairs.map(|(from, to)| rooms(from) + rooms(to)).sum();
    if passages <= PASSAGES {
        return Ok(());
    }
    Err(format!(
        "the rooms of {} states ({} rooms in {} layers) have some {:.1} million passages from state to state, more than {} \
         million; take fewer states, or several robots",
        states.len(),
        stack.iter().map(rooms).sum::<usize>(),
        stack.len(),
        passages as f64 / 1e6,
        PASSAGES / 1_000_000
    ))
}

fn rooms<'a>(world: &'a World, placed: &'a Placed) -> impl Iterator<Item = Room> + 'a {
    let lowest = |outline: &Convex| {
        let above = world.bridges.iter().filter(|bridge| {
            let is_near = bridge.rect.overlaps(&outline.bounds());
            is_near && outline.common(&bridge.rect.into()).is_some()
        });
        above.map(|bridge| bridge.height).min_by(f64::total_cmp)
    };
    let facing = placed.facing.map(|facing| facing as f64 * STEP_DEGREES);
    placed.layer.rooms.iter().map(move |outline| Room {
        state: placed.state,
        facing,
        outline: outline.clone(),
        radius: placed.layer.radius,
        height: lowest(outline),
    })
}

fn doors(placed: &Placed) -> impl Iterator<Item = Crossing> + '_ {
    let first = placed.first;
    placed.layer.beside.iter().map(move |&(a, b, across)| {
        let (room1, room2) = (first + a as usize, first + b as usize);
        Crossing { kind: Kind::Door, room1, room2, across, at: across.middle(), width: across.length() }
    })
}
