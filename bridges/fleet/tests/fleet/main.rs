//! Vehicles on a broker, as a fleet's integrator sees them.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

mod alone;
mod drives;
mod fuzz;
mod judge;
mod malformed;
mod messages;
mod rows;
mod storm;
mod waits;
mod ways;
mod yard;
mod zones;
