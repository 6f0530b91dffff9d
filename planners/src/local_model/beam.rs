//! Readings put where the estimated pose says that they were taken.

use super::Settings;
use crate::body::Reading;
use crate::geometry::Point;
use crate::pose::{Frame, Past, Pose};

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
    pub fn new(reading: &Reading, past: &mut Past, settings: &Settings) -> Self {
        let [back, then] = past.at(&reading.odometry);
        let range = reading.range_m.unwrap_or(settings.sonar_range_m);
        Self {
            from: then.at,
            towards: then.direction(reading.bearing),
            range_m: reading.range_m,
            sigma_m: (settings.range_noise * range).hypot(settings.range_noise_m),
            since_m: back.at.length(),
        }
    }

    pub fn at(&self, range_m: f64) -> Point {
        self.from + self.towards * range_m
    }

    pub fn echo(&self) -> Option<Point> {
        self.range_m.map(|range| self.at(range))
    }

    /// How far ahead along the beam a place lies, and how far aside of it.
    pub fn seen_from(&self, place: Point) -> (f64, f64) {
        let seen = (place - self.from).seen_along(self.towards);
        (seen.x, seen.y.abs())
    }

    /// The same reading, once the pose that it was placed by is found to be another.
    pub fn moved(&self, shift: &Shift) -> Self {
        Self { from: shift.of(self.from), towards: self.towards.rotated(shift.to.ahead), ..*self }
    }
}

/// From where things were placed by one pose to where another puts them.
pub(super) struct Shift {
    from: Point,
    /// Where that is put, and the direction of the angle between the headings.
    to: Frame,
}

impl Shift {
    pub fn new(before: &Pose, after: &Pose) -> Self {
        let to = Pose { at: after.at, heading: after.heading - before.heading };
        Self { from: before.at, to: Frame::from(&to) }
    }

    pub fn of(&self, p: Point) -> Point {
        self.to.place(p - self.from)
    }
}
