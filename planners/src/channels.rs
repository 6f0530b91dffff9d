//! Channels and junctions: free space as a chain of boxes, through which rules steer (Lee).

pub mod assembly;
