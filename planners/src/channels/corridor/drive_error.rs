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
    #[error("the robot is {} m wide and {} m long, expected two finite numbers above 0", robot.width, robot.length)]
    BadRobot { robot: Robot },
    #[error("the robot's heading at the start is {heading}, expected a finite number of radians")]
    BadHeading { heading: f64 },
    /// It could not be told what to do at a junction.
    #[error("{0}")]
    Steer(E),
    #[error(
        "junction {junction}{}: the gap is {} m, expected a finite number that is not negative; in a channel {} m wide \
         the robot can keep {} m",
        by(*rule), Rounded(*gap), Rounded(*width), Rounded(*safest)
    )]
    BadGap {
        junction: usize,
        rule: Option<u32>,
        gap: f64,
        width: f64,
        /// The safest gap there; negative where the robot is too large to turn.
        safest: f64,
    },
    #[error(
        "junction {junction}{}: the arriving point {} {}; the line from {} touches the circle about {} at {}",
        by(*rule), Coords(*arriving), off_circle(*distance, *radius), Coords(*present), Coords(*corner), Coords(*tangent)
    )]
    NotOnCircle {
        junction: usize,
        rule: Option<u32>,
        present: Point,
        corner: Point,
        radius: f64,
        arriving: Point,
        distance: f64,
        tangent: Point,
    },
    #[error(
        "junction {junction}{}: {what} {} is {} m from the corner {}, expected at least {} m (half the robot's width and \
         the gap)",
        by(*rule), Coords(*point), Rounded(*distance), Coords(*corner), Rounded(*radius)
    )]
    InsideCircle {
        junction: usize,
        rule: Option<u32>,
        what: End,
        point: Point,
        corner: Point,
        distance: f64,
        radius: f64,
    },
    #[error(
        "junction {junction}{}: {what} {} is {} m to the side of the inner wall, expected at least {} m (half the robot's \
         width and the gap)",
        by(*rule), Coords(*point), Rounded(*distance), Rounded(*radius)
    )]
    TooNearInnerWall {
        junction: usize,
        rule: Option<u32>,
        what: End,
        point: Point,
        /// Metres to the line on which the inner wall lies.
        distance: f64,
        radius: f64,
    },
    #[error(
        "junctions {first} and {second}: their corners are {} m apart, expected at least {} m for a turn to the \
         {first_turn} about {} m and then to the {second_turn} about {} m",
        Rounded(*distance), Rounded(*needed), Rounded(*first_radius), Rounded(*second_radius)
    )]
    TooNearEachOther {
        first: usize,
        second: usize,
        distance: f64,
        needed: f64,
        first_turn: Turn,
        second_turn: Turn,
        first_radius: f64,
        second_radius: f64,
    },
    #[error(
        "the robot hits the wall from {} to {} on its way from {} {} to {} {}",
        Coords(wall.a), Coords(wall.b), from, Coords(*a), to, Coords(*b)
    )]
    HitsOnLine { wall: Wall, from: End, a: Point, to: End, b: Point },
    #[error(
        "junction {junction}{} is too small for the robot with a gap of {} m: turning about {}, its outer corner reaches {} \
         m, and the wall from {} to {} is {} m away; the safest gap is {} m",
        by(*rule), Rounded(*gap), Coords(*corner), Rounded(*reach), Coords(wall.a), Coords(wall.b), Rounded(*distance),
        Rounded(*safest)
    )]
    HitsInTurn {
        junction: usize,
        rule: Option<u32>,
        gap: f64,
        corner: Point,
        reach: f64,
        wall: Wall,
        distance: f64,
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
