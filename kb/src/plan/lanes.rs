//! Lane graphs of fleets as sites: nodes, lanes, doors and lifts are tables, rules say what a vehicle type makes of each lane,
//! and routes over them are Dijkstra's.

pub mod course;
pub mod export;
pub mod judge;
pub mod routes;
mod seed;
pub mod tables;
pub mod travel;
