//! What stands in a cell.

use super::shape::Shape;
use crate::geometry::Point;
use crate::pose::Pose;
use crate::segment::Segment;

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
        self.shape.corners().iter().map(|c| self.pose.then(&Pose::new(c.x, c.y, 0.0)).at).collect()
    }
}

/// The frame of an object, ready to turn segments of the cell into it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    at: Point,
    sin: f64,
    cos: f64,
}

impl Frame {
    pub fn new(pose: &Pose) -> Self {
        let (sin, cos) = pose.heading.sin_cos();
        Self { at: pose.at, sin, cos }
    }

    pub fn inward(&self, segment: &Segment) -> Segment {
        Segment::new(self.point(segment.a), self.point(segment.b))
    }

    fn point(&self, p: Point) -> Point {
        let (dx, dy) = (p.x - self.at.x, p.y - self.at.y);
        Point::new(self.cos * dx + self.sin * dy, self.cos * dy - self.sin * dx)
    }
}
