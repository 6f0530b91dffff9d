//! From a route and what rules say at its junctions to lines and arcs (Lee, section 5.1).

use super::assemble::{assembled, too_near};
use super::body::Robot;
use super::circle::Circle;
use super::drive_error::DriveError;
use super::route::Route;
use super::steer::{Steer, StepFacts, Turn};
use super::tangents::driven_lines;
use crate::geometry::Point;

/// A drive from start to goal.
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
    /// Metres that the robot's middle travels.
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

impl Route<'_> {
    /// Drives the route.
    ///
    /// # Arguments
    /// `heading` is the robot's at the start; it turns from there while it drives its first line, the shorter way round,
    /// to the left where both are the same. `None`: it starts with the heading of that line. `steer` is asked at each
    /// junction, in the order of travel.
    ///
    /// # Returns
    /// The drive, whose clearances are exact to rounding, but for a first line with a turn, where they may be as much as
    /// a micrometre too small; or what is in the way, see [above](super).
    ///
    /// # Complexity
    /// Junctions times walls; a line with a turn costs more the nearer it comes to walls.
    pub fn drive<E>(
        &self,
        robot: Robot,
        heading: Option<f64>,
        mut steer: impl FnMut(&StepFacts) -> Result<Steer, E>,
    ) -> Result<Drive, DriveError<E>> {
        let is_length = |metres: f64| metres.is_finite() && metres > 0.0;
        if !(is_length(robot.width) && is_length(robot.length)) {
            return Err(DriveError::BadRobot { robot });
        }
        if let Some(heading) = heading.filter(|heading| !heading.is_finite()) {
            return Err(DriveError::BadHeading { heading });
        }
        let steps = self.junctions.len();
        let (mut turns, mut circles) = (Vec::with_capacity(steps), Vec::with_capacity(steps + 2));
        circles.push(Circle::point(self.start));
        for step in 0..steps {
            let present = turns.last().map_or(self.start, |turn: &TurnMade| turn.arriving);
            let facts = self.facts(step, robot, present);
            let steer = steer(&facts).map_err(DriveError::Steer)?;
            let turn = self.decided(step, facts, steer)?;
            circles.push(Circle { centre: turn.corner, radius: turn.radius, turn: steer.turn });
            turns.push(turn);
            let line = circles[step].tangent_to(&circles[step + 1]);
            let line = line.ok_or_else(|| too_near(&turns, &circles, step, step + 1))?;
            turns[step].arrive_by_table(&line)?;
        }
        circles.push(Circle::point(self.goal));
        let lines = driven_lines(&circles).map_err(|(one, other)| too_near(&turns, &circles, one, other))?;
        assembled(self, robot, heading, turns, &lines)
    }
}
