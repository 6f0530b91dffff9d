//! The navigator of the IMP (Crowley 1985, sections 4.1 and 4.4 to 4.6): it drives a body to a goal in a known building, and
//! round what it meets on the way.
//!
//! A path over the network of places is gone leg by leg, straight, as the states of Figure 5 follow one another. While the
//! robot moves, the distance to the goal point, the legal highway, the free way ahead and the skirt are watched. Where
//! the way is blocked, detours left and right are planned in the local model; where none is free, the way is reported
//! closed and another one is looked for. What is decided, and what a way weighs, comes from a [`Judge`].

mod cuts;
mod detour;
mod drive;
mod event;
mod field;
mod free_grid;
mod highway;
mod judge;
mod known;
pub mod learn;
mod machine;
mod mission;
mod missions;
mod navigator;
mod route;
mod router;
mod run;
mod settings;
mod stretch;
mod together;
mod tour;
mod trip;

pub use drive::{Driven, Order, drive};
pub use event::{Ending, Event, Happening};
pub use judge::{Action, Judge, Mode, State, StateDecision, StateFacts, WayFacts};
pub use known::Building;
pub use machine::trip;
pub use mission::{Drivable, Entry, Kidnapping, Mission, Outcome, Outfit, Possible, ROOM_M, Underway};
pub use missions::{draw, draw_along, draw_kidnapping, stops};
pub use navigator::Navigator;
pub use router::{Met, Router};
pub use run::run;
pub use settings::Settings;
pub use stretch::Stretch;
pub use together::{Door, things_about};
pub use tour::{Tour, Wrong};
pub use trip::{Advance, Pace, Trip};
