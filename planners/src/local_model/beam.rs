//! Readings put where the estimated pose says that they were taken.

use super::{Estimate, Settings};
use crate::body::Reading;
use crate::geometry::Point;
use crate::pose::Pose;

/// A reading in the map's frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Beam {
    pub from: Point,
    /// Of length 1.
    pub towards: Point,
    pub range_m: Option<f64>,
    /// Standard deviation of the range.
    pub sigma_m: f64,
    /// Metres that the robot has driven since, at least.
    pub since_m: f64,
}

impl Beam {
    pub fn new(reading: &Reading, estimate: &Estimate, odometry: &Pose, settings: &Settings) -> Self {
        let back = odometry.to(&reading.odometry);
        let then = estimate.pose.then(&back);
        let range = reading.range_m.unwrap_or(settings.sonar_range_m);
        Self {
            from: then.at,
            towards: then.direction(reading.bearing),
            range_m: reading.range_m,
            sigma_m: (settings.range_noise * range).hypot(settings.range_noise_m),
            since_m: back.at.x.hypot(back.at.y),
        }
    }

    /// The point so far along the beam.
    pub fn at(&self, range_m: f64) -> Point {
        Point::new(self.from.x + range_m * self.towards.x, self.from.y + range_m * self.towards.y)
    }

    /// Where the echo came from.
    pub fn echo(&self) -> Option<Point> {
        self.range_m.map(|range| self.at(range))
    }

    /// How far ahead along the beam a place lies, and how far aside of it.
    pub fn seen_from(&self, place: Point) -> (f64, f64) {
        let (dx, dy) = (place.x - self.from.x, place.y - self.from.y);
        let aside = dx * self.towards.y - dy * self.towards.x;
        (dx * self.towards.x + dy * self.towards.y, aside.abs())
    }

    /// The same reading, once the pose that it was placed by is found to be another.
    pub fn moved(&self, shift: &Shift) -> Self {
        let Shift { sin, cos, .. } = *shift;
        let towards = Point::new(
            cos * self.towards.x - sin * self.towards.y,
            sin * self.towards.x + cos * self.towards.y,
        );
        Self { from: shift.of(self.from), towards, ..*self }
    }
}

/// From where things were placed by one pose to where another puts them.
pub(super) struct Shift {
    sin: f64,
    cos: f64,
    from: Point,
    to: Point,
}

impl Shift {
    pub fn new(before: &Pose, after: &Pose) -> Self {
        let (sin, cos) = (after.heading - before.heading).sin_cos();
        Self { sin, cos, from: before.at, to: after.at }
    }

    pub fn of(&self, p: Point) -> Point {
        let (dx, dy) = (p.x - self.from.x, p.y - self.from.y);
        Point::new(self.to.x + self.cos * dx - self.sin * dy, self.to.y + self.sin * dx + self.cos * dy)
    }
}
