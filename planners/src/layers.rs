//! Rooms by state: one layer of rooms for each state of each robot, and the crossings within and between them.
//!
//! A layer is the free space of a disc as wide as the state: the places of its centre. Where the rooms of the
//! paper ask whether a rectangle is wide enough, here every point of a room is a point at which the state fits.

mod bottleneck;
mod cells;
mod clearance;
mod cut;
mod free_space;
mod gap;
mod headroom;
mod labels;
mod lattice;
mod maximal;
mod narrowest;
mod neighbours;
mod planner;
mod slivers;
mod transform;

use cells::CellRect;
use labels::{Label, Labels};
use neighbours::{Owners, boundary};
use rayon::prelude::*;

use crate::geometry::Rect;
use crate::world::World;

pub(crate) use free_space::Solid;
pub use headroom::{Headroom, headroom};
pub use lattice::{Lattice, MAX_CELLS};
pub use narrowest::{Narrowest, narrowest};
pub use planner::RoomsByState;

/// A state in which a robot can move.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// The robot; `None` where there is but one, without a name.
    pub robot: Option<String>,
    /// The state's name.
    pub state: String,
    /// Metres.
    pub height: f64,
    /// Metres, more than 0.
    pub width: f64,
}

/// A room of one state's layer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Room {
    /// The state, by its index.
    pub state: usize,
    /// Where the robot's centre may be.
    pub rect: Rect,
    /// The lowest bridge above the room, metres; `None` where there is none.
    pub height: Option<f64>,
}

/// How a robot comes from one room into another.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// Through a common boundary, both ways, without a change of shape.
    Door,
    /// By a change of shape where the rooms of two states overlap; from the first room into the second.
    Change,
}

/// A way from one room into another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// What sort of way.
    pub kind: Kind,
    /// A room, by its index.
    pub room1: usize,
    /// The other room; more than `room1` for a door.
    pub room2: usize,
    /// The common boundary segment of a door, the overlap of a change.
    pub rect: Rect,
}

/// All layers of a world.
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

/// Cuts one layer a state. States of equal width that the same bridges block are computed once.
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
/// separates nothing: so up to three cells' diagonals. Changes join layers of the same robot only. The error is one sentence.
///
/// # Complexity
/// Near-linear in the number of cells, times the number of states of different size.
pub fn cut_layers(world: &World, states: &[State]) -> Result<Layers, String> {
    let lattice = Lattice::new(world.bounds, side(world, states)?)?;
    let solid = Solid::new(world, lattice);
    let labels = Labels::new(world, lattice)?;
    let sizes: Vec<Size> = states.iter().map(|state| Size::of(world, state)).collect();
    let mut distinct: Vec<&Size> = Vec::new();
    for size in &sizes {
        if !distinct.contains(&size) {
            distinct.push(size);
        }
    }
    let layers: Vec<Layer> =
        distinct.par_iter().map(|size| Layer::cut(world, &solid, (lattice, labels.as_ref()), size)).collect();
    let index = |size: &Size| distinct.iter().position(|known| *known == size);
    let of_state: Vec<&Layer> = sizes.iter().filter_map(index).map(|layer| &layers[layer]).collect();
    let first_room: Vec<usize> = of_state
        .iter()
        .scan(0, |next, layer| {
            let first = *next;
            *next += layer.rooms.len();
            Some(first)
        })
        .collect();
    let rooms = room_records(world, lattice, states, &of_state);
    let mut crossings = doors(lattice, &of_state, &first_room);
    crossings.extend(changes(lattice, states, &of_state, &first_room));
    crossings.sort_by_key(|crossing| (crossing.room1, crossing.room2));
    let members = |of: fn(&Label) -> &[usize]| match &labels {
        Some(labels) => members(labels, &of_state, of),
        None => Vec::new(),
    };
    let (area_rooms, door_rooms) = (members(|label| &label.areas), members(|label| &label.doors));
    Ok(Layers { lattice, rooms, crossings, area_rooms, door_rooms })
}

fn side(world: &World, states: &[State]) -> Result<f64, String> {
    let narrow = states.iter().find(|state| !(state.width.is_finite() && state.width > 0.0));
    if let Some(State { state, width, .. }) = narrow {
        return Err(format!(
            "state `{state}` moves and is {width} m wide; a width is finite and more than 0"
        ));
    }
    let native = world.occupancy.as_ref().map(|cells| cells.resolution);
    let slimmest = states.iter().map(|state| state.width).fold(f64::INFINITY, f64::min);
    match world.grid.or(native) {
        Some(side) => Ok(side),
        None if slimmest.is_finite() => Ok(lattice::round_step(slimmest / 7.0)),
        None => Err("no state moves, so there is no layer to cut".to_owned()),
    }
}

/// What of a state decides its layer.
#[derive(Clone, Debug, PartialEq)]
struct Size {
    width: f64,
    /// Indices of the bridges that it does not pass.
    low: Vec<usize>,
}

impl Size {
    fn of(world: &World, state: &State) -> Self {
        let passes = |height: f64| state.height < height;
        let low = (0..world.bridges.len()).filter(|&bridge| !passes(world.bridges[bridge].height));
        Self { width: state.width, low: low.collect() }
    }
}

struct Layer {
    rooms: Vec<CellRect>,
    owners: Owners,
}

impl Layer {
    fn cut(
        world: &World,
        solid: &Solid<'_>,
        (lattice, labels): (Lattice, Option<&Labels>),
        size: &Size,
    ) -> Self {
        let low: Vec<Rect> = size.low.iter().map(|&bridge| world.bridges[bridge].rect).collect();
        let free = solid.free_cells(size.width / 2.0 + world.clearance, &low);
        let rooms = slivers::drop_slivers(&free, &cut::cut_along(&free, labels), labels);
        let owners = Owners::new(lattice.columns(), lattice.rows(), &rooms);
        Self { rooms, owners }
    }
}

fn room_records(world: &World, lattice: Lattice, states: &[State], layers: &[&Layer]) -> Vec<Room> {
    let lowest = |rect: &Rect| {
        let above = world.bridges.iter().filter(|bridge| bridge.rect.overlaps(rect));
        above.map(|bridge| bridge.height).min_by(f64::total_cmp)
    };
    let of_state = |state: usize| {
        layers[state].rooms.iter().map(move |&room| {
            let rect = lattice.rect(room);
            Room { state, rect, height: lowest(&rect) }
        })
    };
    (0..states.len()).flat_map(of_state).collect()
}

/// For each room, by index, what of its label is asked for.
fn members(labels: &Labels, layers: &[&Layer], of: fn(&Label) -> &[usize]) -> Vec<(usize, usize)> {
    let rooms = layers.iter().flat_map(|layer| &layer.rooms).enumerate();
    rooms.flat_map(|(room, &block)| of(labels.of(block)).iter().map(move |&named| (room, named))).collect()
}

fn doors(lattice: Lattice, layers: &[&Layer], first_room: &[usize]) -> Vec<Crossing> {
    let of_layer = |(layer, &first): (&&Layer, &usize)| {
        let door = |(a, b): (u32, u32)| {
            let (a, b) = (a as usize, b as usize);
            let rect = lattice.rect(boundary(layer.rooms[a], layer.rooms[b]));
            Crossing { kind: Kind::Door, room1: first + a, room2: first + b, rect }
        };
        layer.owners.beside().into_iter().map(door).collect::<Vec<_>>()
    };
    layers.iter().zip(first_room).flat_map(of_layer).collect()
}

fn changes(lattice: Lattice, states: &[State], layers: &[&Layer], first_room: &[usize]) -> Vec<Crossing> {
    let mut found = Vec::new();
    for from in 0..states.len() {
        for to in from + 1..states.len() {
            if states[from].robot != states[to].robot {
                continue;
            }
            for (a, b) in layers[from].owners.over(&layers[to].owners) {
                let (a, b) = (a as usize, b as usize);
                let common = boundary(layers[from].rooms[a], layers[to].rooms[b]);
                let rect = lattice.rect(common);
                let (room1, room2) = (first_room[from] + a, first_room[to] + b);
                let kind = Kind::Change;
                found.push(Crossing { kind, room1, room2, rect });
                found.push(Crossing { kind, room1: room2, room2: room1, rect });
            }
        }
    }
    found
}
