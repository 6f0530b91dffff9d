//! The site, as its service answers: the only thing that the fleet knows of it.

mod tables;

pub use adit_site::{Followed, Route, Site, Step, Trouble, Waypoint, query};
pub use tables::{Fleet, Meaning, State, VEHICLES, Vehicle};
