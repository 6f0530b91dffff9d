//! A ROS 2 node that plans routes of a site that is served, in pure Rust: no ROS installation is needed.
//!
//! It is a client of the site's service as anybody's program would be. [`msgs`] is what goes over the wire, [`planner`] asks the
//! site and words what is wrong, [`actions`] are ROS 2's actions over `ros2-client`, [`node`] joins them.

mod actions;
mod body;
pub mod cli;
mod ears;
mod failure;
mod frames;
mod grid;
mod keepout;
mod msgs;
mod node;
mod path;
mod planner;
mod plans;
mod presence;
mod shown;
mod told;
mod track;
mod whereabouts;
