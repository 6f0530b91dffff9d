//! kb

pub mod draw;
