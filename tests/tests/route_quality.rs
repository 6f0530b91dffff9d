//! Routes are as good as the best way, judged by means that share nothing with the search.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

#[path = "route_quality/judge.rs"]
mod judge;
#[path = "route_quality/many_maps.rs"]
mod many_maps;
#[path = "route_quality/metamorphic.rs"]
mod metamorphic;
#[path = "route_quality/occupancy_maps.rs"]
mod occupancy_maps;
#[path = "route_quality/off_walls.rs"]
mod off_walls;
#[path = "route_quality/random_maps.rs"]
mod random_maps;
#[path = "route_quality/turned_images.rs"]
mod turned_images;
