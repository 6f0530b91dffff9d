//! Adapt (Chen 1994): the figures of the paper, and what must hold whatever the cell.

mod arm_scenario;
mod bad_input;
mod changes;
mod figure_3;
mod figure_5;
mod free_paths;
mod own_scenario;
mod plugins;
mod restart;
mod sliding;
mod strategies;
pub mod support;
mod two_step;
mod work;
