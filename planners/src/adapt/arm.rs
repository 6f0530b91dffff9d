//! A planar arm (Chen 1994, section 4, has one of two links).

mod inverse;

use super::robot::{Configuration, Limit, Link, Links, Robot};
use crate::geometry::{Point, Segment};
use crate::pose::{Pose, wrapped};

/// An arm of n links in the plane. Joint i turns link i against link i - 1, the first one against the x axis of the cell;
/// radians, counter-clockwise. The tool is at the end of the last link and looks along it.
#[derive(Clone, Debug, PartialEq)]
pub struct Arm {
    base: Point,
    lengths: Vec<f64>,
    radius: f64,
    limits: Vec<Limit>,
}

/// Why numbers are no arm. Links are numbered from 0.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ArmError {
    #[error("an arm needs a link at least")]
    NoLinks,
    #[error("link {link} is {1} m long, and must be longer than 0", link = .0 + 1)]
    LinkLength(usize, f64),
    #[error("the radius of the links is {0} m, and must be 0 at least")]
    Radius(f64),
    #[error("the base of the arm is not at a finite place")]
    Base,
    #[error("there are {limits} joint limits for {links} links")]
    Limits { limits: usize, links: usize },
    #[error("joint {joint} goes from {1} to {2} rad, and must go from a lower to a higher angle", joint = .0 + 1)]
    Limit(usize, f64, f64),
}

impl Arm {
    /// An arm from its base, the lengths of its links and their common radius (metres) and a limit for each joint.
    pub fn new(base: Point, lengths: Vec<f64>, radius: f64, limits: Vec<Limit>) -> Result<Self, ArmError> {
        if lengths.is_empty() {
            return Err(ArmError::NoLinks);
        }
        if let Some((link, &length)) = (0..).zip(&lengths).find(|(_, l)| !(l.is_finite() && **l > 0.0)) {
            return Err(ArmError::LinkLength(link, length));
        }
        if !(radius.is_finite() && radius >= 0.0) {
            return Err(ArmError::Radius(radius));
        }
        if !(base.x.is_finite() && base.y.is_finite()) {
            return Err(ArmError::Base);
        }
        if limits.len() != lengths.len() {
            return Err(ArmError::Limits { limits: limits.len(), links: lengths.len() });
        }
        let is_wrong = |l: &Limit| !(l.low.is_finite() && l.high.is_finite() && l.low < l.high);
        if let Some((joint, limit)) = (0..).zip(&limits).find(|(_, l)| is_wrong(l)) {
            return Err(ArmError::Limit(joint, limit.low, limit.high));
        }
        Ok(Self { base, lengths, radius, limits })
    }

    pub fn base(&self) -> Point {
        self.base
    }

    pub fn lengths(&self) -> &[f64] {
        &self.lengths
    }

    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// The base, and the end of each link; metres in the frame of the cell.
    pub fn joints(&self, at: &[f64]) -> Vec<Point> {
        std::iter::once(self.base).chain(self.ends(at)).collect()
    }

    /// The end of each link, from the base on.
    fn ends(&self, at: &[f64]) -> impl Iterator<Item = Point> {
        at.iter().zip(&self.lengths).scan((self.base, 0.0_f64), |(place, heading), (angle, length)| {
            *heading += angle;
            let (sin, cos) = heading.sin_cos();
            *place = Point::new(place.x + length * cos, place.y + length * sin);
            Some(*place)
        })
    }

    /// For each link the sum over the links up to it of their lengths times something of how far they turn. The joints turn in
    /// step, so each link turns evenly, by the sum of the turns below it.
    fn turned(&self, from: &[f64], to: &[f64], of: impl Fn(f64) -> f64) -> Vec<f64> {
        let (mut sum, mut turned) = (0.0, 0.0);
        let turns = from.iter().zip(to).map(|(a, b)| b - a).zip(&self.lengths);
        turns
            .map(|(turn, length)| {
                turned += turn;
                sum += of(turned) * length;
                sum
            })
            .collect()
    }

    fn is_at(&self, at: &[f64], place: Point) -> bool {
        self.tool(at).at.distance(place) <= inverse::TOLERANCE_M
    }
}

impl Robot for Arm {
    fn limits(&self) -> &[Limit] {
        &self.limits
    }

    fn links(&self, at: &[f64]) -> Links {
        let from = |start: &mut Point, end| Some(Segment::new(std::mem::replace(start, end), end));
        self.ends(at).scan(self.base, from).map(|axis| Link { axis, radius: self.radius }).collect()
    }

    fn travel(&self, from: &[f64], to: &[f64]) -> Vec<f64> {
        // Each joint goes at most as far as the links below take it.
        self.turned(from, to, f64::abs)
    }

    fn bend(&self, from: &[f64], to: &[f64]) -> Vec<f64> {
        // What turns evenly accelerates by the square of its turn times its length, towards its middle.
        self.turned(from, to, |turned| turned * turned)
    }

    fn tool(&self, at: &[f64]) -> Pose {
        let end = self.ends(at).last().unwrap_or(self.base);
        Pose::new(end.x, end.y, wrapped(at.iter().sum()))
    }

    fn branch(&self, at: &[f64]) -> u8 {
        u8::from(at.get(1).is_some_and(|elbow| *elbow < 0.0))
    }

    fn inverse(&self, tool: &Pose, branch: u8, near: &[f64]) -> Option<Configuration> {
        match self.lengths.len() {
            1 => inverse::one_link(self, tool, near),
            2 => inverse::two_links(self, tool, branch, near),
            3 => inverse::three_links(self, tool, branch, near),
            _ => inverse::many_links(self, tool, near),
        }
    }
}

#[cfg(test)]
mod tests;
