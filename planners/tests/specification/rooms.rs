//! From a map to prime areas, rooms and doors, as the paper has them.
#![allow(clippy::float_cmp, reason = "edges are copied, never computed, so they are equal or wrong")]

mod doors;
mod fewest_rooms;
mod golden_maps;
mod maps;
mod oracle;
mod paper_example;
mod paper_rooms;
mod prime_areas;
