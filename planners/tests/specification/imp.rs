//! A simulated robot and what it makes of what it senses: the composite local model and the corrected pose.
#![allow(clippy::print_stdout, reason = "figures are printed for who asks")]

mod model;
mod plans;
mod simulated;
mod table;
mod tour;
