//! Floor plans: regions, doorways, adits and ways.
#![allow(clippy::float_cmp)] // a direction is removed that was put in, to the bit

mod bad_input;
mod dice;
mod hertel_mehlhorn;
mod maps_of_before;
mod oracle;
mod paths;
mod random_plan;
mod rays;
mod regions;
