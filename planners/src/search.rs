//! Search on graphs and grids, shared by all planners.

pub mod bottleneck;
mod by_value;
mod csr;
pub mod grid;

pub use by_value::ByValue;
pub use csr::Csr;
