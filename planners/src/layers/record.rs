//! States, rooms, and the crossings from room to room.

use crate::geometry::{Convex, Point, Segment};

/// A state in which a robot can move.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// The robot; `None` where there is but one, without a name.
    pub robot: Option<String>,
    pub state: String,
    /// Metres.
    pub height: f64,
    /// Metres, more than 0; across the facing.
    pub width: f64,
    /// Metres along the facing; `None` for a disc of its width, which turns on the spot.
    pub length: Option<f64>,
}

/// A room of one state's layer.
#[derive(Clone, Debug, PartialEq)]
pub struct Room {
    /// The state, by its index.
    pub state: usize,
    /// How the body lies there, degrees counterclockwise from x, less than 180; `None` for a disc.
    pub facing: Option<f64>,
    /// Where the robot's centre may be.
    pub outline: Convex,
    /// How far it keeps from walls, metres; `None` for what is no disc.
    pub radius: Option<f64>,
    /// The lowest bridge above the room, metres; `None` where there is none.
    pub height: Option<f64>,
}

/// How a robot comes from one room into another.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// Through a common boundary, both ways, without a change of shape.
    Door,
    /// By a change of shape, or a turn to the next facing, where rooms of two layers overlap; from the first room
    /// into the second.
    Change,
}

/// A way from one room into another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    pub kind: Kind,
    pub room1: usize,
    /// The other room; more than `room1` for a door.
    pub room2: usize,
    /// The common boundary of a door; of a change opposite corners of the least rectangle about what both rooms have in
    /// common, of a turn of a rectangle in which the body can turn.
    pub across: Segment,
    /// Where it is on the map: the middle of a door, the centre of the area in which a shape is changed.
    pub at: Point,
    /// How wide that is, metres.
    pub width: f64,
}
