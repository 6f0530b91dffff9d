//! Why a robot cannot drive a route.

use std::fmt;

use thiserror::Error;

use super::body::Robot;
use super::passage::End;
use super::steer::Turn;
use super::walls::Wall;
use crate::geometry::Point;
use crate::geometry::tolerance::ROUNDING;

/// Why [`Route::drive`](super::Route::drive) gives no drive; `E` is what steering fails with.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum DriveError<E> {
    /// No robot has this size.
    #[error("the robot is {} m wide and {} m long, expected two finite numbers above 0", robot.width, robot.length)]
    BadRobot { robot: Robot },
    /// No robot has this heading.
    #[error("the robot's heading at the start is {heading}, expected a finite number of radians")]
    BadHeading { heading: f64 },
    /// It could not be told what to do at a junction.
    #[error("{0}")]
    Steer(E),
    /// A gap that cannot be kept.
    #[error(
        "junction {junction}{}: the gap is {} m, expected a finite number that is not negative; in a channel {} m wide \
         the robot can keep {} m",
        by(*rule), Rounded(*gap), Rounded(*width), Rounded(*safest)
    )]
    BadGap {
        /// Number of the junction.
        junction: usize,
        /// The rule that said so.
        rule: Option<u32>,
        gap: f64,
        /// Width of the narrower channel.
        width: f64,
        /// The safest gap there; negative where the robot is too large to turn.
        safest: f64,
    },
    /// The arriving point is not where a line from the robot touches the guiding circle.
    #[error(
        "junction {junction}{}: the arriving point {} {}; the line from {} touches the circle about {} at {}",
        by(*rule), Coords(*arriving), off_circle(*distance, *radius), Coords(*present), Coords(*corner), Coords(*tangent)
    )]
    NotOnCircle {
        /// Number of the junction.
        junction: usize,
        /// The rule that said so.
        rule: Option<u32>,
        /// Where the robot comes from.
        present: Point,
        /// The corner that the rule chose.
        corner: Point,
        /// Radius of the guiding circle.
        radius: f64,
        /// The point that the rule gives.
        arriving: Point,
        /// Metres from the corner to that point.
        distance: f64,
        /// Where the circle is touched.
        tangent: Point,
    },
    /// Start or goal lie inside a guiding circle.
    #[error(
        "junction {junction}{}: {what} {} is {} m from the corner {}, expected at least {} m (half the robot's width and \
         the gap)",
        by(*rule), Coords(*point), Rounded(*distance), Coords(*corner), Rounded(*radius)
    )]
    InsideCircle {
        /// Number of the junction.
        junction: usize,
        /// The rule that chose the corner.
        rule: Option<u32>,
        /// Which of the two ends.
        what: End,
        point: Point,
        corner: Point,
        /// Metres between the two.
        distance: f64,
        /// Radius of the guiding circle.
        radius: f64,
    },
    /// Start or goal are too near the inner wall.
    #[error(
        "junction {junction}{}: {what} {} is {} m to the side of the inner wall, expected at least {} m (half the robot's \
         width and the gap)",
        by(*rule), Coords(*point), Rounded(*distance), Rounded(*radius)
    )]
    TooNearInnerWall {
        /// Number of the junction.
        junction: usize,
        /// The rule that chose the corner.
        rule: Option<u32>,
        /// Which of the two ends.
        what: End,
        point: Point,
        /// Metres to the line on which the inner wall lies.
        distance: f64,
        /// Radius of the guiding circle.
        radius: f64,
    },
    /// Two junctions are too near each other for what is to be driven about them.
    #[error(
        "junctions {first} and {second}: their corners are {} m apart, expected at least {} m for a turn to the \
         {first_turn} about {} m and then to the {second_turn} about {} m",
        Rounded(*distance), Rounded(*needed), Rounded(*first_radius), Rounded(*second_radius)
    )]
    TooNearEachOther {
        /// Number of the junction passed first.
        first: usize,
        /// Number of the other.
        second: usize,
        /// Metres between the two corners.
        distance: f64,
        /// Metres that are needed.
        needed: f64,
        /// Sense at the first one.
        first_turn: Turn,
        /// Sense at the other.
        second_turn: Turn,
        /// Radius of the guiding circle of the first one.
        first_radius: f64,
        /// Radius of the guiding circle of the other.
        second_radius: f64,
    },
    /// The robot hits a wall while it drives straight.
    #[error(
        "the robot hits the wall from {} to {} on its way from {} {} to {} {}",
        Coords(wall.a), Coords(wall.b), from, Coords(*a), to, Coords(*b)
    )]
    HitsOnLine {
        wall: Wall,
        /// What it comes from.
        from: End,
        a: Point,
        /// What it drives to.
        to: End,
        b: Point,
    },
    /// The robot hits a wall while it turns.
    #[error(
        "junction {junction}{} is too small for the robot with a gap of {} m: turning about {}, its outer corner reaches {} \
         m, and the wall from {} to {} is {} m away; the safest gap is {} m",
        by(*rule), Rounded(*gap), Coords(*corner), Rounded(*reach), Coords(wall.a), Coords(wall.b), Rounded(*distance),
        Rounded(*safest)
    )]
    HitsInTurn {
        /// Number of the junction.
        junction: usize,
        /// The rule that said how to turn.
        rule: Option<u32>,
        /// The gap it gave.
        gap: f64,
        /// The corner turned round.
        corner: Point,
        /// Metres from there to the outermost point of the robot.
        reach: f64,
        wall: Wall,
        /// Metres from the corner to the wall.
        distance: f64,
        /// The safest gap there.
        safest: f64,
    },
}

/// A number to six digits behind the point.
pub(super) struct Rounded(pub f64);

impl fmt::Display for Rounded {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // a zero without a sign
        write!(f, "{}", (self.0 * 1e6).round() / 1e6 + 0.0)
    }
}

struct Coords(Point);

impl fmt::Display for Coords {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "({}, {})", Rounded(self.0.x), Rounded(self.0.y))
    }
}

fn by(rule: Option<u32>) -> String {
    rule.map_or_else(String::new, |rule| format!(" (rule {rule})"))
}

fn off_circle(distance: f64, radius: f64) -> String {
    if (distance - radius).abs() > ROUNDING * radius {
        format!(
            "is off the guiding circle, {} m from the corner instead of {} m",
            Rounded(distance),
            Rounded(radius)
        )
    } else {
        "lies on the guiding circle, but is not reached by a line that touches it".to_owned()
    }
}
