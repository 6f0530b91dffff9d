//! The site, as its service answers: the only thing that the fleet knows of it.

mod tables;
mod zones;

pub use adit_site::{Followed, Route, Site, Step, Trouble, Waypoint, query};
pub use tables::{Fleet, Meaning, State, VEHICLES, Vehicle};
pub use zones::{Area, Meaning as ZoneMeaning};
