//! Geometry and search for Adit: pure functions from a world to typed records (rooms, doors), and from
//! weighted records to routes. No SQL, no rules.

pub mod facts;
pub mod geometry;
pub mod layers;
pub mod names;
pub mod planner;
pub mod read;
pub mod routes;
pub mod world;
