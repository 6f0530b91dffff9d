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
        if (to_heading - from_heading).abs() <= STRAIGHT && line.length > 0.0 {
            let swept = |body: Body| Body { half_length: body.half_length + line.length / 2.0, ..body };
            let middle =
                Point::new(f64::midpoint(line.from.x, line.to.x), f64::midpoint(line.from.y, line.to.y));
            let area = swept(self.body).bounds(middle, line.along);
            return self.least(
                TOUCH,
                |wall| apart(&area, wall),
                |body, wall, _| swept(body).distance_from(middle, line.along, wall),
            );
        }
        let turning =
            Turning { from: line.from, to: line.to, heading: from_heading, by: to_heading - from_heading };
        let area = turning.bounds(self.body.reach());
        self.least(
            TOUCH_TURNING,
            |wall| apart(&area, wall),
            |body, wall, known| turning.distance(&body, wall, known),
        )
    }

    /// What is left along an arc that is entered from a line; the wall that is hit, if one is.
    pub fn arc(&self, circle: &Circle, arriving: &Tangent, angle: f64) -> Result<f64, Wall> {
        let Circle { centre, radius, .. } = *circle;
        let reach = |body: &Body| (radius + body.half_width).hypot(body.half_length);
        let outermost = reach(&self.body);
        self.least(
            TOUCH,
            |wall| centre.distance(centre.nearest_on(wall.a, wall.b)) - outermost,
            |body, wall, _| Orbit { body, circle, along: arriving.along, angle }.distance(wall),
        )
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

/// A body that turns rigidly about a centre abreast of it.
struct Orbit<'a> {
    body: Body,
    circle: &'a Circle,
    /// Direction of travel at the start, of length 1.
    along: Point,
    angle: f64,
}

impl Orbit<'_> {
    /// Metres to a wall where it is nearest.
    ///
    /// Seen from the body, the wall turns about the centre. The distance to a fixed piece of it then has one minimum in a
    /// full turn: an end is nearest where it is abreast of the body, or passes its outer corners; the inside of the wall
    /// where its foot passes them. So it is enough to look at these angles and at both ends of the arc.
    fn distance(&self, wall: &Wall) -> f64 {
        let centre = self.circle.centre;
        let outer = self.circle.radius + self.body.half_width;
        let corner = self.body.half_length.atan2(outer);
        let reach = outer.hypot(self.body.half_length);
        let mut least = self.at(0.0, wall).min(self.at(self.angle, wall));
        let mut look = |point: Point, offset: f64| {
            let seen = self.seen(point, 0.0);
            let angle = (seen.x.atan2(seen.y + self.circle.radius) - offset).rem_euclid(TAU);
            if angle < self.angle {
                least = least.min(self.at(angle, wall));
            }
        };
        for end in [wall.a, wall.b] {
            let distance = centre.distance(end);
            if distance <= outer {
                look(end, 0.0);
            } else {
                let offset = if distance < reach { (outer / distance).acos() } else { corner };
                look(end, offset);
                look(end, -offset);
            }
        }
        let foot = centre.nearest_on(wall.a, wall.b);
        if foot != wall.a && foot != wall.b && foot != centre {
            look(foot, corner);
            look(foot, -corner);
        }
        least
    }

    /// Metres to a wall after some angle.
    fn at(&self, angle: f64, wall: &Wall) -> f64 {
        self.body.distance(self.seen(wall.a, angle), self.seen(wall.b, angle))
    }

    /// A point as the body sees it after some angle: x ahead, y away from the centre of the circle.
    fn seen(&self, point: Point, angle: f64) -> Point {
        let sign = self.circle.turn.sign();
        let (sin, cos) = (sign * angle).sin_cos();
        let (x, y) = (cos * self.along.x - sin * self.along.y, sin * self.along.x + cos * self.along.y);
        let (dx, dy) = (point.x - self.circle.centre.x, point.y - self.circle.centre.y);
        Point::new(dx * x + dy * y, sign * (dx * y - dy * x) - self.circle.radius)
    }
}

/// Metres between a rectangle and a wall.
fn apart(area: &Rect, wall: &Wall) -> f64 {
    let dx = (wall.a.x - area.x1).max(area.x0 - wall.b.x).max(0.0);
    let dy = (wall.a.y - area.y1).max(area.y0 - wall.b.y).max(0.0);
    (dx * dx + dy * dy).sqrt()
}
