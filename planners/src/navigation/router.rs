//! Ways that a knowledge base finds, and what a robot tells it of those that are closed.

use super::stretch::Stretch;
use crate::geometry::{Point, Segment};

/// Where the robot found its way closed.
#[derive(Clone, Debug, PartialEq)]
pub struct Met {
    /// Where what it met stands, as it thinks.
    pub at: Point,
    /// Where it was heading: radians, counter-clockwise from the x axis.
    pub heading: f64,
    /// Whether what it met is known to stand there: the way is too narrow for it.
    pub is_known: bool,
    /// What it saw there, and did not know of.
    pub seen: Vec<Segment>,
}

/// Finds ways for a robot.
pub trait Router {
    /// The best way for a robot in a stance, from where it is to its goal, or to where it can tell where it is; `None` where there is
    /// none.
    ///
    /// # Arguments
    /// `met` is where the robot found its way closed, the latest last; none of it any more after it has begun anew.
    fn way(&mut self, ends: [Point; 2], stance: usize, met: &[Met]) -> Option<Vec<Stretch>>;

    /// How much of what the robot met was passed on to everybody, and how much taken back, since this was asked last.
    fn take_told(&mut self) -> [usize; 2] {
        [0; 2]
    }

    /// Whether others have changed what ways there are since a way was asked for.
    fn has_news(&mut self) -> bool {
        false
    }
}
