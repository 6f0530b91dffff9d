//! Paths through channels: free space as boxes that meet at right angles in junctions, and rules say how each junction is
//! passed (Lee, "Rule-Based Path Finding Algorithm for Part Assembly and Its Extension to Mobile Robot Path Planning").

pub mod assembly;
pub mod corridor;
mod junctions;

pub use junctions::{CorridorJunctions, PartJunctions};
