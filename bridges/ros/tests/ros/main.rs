//! ROS 2 clients that others wrote (rclpy) ask the node for plans, as an integrator sees it.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

mod actions;
mod floor;
mod malformed;
mod masks;
mod plans;
mod storm;
mod tracks;
