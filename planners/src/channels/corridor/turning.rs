//! A robot that drives straight and turns while it does.

use super::body::{Body, length};
use super::walls::{Wall, apart};
use crate::geometry::{Point, Rect};

/// Metres by which a distance may be too small.
const SLACK: f64 = 2e-7;

/// A straight way on which the heading changes evenly.
pub(super) struct Turning {
    pub from: Point,
    pub to: Point,
    pub heading: f64,
    /// Radians, to the left.
    pub by: f64,
}

/// A moment of it, from 0 to 1, and where a point is then.
#[derive(Clone, Copy)]
struct Moment {
    share: f64,
    at: Point,
}

impl Turning {
    /// All that a body can reach whose farthest point is `reach` from its middle.
    fn bounds(&self, reach: f64) -> Rect {
        let Self { from, to, .. } = self;
        Rect::new(
            from.x.min(to.x) - reach,
            from.y.min(to.y) - reach,
            from.x.max(to.x) + reach,
            from.y.max(to.y) + reach,
        )
    }

    /// Metres between a body and the walls where they are nearest, at most [`SLACK`] too small and never too large; and
    /// the wall that is nearest. `None` without walls.
    pub fn nearest(&self, body: &Body, walls: &[Wall]) -> Option<(f64, Wall)> {
        let at_ends = |wall: &Wall| self.at(body, wall, 0.0).min(self.at(body, wall, 1.0));
        let (mut least, mut nearest) =
            walls.iter().map(|wall| (at_ends(wall), *wall)).min_by(|one, other| one.0.total_cmp(&other.0))?;
        let area = self.bounds(body.reach());
        for wall in walls {
            if apart(&area, wall) >= least {
                continue;
            }
            let found = self.distance(body, wall, least);
            if found < least {
                (least, nearest) = (found, *wall);
            }
        }
        Some((least - SLACK, nearest))
    }

    /// The smaller of `known` and what is between a body and a wall, at most [`SLACK`] too large.
    ///
    /// Two convex shapes come nearest with a corner of one of them: a corner of the body on its way past the wall, or an
    /// end of the wall on its way past the body, as the body sees it.
    fn distance(&self, body: &Body, wall: &Wall, known: f64) -> f64 {
        let middle = Point::new(f64::midpoint(wall.a.x, wall.b.x), f64::midpoint(wall.a.y, wall.b.y));
        let as_body = Body { half_length: wall.b.x - middle.x, half_width: wall.b.y - middle.y };
        let mut least = known;
        let (turned, travelled) = (self.by.abs(), length(self.to.x - self.from.x, self.to.y - self.from.y));
        for corner in body.corners() {
            let way = |share| {
                let (at, (sin, cos)) = self.pose(share);
                let (x, y) = (at.x + cos * corner.x - sin * corner.y, at.y + sin * corner.x + cos * corner.y);
                Point::new(x - middle.x, y - middle.y)
            };
            let bend = turned * turned * body.reach();
            least = least_of(&way, &|_, _| bend, &as_body, least);
        }
        for end in [wall.a, wall.b] {
            let way = |share| self.seen(end, share);
            let bend = |a: Point, b: Point| {
                turned * turned * length(a.x, a.y).max(length(b.x, b.y)) + 2.0 * turned * travelled
            };
            least = least_of(&way, &bend, body, least);
        }
        least
    }

    fn at(&self, body: &Body, wall: &Wall, share: f64) -> f64 {
        body.distance(self.seen(wall.a, share), self.seen(wall.b, share))
    }

    /// Where the middle is, and the sine and cosine of the heading.
    fn pose(&self, share: f64) -> (Point, (f64, f64)) {
        let Self { from, to, heading, by } = self;
        let at = Point::new(from.x + share * (to.x - from.x), from.y + share * (to.y - from.y));
        (at, (heading + share * by).sin_cos())
    }

    /// A point as the body sees it.
    fn seen(&self, point: Point, share: f64) -> Point {
        let (at, (sin, cos)) = self.pose(share);
        let (dx, dy) = (point.x - at.x, point.y - at.y);
        Point::new(cos * dx + sin * dy, cos * dy - sin * dx)
    }
}

/// The smaller of `known` and the least distance of a moving point to a body, at most [`SLACK`] too large.
///
/// Between two moments the point is as near to the chord between its places as an eighth of the square of the time times
/// `bend`, a bound on how its velocity changes; where even that is not nearer than what is known, nothing need be looked
/// at between them.
fn least_of(
    way: &impl Fn(f64) -> Point,
    bend: &impl Fn(Point, Point) -> f64,
    body: &Body,
    known: f64,
) -> f64 {
    let moment = |share| Moment { share, at: way(share) };
    let mut least = known;
    between(way, bend, body, (moment(0.0), moment(1.0)), &mut least);
    least
}

fn between(
    way: &impl Fn(f64) -> Point,
    bend: &impl Fn(Point, Point) -> f64,
    body: &Body,
    (from, to): (Moment, Moment),
    least: &mut f64,
) {
    let time = to.share - from.share;
    let off_chord = bend(from.at, to.at) * time * time / 8.0;
    let enough = *least - SLACK + off_chord;
    if body.least_distance(from.at, to.at) >= enough || body.distance(from.at, to.at) >= enough {
        return;
    }
    let share = f64::midpoint(from.share, to.share);
    let middle = Moment { share, at: way(share) };
    *least = least.min(body.distance_to(middle.at));
    // moments that are this near are the same place
    if time > 1e-9 && *least > 0.0 {
        between(way, bend, body, (from, middle), least);
        between(way, bend, body, (middle, to), least);
    }
}
