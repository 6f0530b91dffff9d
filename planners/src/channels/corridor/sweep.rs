//! What is left between the robot and the walls while it drives.

use super::body::{Body, Robot, apart, length};
use super::circle::{Circle, Tangent};
use super::turning::Turning;
use super::walls::Wall;
use crate::geometry::tolerance::{ROUNDING_M, SNAP_M};
use crate::geometry::{Point, Rect};

/// A wall into which a turning robot comes by less is only touched, metres: its distances are not exact.
const TOUCH_TURNING: f64 = SNAP_M;

/// Radians by which a heading may change unseen.
const STRAIGHT: f64 = 1e-12;

pub(super) struct Sweep<'a> {
    body: Body,
    walls: &'a [Wall],
}

impl<'a> Sweep<'a> {
    pub fn new(robot: Robot, walls: &'a [Wall]) -> Self {
        Self { body: Body::from(robot), walls }
    }

    /// What is left along a line, from one heading to another; the wall that is hit, if one is.
    pub fn line(&self, line: &Tangent, from_heading: f64, to_heading: f64) -> Result<f64, Wall> {
        let by = to_heading - from_heading;
        if by.abs() > STRAIGHT {
            let turning = Turning::new(line.from, line.to, from_heading, by);
            let least = turning.nearest(&self.body, self.walls).map_or(f64::INFINITY, |nearest| nearest.0);
            if least <= 0.0 {
                let within = turning.nearest(&self.body.grown(-TOUCH_TURNING), self.walls);
                if let Some((_, wall)) = within.filter(|within| within.0 <= 0.0) {
                    return Err(wall);
                }
            }
            return Ok(least.max(0.0));
        }
        let along = if line.length > 0.0 {
            line.along
        } else {
            let (sin, cos) = to_heading.sin_cos();
            Point::new(cos, sin)
        };
        let middle = line.from.midpoint(line.to);
        let swept = |body: Body| Body { half_length: body.half_length + line.length / 2.0, ..body };
        let area = swept(self.body).bounds(middle, along);
        let distance = |body, wall: &Wall| swept(body).distance_from(middle, along, wall);
        self.least(|wall| apart(&area, wall), distance)
    }

    /// What is left along an arc that is entered from a line; the wall that is hit, if one is.
    pub fn arc(&self, circle: &Circle, arriving: &Tangent, angle: f64) -> Result<f64, Wall> {
        let orbit = Orbit::new(circle, arriving.along, angle);
        let outermost = length(circle.radius + self.body.half_width, self.body.half_length);
        let Point { x, y } = circle.centre;
        let bound = |wall: &Wall| apart(&Rect::new(x, y, x, y), wall) - outermost;
        self.least(bound, |body, wall| orbit.distance(&body, wall))
    }

    /// The least distance to any wall; the wall that is hit, if one is. `bound` is a distance that is not larger.
    fn least(
        &self,
        bound: impl Fn(&Wall) -> f64,
        distance: impl Fn(Body, &Wall) -> f64,
    ) -> Result<f64, Wall> {
        let mut least = f64::INFINITY;
        for wall in self.walls {
            // a wall that is touched hides none that is hit
            if bound(wall) >= least.max(f64::MIN_POSITIVE) {
                continue;
            }
            least = least.min(distance(self.body, wall));
            if least <= 0.0 && distance(self.body.grown(-ROUNDING_M), wall) <= 0.0 {
                return Err(*wall);
            }
        }
        Ok(least)
    }
}

/// A rigid turn by less than half a circle about a centre abreast of what turns.
struct Orbit<'a> {
    circle: &'a Circle,
    /// Direction of travel at the start, of length 1.
    along: Point,
    angle: Angle,
}

/// An angle by its sine and cosine.
#[derive(Clone, Copy)]
struct Angle {
    sin: f64,
    cos: f64,
}

impl Angle {
    /// That of a vector, from the y axis on.
    fn of(x: f64, y: f64) -> Self {
        let length = length(x, y);
        Self { sin: x / length, cos: y / length }
    }

    fn minus(self, other: Self) -> Self {
        let Self { sin, cos } = other;
        Self { sin: self.sin * cos - self.cos * sin, cos: self.cos * cos + self.sin * sin }
    }
}

impl<'a> Orbit<'a> {
    fn new(circle: &'a Circle, along: Point, angle: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        Self { circle, along, angle: Angle { sin, cos } }
    }

    /// Metres from a body to a wall where they are nearest.
    ///
    /// Seen from the body, the wall turns about the centre. The distance to a fixed piece of it then has one minimum in a
    /// full turn: an end is nearest where it is abreast of the body, or passes its outer corners; the inside of the wall
    /// where its foot passes them. Who comes through the wall is on it with its middle at some moment. So it is enough to
    /// look at these angles and at both ends of the arc.
    fn distance(&self, body: &Body, wall: &Wall) -> f64 {
        let outer = self.circle.radius + body.half_width;
        let seen = [self.seen(wall.a), self.seen(wall.b)];
        let at = |angle: Angle| {
            let [a, b] = seen.map(|point| self.turned(point, angle));
            body.distance(a, b)
        };
        let mut least = at(Angle { sin: 0.0, cos: 1.0 }).min(at(self.angle));
        let mut look = |point: Point, offset: Angle| {
            // of the centre itself, which never comes nearer, this is no number, and neither comparison holds
            let angle = Angle::of(point.x, point.y).minus(offset);
            if angle.sin > 0.0 && self.angle.minus(angle).sin > 0.0 {
                least = least.min(at(angle));
            }
        };
        let corner = Angle::of(body.half_length, outer);
        for end in seen {
            let beyond = end.dot(end) - outer * outer;
            if beyond <= 0.0 {
                look(end, Angle { sin: 0.0, cos: 1.0 });
            } else {
                let ahead = beyond.sqrt();
                let offset = if ahead < body.half_length { Angle::of(ahead, outer) } else { corner };
                look(end, offset);
                look(end, Angle { sin: -offset.sin, ..offset });
            }
        }
        for crossed in self.crossings(seen) {
            look(crossed, Angle { sin: 0.0, cos: 1.0 });
        }
        let foot = Point::default().nearest_on(seen[0], seen[1]);
        if foot != seen[0] && foot != seen[1] {
            look(foot, corner);
            look(foot, Angle { sin: -corner.sin, ..corner });
        }
        least
    }

    /// Where a wall crosses the circle that the middle goes along.
    fn crossings(&self, [a, b]: [Point; 2]) -> impl Iterator<Item = Point> + use<> {
        let whole = (b - a).length();
        let along = (b - a) * (1.0 / whole);
        let foot = -a.dot(along);
        let half = (self.circle.radius.powi(2) - a.cross(along).powi(2)).sqrt();
        // no number where the wall lies outside of the circle, and then neither comparison holds
        [foot - half, foot + half]
            .into_iter()
            .filter(move |at| (0.0..=whole).contains(at))
            .map(move |at| a + along * at)
    }

    /// A point as it is seen at the start, from the centre: x in the direction of travel, y towards the body.
    fn seen(&self, point: Point) -> Point {
        let (dx, dy) = (point.x - self.circle.centre.x, point.y - self.circle.centre.y);
        let (x, y) = (self.along.x, self.along.y);
        Point::new(dx * x + dy * y, self.circle.turn.sign() * (dx * y - dy * x))
    }

    /// How the body sees such a point after some angle, from its own middle.
    fn turned(&self, seen: Point, Angle { sin, cos }: Angle) -> Point {
        Point::new(cos * seen.x - sin * seen.y, sin * seen.x + cos * seen.y - self.circle.radius)
    }
}
