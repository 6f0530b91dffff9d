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
//! With `rho = width / 2 + gap` for each junction, and with decisions that lead to where a line from the robot touches the
//! circle, these are the only bounds ([`DriveError`]):
//! 1. A gap is a number, and not negative.
//! 2. Start and goal are farther than `rho` from the corner next to them, and at least `rho` to the side of its inner
//!    wall, that is, of the line on which this wall lies.
//! 3. Corners that follow each other are at least `rho1 + rho2` apart for turns of opposite senses, `|rho1 - rho2|` for
//!    turns of the same.
//! 4. No wall is hit. Where no gap is above the safest one of its junction, that happens only where start or goal leave
//!    the robot no room in their own channel, or where it turns from a given heading.
//!
//! Where no gap is above the safest one, the robot keeps the least gap from the first junction to the last, unless a dead
//! end is so near that it is still, or already, beside the robot; before and after, the smaller of the gap and what start
//! and goal leave it in their own channel.
//!
//! A channel that ends inside another is taken for one that goes on to the other's far side, which is as free. Where the
//! way passes a circle by, the robot need not turn round that corner, and drives straight on: [`TurnMade::angle`] is 0.
//!
//! # Example
//! ```
//! use adit_planners::channels::corridor::{Axis, Corridors, Extreme, Offset, Part, Robot, Steer, StepFacts, Turn};
//! use adit_planners::geometry::{Point, Rect};
//!
//! let corridors = Corridors::new(&[Rect::new(0.0, 0.0, 3.0, 9.0), Rect::new(0.0, 6.0, 9.0, 9.0)])?;
//! let by_length = |passage: &adit_planners::channels::corridor::Passage| Ok::<_, String>(Some(passage.length));
//! let route = corridors.route(Point::new(1.5, 2.0), Point::new(7.0, 7.5), by_length)?;
//! assert_eq!(route.junctions(), [1]);
//!
//! // Rule 1: up, then right
//! let rule_1 = |_: &StepFacts| {
//!     Ok::<_, String>(Steer {
//!         rule: Some(1),
//!         corner: (Extreme::Max, Extreme::Min),
//!         turn: Turn::Right,
//!         gap: 0.2,
//!         arriving: (
//!             Offset { is_negative: true, part: Part::Cos },
//!             Offset { is_negative: false, part: Part::Sin },
//!         ),
//!         measured_along: Axis::X,
//!     })
//! };
//! let drive = route.drive(Robot { width: 1.0, length: 1.5 }, None, rule_1)?;
//! assert!((drive.length - 9.256_241).abs() < 1e-6);
//! assert!((drive.min_clearance - 0.2).abs() < 1e-9);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

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
mod tangents;
mod turning;
mod walls;

pub use axis::Axis;
pub use body::Robot;
pub use drive::{Drive, Primitive, TurnMade};
pub use drive_error::DriveError;
pub use network::{CorridorError, Corridors, Junction, Overlap};
pub use passage::{End, Passage};
pub use route::{Route, Through};
pub use route_error::{NoRoute, RouteError};
pub use steer::{Extreme, Offset, Part, Steer, StepFacts, Turn};
pub use walls::Wall;
