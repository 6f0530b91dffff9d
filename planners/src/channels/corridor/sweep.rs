//! What is left between the robot and the walls while it drives.

use std::f64::consts::TAU;

use super::body::{Body, Robot};
use super::circle::{Circle, Tangent};
use super::turning::Turning;
use super::walls::Wall;
use crate::geometry::{Point, Rect};

/// Metres by which the robot may reach into a wall and only touch it: what rounding makes of a gap of 0.
const TOUCH: f64 = 1e-9;

/// The same where distances are not exact.
const TOUCH_TURNING: f64 = 1e-6;

/// Radians by which a heading may change unseen.
const STRAIGHT: f64 = 1e-12;

/// A robot among walls.
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
            let turning = Turning { from: line.from, to: line.to, heading: from_heading, by };
            let area = turning.bounds(self.body.reach());
            let distance = |body: Body, wall: &Wall, known| turning.distance(&body, wall, known);
            return self.least(TOUCH_TURNING, |wall| apart(&area, wall), distance);
        }
        let along = if line.length > 0.0 {
            line.along
        } else {
            let (sin, cos) = to_heading.sin_cos();
            Point::new(cos, sin)
        };
        let middle = Point::new(f64::midpoint(line.from.x, line.to.x), f64::midpoint(line.from.y, line.to.y));
        let swept = |body: Body| Body { half_length: body.half_length + line.length / 2.0, ..body };
        let area = swept(self.body).bounds(middle, along);
        let distance = |body, wall: &Wall, _| swept(body).distance_from(middle, along, wall);
        self.least(TOUCH, |wall| apart(&area, wall), distance)
    }

    /// What is left along an arc that is entered from a line; the wall that is hit, if one is.
    pub fn arc(&self, circle: &Circle, arriving: &Tangent, angle: f64) -> Result<f64, Wall> {
        let orbit = Orbit::new(circle, arriving.along, angle);
        let outermost = (circle.radius + self.body.half_width).hypot(self.body.half_length);
        let bound = |wall: &Wall| {
            let foot = circle.centre.nearest_on(wall.a, wall.b);
            length(foot.x - circle.centre.x, foot.y - circle.centre.y) - outermost
        };
        self.least(TOUCH, bound, |body, wall, _| orbit.distance(&body, wall))
    }

    /// The least distance to any wall; the wall that is hit, if the robot reaches more than `touch` into one. `bound` is a
    /// distance that is not larger, `distance` is told the least one known and need not be exact above it.
    fn least(
        &self,
        touch: f64,
        bound: impl Fn(&Wall) -> f64,
        distance: impl Fn(Body, &Wall, f64) -> f64,
    ) -> Result<f64, Wall> {
        let mut least = f64::INFINITY;
        for wall in self.walls {
            // a wall that is touched hides none that is hit
            if bound(wall) >= least.max(f64::MIN_POSITIVE) {
                continue;
            }
            least = least.min(distance(self.body, wall, least));
            if least <= 0.0 {
                if distance(self.body.grown(-touch), wall, f64::INFINITY) <= 0.0 {
                    return Err(*wall);
                }
                least = 0.0;
            }
        }
        Ok(least)
    }
}

/// A rigid turn about a centre abreast of what turns.
struct Orbit<'a> {
    circle: &'a Circle,
    /// Direction of travel at the start, of length 1.
    along: Point,
    angle: f64,
    /// Of `angle`.
    sin_cos: (f64, f64),
}

impl<'a> Orbit<'a> {
    fn new(circle: &'a Circle, along: Point, angle: f64) -> Self {
        Self { circle, along, angle, sin_cos: angle.sin_cos() }
    }

    /// Metres from a body to a wall where they are nearest.
    ///
    /// Seen from the body, the wall turns about the centre. The distance to a fixed piece of it then has one minimum in a
    /// full turn: an end is nearest where it is abreast of the body, or passes its outer corners; the inside of the wall
    /// where its foot passes them. So it is enough to look at these angles and at both ends of the arc.
    fn distance(&self, body: &Body, wall: &Wall) -> f64 {
        let outer = self.circle.radius + body.half_width;
        let seen = [self.seen(wall.a), self.seen(wall.b)];
        let at = |sin_cos| {
            let [a, b] = seen.map(|point| self.turned(point, sin_cos));
            body.distance(a, b)
        };
        let mut least = at((0.0, 1.0)).min(at(self.sin_cos));
        let mut look = |point: Point, offset: f64| {
            let angle = point.x.atan2(point.y) - offset;
            let angle = if angle < 0.0 { angle + TAU } else { angle };
            if angle < self.angle {
                least = least.min(at(angle.sin_cos()));
            }
        };
        let corner = || body.half_length.atan2(outer);
        for end in seen {
            let distance = length(end.x, end.y);
            if distance <= outer {
                look(end, 0.0);
                continue;
            }
            let passes_beside = distance >= length(outer, body.half_length);
            let offset = if passes_beside { corner() } else { (outer / distance).acos() };
            look(end, offset);
            look(end, -offset);
        }
        let foot = Point::default().nearest_on(seen[0], seen[1]);
        if foot != seen[0] && foot != seen[1] && foot != Point::default() {
            look(foot, corner());
            look(foot, -corner());
        }
        least
    }

    /// A point as it is seen at the start, from the centre: x in the direction of travel, y towards the body.
    fn seen(&self, point: Point) -> Point {
        let (dx, dy) = (point.x - self.circle.centre.x, point.y - self.circle.centre.y);
        let (x, y) = (self.along.x, self.along.y);
        Point::new(dx * x + dy * y, self.circle.turn.sign() * (dx * y - dy * x))
    }

    /// How the body sees such a point after some angle, from its own middle.
    fn turned(&self, seen: Point, (sin, cos): (f64, f64)) -> Point {
        Point::new(cos * seen.x - sin * seen.y, sin * seen.x + cos * seen.y - self.circle.radius)
    }
}

/// Of a vector of some metres: faster than `hypot`, which spares it numbers near the ends of their range.
fn length(x: f64, y: f64) -> f64 {
    (x * x + y * y).sqrt()
}

/// Metres between a rectangle and a wall.
fn apart(area: &Rect, wall: &Wall) -> f64 {
    let dx = (wall.a.x - area.x1).max(area.x0 - wall.b.x).max(0.0);
    let dy = (wall.a.y - area.y1).max(area.y0 - wall.b.y).max(0.0);
    length(dx, dy)
}
