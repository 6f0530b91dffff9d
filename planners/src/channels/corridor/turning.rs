//! A robot that drives straight and turns while it does.

use super::body::{Body, apart, length};
use super::walls::Wall;
use crate::geometry::tolerance::ROUNDING;
use crate::geometry::{Point, Rect};
use crate::pose::{Frame, Pose};

/// Metres by which a distance may be too small.
const SLACK: f64 = 2e-7;

/// A straight way on which the heading changes evenly.
pub(super) struct Turning {
    from: Point,
    to: Point,
    heading: f64,
    by: f64,
    ends: [Frame; 2],
}

/// A moment, from 0 to 1, and where a point is then.
#[derive(Clone, Copy)]
struct Moment {
    share: f64,
    at: Point,
}

impl Turning {
    /// Turns by so many radians, to the left.
    pub fn new(from: Point, to: Point, heading: f64, by: f64) -> Self {
        let frame = |at, heading: f64| Frame::from(&Pose { at, heading });
        Self { from, to, heading, by, ends: [frame(from, heading), frame(to, heading + by)] }
    }

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
        let area = self.bounds(body.reach());
        let (mut least, mut nearest) = (f64::INFINITY, *walls.first()?);
        for wall in walls {
            if apart(&area, wall) >= least {
                continue;
            }
            let found = self.ends.map(|pose| body.distance(pose.seen(wall.a), pose.seen(wall.b)));
            let found = found[0].min(found[1]);
            if found < least {
                (least, nearest) = (found, *wall);
            }
        }
        for (index, wall) in walls.iter().enumerate() {
            if apart(&area, wall) >= least {
                continue;
            }
            let found = self.distance(body, &walls[..=index], least);
            if found < least {
                (least, nearest) = (found, *wall);
            }
        }
        Some((least - SLACK, nearest))
    }

    /// The smaller of `known` and what is between a body and the last one of some walls, at most [`SLACK`] too large; all
    /// before it are known.
    ///
    /// Two convex shapes come nearest with a corner of one of them: a corner of the body on its way past the wall, or an
    /// end of the wall on its way past the body, as the body sees it.
    fn distance(&self, body: &Body, walls: &[Wall], known: f64) -> f64 {
        let Some((wall, before)) = walls.split_last() else { return known };
        let middle = wall.a.midpoint(wall.b);
        let as_body = Body { half_length: wall.b.x - middle.x, half_width: wall.b.y - middle.y };
        let mut least = known;
        let (turned, travelled) = (self.by.abs(), length(self.to.x - self.from.x, self.to.y - self.from.y));
        for corner in body.corners() {
            let way = |pose: &Frame| pose.place(corner) - middle;
            let bend = turned * turned * body.reach();
            least = self.least_of(&way, &|_, _| bend, &as_body, least);
        }
        let is_new = |end: &Point| !before.iter().any(|wall| wall.a == *end || wall.b == *end);
        for end in [wall.a, wall.b].into_iter().filter(is_new) {
            let way = |pose: &Frame| pose.seen(end);
            let bend = |a: Point, b: Point| {
                turned * turned * length(a.x, a.y).max(length(b.x, b.y)) + 2.0 * turned * travelled
            };
            least = self.least_of(&way, &bend, body, least);
        }
        least
    }

    fn pose(&self, share: f64) -> Frame {
        let Self { from, to, heading, by, .. } = self;
        Frame::from(&Pose { at: from.lerp(*to, share), heading: heading + share * by })
    }

    /// The smaller of `known` and the least distance of a moving point to a body, at most [`SLACK`] too large. `known` is not
    /// larger than the distances at the start and at the end.
    ///
    /// At a share `t` of the time between two moments the point is at most `bend time² t (1 - t) / 2` beside the chord between
    /// its places, where `bend` bounds how its velocity changes. The distance along a chord is convex. So nothing need be
    /// looked at between two moments where the chord, less that, is not nearer than what is known, or leads away from the
    /// body fast enough at its start, or towards it at its end.
    fn least_of(
        &self,
        way: &impl Fn(&Frame) -> Point,
        bend: &impl Fn(Point, Point) -> f64,
        body: &Body,
        known: f64,
    ) -> f64 {
        let [from, to] = &self.ends;
        let (from, to) = (Moment { share: 0.0, at: way(from) }, Moment { share: 1.0, at: way(to) });
        let mut least = known;
        self.between(way, bend, body, (from, to), &mut least);
        least
    }

    fn between(
        &self,
        way: &impl Fn(&Frame) -> Point,
        bend: &impl Fn(Point, Point) -> f64,
        body: &Body,
        (from, to): (Moment, Moment),
        least: &mut f64,
    ) {
        let time = to.share - from.share;
        let curve = bend(from.at, to.at) * time * time / 2.0;
        let way_m = to.at - from.at;
        let (start, end) = (body.away(from.at), body.away(to.at));
        if start.dot(way_m) >= curve || end.dot(way_m) <= -curve {
            return;
        }
        let enough = *least - SLACK + curve / 4.0;
        if body.least_distance(from.at, to.at) >= enough || body.distance(from.at, to.at) >= enough {
            return;
        }
        let share = f64::midpoint(from.share, to.share);
        let middle = Moment { share, at: way(&self.pose(share)) };
        *least = least.min(body.distance_to(middle.at));
        if time > ROUNDING && *least > 0.0 {
            self.between(way, bend, body, (from, middle), least);
            self.between(way, bend, body, (middle, to), least);
        }
    }
}
