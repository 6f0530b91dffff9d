//! A point in the plane (Chen 1994, section 3).

use smallvec::smallvec;

use super::robot::{Configuration, Limit, Link, Links, Robot};
use crate::geometry::{Point, Segment};
use crate::pose::Pose;

/// A robot that is a disc, or a point where its radius is 0; its configuration is `[x, y]`, metres.
#[derive(Clone, Debug, PartialEq)]
pub struct PointRobot {
    limits: [Limit; 2],
    radius: f64,
}

impl PointRobot {
    /// A robot in a box; `radius` in metres.
    pub const fn new(limits: [Limit; 2], radius: f64) -> Self {
        Self { limits, radius }
    }

    pub fn radius(&self) -> f64 {
        self.radius
    }
}

impl Robot for PointRobot {
    fn limits(&self) -> &[Limit] {
        &self.limits
    }

    fn links(&self, at: &[f64]) -> Links {
        let place = Point::new(at[0], at[1]);
        smallvec![Link { axis: Segment::new(place, place), radius: self.radius }]
    }

    fn travel(&self, from: &[f64], to: &[f64]) -> Vec<f64> {
        vec![super::robot::distance(from, to)]
    }

    fn bend(&self, _from: &[f64], _to: &[f64]) -> Vec<f64> {
        vec![0.0]
    }

    fn tool(&self, at: &[f64]) -> Pose {
        Pose::new(at[0], at[1], 0.0)
    }

    fn branch(&self, _at: &[f64]) -> u8 {
        0
    }

    fn inverse(&self, tool: &Pose, _branch: u8, _near: &[f64]) -> Option<Configuration> {
        let at = vec![tool.at.x, tool.at.y];
        self.admits(&at).then_some(at)
    }
}
