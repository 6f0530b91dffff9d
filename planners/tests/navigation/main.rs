//! The navigator: straight legs, detours, closed ways, and missions to judge it by.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

mod learn;
mod longer;
mod missions;
mod routed;
mod scene;
mod states;
mod table;
mod whereabouts;
