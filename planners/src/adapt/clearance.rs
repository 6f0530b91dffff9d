//! What evaluations taught about an object: room that it leaves free, and places that it takes.
//!
//! All of it lies in the frame of the object, so it holds wherever the object is moved or turned, until its shape changes.

use super::robot::Link;
use super::shape::Distance;
use crate::geometry::tolerance::ROUNDING_M;
use crate::geometry::{Point, Segment};

/// One thing learned, in the frame of the object.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Clearance {
    /// Everything nearer to this segment than so many metres is free of the object.
    Free {
        /// Where the axis of a link lay.
        axis: Segment,
        within_m: f64,
    },
    /// Everything nearer to this point than so many metres belongs to the object; 0 for a point of its outline.
    Taken { at: Point, within_m: f64 },
}

#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Known {
    free: Vec<Room>,
    taken: Vec<(Point, f64)>,
}

/// Free room about a segment, made ready for many questions.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Room {
    axis: Segment,
    within_m: f64,
    along: Point,
    /// One over the square of the segment's length; 0 where it is a point.
    per_square: f64,
}

impl Room {
    fn new(axis: Segment, within_m: f64) -> Self {
        let along = axis.b - axis.a;
        let square = along.dot(along);
        Self { axis, within_m, along, per_square: if square > 0.0 { 1.0 / square } else { 0.0 } }
    }

    fn squared(&self, p: Point) -> f64 {
        let out = p - self.axis.a;
        let off = out - self.along * (out.dot(self.along) * self.per_square).clamp(0.0, 1.0);
        off.dot(off)
    }

    /// Square of the distance to the farther end of an axis. The room is convex, so what holds both ends holds the axis.
    fn farther_squared(&self, axis: &Segment) -> f64 {
        self.squared(axis.a).max(self.squared(axis.b))
    }

    fn slack(&self, link: &Link) -> f64 {
        self.within_m - link.radius - self.farther_squared(&link.axis).sqrt()
    }
}

/// Places that are taken are kept no closer than this: what lies between them is met on the way from one to the next.
const SPACING_M: f64 = 0.03;

impl Known {
    /// By how many metres the known free room exceeds a link there, and which room that is; the slack is negative or
    /// `-INFINITY` where the link is not known to be free.
    pub fn slack(&self, link: &Link) -> (f64, usize) {
        let mut best = (f64::NEG_INFINITY, 0);
        for (index, room) in self.free.iter().enumerate() {
            let left = room.within_m - best.0;
            if left > 0.0 {
                let squared = room.farther_squared(&link.axis);
                if squared < left * left {
                    best = (room.within_m - squared.sqrt(), index);
                }
            }
        }
        (best.0 - link.radius, best.1)
    }

    /// The same by one room alone; less than what all of them give.
    pub fn slack_in(&self, room: usize, link: &Link) -> f64 {
        self.free.get(room).map_or(f64::NEG_INFINITY, |room| room.slack(link))
    }

    /// Whether a link there is known to overlap the object. What only touches it is not: room that is known to be free goes up
    /// to there, and what was free must not be refused later.
    pub fn takes(&self, link: &Link) -> bool {
        let is_taken = |(at, within_m): &(Point, f64)| {
            let near = within_m + link.radius - ROUNDING_M;
            near > 0.0 && link.axis.squared_distance(*at) < near * near
        };
        self.taken.iter().any(is_taken)
    }

    /// Keeps what an evaluation found, where it says more than what is known; gives what was kept.
    pub fn learn(&mut self, link: &Link, distance: &Distance) -> Vec<Clearance> {
        let mut kept = Vec::new();
        let within_m = distance.metres;
        if within_m > 0.0 && self.slack(&Link { axis: link.axis, radius: within_m }).0 < 0.0 {
            kept.push(Clearance::Free { axis: link.axis, within_m });
        }
        let depth_m = (-within_m).max(0.0);
        let is_news =
            |(at, within_m): &(Point, f64)| at.distance(distance.witness) + depth_m > within_m + SPACING_M;
        if distance.metres.is_finite() && self.taken.iter().all(is_news) {
            kept.push(Clearance::Taken { at: distance.witness, within_m: depth_m });
        }
        for clearance in &kept {
            self.put(clearance);
        }
        kept
    }

    pub fn put(&mut self, clearance: &Clearance) {
        match *clearance {
            Clearance::Free { axis, within_m } => self.free.push(Room::new(axis, within_m)),
            Clearance::Taken { at, within_m } => self.taken.push((at, within_m)),
        }
    }

    pub fn clearances(&self) -> impl Iterator<Item = Clearance> + '_ {
        let free = self.free.iter().map(|room| Clearance::Free { axis: room.axis, within_m: room.within_m });
        free.chain(self.taken.iter().map(|&(at, within_m)| Clearance::Taken { at, within_m }))
    }
}
