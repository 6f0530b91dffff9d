//! The judge itself is right: where the best way is known in closed form, it finds it within one per cent.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

#[path = "route_quality/judge.rs"]
mod judge;
#[path = "route_quality/random_maps.rs"]
mod random_maps;
