//! Guiding circles, and the lines that touch two of them.

use super::body::length;
use super::steer::Turn;
use crate::geometry::Point;

/// A circle that is driven in one sense; a point where its radius is 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct Circle {
    pub centre: Point,
    pub radius: f64,
    pub turn: Turn,
}

/// A straight way that touches two circles in their senses.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tangent {
    pub from: Point,
    pub to: Point,
    /// Direction of travel, of length 1.
    pub along: Point,
    pub length: f64,
}

impl Circle {
    /// A start or a goal.
    pub fn point(centre: Point) -> Self {
        Self { centre, radius: 0.0, turn: Turn::Left }
    }

    /// To the left where it is driven counter-clockwise: its radius, with a sign.
    fn bend(&self) -> f64 {
        self.turn.sign() * self.radius
    }

    /// How far the centre of `next` must be away at least.
    pub fn least_distance(&self, next: &Self) -> f64 {
        (next.bend() - self.bend()).abs()
    }

    /// The line that leaves this circle and arrives at `next`; `None` where their centres are nearer than
    /// [`Circle::least_distance`], or the same for other than points. From a point to itself, a line without length along x.
    pub fn tangent_to(&self, next: &Self) -> Option<Tangent> {
        let (dx, dy) = (next.centre.x - self.centre.x, next.centre.y - self.centre.y);
        let distance = length(dx, dy);
        let k = next.bend() - self.bend();
        if distance < k.abs() {
            return None;
        }
        if distance <= 0.0 {
            let standing =
                Tangent { from: self.centre, to: next.centre, along: Point::new(1.0, 0.0), length: 0.0 };
            return (self.radius <= 0.0 && next.radius <= 0.0).then_some(standing);
        }
        let length = ((distance - k) * (distance + k)).sqrt();
        let (cos, sin) = (length / distance, -k / distance);
        let along = Point::new((cos * dx - sin * dy) / distance, (sin * dx + cos * dy) / distance);
        let at = |circle: &Self| {
            let bend = circle.bend();
            circle.centre - along.perpendicular() * bend
        };
        Some(Tangent { from: at(self), to: at(next), along, length })
    }

    /// The angle driven about this circle between two lines that touch it; negative where the second one leaves before
    /// the first one arrives.
    pub fn angle(&self, arriving: &Tangent, leaving: &Tangent) -> f64 {
        let (a, b) = (arriving.along, leaving.along);
        (self.turn.sign() * a.cross(b)).atan2(a.dot(b))
    }
}
