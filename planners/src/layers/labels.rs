//! Which named areas and doors a room lies in. Rooms are cut along their outlines, so that none lies in one in part. Some areas
//! are entered as soon as any part of the robot comes into them: their outlines are grown by it.
//!
//! A named door is a band along its segment: whoever passes the door enters a room of the band.

use super::grown::{Moved, Rings};
use crate::geometry::{Convex, Point, Rect, Segment, polygon};
use crate::world::{Area, NamedDoor, Shape, World};

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
    sides: Vec<Segment>,
    bounds: Rect,
}

impl From<Rings> for Outline {
    fn from(rings: Rings) -> Self {
        Self {
            sides: rings.iter().flat_map(|ring| polygon::sides(ring)).collect(),
            bounds: Rect::around(rings.iter().flatten().copied()),
        }
    }
}

impl Outline {
    fn holds(&self, p: Point) -> bool {
        self.bounds.contains(p) && polygon::encloses(self.sides.iter().copied(), p)
    }
}

impl Labels {
    /// # Arguments
    /// `whole` are the areas, by number, that are entered by any part of `robot`; the others are by its middle.
    pub(super) fn new(world: &World, whole: &[usize], robot: &Moved) -> Self {
        let area = |(number, area): (usize, &Area)| {
            let corners = match &area.shape {
                Shape::Rect(rect) => Vec::from(rect.corners()),
                Shape::Polygon(corners) => corners.clone(),
            };
            let rings =
                if whole.contains(&number) { robot.met(world.bounds, &corners) } else { vec![corners] };
            Outline::from(rings)
        };
        Self {
            areas: world.areas.iter().enumerate().map(area).collect(),
            doors: world.named_doors.iter().map(|door| vec![band(door)].into()).collect(),
        }
    }

    /// Where rooms are cut.
    pub(super) fn lines(&self) -> Vec<Segment> {
        self.areas.iter().chain(&self.doors).flat_map(|outline| outline.sides.iter().copied()).collect()
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
