//! Straight pieces between two points, in metres in the map's frame.

use super::tolerance::{ROUNDING_M, SNAP_M};
use super::{Point, Rect, orient};

/// The piece from `a` to `b`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    pub a: Point,
    pub b: Point,
}

impl From<[Point; 2]> for Segment {
    fn from([a, b]: [Point; 2]) -> Self {
        Self { a, b }
    }
}

impl From<Segment> for geo::Line {
    fn from(segment: Segment) -> Self {
        Self::new(segment.a, segment.b)
    }
}

impl Segment {
    pub const fn new(a: Point, b: Point) -> Self {
        Self { a, b }
    }

    pub fn length(&self) -> f64 {
        self.a.distance(self.b)
    }

    /// The direction from `a` to `b`, of length 1; along x where both ends are one point.
    pub fn direction(&self) -> Point {
        let length = self.length();
        if length > 0.0 {
            let way = self.b - self.a;
            Point::new(way.x / length, way.y / length)
        } else {
            Point::new(1.0, 0.0)
        }
    }

    /// The direction from `a` to `b`, radians counter-clockwise from the x axis.
    pub fn angle(&self) -> f64 {
        (self.b - self.a).angle()
    }

    /// The point at a share of its length: 0 is `a`, 1 is `b`.
    pub fn at(&self, share: f64) -> Point {
        self.a.lerp(self.b, share)
    }

    pub fn middle(&self) -> Point {
        self.a.midpoint(self.b)
    }

    pub fn nearest_to(&self, p: Point) -> Point {
        p.nearest_on(self.a, self.b)
    }

    pub fn distance(&self, p: Point) -> f64 {
        p.distance(self.nearest_to(p))
    }

    /// Whether a point is no farther than so much: as [`Self::distance`] tells it, and of most that are farther, sooner.
    pub fn is_within(&self, p: Point, reach_m: f64) -> bool {
        let Rect { x0, y0, x1, y1 } = self.bounds();
        let aside = (x0 - p.x).max(p.x - x1).max(y0 - p.y).max(p.y - y1);
        aside <= reach_m + ROUNDING_M && self.distance(p) <= reach_m
    }

    /// Metres between two segments; 0 where they meet.
    pub fn gap(&self, other: &Self) -> f64 {
        if self.crosses(other) {
            return 0.0;
        }
        let [a, b] = [other.a, other.b].map(|end| self.squared_distance(end));
        let [c, d] = [self.a, self.b].map(|end| other.squared_distance(end));
        a.min(b).min(c).min(d).sqrt()
    }

    /// The square of that distance, square metres: without a root, for comparisons.
    pub fn squared_distance(&self, p: Point) -> f64 {
        p.squared_distance(self.nearest_to(p))
    }

    /// The least rectangle about it.
    pub fn bounds(&self) -> Rect {
        let (a, b) = (self.a, self.b);
        Rect::new(a.x.min(b.x), a.y.min(b.y), a.x.max(b.x), a.y.max(b.y))
    }

    #[must_use]
    pub fn reversed(&self) -> Self {
        Self { a: self.b, b: self.a }
    }

    /// The part that lies on another one, as near as points are told apart, in its own direction; `None` where that is at
    /// most a point.
    pub fn shared_with(&self, other: &Self) -> Option<Self> {
        let (dx, dy) = self.bounds().axis_gaps(&other.bounds());
        if dx.max(dy) > SNAP_M {
            return None;
        }
        let way = self.b - self.a;
        let squared = way.dot(way);
        let [one, two] = [other.a, other.b].map(|end| (end - self.a).dot(way) / squared);
        let (from, to) = (one.min(two).max(0.0), one.max(two).min(1.0));
        let is_long = to > from && (to - from).powi(2) * squared > ROUNDING_M * ROUNDING_M;
        let a = if from > 0.0 { self.at(from) } else { self.a };
        let b = if to < 1.0 { self.at(to) } else { self.b };
        let is_on = |p: Point| other.squared_distance(p) <= SNAP_M * SNAP_M;
        (is_long && is_on(a) && is_on(b)).then_some(Self { a, b })
    }

    /// Whether both cross inside: not where one ends on the other, and not along one line. Exact.
    pub fn crosses(&self, other: &Self) -> bool {
        let parts = |sides: [f64; 2]| sides[0].min(sides[1]) < 0.0 && sides[0].max(sides[1]) > 0.0;
        // most that are asked about are far apart, and boxes tell that soonest
        let (dx, dy) = self.bounds().axis_gaps(&other.bounds());
        dx.max(dy) <= 0.0 && parts(self.sides_of(other)) && parts(other.sides_of(self))
    }

    /// Where both [cross](Self::crosses).
    pub fn crossing(&self, other: &Self) -> Option<Point> {
        let [from, to] = other.sides_of(self);
        self.crosses(other).then(|| self.at(from / (from - to)))
    }

    /// Whether both have a point in common, an end or a stretch of one line, too. Exact.
    pub fn meets(&self, other: &Self) -> bool {
        let apart = |sides: [f64; 2]| sides[0].min(sides[1]) > 0.0 || sides[0].max(sides[1]) < 0.0;
        let gaps = self.bounds().axis_gaps(&other.bounds());
        gaps.0.max(gaps.1) <= 0.0 && !apart(self.sides_of(other)) && !apart(other.sides_of(self))
    }

    /// On which sides of this one's line the ends of another one lie, as [`orient`] tells it.
    pub fn sides_of(&self, other: &Self) -> [f64; 2] {
        [other.a, other.b].map(|end| orient(self.a, self.b, end))
    }

    /// How far a ray runs until it meets the segment, and where on it (0 at `a`, 1 at `b`); `None` where it does not.
    /// `towards` has length 1. A ray along the segment does not meet it.
    pub fn hit(&self, from: Point, towards: Point) -> Option<(f64, f64)> {
        let (way, out) = (self.b - self.a, self.a - from);
        let (sine, aside) = (towards.cross(way), out.cross(towards));
        // most rays miss, which is told without divisions
        if aside.abs() > sine.abs() {
            return None;
        }
        let (share, range) = (aside / sine, out.cross(way) / sine);
        (range >= 0.0 && (0.0..=1.0).contains(&share)).then_some((range, share))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn segment(x0: f64, y0: f64, x1: f64, y1: f64) -> Segment {
        Segment::new(Point::new(x0, y0), Point::new(x1, y1))
    }

    #[test]
    fn segments_that_touch_or_overlap_meet_and_do_not_cross() {
        let lying = segment(0.0, 0.0, 4.0, 0.0);
        let upright = segment(1.0, -1.0, 1.0, 3.0);
        assert_eq!(lying.crossing(&upright), Some(Point::new(1.0, 0.0)));
        assert!(lying.meets(&upright) && lying.gap(&upright) <= 0.0);
        for touching in
            [segment(1.0, 0.0, 1.0, 3.0), segment(3.0, 0.0, 9.0, 0.0), segment(4.0, 0.0, 5.0, 1.0)]
        {
            assert!(lying.meets(&touching) && !lying.crosses(&touching) && lying.gap(&touching) <= 0.0);
        }
        for apart in [segment(1.0, 0.5, 1.0, 3.0), segment(5.0, 0.0, 9.0, 0.0), segment(4.5, -1.0, 4.5, 3.0)]
        {
            assert!(!lying.meets(&apart) && !lying.crosses(&apart) && lying.gap(&apart) > 0.4);
        }
    }

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
