//! The check before execution: an own reading of the objects, of which the planner's count and memory know nothing.

use super::object::Object;
use super::robot::{Configuration, Link, Robot, links_between};
use crate::geometry::Point;
use crate::segment::Segment;

/// Where a path is in collision.
#[derive(Clone, Debug, PartialEq)]
pub struct Collision {
    /// The motion, counted from 0: the one from this configuration of the path to the next.
    pub motion: usize,
    /// The share of the motion (0 to 1) after which it is.
    pub share: f64,
    /// The name of the object.
    pub object: String,
}

/// The resolution, metres: what touches by less than this between two points of the check may pass.
const FINE_M: f64 = 1e-4;

/// What touches overlaps by no more than this in floating point.
const ROUNDING_M: f64 = 1e-9;

/// The first collision on a path of straight motions, by conservative advancement (Mirtich 1996): from each configuration
/// on, the path is free for as far as no point of the robot can come to the object. Touching is no collision.
pub fn collision<'o>(
    robot: &dyn Robot,
    objects: impl IntoIterator<Item = &'o Object>,
    path: &[Configuration],
) -> Option<Collision> {
    let outlines: Vec<(&str, Vec<Point>)> =
        objects.into_iter().map(|object| (object.name.as_str(), object.corners())).collect();
    let stays = path.len() == 1;
    let last = if stays { 1 } else { path.len().saturating_sub(1) };
    for motion in 0..last {
        let (from, to) = (&path[motion], &path[if stays { motion } else { motion + 1 }]);
        let travel = robot.travel(from, to).into_iter().fold(0.0, f64::max);
        for (name, outline) in &outlines {
            if let Some(share) = hit(robot, from, to, travel, outline) {
                return Some(Collision { motion, share, object: (*name).to_owned() });
            }
        }
    }
    None
}

fn hit(robot: &dyn Robot, from: &[f64], to: &[f64], travel: f64, outline: &[Point]) -> Option<f64> {
    let mut share = 0.0;
    loop {
        let links = links_between(robot, from, to, share);
        let gap = links.iter().map(|link| gap(link, outline)).fold(f64::INFINITY, f64::min);
        if gap < -ROUNDING_M {
            return Some(share);
        }
        if share >= 1.0 {
            return None;
        }
        share = (share + gap.max(FINE_M) / travel.max(FINE_M)).min(1.0);
    }
}

/// Metres between a link and an outline; negative where they overlap.
fn gap(link: &Link, outline: &[Point]) -> f64 {
    let Segment { a, b } = link.axis;
    if winds_round(outline, a) {
        return -f64::INFINITY;
    }
    let mut squared = f64::INFINITY;
    for (index, &c) in outline.iter().enumerate() {
        let d = outline[(index + 1) % outline.len()];
        if side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0 {
            return -f64::INFINITY;
        }
        let ends = [apart(a, c, d), apart(b, c, d), apart(c, a, b), apart(d, a, b)];
        squared = ends.into_iter().fold(squared, f64::min);
    }
    squared.sqrt() - link.radius
}

/// On which side of the line through `a` and `b` a point is.
fn side(a: Point, b: Point, p: Point) -> f64 {
    (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x)
}

/// Square of the distance from a point to a segment.
fn apart(p: Point, a: Point, b: Point) -> f64 {
    let (along, out) = ((b.x - a.x, b.y - a.y), (p.x - a.x, p.y - a.y));
    let squared = along.0 * along.0 + along.1 * along.1;
    let share = if squared > 0.0 { (out.0 * along.0 + out.1 * along.1) / squared } else { 0.0 };
    let share = share.clamp(0.0, 1.0);
    (out.0 - share * along.0).powi(2) + (out.1 - share * along.1).powi(2)
}

/// Whether an outline goes round a point, by its winding number (Sunday 2001).
fn winds_round(outline: &[Point], p: Point) -> bool {
    let mut turns = 0;
    for (index, &a) in outline.iter().enumerate() {
        let b = outline[(index + 1) % outline.len()];
        if a.y <= p.y && b.y > p.y && side(a, b, p) > 0.0 {
            turns += 1;
        } else if a.y > p.y && b.y <= p.y && side(a, b, p) < 0.0 {
            turns -= 1;
        }
    }
    turns != 0
}
