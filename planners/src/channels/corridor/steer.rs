//! What is known at a junction, and what a rule says to do there (a row of Lee's Table 2).

use std::fmt;

use super::axis::Axis;
use super::body::Robot;
use crate::geometry::{Point, Rect};

/// What is known when the robot is about to enter a junction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepFacts {
    pub junction: usize,
    pub rect: Rect,
    /// Number of the channel that is left there.
    pub channel: usize,
    /// Number of the channel that is entered there.
    pub next_channel: usize,
    /// The axis of the channel that is left.
    pub entering: Axis,
    /// Where the robot is: at its start, or where it arrives at the circle of the junction before.
    pub present: Point,
    /// Where it goes next: the centre of the next junction, or the goal.
    pub next: Point,
    /// Number of the next junction; `None` at the last one.
    pub next_junction: Option<usize>,
    /// Width of the narrower of the two channels.
    pub width: f64,
    /// The largest gap up to which the clearance about the corner is the gap:
    /// `(W² - w² - h²/4) / (2 (W + w))` for channels `W` wide and a robot `w` wide and `h` long. Negative where the robot
    /// cannot turn here at all.
    pub safest: f64,
    pub robot: Robot,
}

/// What a rule says to do at a junction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Steer {
    /// Which rule said so, for messages.
    pub rule: Option<u32>,
    /// The junction's corner to turn round: smallest or largest x, smallest or largest y.
    pub corner: (Extreme, Extreme),
    pub turn: Turn,
    /// Metres to keep between the robot's side and the corner.
    pub gap: f64,
    /// What leads from the corner to the arriving point, along x and along y.
    pub arriving: (Offset, Offset),
    /// The axis on which the distance from the robot to the corner enters the arriving angle: x is Lee's equation 5.6,
    /// y is 5.7.
    pub measured_along: Axis,
}

/// One of the two ends of a range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extreme {
    Min,
    Max,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Turn {
    Left,
    Right,
}

/// A part of the guiding circle's radius: `± rho cos theta` or `± rho sin theta`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Offset {
    /// Whether it is taken off.
    pub is_negative: bool,
    pub part: Part,
}

/// A part of the guiding circle's radius.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    Cos,
    Sin,
}

impl Turn {
    pub fn name(self) -> &'static str {
        match self {
            Self::Left => "left",
            Self::Right => "right",
        }
    }

    /// 1 for a left turn, -1 for a right one.
    pub fn sign(self) -> f64 {
        match self {
            Self::Left => 1.0,
            Self::Right => -1.0,
        }
    }
}

impl Offset {
    /// Its size on a circle of radius 1.
    pub(super) fn of(self, (cos, sin): (f64, f64)) -> f64 {
        let part = match self.part {
            Part::Cos => cos,
            Part::Sin => sin,
        };
        if self.is_negative { -part } else { part }
    }
}

impl Steer {
    pub(super) fn corner_of(&self, rect: &Rect) -> Point {
        let pick = |extreme, min, max| if extreme == Extreme::Min { min } else { max };
        Point::new(pick(self.corner.0, rect.x0, rect.x1), pick(self.corner.1, rect.y0, rect.y1))
    }
}

impl fmt::Display for Turn {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
