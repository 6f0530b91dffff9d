//! Straight pieces between two points, in metres in the map's frame.

use crate::geometry::{Point, Rect};

/// The piece from `a` to `b`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// One end.
    pub a: Point,
    /// The other end.
    pub b: Point,
}

impl From<[Point; 2]> for Segment {
    fn from([a, b]: [Point; 2]) -> Self {
        Self { a, b }
    }
}

impl Segment {
    /// A segment from its ends.
    pub const fn new(a: Point, b: Point) -> Self {
        Self { a, b }
    }

    /// Metres from end to end.
    pub fn length(&self) -> f64 {
        self.a.distance(self.b)
    }

    /// The direction from `a` to `b`, of length 1; along x where both ends are one point.
    pub fn direction(&self) -> Point {
        let length = self.length();
        if length > 0.0 {
            Point::new((self.b.x - self.a.x) / length, (self.b.y - self.a.y) / length)
        } else {
            Point::new(1.0, 0.0)
        }
    }

    /// The direction from `a` to `b`, radians counter-clockwise from the x axis.
    pub fn angle(&self) -> f64 {
        (self.b.y - self.a.y).atan2(self.b.x - self.a.x)
    }

    /// The point half way.
    pub fn middle(&self) -> Point {
        Point::new(f64::midpoint(self.a.x, self.b.x), f64::midpoint(self.a.y, self.b.y))
    }

    /// Metres from a point to the nearest point of the segment.
    pub fn distance(&self, p: Point) -> f64 {
        p.distance(p.nearest_on(self.a, self.b))
    }

    /// The square of that distance, square metres: without a root, for comparisons.
    pub fn squared_distance(&self, p: Point) -> f64 {
        let foot = p.nearest_on(self.a, self.b);
        (p.x - foot.x).powi(2) + (p.y - foot.y).powi(2)
    }

    /// The least rectangle about it.
    pub fn bounds(&self) -> Rect {
        let (a, b) = (self.a, self.b);
        Rect::new(a.x.min(b.x), a.y.min(b.y), a.x.max(b.x), a.y.max(b.y))
    }

    /// How far a ray runs until it meets the segment, and where on it (0 at `a`, 1 at `b`); `None` where it does not.
    /// `towards` has length 1. A ray along the segment does not meet it.
    pub fn hit(&self, from: Point, towards: Point) -> Option<(f64, f64)> {
        let (sx, sy) = (self.b.x - self.a.x, self.b.y - self.a.y);
        let cross = towards.x * sy - towards.y * sx;
        let (ax, ay) = (self.a.x - from.x, self.a.y - from.y);
        let share = (ax * towards.y - ay * towards.x) / cross;
        let range = (ax * sy - ay * sx) / cross;
        (range >= 0.0 && (0.0..=1.0).contains(&share)).then_some((range, share))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ray_meets_a_segment_ahead_and_none_behind_or_beside() {
        let wall = Segment::new(Point::new(2.0, -1.0), Point::new(2.0, 3.0));
        assert_eq!(wall.hit(Point::default(), Point::new(1.0, 0.0)), Some((2.0, 0.25)));
        assert_eq!(wall.hit(Point::default(), Point::new(-1.0, 0.0)), None);
        assert_eq!(wall.hit(Point::new(0.0, 4.0), Point::new(1.0, 0.0)), None);
        assert_eq!(wall.hit(Point::default(), Point::new(0.0, 1.0)), None);
    }

    #[test]
    fn a_segment_without_length_is_met_by_nothing() {
        let dot = Segment::new(Point::new(2.0, 0.0), Point::new(2.0, 0.0));
        assert_eq!(dot.hit(Point::default(), Point::new(1.0, 0.0)), None);
        assert_eq!(dot.direction(), Point::new(1.0, 0.0));
    }
}
