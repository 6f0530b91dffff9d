//! What has to be free about the point where a robot is, and whether it is: judged in closed form, without cells.

use geo::{Contains, Coord, Line};

use super::{Outline, Solid, Solids};
use crate::geometry::tolerance::ROUNDING_M;
use crate::geometry::{Point, Rect, Segment, polygon};
use crate::layers::{STEP_DEGREES, body};

/// What a state takes up, with what is kept free around it.
#[derive(Clone, Debug, PartialEq)]
pub struct Footprint {
    pub(super) outline: Shape,
    pub(super) height: f64,
}

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Shape {
    /// By its radius.
    Disc(f64),
    /// Convex, by its corners about the robot's middle, counterclockwise.
    Body(Vec<Point>),
}

impl Footprint {
    /// Of a state; `clearance` is kept free around it.
    ///
    /// # Arguments
    /// `lies` is the length of a body that cannot turn on the spot, and the degrees to which it faces.
    pub fn new((width, height): (f64, f64), clearance: f64, lies: Option<(f64, f64)>) -> Self {
        let outline = match lies {
            None => Shape::Disc(width / 2.0 + clearance),
            Some((length, degrees)) => {
                let facing = (degrees / STEP_DEGREES).round() as usize;
                Shape::Body(body(length, width, clearance, facing))
            }
        };
        Self { outline, height }
    }

    /// The least rectangle about it, with its middle at the origin.
    pub(super) fn extent(&self) -> Rect {
        match &self.outline {
            Shape::Disc(radius) => Rect::new(-radius, -radius, *radius, *radius),
            Shape::Body(corners) => Rect::around(corners.iter().copied()),
        }
    }
}

impl Solids {
    /// Whether nothing solid is overlapped on the straight way from `a` to `b`; what is only touched is not.
    pub fn fits(&self, of: &Footprint, a: Point, b: Point) -> bool {
        let (way, extent) = (Segment::new(a, b).bounds(), of.extent());
        let about = Rect::new(
            way.x0 + extent.x0 + ROUNDING_M,
            way.y0 + extent.y0 + ROUNDING_M,
            way.x1 + extent.x1 - ROUNDING_M,
            way.y1 + extent.y1 - ROUNDING_M,
        );
        if !self.bounds.encloses(&about) {
            return false;
        }
        let mut near = self.within(about, of.height);
        match &of.outline {
            Shape::Disc(radius) => {
                let line = Line::from(Segment::new(a, b));
                near.all(|solid| solid.distance(&line) >= radius - ROUNDING_M)
            }
            Shape::Body(corners) => {
                let swept = polygon::hull(corners.iter().flat_map(|&corner| [a + corner, b + corner]));
                near.all(|solid| solid.is_clear_of(&swept))
            }
        }
    }
}

impl Solid {
    /// Whether a convex outline and this one have no inner point in common.
    fn is_clear_of(&self, convex: &[Point]) -> bool {
        match &self.outline {
            Outline::Rect(rect) => are_apart(convex, &rect.corners()),
            Outline::Polygon(polygon) => {
                // an outline that meets no side lies inside with all its points or with none
                let sum = convex.iter().fold(Point::default(), |sum, &corner| sum + corner);
                let middle = Coord::from(sum * (1.0 / convex.len() as f64));
                !polygon.contains(&middle)
                    && self.sides().iter().all(|side| are_apart(convex, &[side.a, side.b]))
            }
        }
    }
}

/// Whether a line along a side of one of two convex outlines parts them.
fn are_apart(one: &[Point], other: &[Point]) -> bool {
    let parts = |side: Segment| {
        let out = side.direction();
        let beyond = |p: &Point| (*p - side.a).cross(out);
        let limits = |points: &[Point]| {
            let all = points.iter().map(beyond);
            all.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), at| (low.min(at), high.max(at)))
        };
        let ((a, b), (c, d)) = (limits(one), limits(other));
        b <= c + ROUNDING_M || d <= a + ROUNDING_M
    };
    polygon::sides(one).chain(polygon::sides(other)).any(parts)
}
