//! What the planner knows of a robot: its configurations, its body, its tool.

use std::fmt;

use smallvec::SmallVec;

use crate::geometry::Segment;
use crate::pose::Pose;
use crate::random::Random;

/// One number a joint or axis: radians or metres.
pub type Configuration = Vec<f64>;

/// A part of the body: everything within `radius` of its axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    /// In the frame of the cell, metres. Its ends may be one point.
    pub axis: Segment,
    /// Metres.
    pub radius: f64,
}

/// The body of a robot at a configuration; that of a robot of few links lies where it is used, without an allocation.
pub type Links = SmallVec<[Link; 4]>;

/// How far a joint or axis goes, radians or metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limit {
    pub low: f64,
    pub high: f64,
}

/// A robot whose configurations are points of a box; angles do not wrap.
///
/// A straight motion goes from one configuration to another with all joints in step.
pub trait Robot: fmt::Debug + Send + Sync {
    /// One for each joint or axis, so their number is the dimension of the configuration space.
    fn limits(&self) -> &[Limit];

    /// The body at a configuration; always the same number of links, in the same order.
    fn links(&self, at: &[f64]) -> Links;

    /// For each link a length, metres, that no point of it exceeds on its way along the straight motion.
    fn travel(&self, from: &[f64], to: &[f64]) -> Vec<f64>;

    /// For each link a length, metres: over a share of the straight motion no point of it strays farther from its own straight
    /// way than an eighth of that length times the square of the share. Unless something is known of a robot, it may stray
    /// without bound.
    fn bend(&self, from: &[f64], to: &[f64]) -> Vec<f64> {
        vec![f64::INFINITY; self.travel(from, to).len()]
    }

    /// Where the tool is at a configuration, and how it is turned.
    fn tool(&self, at: &[f64]) -> Pose;

    /// On which branch of the inverse kinematics a configuration is (an arm's elbow); 0 where there is only one.
    fn branch(&self, at: &[f64]) -> u8;

    /// A configuration within the limits that brings the tool to a pose (for robots of fewer than three joints: to its
    /// place), on this branch and, where there are several, near to a configuration; `None` where there is none.
    fn inverse(&self, tool: &Pose, branch: u8, near: &[f64]) -> Option<Configuration>;

    /// Whether this is a configuration: as many finite numbers as there are limits, each within its own.
    fn admits(&self, at: &[f64]) -> bool {
        let limits = self.limits();
        at.len() == limits.len()
            && at.iter().zip(limits).all(|(q, limit)| limit.low <= *q && *q <= limit.high)
    }
}

/// A configuration anywhere within the limits of a robot.
pub fn any_configuration(robot: &dyn Robot, random: &mut Random) -> Configuration {
    robot.limits().iter().map(|limit| random.between(limit.low, limit.high)).collect()
}

/// Distance of two configurations: Euclidean over the joints.
pub fn distance(from: &[f64], to: &[f64]) -> f64 {
    from.iter().zip(to).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

/// Length of a path of straight motions, by [`distance`].
pub fn length(path: &[Configuration]) -> f64 {
    path.windows(2).map(|pair| distance(&pair[0], &pair[1])).sum()
}

/// The configuration at a share (0 to 1) of a straight motion.
pub fn between(from: &[f64], to: &[f64], share: f64) -> Configuration {
    on_the_way(from, to, share).collect()
}

fn on_the_way(from: &[f64], to: &[f64], share: f64) -> impl Iterator<Item = f64> {
    from.iter().zip(to).map(move |(a, b)| a + share * (b - a))
}

/// A body whose links are wider by so many metres.
pub(super) fn wider(mut links: Links, by_m: f64) -> Links {
    for link in &mut links {
        link.radius += by_m;
    }
    links
}

/// The body of a robot at a share (0 to 1) of a straight motion.
pub(super) fn links_between(robot: &dyn Robot, from: &[f64], to: &[f64], share: f64) -> Links {
    robot.links(&on_the_way(from, to, share).collect::<SmallVec<[f64; 8]>>())
}
