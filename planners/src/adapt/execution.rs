//! The check before execution: an own reading of the objects, of which the planner's count and memory know nothing.

use super::object::Object;
use super::robot::{Configuration, Link, Robot, links_between};
use crate::geometry::tolerance::ROUNDING_M;
use crate::geometry::{Point, polygon};

#[derive(Clone, Debug, PartialEq)]
pub struct Collision {
    /// The motion, counted from 0: the one from this configuration of the path to the next.
    pub motion: usize,
    /// The share of the motion (0 to 1) after which it is.
    pub share: f64,
    pub object: String,
}

/// The resolution, metres: what touches by less than this between two points of the check may pass.
const FINE_M: f64 = 1e-4;

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
    let sides = polygon::sides(outline);
    if polygon::encloses(sides.clone(), link.axis.a) || sides.clone().any(|side| side.crosses(&link.axis)) {
        return -f64::INFINITY;
    }
    sides.map(|side| side.gap(&link.axis)).fold(f64::INFINITY, f64::min) - link.radius
}
