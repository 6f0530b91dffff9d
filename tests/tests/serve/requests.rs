//! What differs little with the database that a site is in: requests that are refused, who may come in, what a service says of itself
//! and of its routes, and what hostile requests may take.

mod described;
mod errands;
mod failures;
mod floor;
pub mod follow;
mod hostile;
mod roles;
mod sql;
mod whereabouts;

use crate::suite::{hardness, served, within_a_second};
