//! A simulated robot and what it makes of what it senses: the composite local model and the corrected pose.
#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
#![allow(clippy::print_stdout, reason = "figures are printed for who asks")]

#[path = "imp/model.rs"]
mod model;
#[path = "imp/plans.rs"]
mod plans;
#[path = "imp/simulated.rs"]
mod simulated;
#[path = "imp/table.rs"]
mod table;
#[path = "imp/tour.rs"]
mod tour;
