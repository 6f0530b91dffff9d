//! The outline of a robot about its middle: how near things are to it, and how far it gets until it touches them.

use std::f64::consts::TAU;

use crate::geometry::{Point, Segment, polygon};

mod disc;
mod turning;

use disc::HAIR_M;
pub use disc::Touch;

/// Corners of a body are rounded by so much, metres: how deep something is in it can be told up to that.
const CORNER_M: f64 = 1e-3;

/// A disc looks to others like a polygon of so many sides about it.
const SIDES: usize = 24;

/// All that is within a radius of a core: of a point, or of a rectangle. Along x where it is not turned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rim {
    core: Core,
    radius_m: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Core {
    Middle,
    /// By its corners, counterclockwise.
    Rectangle([Point; 4]),
}

impl Rim {
    /// Of a round robot.
    pub const fn disc(radius_m: f64) -> Self {
        Self { core: Core::Middle, radius_m }
    }

    /// Of a robot that is longer than wide, or wider than long; metres.
    pub fn body(length_m: f64, width_m: f64) -> Self {
        let (half_length, half_width) = (length_m / 2.0, width_m / 2.0);
        let radius_m = CORNER_M.min(half_length).min(half_width);
        let (x, y) = (half_length - radius_m, half_width - radius_m);
        let corners = [Point::new(-x, -y), Point::new(x, -y), Point::new(x, y), Point::new(-x, y)];
        Self { core: Core::Rectangle(corners), radius_m }
    }

    /// Of a body of a width; of a disc of that width where it has no length.
    pub fn of(width_m: f64, length_m: Option<f64>) -> Self {
        length_m.map_or_else(|| Self::disc(width_m / 2.0), |length_m| Self::body(length_m, width_m))
    }

    /// By how much it is larger than what it is measured from, metres: a barrier nearer than that [is touched](Self::distance).
    pub const fn radius_m(&self) -> f64 {
        self.radius_m
    }

    pub const fn is_disc(&self) -> bool {
        matches!(self.core, Core::Middle)
    }

    /// By radians, counter-clockwise.
    #[must_use]
    pub fn turned(&self, by: f64) -> Self {
        match self.core {
            Core::Middle => *self,
            Core::Rectangle(corners) => {
                let turn = Point::towards(by);
                let core = Core::Rectangle(corners.map(|corner| corner.rotated(turn)));
                Self { core, ..*self }
            }
        }
    }

    /// Metres from the middle to the farthest point of it.
    pub fn outer_m(&self) -> f64 {
        self.corners().iter().map(|corner| corner.length()).fold(0.0, f64::max) + self.radius_m
    }

    /// Metres from the middle to the farthest point of what it is measured from.
    pub fn core_m(&self) -> f64 {
        self.outer_m() - self.radius_m
    }

    /// Metres from the middle to the nearest point outside of it.
    pub fn inner_m(&self) -> f64 {
        let sides = polygon::sides(self.corners());
        sides.map(|side| side.distance(Point::default())).fold(f64::INFINITY, f64::min) + self.radius_m
    }

    /// How far it reaches in a direction (of length 1), metres.
    pub fn extent_m(&self, towards: Point) -> f64 {
        self.corners().iter().map(|corner| corner.dot(towards)).fold(f64::NEG_INFINITY, f64::max)
            + self.radius_m
    }

    /// Metres from the middle to the rim in a direction (of length 1).
    pub fn reach_m(&self, towards: Point) -> f64 {
        let hit = |side: Segment| side.hit(Point::default(), towards).map(|(range, _)| range);
        polygon::sides(self.corners()).filter_map(hit).fold(0.0, f64::max) + self.radius_m
    }

    /// Metres from the core to a barrier, the middle being at a point: less than [the radius](Self::radius_m) is within the robot.
    pub fn distance(&self, at: Point, barrier: &Segment) -> f64 {
        match &self.core {
            Core::Middle => barrier.distance(at),
            Core::Rectangle(corners) => gap(&corners.map(|corner| at + corner), barrier),
        }
    }

    /// As [`Self::distance`], the least on a straight way of the middle.
    pub fn way_distance(&self, way: &Segment, barrier: &Segment) -> f64 {
        match &self.core {
            Core::Middle => way.gap(barrier),
            Core::Rectangle(corners) if way.a == way.b => gap(&corners.map(|corner| way.a + corner), barrier),
            Core::Rectangle(corners) => gap(
                &polygon::hull(corners.iter().flat_map(|&corner| [way.a + corner, way.b + corner])),
                barrier,
            ),
        }
    }

    /// The point of a barrier that is nearest to it.
    pub fn nearest_on(&self, at: Point, barrier: &Segment) -> Point {
        match &self.core {
            Core::Middle => barrier.nearest_to(at),
            Core::Rectangle(corners) => {
                let corners = corners.map(|corner| at + corner);
                let of_corner = corners.iter().map(|&corner| {
                    let on = barrier.nearest_to(corner);
                    (on.distance(corner), on)
                });
                let of_end = [barrier.a, barrier.b].into_iter().map(|end| {
                    let is_in = polygon::is_in_convex(&corners, end, 0.0);
                    let far = || polygon::sides(&corners).map(|side| side.distance(end));
                    (if is_in { 0.0 } else { far().fold(f64::INFINITY, f64::min) }, end)
                });
                let nearest = of_corner.chain(of_end).min_by(|one, other| one.0.total_cmp(&other.0));
                nearest.map_or(barrier.a, |(_, on)| on)
            }
        }
    }

    /// How far it gets on a straight way until it touches a barrier; `None` where it does not. What is touched already may be moved
    /// along and away from, and no nearer to.
    pub fn touch(&self, at: Point, way: Point, barrier: &Segment) -> Option<Touch> {
        let reach_m = self.radius_m;
        let Core::Rectangle(corners) = &self.core else { return disc::touch(at, reach_m, way, barrier) };
        let corners = corners.map(|corner| at + corner);
        let by_corner = corners.iter().filter_map(|&corner| disc::touch(corner, reach_m, way, barrier));
        // an end of the barrier that comes towards a side, seen from the robot
        let sides = polygon::sides(&corners);
        let by_side = [barrier.a, barrier.b].into_iter().flat_map(|end| {
            let touch = sides.clone().filter_map(move |side| disc::touch(end, reach_m, -way, &side));
            touch.map(move |touch| Touch { at: end, ..touch })
        });
        by_corner.chain(by_side).min_by(|one, other| one.share.total_cmp(&other.share))
    }

    /// Whether it is so near to a barrier that it feels it.
    pub fn feels(&self, at: Point, barrier: &Segment) -> bool {
        self.distance(at, barrier) <= self.radius_m + 3.0 * HAIR_M
    }

    /// Whether it stands clear of what is [so far away](Self::distance), metres.
    pub const fn is_clear_by(&self, distance_m: f64) -> bool {
        distance_m >= self.radius_m + HAIR_M
    }

    /// An outline that holds it, convex and counterclockwise.
    pub fn outline(&self, at: Point) -> Vec<Point> {
        match &self.core {
            Core::Middle => {
                let radius = self.radius_m / (TAU / (2 * SIDES) as f64).cos();
                let corner = |side: usize| at + Point::towards(TAU * side as f64 / SIDES as f64) * radius;
                (0..SIDES).map(corner).collect()
            }
            Core::Rectangle(corners) => {
                let [half_length, half_width] = [(0, 1), (1, 2)].map(|(from, to)| {
                    let side = Segment::new(corners[from], corners[to]);
                    side.direction() * self.radius_m
                });
                let out = [-half_length - half_width, half_length - half_width];
                let out = [out[0], out[1], -out[0], -out[1]];
                corners.iter().zip(out).map(|(&corner, out)| at + corner + out).collect()
            }
        }
    }

    /// Of what it is measured from.
    fn corners(&self) -> &[Point] {
        const MIDDLE: [Point; 1] = [Point::new(0.0, 0.0)];
        match &self.core {
            Core::Middle => &MIDDLE,
            Core::Rectangle(corners) => corners,
        }
    }
}

/// Metres from a convex outline, counterclockwise, to a barrier; 0 where they meet.
fn gap(corners: &[Point], barrier: &Segment) -> f64 {
    if polygon::is_in_convex(corners, barrier.a, 0.0) || polygon::is_in_convex(corners, barrier.b, 0.0) {
        return 0.0;
    }
    polygon::sides(corners).map(|side| side.gap(barrier)).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::geometry::tolerance::ROUNDING_M;

    fn point() -> impl Strategy<Value = Point> {
        (-2.0..2.0, -2.0..2.0).prop_map(|(x, y)| Point::new(x, y))
    }

    proptest! {
        #[test]
        fn a_body_stops_where_it_touches_and_not_before(
            at in point(), way in point(), a in point(), b in point(), by in -3.0..3.0_f64,
        ) {
            let (rim, barrier) = (Rim::body(0.9, 0.4).turned(by), Segment::new(a, b));
            prop_assume!(rim.distance(at, &barrier) > rim.radius_m() + 1e-6);
            let share = rim.touch(at, way, &barrier).map_or(1.0, |touch| touch.share);
            let gap = |share: f64| rim.distance(at + way * share, &barrier) - rim.radius_m();
            let least = (0..=500).map(|i| gap(share * f64::from(i) / 500.0)).fold(f64::INFINITY, f64::min);
            prop_assert!(least >= 0.0, "{least}");
            prop_assert!(share >= 1.0 || gap(share) < 3.0 * HAIR_M, "{share} {}", gap(share));
            let swept = rim.way_distance(&Segment::new(at, at + way * share), &barrier) - rim.radius_m();
            prop_assert!(swept >= -ROUNDING_M && swept <= least + ROUNDING_M, "{swept} {least}");
        }

        #[test]
        fn its_outline_is_as_long_and_as_wide_as_it_was_said_to_be(length in 0.1..2.0_f64, width in 0.1..2.0_f64, by in -3.0..3.0_f64) {
            let rim = Rim::body(length, width).turned(by);
            let at = Point::new(1.0, 2.0);
            let sides: Vec<f64> = polygon::sides(&rim.outline(at)).map(|side| side.length()).collect();
            prop_assert!((sides[0] - length).abs() < 1e-9 && (sides[1] - width).abs() < 1e-9, "{sides:?}");
            let along = Point::towards(by);
            prop_assert!((rim.extent_m(along) - length / 2.0).abs() < 1e-9);
            prop_assert!((rim.reach_m(along.perpendicular()) - width / 2.0).abs() < 1e-9);
            prop_assert!((rim.inner_m() - length.min(width) / 2.0).abs() < 1e-9);
        }
    }
}
