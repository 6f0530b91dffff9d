//! The nearest point at which a body fits.
//!
//! Where the body touches a side or a corner of something solid, its middle lies on a boundary: a segment, or a circle. The
//! nearest point of free space is the foot of the point on one of these, or where two of them cross.

use super::footprint::{Footprint, Shape};
use super::{Solid, Solids};
use crate::geometry::{Point, Rect, Segment, polygon};

/// So far the nearest point is looked for step by step, each so many times the one before, metres.
const FIRST_M: f64 = 0.05;
const STEP: f64 = 2.0;

enum Boundary {
    Straight(Segment),
    Round { centre: Point, radius: f64 },
}

impl Solids {
    /// The nearest point at which a body fits, and that is accepted; `None` where none is nearer than `within` metres.
    ///
    /// # Complexity
    /// Quadratic in the number of sides that are so near that the body at the point found would reach them.
    pub fn nearest_fit(
        &self,
        of: &Footprint,
        at: Point,
        within: f64,
        is_accepted: impl Fn(Point) -> bool,
    ) -> Option<Point> {
        let is_fit = |p: &Point| self.fits(of, *p, *p) && is_accepted(*p);
        if is_fit(&at) {
            return Some(at);
        }
        let mut reach = FIRST_M.min(within);
        loop {
            let mut near = self.candidates(of, at, reach);
            near.sort_by(|one, two| one.distance(at).total_cmp(&two.distance(at)));
            if let Some(found) = near.into_iter().find(is_fit) {
                return Some(found);
            }
            if reach >= within {
                return None;
            }
            reach = (reach * STEP).min(within);
        }
    }

    /// Where the nearest point may be, as far as it is nearer than `reach`.
    fn candidates(&self, of: &Footprint, at: Point, reach: f64) -> Vec<Point> {
        let extent = of.extent();
        let about = Rect::new(at.x - extent.x1, at.y - extent.y1, at.x - extent.x0, at.y - extent.y0);
        let b = self.bounds;
        let inner = Rect::new(b.x0 - extent.x0, b.y0 - extent.y0, b.x1 - extent.x1, b.y1 - extent.y1);
        let mut boundaries: Vec<Boundary> =
            polygon::sides(&inner.corners()).map(Boundary::Straight).collect();
        boundaries.extend(self.within(about.grown(reach), of.height).flat_map(|solid| solid.boundaries(of)));
        boundaries.retain(|boundary| boundary.foot(at).distance(at) < reach);
        let mut points: Vec<Point> = boundaries.iter().map(|boundary| boundary.foot(at)).collect();
        for (index, one) in boundaries.iter().enumerate() {
            points.extend(boundaries[index + 1..].iter().flat_map(|two| one.crossings(two)));
        }
        points.retain(|point| point.distance(at) < reach);
        points
    }
}

impl Solid {
    /// Where the middle of a body is that touches it, and some lines inside of that.
    fn boundaries(&self, of: &Footprint) -> Vec<Boundary> {
        let of_side = |side: Segment| -> Vec<Boundary> {
            match &of.outline {
                Shape::Disc(radius) => {
                    let along = side.direction();
                    let aside = along.perpendicular() * *radius;
                    let moved = |by: Point| Boundary::Straight(Segment::new(side.a + by, side.b + by));
                    let corner = Boundary::Round { centre: side.a, radius: *radius };
                    vec![moved(aside), moved(-aside), corner]
                }
                Shape::Body(corners) => {
                    let grown =
                        polygon::hull(corners.iter().flat_map(|&corner| [side.a - corner, side.b - corner]));
                    polygon::sides(&grown).map(Boundary::Straight).collect()
                }
            }
        };
        self.sides().into_iter().flat_map(of_side).collect()
    }
}

impl Boundary {
    /// Its point that is nearest to `p`.
    fn foot(&self, p: Point) -> Point {
        match self {
            Self::Straight(side) => side.nearest_to(p),
            Self::Round { centre, radius } => *centre + Segment::new(*centre, p).direction() * *radius,
        }
    }

    fn crossings(&self, other: &Self) -> Vec<Point> {
        match (self, other) {
            (Self::Straight(one), Self::Straight(two)) => {
                let (along, across) = (one.b - one.a, two.b - two.a);
                let sine = along.cross(across);
                if sine == 0.0 {
                    return Vec::new();
                }
                let share = (two.a - one.a).cross(across) / sine;
                vec![one.at(share)]
            }
            (Self::Straight(side), Self::Round { centre, radius })
            | (Self::Round { centre, radius }, Self::Straight(side)) => {
                let along = side.direction();
                let foot = side.a + along * (*centre - side.a).dot(along);
                let half = (radius * radius - foot.squared_distance(*centre)).max(0.0).sqrt();
                vec![foot + along * half, foot - along * half]
            }
            (Self::Round { centre, radius }, Self::Round { centre: other, radius: too }) => {
                let apart = centre.distance(*other);
                if apart == 0.0 || apart > radius + too {
                    return Vec::new();
                }
                let along = Segment::new(*centre, *other).direction();
                let to_chord = (apart * apart + radius * radius - too * too) / (2.0 * apart);
                let half = (radius * radius - to_chord * to_chord).max(0.0).sqrt();
                let (foot, aside) = (*centre + along * to_chord, along.perpendicular() * half);
                vec![foot + aside, foot - aside]
            }
        }
    }
}
