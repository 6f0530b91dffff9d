//! The site, as its service answers: the only thing that the fleet knows of it.

mod http;
mod route;
mod tables;
mod zones;

pub use http::{Site, Trouble, query};
pub use route::{Followed, Route, Step, Waypoint};
pub use tables::{Fleet, Meaning, State, VEHICLES, Vehicle};
pub use zones::{Area, Meaning as ZoneMeaning};
