//! Search on graphs and grids, shared by all planners.

mod by_value;
mod csr;
pub mod grid;

pub use by_value::ByValue;
pub use csr::Csr;
