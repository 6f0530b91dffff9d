//! The check before execution: an own reading of the objects, of which the planner's count and memory know nothing.

use std::sync::Arc;

use smallvec::SmallVec;

use super::object::Object;
use super::robot::{Configuration, Link, Robot, links_between};
use super::workcell::Revision;
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

/// The first collision on a path of straight motions: no point of the robot comes farther than the half of a stretch is long from
/// where it is in its middle, so that objects which are farther off there are out of the question, and what is left is halved (as
/// the conservative advancement of Mirtich 1996, from the middle). Touching is no collision.
pub fn collision<'o>(
    robot: &dyn Robot,
    objects: impl IntoIterator<Item = &'o Object>,
    path: &[Configuration],
) -> Option<Collision> {
    let outlines: Vec<Outline> = objects.into_iter().map(Outline::of).collect();
    hit_of(robot, &outlines, path)
}

/// The first collision of a path with outlines that were made ready before.
pub(super) fn hit_of<'o>(
    robot: &dyn Robot,
    outlines: impl IntoIterator<Item = &'o Outline>,
    path: &[Configuration],
) -> Option<Collision> {
    let last = path.len().saturating_sub(1);
    let outlines: Vec<&Outline> = outlines.into_iter().collect();
    (0..last.max(1)).find_map(|motion| {
        let (from, to) = (path.get(motion)?, path.get((motion + 1).min(last))?);
        let (share, outline) =
            Motion { robot, from, to, travel: robot.travel(from, to) }.first_hit(&outlines)?;
        Some(Collision { motion, share, object: outline.name.clone() })
    })
}

/// A straight motion under this check; the one of the planner's own is not used, so that its faults are found.
struct Motion<'m> {
    robot: &'m dyn Robot,
    from: &'m [f64],
    to: &'m [f64],
    /// For each link how far its points go at most, metres.
    travel: Vec<f64>,
}

/// A stretch of a motion, and the outlines to which the robot may come on it.
struct Stretch<'o> {
    low: f64,
    high: f64,
    near: SmallVec<[&'o Outline; 16]>,
    /// The first of them that is hit in the middle.
    hit: Option<&'o Outline>,
}

impl Motion<'_> {
    /// The first share at which an outline is hit, and which.
    fn first_hit<'o>(&self, outlines: &[&'o Outline]) -> Option<(f64, &'o Outline)> {
        let all = self.stretch(outlines, (0.0, 1.0));
        if all.near.is_empty() {
            return None;
        }
        // The ends are places of their own: between them it is looked at as closely as is said.
        let hit_at = |share: f64| {
            let hit = self.stretch(&all.near, (share, share)).hit;
            hit.map(|outline| (share, outline))
        };
        hit_at(0.0).or_else(|| self.hit_on(&all)).or_else(|| hit_at(1.0))
    }

    fn stretch<'o>(&self, outlines: &[&'o Outline], (low, high): (f64, f64)) -> Stretch<'o> {
        let half = (high - low) / 2.0;
        let links = links_between(self.robot, self.from, self.to, f64::midpoint(low, high));
        let mut stretch = Stretch { low, high, near: SmallVec::new(), hit: None };
        for &outline in outlines {
            let mut gap = f64::INFINITY;
            for (link, travel) in links.iter().zip(&self.travel) {
                let may_m = travel * half;
                if !outline.is_beyond(link, may_m) {
                    gap = gap.min(outline.gap(link) - may_m);
                    if gap + may_m < -ROUNDING_M {
                        stretch.hit.get_or_insert(outline);
                    }
                }
            }
            if gap < 0.0 {
                stretch.near.push(outline);
            }
        }
        stretch
    }

    fn hit_on<'o>(&self, stretch: &Stretch<'o>) -> Option<(f64, &'o Outline)> {
        let &Stretch { low, high, ref near, hit } = stretch;
        let middle = f64::midpoint(low, high);
        let hit = hit.map(|outline| (middle, outline));
        let is_fine = self.travel.iter().all(|travel| travel * (high - low) <= FINE_M);
        if near.is_empty() || is_fine {
            return hit;
        }
        let first = self.hit_on(&self.stretch(near, (low, middle)));
        first.or(hit).or_else(|| self.hit_on(&self.stretch(near, (middle, high))))
    }
}

/// What the check reads of objects, each with the state of the cell since when it is as it is.
pub(super) type Outlines = Arc<[(Revision, Outline)]>;

/// An object's outline in the cell, and a circle about it.
#[derive(Clone, Debug)]
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

    /// Whether a link is plainly farther off than so many metres.
    fn is_beyond(&self, link: &Link, than_m: f64) -> bool {
        let near_m = self.radius + link.radius + than_m;
        link.axis.squared_distance(self.middle) > near_m * near_m
    }

    /// Metres between a link and the outline, or less where it is far; negative where they overlap.
    fn gap(&self, link: &Link) -> f64 {
        let far = link.axis.distance(self.middle) - self.radius - link.radius;
        if far > self.radius {
            return far;
        }
        let sides = polygon::sides(&self.corners);
        // What encloses an end of the link lies about it, and so does the circle.
        let may_enclose = link.axis.a.squared_distance(self.middle) <= self.radius * self.radius;
        if may_enclose && polygon::encloses(sides.clone(), link.axis.a) {
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
