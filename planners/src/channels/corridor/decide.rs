//! What is known at a junction of a route, and what comes of what is said to do there (Lee, Table 2).

use super::axis::Axis;
use super::body::Robot;
use super::circle::Tangent;
use super::drive::TurnMade;
use super::drive_error::DriveError;
use super::passage::End;
use super::route::Route;
use super::steer::{Offset, Steer, StepFacts};
use crate::geometry::Point;
use crate::geometry::tolerance::ROUNDING;

impl Route<'_> {
    fn axis_before(&self, step: usize) -> Axis {
        self.corridors.axis_of(self.channels[step])
    }

    fn axis_after(&self, step: usize) -> Axis {
        self.axis_before(step + 1)
    }

    pub(super) fn facts(&self, step: usize, robot: Robot, present: Point) -> StepFacts {
        let junction = self.junctions[step];
        let next_junction = self.junctions.get(step + 1).copied();
        let rect = |number: usize| self.corridors.junctions()[number - 1].rect;
        let (channel, next_channel) = (self.channels[step], self.channels[step + 1]);
        let width = self.corridors.width(channel).min(self.corridors.width(next_channel));
        StepFacts {
            junction,
            rect: rect(junction),
            channel,
            next_channel,
            entering: self.axis_before(step),
            present,
            next: next_junction.map_or(self.goal, |next| rect(next).centre()),
            next_junction,
            width,
            safest: robot.safest(width),
            robot,
        }
    }

    /// The corner and the radius of a decision, checked against start and goal if they are next to it.
    pub(super) fn decided<E>(
        &self,
        step: usize,
        facts: StepFacts,
        steer: Steer,
    ) -> Result<TurnMade, DriveError<E>> {
        let StepFacts { junction, robot, width, safest, .. } = facts;
        let Steer { rule, gap, .. } = steer;
        if !(gap.is_finite() && gap >= 0.0) {
            return Err(DriveError::BadGap { junction, rule, gap, width, safest });
        }
        let (corner, radius) = (steer.corner_of(&facts.rect), robot.width / 2.0 + gap);
        let turn = TurnMade {
            facts,
            steer,
            corner,
            radius,
            theta: 0.0,
            arriving: corner,
            leaving: corner,
            angle: 0.0,
        };
        if step == 0 {
            self.check_end(End::Start, self.axis_before(step), &turn)?;
        }
        if step + 1 == self.junctions.len() {
            self.check_end(End::Goal, self.axis_after(step), &turn)?;
        }
        Ok(turn)
    }

    /// Whether start or goal are far enough from the corner next to them, and from the inner wall along `axis`.
    fn check_end<E>(&self, what: End, axis: Axis, turn: &TurnMade) -> Result<(), DriveError<E>> {
        let point = if what == End::Start { self.start } else { self.goal };
        let &TurnMade {
            facts: StepFacts { junction, .. }, steer: Steer { rule, .. }, corner, radius, ..
        } = turn;
        let distance = point.distance(corner);
        if distance <= radius {
            return Err(DriveError::InsideCircle { junction, rule, what, point, corner, distance, radius });
        }
        let across = axis.across();
        let distance = (across.of(point) - across.of(corner)).abs();
        if distance < radius * (1.0 - ROUNDING) {
            return Err(DriveError::TooNearInnerWall { junction, rule, what, point, distance, radius });
        }
        Ok(())
    }
}

impl TurnMade {
    /// Puts the arriving point where the decision says, if `line` is the one that touches the circle there.
    pub(super) fn arrive_by_table<E>(&mut self, line: &Tangent) -> Result<(), DriveError<E>> {
        let (theta, arriving) = by_table(self, line.from);
        // far from the frame's origin, coordinates themselves are as coarse as this
        let coarse = 16.0 * f64::EPSILON * (self.corner.x.abs() + self.corner.y.abs());
        if arriving.distance(line.to) > ROUNDING * (self.radius + line.length) + coarse {
            return Err(DriveError::NotOnCircle {
                junction: self.facts.junction,
                rule: self.steer.rule,
                present: line.from,
                corner: self.corner,
                radius: self.radius,
                arriving,
                distance: arriving.distance(self.corner),
                tangent: line.to,
            });
        }
        (self.theta, self.arriving, self.leaving) = (theta, arriving, arriving);
        Ok(())
    }
}

/// Lee's arriving angle (equations 5.6 and 5.7), and the arriving point that a decision makes of it. The angle at which
/// the robot is seen from the corner counts with a sign, so that it also holds for a robot that is past the corner.
fn by_table(turn: &TurnMade, from: Point) -> (f64, Point) {
    let TurnMade { facts, steer, corner, radius, .. } = turn;
    let (measured, other) = (steer.measured_along, steer.measured_along.across());
    let aside = (measured.of(*corner) - measured.of(from)).abs();
    let ahead = other.of(*corner) - other.of(from);
    let is_backwards = other.of(facts.rect.centre()) < other.of(facts.present);
    let ahead = if is_backwards { -ahead } else { ahead };
    let distance = corner.distance(from);
    let touching = ((distance - radius) * (distance + radius)).max(0.0).sqrt();
    let theta = touching.atan2(*radius) - ahead.atan2(aside);
    let (sin, cos) = theta.sin_cos();
    let offset = |offset: Offset| radius * offset.of((cos, sin));
    (theta, Point::new(corner.x + offset(steer.arriving.0), corner.y + offset(steer.arriving.1)))
}
