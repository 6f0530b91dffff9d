//! The robot: a rectangle with its length along its heading, and what lies between it and a piece of wall.

use super::walls::Wall;
use crate::geometry::{Point, Rect};

/// A rectangular robot, turned about and located by its middle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Robot {
    /// Metres across its heading.
    pub width: f64,
    /// Metres along its heading.
    pub length: f64,
}

impl Robot {
    /// The largest gap up to which the clearance about a corner is the gap, between channels `width` wide. Negative where
    /// the robot cannot turn there at all.
    pub fn safest(&self, width: f64) -> f64 {
        let Self { width: across, length } = *self;
        (width * width - across * across - length * length / 4.0) / (2.0 * (width + across))
    }

    /// How far from a corner the robot's outermost point is, while its middle is driven round it at `radius`.
    pub fn reach_about(&self, radius: f64) -> f64 {
        (radius + self.width / 2.0).hypot(self.length / 2.0)
    }
}

/// A rectangle about the origin, with its sides along the axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Body {
    pub half_length: f64,
    pub half_width: f64,
}

impl From<Robot> for Body {
    fn from(robot: Robot) -> Self {
        Self { half_length: robot.length / 2.0, half_width: robot.width / 2.0 }
    }
}

impl Body {
    /// The same with all sides moved outwards; inwards where `by` is negative, at most to the middle.
    pub fn grown(&self, by: f64) -> Self {
        Self { half_length: (self.half_length + by).max(0.0), half_width: (self.half_width + by).max(0.0) }
    }

    /// From the middle to each corner.
    pub fn reach(&self) -> f64 {
        self.half_length.hypot(self.half_width)
    }

    pub fn corners(&self) -> [Point; 4] {
        let (x, y) = (self.half_length, self.half_width);
        [Point::new(x, y), Point::new(-x, y), Point::new(-x, -y), Point::new(x, -y)]
    }

    /// Metres to the segment from `a` to `b`; 0 where they meet.
    pub fn distance(&self, a: Point, b: Point) -> f64 {
        if self.meets(a, b) {
            return 0.0;
        }
        let (dx, dy) = (b.x - a.x, b.y - a.y);
        // of a point, any share is the nearest one
        let per_share = 1.0 / (dx * dx + dy * dy).max(f64::MIN_POSITIVE);
        let to_corner = self.corners().map(|corner| {
            let (x, y) = (corner.x - a.x, corner.y - a.y);
            let share = ((x * dx + y * dy) * per_share).clamp(0.0, 1.0);
            squared(x - share * dx, y - share * dy)
        });
        let to_corner = to_corner.into_iter().fold(f64::INFINITY, f64::min).sqrt();
        to_corner.min(self.distance_to(a)).min(self.distance_to(b))
    }

    /// Metres to a point; 0 inside.
    pub fn distance_to(&self, point: Point) -> f64 {
        length((point.x.abs() - self.half_length).max(0.0), (point.y.abs() - self.half_width).max(0.0))
    }

    /// The direction, of length 1, in which a point is farther from the body the soonest; no direction inside.
    pub fn away(&self, point: Point) -> Point {
        let beyond = |at: f64, half: f64| (at.abs() - half).max(0.0).copysign(at);
        let (x, y) = (beyond(point.x, self.half_length), beyond(point.y, self.half_width));
        let per_metre = 1.0 / length(x, y).max(f64::MIN_POSITIVE);
        Point::new(x * per_metre, y * per_metre)
    }

    /// Metres that the segment from `a` to `b` is away at least: those of the rectangle about it.
    pub fn least_distance(&self, a: Point, b: Point) -> f64 {
        let beyond = |a: f64, b: f64, half: f64| (a.min(b) - half).max(-half - a.max(b)).max(0.0);
        length(beyond(a.x, b.x, self.half_length), beyond(a.y, b.y, self.half_width))
    }

    /// Metres to a wall, for the body about `middle` with its length along the direction `along`.
    pub fn distance_from(&self, middle: Point, along: Point, wall: &Wall) -> f64 {
        let seen = |p: Point| (p - middle).seen_along(along);
        self.distance(seen(wall.a), seen(wall.b))
    }

    /// What holds the body about `middle` with its length along the direction `along`.
    pub fn bounds(&self, middle: Point, along: Point) -> Rect {
        let x = (along.x * self.half_length).abs() + (along.y * self.half_width).abs();
        let y = (along.y * self.half_length).abs() + (along.x * self.half_width).abs();
        Rect::new(middle.x - x, middle.y - y, middle.x + x, middle.y + y)
    }

    /// Whether no line separates the rectangle from a segment.
    fn meets(&self, a: Point, b: Point) -> bool {
        let (x, y) = (self.half_length, self.half_width);
        let is_beside = a.x.min(b.x) > x || a.x.max(b.x) < -x || a.y.min(b.y) > y || a.y.max(b.y) < -y;
        let (dx, dy) = (b.x - a.x, b.y - a.y);
        let of_middle = (dx * a.y - dy * a.x).abs();
        !is_beside && of_middle <= x * dy.abs() + y * dx.abs()
    }
}

/// Metres between a rectangle and a wall.
pub(super) fn apart(area: &Rect, wall: &Wall) -> f64 {
    let dx = (wall.a.x - area.x1).max(area.x0 - wall.b.x).max(0.0);
    let dy = (wall.a.y - area.y1).max(area.y0 - wall.b.y).max(0.0);
    length(dx, dy)
}

fn squared(x: f64, y: f64) -> f64 {
    x * x + y * y
}

/// Of a vector of some metres: faster than `hypot`, which minds numbers near the ends of their range.
pub(super) fn length(x: f64, y: f64) -> f64 {
    squared(x, y).sqrt()
}
