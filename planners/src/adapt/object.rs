//! What stands in a cell.

use super::shape::Shape;
use crate::geometry::Point;
use crate::pose::{Frame, Pose};

/// Something solid in the cell, which may move, turn, change its shape, come and go between tasks.
#[derive(Clone, Debug, PartialEq)]
pub struct Object {
    /// By which it is known over changes; unique in its cell.
    pub name: String,
    /// Its outline, in its own frame.
    pub shape: Shape,
    /// Where its frame lies in the cell: metres, radians.
    pub pose: Pose,
    /// Whether it is said to move now and then; a fact for whoever chooses landmarks.
    pub is_movable: bool,
}

impl Object {
    /// An object that stands still, its frame being that of the cell.
    pub fn fixed(name: impl Into<String>, shape: Shape) -> Self {
        Self { name: name.into(), shape, pose: Pose::default(), is_movable: false }
    }

    /// The corners of its outline, in the frame of the cell.
    pub fn corners(&self) -> Vec<Point> {
        let frame = Frame::from(&self.pose);
        self.shape.corners().iter().map(|&corner| frame.place(corner)).collect()
    }
}
