//! What is the same whatever database a site is in: requests that are refused, what a service says of itself, the floor as it is
//! sent, and what hostile requests may take.

mod described;
mod failures;
mod floor;
mod hostile;

use crate::suite::{hardness, served};
