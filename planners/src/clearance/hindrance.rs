//! What keeps a body from going a way: something low over it, or an opening that is too narrow.

use super::{Footprint, Solid, Solids};
use crate::geometry::tolerance::ROUNDING_M;
use crate::geometry::{Point, Rect, Segment};

/// Steps in which a way is looked at, metres.
const STEP_M: f64 = 0.05;

/// What keeps a body from going a way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Hindrance {
    /// Something to pass under that leaves so much height, metres, at a point of the way.
    Low { leaves: f64, at: Point },
    /// The way leads between two solid things that are so far apart, metres: where they are nearest to each other.
    Narrow { leaves: f64, at: Point },
    /// It does not fit here, though it is slim and low enough.
    NoRoom { at: Point },
}

impl Hindrance {
    /// Where it is.
    pub fn at(&self) -> Point {
        match self {
            Self::Low { at, .. } | Self::Narrow { at, .. } | Self::NoRoom { at } => *at,
        }
    }
}

impl Solids {
    /// What keeps a body from going a way that others go; `None` where it fits all along, in some facing at each point.
    ///
    /// # Arguments
    /// `facings` is the body as it lies in each of its facings; `needs` is how wide an opening must be for it, metres.
    pub fn hindrance(&self, facings: &[Footprint], needs: f64, way: &[Segment]) -> Option<Hindrance> {
        let height = facings.first()?.height;
        let points: Vec<Point> = way.iter().flat_map(steps).collect();
        let is_out = |of: &dyn Fn(&Footprint, Point) -> bool| -> Vec<Point> {
            let fits = |p: &Point| facings.iter().any(|facing| of(facing, *p));
            points.iter().copied().filter(|p| !fits(p)).collect()
        };
        let out = is_out(&|facing, p| self.fits(facing, p, p));
        let under = out.iter().filter_map(|&p| Some((p, self.least_over(p, height)?)));
        let under: Vec<(Point, f64)> = under.collect();
        let least = under.iter().map(|(_, clear)| *clear).reduce(f64::min);
        if let Some(leaves) = least {
            let lowest: Vec<Point> =
                under.iter().filter(|(_, clear)| *clear <= leaves).map(|(p, _)| *p).collect();
            return Some(Hindrance::Low { leaves, at: lowest[lowest.len() / 2] });
        }
        let middle = *out.get(out.len() / 2)?;
        let opening = self.opening(&out, needs, height, way);
        Some(opening.unwrap_or(Hindrance::NoRoom { at: middle }))
    }

    /// The least clear height over a point, of what a body of a height does not pass under.
    fn least_over(&self, at: Point, height: f64) -> Option<f64> {
        let here = Rect::new(at.x, at.y, at.x, at.y).grown(ROUNDING_M);
        let over = self.within(here, height).filter(|solid| solid.is_over(at));
        over.filter_map(|solid| solid.height).reduce(f64::min)
    }

    /// The narrowest opening that a way leads through near some of its points, where it is narrower than what is needed.
    fn opening(&self, near: &[Point], needs: f64, height: f64, way: &[Segment]) -> Option<Hindrance> {
        let about = Rect::around(near.iter().copied()).grown(needs);
        let b = &self.bounds;
        let edge = [
            [b.x0, b.y0, b.x1, b.y0],
            [b.x1, b.y0, b.x1, b.y1],
            [b.x1, b.y1, b.x0, b.y1],
            [b.x0, b.y1, b.x0, b.y0],
        ];
        let edge = edge.map(|[x0, y0, x1, y1]| Segment::new(Point::new(x0, y0), Point::new(x1, y1)));
        let is_near = |side: &Segment| near.iter().any(|p| side.distance(*p) < needs);
        let sides = self.within(about, height).flat_map(Solid::sides).chain(edge);
        let sides: Vec<Segment> = sides.filter(is_near).collect();
        let mut best: Option<Segment> = None;
        for (index, one) in sides.iter().enumerate() {
            for other in &sides[index + 1..] {
                let across = between(one, other);
                let length = across.length();
                let is_less = best.is_none_or(|best| length < best.length());
                if length > ROUNDING_M
                    && length < needs - ROUNDING_M
                    && is_less
                    && way.iter().any(|leg| leg.meets(&across))
                {
                    best = Some(across);
                }
            }
        }
        best.map(|across| Hindrance::Narrow { leaves: across.length(), at: across.middle() })
    }
}

impl Solid {
    /// Whether a point lies in its outline or on it.
    fn is_over(&self, at: Point) -> bool {
        self.distance(&Segment::new(at, at).into()) <= ROUNDING_M
    }
}

/// Points of a leg, its ends with them.
fn steps(leg: &Segment) -> impl Iterator<Item = Point> + use<> {
    let (leg, count) = (*leg, (leg.length() / STEP_M).ceil().max(1.0) as u32);
    (0..=count).map(move |step| leg.at(f64::from(step) / f64::from(count)))
}

/// The shortest segment from one to another; of parallel ones, in the middle of what they have beside each other.
fn between(one: &Segment, other: &Segment) -> Segment {
    let feet = [
        Segment::new(one.a, other.nearest_to(one.a)),
        Segment::new(one.b, other.nearest_to(one.b)),
        Segment::new(one.nearest_to(other.a), other.a),
        Segment::new(one.nearest_to(other.b), other.b),
    ];
    let least = feet.iter().map(Segment::length).fold(f64::INFINITY, f64::min);
    let mut shortest = feet.into_iter().filter(|foot| foot.length() <= least + ROUNDING_M);
    let Some(first) = shortest.next() else { return feet[0] };
    let last = shortest.next_back().unwrap_or(first);
    Segment::new(first.a.midpoint(last.a), first.b.midpoint(last.b))
}
