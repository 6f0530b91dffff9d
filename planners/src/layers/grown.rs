//! Where the middle of a disc or of a body can be: the floor without all that is solid, grown by it. Straight walls are grown
//! exactly; about their corners a disc's arc is drawn around by its tangents, on the safe side.

use std::f64::consts::TAU;

use geo::algorithm::bool_ops::FillRule;
use geo::{BooleanOps, Coord, LineString, MultiPolygon, OpType, Polygon};

use super::walls::Corner;
use crate::geometry::polygon::{sides, without_straight};
use crate::geometry::tolerance::SNAP_M;
use crate::geometry::{Point, Rect};

/// Rings whose insides lie to their left: outlines counterclockwise, their holes clockwise.
pub(super) type Rings = Vec<Vec<Point>>;

/// The largest angle by which a tangent of an arc turns from the next one.
const TURN: f64 = TAU / 4.0;

/// An area that a disc may not touch has tangents about its corners in so many directions.
const FINE: u32 = 16;

/// Straight sides are left as rough as this, metres.
const ROUGH_M: f64 = 0.5 * SNAP_M;

/// What is moved about.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Moved {
    /// By its radius, metres.
    Disc(f64),
    /// Convex, by its corners about the middle, counterclockwise.
    Body(Vec<Point>),
}

impl Moved {
    /// How far a disc of radius 1 stays from a corner at most where the arc about it is drawn coarsely.
    pub fn most() -> f64 {
        1.0 / (TURN / 2.0).cos()
    }

    /// Where its middle can be, up to [`SNAP_M`].
    ///
    /// # Arguments
    /// `solid` lies to the left of its rings.
    pub fn free_space(&self, bounds: Rect, solid: &[Vec<Corner>]) -> Rings {
        let extent = self.extent();
        let inner = Rect::new(
            bounds.x0 - extent.x0,
            bounds.y0 - extent.y0,
            bounds.x1 - extent.x1,
            bounds.y1 - extent.y1,
        );
        if inner.dx() <= 0.0 || inner.dy() <= 0.0 {
            return Vec::new();
        }
        let grown = MultiPolygon::new(solid.iter().map(|ring| polygon(self.grown(ring))).collect());
        let floor = polygon(inner.corners().map(Coord::from).into());
        let free = floor.boolean_op_with_fill_rule(&grown, OpType::Difference, FillRule::Positive);
        rings(&free)
    }

    /// Where its middle is while any part of it is in an area.
    pub fn met(&self, bounds: Rect, area: &[Point]) -> Rings {
        let signed: f64 = sides(area).map(|side| side.a.cross(side.b)).sum();
        // nothing rounds these arcs later
        let tight: Vec<Point> =
            (0..FINE).map(|part| Point::towards(TAU * f64::from(part) / f64::from(FINE))).collect();
        let mut corners: Vec<Corner> = area.iter().map(|&at| Corner { at, tight: tight.clone() }).collect();
        if signed < 0.0 {
            corners.reverse();
        }
        let grown = MultiPolygon::new(vec![polygon(self.grown(&corners))]);
        let floor = polygon(bounds.corners().map(Coord::from).into());
        rings(&floor.boolean_op_with_fill_rule(&grown, OpType::Intersection, FillRule::Positive))
    }

    fn extent(&self) -> Rect {
        match self {
            Self::Disc(radius) => Rect::new(-radius, -radius, *radius, *radius),
            Self::Body(corners) => Rect::around(corners.iter().copied()),
        }
    }

    /// A ring moved outwards: where it winds about a point at least once, nothing can have its middle there.
    fn grown(&self, ring: &[Corner]) -> Vec<Coord> {
        let count = ring.len();
        let mut moved: Vec<Coord> = Vec::with_capacity(3 * count);
        for at in 0..count {
            let before = ring[(at + count - 1) % count].at;
            let Corner { at: here, tight } = &ring[at];
            let here = *here;
            let after = ring[(at + 1) % count].at;
            let [one, two] = [outward(before, here), outward(here, after)];
            let turned = one.cross(two).atan2(one.dot(two));
            if turned < 0.0 {
                // the two sides moved cross each other: what lies between is wound about the other way round
                moved.extend([here + self.reach(one), here, here + self.reach(two)].map(Coord::from));
            } else {
                self.round(here, (one, turned), tight, &mut moved);
            }
        }
        moved
    }

    /// How a side is moved to whose outside a direction points.
    fn reach(&self, outward: Point) -> Point {
        match self {
            Self::Disc(radius) => outward * *radius,
            Self::Body(corners) => {
                // what touches a wall is the part of the body that lies furthest against it
                let furthest = corners.iter().min_by(|a, b| a.dot(outward).total_cmp(&b.dot(outward)));
                furthest.map_or(Point::default(), |&corner| -corner)
            }
        }
    }

    /// The outline about a corner, from one side to the next, which turns from it by so many radians.
    fn round(&self, here: Point, (from, turned): (Point, f64), tight: &[Point], moved: &mut Vec<Coord>) {
        match self {
            Self::Disc(radius) => {
                let even = (turned / TURN - SNAP_M).ceil().max(1.0);
                let mut touching: Vec<f64> =
                    (0..=even as u32).map(|number| turned * f64::from(number) / even).collect();
                let angle = |to: &Point| from.cross(*to).atan2(from.dot(*to));
                touching.extend(tight.iter().map(angle).filter(|angle| (0.0..turned).contains(angle)));
                touching.sort_by(f64::total_cmp);
                let corner = |ends: &[f64]| {
                    let (middle, half) = (f64::midpoint(ends[0], ends[1]), (ends[1] - ends[0]) / 2.0);
                    let way = from.rotated(Point::towards(middle));
                    Coord::from(here + way * (radius / half.cos()))
                };
                moved.extend(touching.windows(2).map(corner));
            }
            Self::Body(corners) => {
                moved.push(Coord::from(here + self.reach(from)));
                let count = corners.len();
                // the body's sides that face the corner one after the other while it is passed
                let mut facing: Vec<(f64, usize)> = Vec::new();
                for side in 0..count {
                    let against = -outward(corners[side], corners[(side + 1) % count]);
                    let angle = from.cross(against).atan2(from.dot(against)).rem_euclid(TAU);
                    if angle < turned {
                        facing.push((angle, side));
                    }
                }
                facing.sort_by(|a, b| a.0.total_cmp(&b.0));
                for (_, side) in facing {
                    moved.push(Coord::from(here - corners[(side + 1) % count]));
                }
                moved.push(Coord::from(here + self.reach(from.rotated(Point::towards(turned)))));
            }
        }
    }
}

fn rings(of: &MultiPolygon) -> Rings {
    let rings = of.iter().flat_map(|part| std::iter::once(part.exterior()).chain(part.interiors()));
    let corners = rings.map(|ring| ring.0.iter().map(|&corner| corner.into()).collect::<Vec<Point>>());
    corners.map(|corners| without_straight(&corners, ROUGH_M)).filter(|corners| corners.len() > 2).collect()
}

/// The direction, of length 1, to the right of a side.
fn outward(from: Point, to: Point) -> Point {
    let way = to - from;
    Point::new(way.y, -way.x) * (1.0 / way.length())
}

fn polygon(ring: Vec<Coord>) -> Polygon {
    Polygon::new(LineString::new(ring), Vec::new())
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::geometry::Segment;
    use crate::geometry::polygon::{encloses, sides};

    const BOUNDS: Rect = Rect::new(0.0, 0.0, 10.0, 10.0);

    fn star() -> impl Strategy<Value = Vec<Point>> {
        let spoke = prop::collection::vec((0.2f64..2.5, 0.3f64..1.0), 4..12);
        (spoke, 2.0..8.0, 2.0..8.0).prop_map(|(spokes, x, y)| {
            let total: f64 = spokes.iter().map(|(_, step)| step).sum();
            let mut angle = 0.0;
            let corner = |(radius, step): (f64, f64)| {
                angle += step / total * TAU;
                Point::new(x, y) + Point::towards(angle) * radius
            };
            spokes.into_iter().map(corner).collect()
        })
    }

    fn corners(stars: &[Vec<Point>]) -> Vec<Vec<Corner>> {
        stars.iter().map(|star| star.iter().map(|&at| at.into()).collect()).collect()
    }

    fn points() -> impl Strategy<Value = Vec<Point>> {
        let point = (0.0f64..10.0, 0.0f64..10.0).prop_map(|(x, y)| Point::new(x, y));
        prop::collection::vec(point, 40)
    }

    proptest! {
        #[test]
        fn a_disc_is_free_where_it_keeps_its_radius_and_only_arcs_take_more(
            stars in prop::collection::vec(star(), 1..5), radius in 0.1f64..0.8, points in points()
        ) {
            let free = Moved::Disc(radius).free_space(BOUNDS, &corners(&stars));
            for p in points {
                let solid = stars.iter().map(|star| {
                    let near = sides(star).map(|side| side.distance(p)).fold(f64::INFINITY, f64::min);
                    if encloses(sides(star), p) { 0.0 } else { near }
                });
                let edge = p.x.min(10.0 - p.x).min(p.y).min(10.0 - p.y);
                let distance = solid.fold(edge, f64::min);
                let is_free = encloses(free.iter().flat_map(|ring| sides(ring)), p);
                if distance < radius - SNAP_M {
                    prop_assert!(!is_free, "{p:?} is {distance} from what is solid");
                } else if distance > radius * Moved::most() + 1e-5 {
                    prop_assert!(is_free, "{p:?} is {distance} from what is solid");
                }
            }
        }

        #[test]
        fn a_body_is_free_where_it_overlaps_nothing(
            stars in prop::collection::vec(star(), 1..5), along in 0.1f64..0.8, across in 0.1f64..0.4,
            heading in 0.0f64..3.0, points in points()
        ) {
            let turned = |x: f64, y: f64| Point::new(x, y).rotated(Point::towards(heading));
            let body = vec![turned(-along, -across), turned(along, -across), turned(along * 1.1, across), turned(-along, across)];
            let free = Moved::Body(body.clone()).free_space(BOUNDS, &corners(&stars));
            for p in points {
                let there: Vec<Point> = body.iter().map(|&corner| corner + p).collect();
                let is_out = there.iter().any(|c| !BOUNDS.contains(*c));
                let gap = stars.iter().flat_map(|star| sides(star)).flat_map(|side| {
                    sides(&there).map(move |own: Segment| own.gap(&side)).collect::<Vec<_>>()
                });
                let gap = gap.fold(f64::INFINITY, f64::min);
                let rim = there.iter().map(|c| c.x.min(10.0 - c.x).min(c.y).min(10.0 - c.y).abs());
                prop_assume!(rim.fold(gap, f64::min) > 1e-5 || gap <= 0.0);
                let is_within = stars.iter().any(|star| encloses(sides(star), there[0]));
                let holds = stars.iter().any(|star| encloses(sides(&there), star[0]));
                let is_free = encloses(free.iter().flat_map(|ring| sides(ring)), p);
                prop_assert_eq!(is_free, !(is_out || gap <= 0.0 || is_within || holds), "{:?}", p);
            }
        }
    }
}
