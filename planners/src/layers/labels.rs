//! Which named areas and doors a room lies in. Rooms are cut along their outlines, so that none lies in one in part.
//!
//! A named door is a band along its segment: whoever passes the door enters a room of the band.

use crate::geometry::{Convex, Point, Rect, Segment, polygon};
use crate::world::{NamedDoor, Shape, World};

/// The band of a named door is so broad, metres.
const BAND_M: f64 = 0.05;

/// The areas and doors that a room lies in, by their index in the world.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub(super) struct Label {
    pub(super) areas: Vec<usize>,
    pub(super) doors: Vec<usize>,
}

/// The outlines of areas, and the bands of doors.
pub(super) struct Labels {
    areas: Vec<Outline>,
    doors: Vec<Outline>,
}

struct Outline {
    corners: Vec<Point>,
    bounds: Rect,
}

impl From<Vec<Point>> for Outline {
    fn from(corners: Vec<Point>) -> Self {
        Self { bounds: Rect::around(corners.iter().copied()), corners }
    }
}

impl Outline {
    fn holds(&self, p: Point) -> bool {
        self.bounds.contains(p) && polygon::encloses(polygon::sides(&self.corners), p)
    }
}

impl Labels {
    pub(super) fn new(world: &World) -> Self {
        let area = |shape: &Shape| match shape {
            Shape::Rect(rect) => Outline::from(Vec::from(rect.corners())),
            Shape::Polygon(corners) => corners.clone().into(),
        };
        Self {
            areas: world.areas.iter().map(|of| area(&of.shape)).collect(),
            doors: world.named_doors.iter().map(|door| band(door).into()).collect(),
        }
    }

    /// Where rooms are cut.
    pub(super) fn lines(&self) -> Vec<Segment> {
        self.areas.iter().chain(&self.doors).flat_map(|outline| polygon::sides(&outline.corners)).collect()
    }

    pub(super) fn of(&self, room: &Convex) -> Label {
        let p = room.centre();
        let holding = |all: &[Outline]| (0..all.len()).filter(|&one| all[one].holds(p)).collect();
        Label { areas: holding(&self.areas), doors: holding(&self.doors) }
    }
}

fn band(door: &NamedDoor) -> Vec<Point> {
    let line = Segment::new(door.from, door.to);
    let aside = line.direction().perpendicular() * (BAND_M / 2.0);
    vec![line.a - aside, line.b - aside, line.b + aside, line.a + aside]
}
