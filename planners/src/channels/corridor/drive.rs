//! A drive from start to goal: lines, arcs, and what was decided at the junctions.

use super::steer::{Steer, StepFacts, Turn};
use crate::geometry::Point;

#[derive(Clone, Debug, PartialEq)]
pub struct Drive {
    /// Lines and arcs in turn, from a line to a line.
    pub primitives: Vec<Primitive>,
    /// What was decided at each junction, in the order of travel.
    pub turns: Vec<TurnMade>,
    /// Metres that the robot's middle travels.
    pub length: f64,
    /// Metres between the robot and the nearest wall where it is nearest.
    pub min_clearance: f64,
}

/// A piece of a drive. The robot's middle follows it; its heading changes evenly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Primitive {
    /// Straight. Only on the first one, and only where the robot starts with another heading, does the heading change.
    Line {
        a: Point,
        b: Point,
        from_heading: f64,
        /// Heading at `b`, less than a full turn away from that at `a`.
        to_heading: f64,
        /// Metres between the robot and the nearest wall where it is nearest.
        clearance: f64,
    },
    /// About the corner of a junction, which lies abreast of the robot all the time.
    Arc {
        junction: usize,
        centre: Point,
        /// From the corner to the robot's middle.
        radius: f64,
        turn: Turn,
        a: Point,
        b: Point,
        from_heading: f64,
        /// Heading at `b`, less than half a turn away from that at `a`.
        to_heading: f64,
        clearance: f64,
    },
}

/// What was decided at a junction, and what came of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TurnMade {
    pub facts: StepFacts,
    pub steer: Steer,
    pub corner: Point,
    /// Radius of the guiding circle: half the robot's width and the gap.
    pub radius: f64,
    /// The arriving angle `theta` of Lee's equations 5.6 and 5.7.
    pub theta: f64,
    /// Where the robot arrives at the circle; where it is nearest to the corner, if it passes the circle by.
    pub arriving: Point,
    /// Where it leaves the circle; the same as `arriving` if it passes the circle by.
    pub leaving: Point,
    /// Radians driven about the corner; 0 if it passes the circle by.
    pub angle: f64,
}

impl Primitive {
    pub fn length(&self) -> f64 {
        match *self {
            Self::Line { a, b, .. } => a.distance(b),
            Self::Arc { radius, from_heading, to_heading, .. } => radius * (to_heading - from_heading).abs(),
        }
    }

    pub fn clearance(&self) -> f64 {
        match *self {
            Self::Line { clearance, .. } | Self::Arc { clearance, .. } => clearance,
        }
    }
}
