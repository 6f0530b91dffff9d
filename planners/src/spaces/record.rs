//! Spaces and doorways, as they are found.

use crate::geometry::{Point, Segment};

/// A part of the floor that people see as one.
#[derive(Clone, Debug, PartialEq)]
pub struct Space {
    /// Rings of corners, metres: the outer one first, counterclockwise, then holes.
    pub outline: Vec<Vec<Point>>,
    /// Square metres.
    pub area: f64,
    /// A point inside, where it is widest.
    pub at: Point,
    /// Metres across, where it is widest.
    pub breadth: f64,
}

/// Where one comes from a space into another.
#[derive(Clone, Debug, PartialEq)]
pub struct Doorway {
    /// By index, the lower one first.
    pub spaces: [usize; 2],
    pub segment: Segment,
    /// The named door that is drawn there, by index.
    pub named: Option<usize>,
}
