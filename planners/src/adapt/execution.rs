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
    let outlines: Vec<Outline> = objects.into_iter().map(Outline::of).collect();
    hit_of(robot, &outlines.iter(), path)
}

/// The first collision of a path with outlines that were made ready before.
pub(super) fn hit_of<'o>(
    robot: &dyn Robot,
    outlines: &(impl Iterator<Item = &'o Outline> + Clone),
    path: &[Configuration],
) -> Option<Collision> {
    let stays = path.len() == 1;
    let last = if stays { 1 } else { path.len().saturating_sub(1) };
    for motion in 0..last {
        let (from, to) = (&path[motion], &path[if stays { motion } else { motion + 1 }]);
        let travel = robot.travel(from, to);
        let middle = links_between(robot, from, to, 0.5);
        // Most objects are so far that one look at the middle is enough.
        let is_near = |outline: &&Outline| {
            middle.iter().zip(&travel).any(|(link, travel)| outline.gap(link) < travel / 2.0)
        };
        for outline in outlines.clone().filter(is_near) {
            if let Some(share) = hit(robot, from, to, &travel, outline) {
                return Some(Collision { motion, share, object: outline.name.clone() });
            }
        }
    }
    None
}

/// An object's outline in the cell, and a circle about it.
pub(super) struct Outline {
    name: String,
    corners: Vec<Point>,
    middle: Point,
    radius: f64,
}

impl Outline {
    pub(super) fn of(object: &Object) -> Self {
        let corners = object.corners();
        let middle = corners.iter().fold(Point::default(), |sum, &corner| sum + corner)
            * (1.0 / corners.len().max(1) as f64);
        let radius = corners.iter().map(|corner| corner.distance(middle)).fold(0.0, f64::max);
        Self { name: object.name.clone(), corners, middle, radius }
    }

    /// Metres between a link and the outline, or less where it is far; negative where they overlap.
    fn gap(&self, link: &Link) -> f64 {
        let far = link.axis.distance(self.middle) - self.radius - link.radius;
        if far > self.radius {
            return far;
        }
        let sides = polygon::sides(&self.corners);
        if polygon::encloses(sides.clone(), link.axis.a) {
            return -f64::INFINITY;
        }
        let mut squared = f64::INFINITY;
        for side in sides {
            if side.crosses(&link.axis) {
                return -f64::INFINITY;
            }
            let of_side = side.squared_distance(link.axis.a).min(side.squared_distance(link.axis.b));
            squared = squared.min(of_side).min(link.axis.squared_distance(side.a));
        }
        squared.sqrt() - link.radius
    }
}

fn hit(robot: &dyn Robot, from: &[f64], to: &[f64], travel: &[f64], outline: &Outline) -> Option<f64> {
    let mut share = 0.0;
    loop {
        let mut step = f64::INFINITY;
        for (link, travel) in links_between(robot, from, to, share).iter().zip(travel) {
            let gap = outline.gap(link);
            if gap < -ROUNDING_M {
                return Some(share);
            }
            step = step.min(gap.max(FINE_M) / travel.max(FINE_M));
        }
        if share >= 1.0 {
            return None;
        }
        share = (share + step).min(1.0);
    }
}
