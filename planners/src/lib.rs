//! Geometry and search for Adit: pure functions from a world to typed records (rooms, doors), and from
//! weighted records to routes. No SQL, no rules.

#![allow(missing_docs, reason = "a name that says it all needs no sentence that repeats it")]

pub mod adapt;
pub mod body;
pub mod bridges;
pub mod channels;
pub mod clearance;
pub mod doors;
pub mod facts;
pub mod figures;
pub mod floor_plan;
pub mod geometry;
mod known;
pub mod lanes;
pub mod layers;
pub mod local_model;
pub mod minimum;
pub mod names;
pub mod navigation;
pub mod overlays;
pub mod planner;
pub mod pose;
pub mod prime_areas;
pub mod random;
pub mod read;
pub mod rect_index;
pub mod rim;
pub mod rooms;
pub mod routes;
pub mod search;
pub mod simulator;
mod skyline;
pub mod spaces;
pub mod strips;
pub mod world;
