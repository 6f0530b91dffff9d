//! A rectangular robot that drives through corridors (Lee, section 5): about each junction it drives a quarter circle or
//! less, and between them straight.
//!
//! [`Corridors`] are read once. [`Corridors::route`] chooses which of them to take, by weights from outside.
//! [`Route::drive`] asks for each junction which corner the robot is to turn round, how far from it, and where the
//! guiding circle is reached (Table 2); it joins the answers to lines and arcs, and measures what is left between the
//! robot and the walls.
//!
//! Channels and junctions are numbered from 1, here and in all messages. All lengths are metres in the map's frame, all
//! angles radians, counter-clockwise from the x axis.
//!
//! # When a drive is refused
//! With `rho = width / 2 + gap` for each junction, and with a steering that is tangent to its circles, these are the only
//! bounds ([`DriveError`]):
//! 1. A gap is a number, and not negative.
//! 2. Start and goal are farther than `rho` from the corner turned round next to them, and as far as `rho` to the side of
//!    the inner wall, that is, of the line on which that wall lies.
//! 3. Two corners are at least `rho1 + rho2` apart for turns of opposite senses, `|rho1 - rho2|` for turns of the same.
//! 4. No wall is hit. Where no gap is above the safest one of its junction, that can happen only next to start and goal
//!    (where they leave too little, or where the robot turns from a given heading), and at a junction of which another
//!    opening lies so near that the robot's outer corner reaches a wall beyond it.
//!
//! Where the way passes a circle by, the robot need not turn round that corner, and drives straight on:
//! [`TurnMade::angle`] is 0 there.

mod assemble;
mod axis;
mod body;
mod circle;
mod decide;
mod drive;
mod drive_error;
mod network;
mod passage;
mod route;
mod route_error;
mod steer;
mod sweep;
mod taut;
mod turning;
mod walls;

pub use axis::Axis;
pub use body::Robot;
pub use drive::{Drive, Primitive, TurnMade};
pub use drive_error::DriveError;
pub use network::{CorridorError, Corridors, Junction, Overlap};
pub use passage::{End, Passage};
pub use route::Route;
pub use route_error::{NoRoute, RouteError};
pub use steer::{Extreme, Offset, Part, Steer, StepFacts, Turn};
pub use walls::Wall;
