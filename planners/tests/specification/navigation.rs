//! The navigator: straight legs, detours, closed ways, and missions to judge it by.

mod learn;
mod longer;
mod missions;
mod routed;
mod scene;
mod states;
mod table;
mod whereabouts;
