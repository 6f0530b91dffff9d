//! Points and displacements of the plane, in metres in the map's frame (x to the right, y up).

use std::ops::{Add, Mul, Neg, Sub};

use geo::Coord;

/// A point, or the way from one point to another: metres.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd, Default)]
pub struct Point {
    pub x: f64,
    pub y: f64,
}

impl From<Coord> for Point {
    fn from(Coord { x, y }: Coord) -> Self {
        Self { x, y }
    }
}

impl From<Point> for Coord {
    fn from(p: Point) -> Self {
        Self { x: p.x, y: p.y }
    }
}

impl Point {
    pub const fn new(x: f64, y: f64) -> Self {
        Self { x, y }
    }

    /// The direction of an angle, of length 1: radians counter-clockwise from the x axis.
    pub fn towards(angle: f64) -> Self {
        let (y, x) = angle.sin_cos();
        Self { x, y }
    }

    /// The angle of a direction, radians counter-clockwise from the x axis: above -PI up to PI.
    pub fn angle(self) -> f64 {
        self.y.atan2(self.x)
    }

    pub fn distance(self, other: Self) -> f64 {
        // `hypot` minds numbers near the ends of their range, and takes several times as long.
        self.squared_distance(other).sqrt()
    }

    /// The square of the distance, square metres: for comparisons.
    pub fn squared_distance(self, other: Self) -> f64 {
        (self.x - other.x).powi(2) + (self.y - other.y).powi(2)
    }

    pub fn length(self) -> f64 {
        self.x.hypot(self.y)
    }

    pub fn dot(self, other: Self) -> f64 {
        self.x * other.x + self.y * other.y
    }

    /// The area that two displacements span, rounded; positive where `other` turns left. Where its sign decides, ask
    /// [`orient`](super::orient).
    pub fn cross(self, other: Self) -> f64 {
        self.x * other.y - self.y * other.x
    }

    /// A quarter turn to the left.
    #[must_use]
    pub fn perpendicular(self) -> Self {
        Self { x: -self.y, y: self.x }
    }

    /// Turned by the angle of a direction of length 1.
    #[must_use]
    pub fn rotated(self, by: Self) -> Self {
        Self { x: by.x * self.x - by.y * self.y, y: by.y * self.x + by.x * self.y }
    }

    /// As it is seen by who looks along a direction of length 1: x ahead, y to the left.
    #[must_use]
    pub fn seen_along(self, ahead: Self) -> Self {
        Self { x: ahead.dot(self), y: ahead.cross(self) }
    }

    #[must_use]
    pub fn midpoint(self, to: Self) -> Self {
        Self { x: f64::midpoint(self.x, to.x), y: f64::midpoint(self.y, to.y) }
    }

    /// The point at a share of the way to another one.
    #[must_use]
    pub fn lerp(self, to: Self, share: f64) -> Self {
        self + (to - self) * share
    }

    /// Grows with the angle of a direction from 0 to 4 in a turn, never faster than the angle itself (the diamond
    /// angle); without trigonometry.
    pub fn diamond_angle(self) -> f64 {
        let share = self.y / (self.x.abs() + self.y.abs());
        match (self.x < 0.0, self.y < 0.0) {
            (true, _) => 2.0 - share,
            (false, true) => 4.0 + share,
            (false, false) => share,
        }
    }

    /// The point of the segment from `a` to `b` that is nearest to this one.
    #[must_use]
    pub fn nearest_on(self, a: Self, b: Self) -> Self {
        let along = b - a;
        let squared = along.dot(along);
        if squared <= 0.0 {
            return a;
        }
        a + along * ((self - a).dot(along) / squared).clamp(0.0, 1.0)
    }
}

impl Add for Point {
    type Output = Self;

    fn add(self, by: Self) -> Self {
        Self { x: self.x + by.x, y: self.y + by.y }
    }
}

impl Sub for Point {
    type Output = Self;

    fn sub(self, from: Self) -> Self {
        Self { x: self.x - from.x, y: self.y - from.y }
    }
}

impl Neg for Point {
    type Output = Self;

    fn neg(self) -> Self {
        Self { x: -self.x, y: -self.y }
    }
}

impl Mul<f64> for Point {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        Self { x: self.x * factor, y: self.y * factor }
    }
}

pub fn path_length(points: &[Point]) -> f64 {
    // A sum of nothing is -0.0.
    points.windows(2).map(|leg| leg[0].distance(leg[1])).fold(0.0, |sum, leg| sum + leg)
}
