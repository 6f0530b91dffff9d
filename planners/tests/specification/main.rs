//! What the planners promise: the papers' tables number by number, properties of random maps, and maps of others.

// clippy knows test functions, but not their helpers.
#![allow(clippy::unwrap_used)]

mod adapt;
mod assembly;
mod bad_vector_maps;
mod corridor;
mod floor_plan;
mod footprint;
mod footprints;
mod hierarchy;
mod hospital;
mod imp;
mod lanes;
mod layers;
mod narrowest;
mod navigation;
mod outlines;
mod real_maps;
mod rooms;
mod ros_maps;
mod routes;
mod salt;
mod spaces;
mod taut;
