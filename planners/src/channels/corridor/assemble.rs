//! From a route and what rules say at its junctions to lines and arcs (Lee, section 5.1), measured against the walls.

use std::f64::consts::FRAC_PI_2;

use super::axis::Axis;
use super::body::Robot;
use super::circle::{Circle, Tangent};
use super::drive::{Drive, Primitive, TurnMade};
use super::drive_error::DriveError;
use super::passage::End;
use super::route::Route;
use super::steer::{Steer, StepFacts};
use super::sweep::Sweep;
use super::tangents::{DrivenLines, Touched, driven_lines};
use super::walls::Wall;
use crate::pose::wrapped;

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

/// The drive along a way, with what is left beside each of its pieces.
fn assembled<E>(
    route: &Route<'_>,
    robot: Robot,
    heading: Option<f64>,
    mut turns: Vec<TurnMade>,
    driven: &DrivenLines,
) -> Result<Drive, DriveError<E>> {
    pass_by(&mut turns, driven);
    let sweep = Sweep::new(robot, route.corridors.walls());
    let mut primitives = Vec::with_capacity(driven.lines.len() + driven.touched.len());
    let mut to_heading = first_heading(route, &driven.lines[0], heading);
    let mut from_heading = heading.unwrap_or(to_heading);
    for (index, line) in driven.lines.iter().enumerate() {
        let clearance = sweep.line(line, from_heading, to_heading);
        let clearance = clearance.map_err(|wall| hits_on_line(&turns, driven, index, wall))?;
        let (a, b) = (line.from, line.to);
        primitives.push(Primitive::Line { a, b, from_heading, to_heading, clearance });
        let Some(touched) = driven.touched.get(index) else { break };
        let turn = &mut turns[touched.turn()];
        (turn.arriving, turn.leaving, turn.angle) = (b, driven.lines[index + 1].from, touched.angle);
        let clearance = sweep.arc(&touched.circle, line, touched.angle);
        let clearance = clearance.map_err(|wall| hits_in_turn(turn, wall))?;
        from_heading = to_heading;
        to_heading += turn.steer.turn.sign() * touched.angle;
        primitives.push(Primitive::Arc {
            junction: turn.facts.junction,
            centre: turn.corner,
            radius: turn.radius,
            turn: turn.steer.turn,
            a: turn.arriving,
            b: turn.leaving,
            from_heading,
            to_heading,
            clearance,
        });
        from_heading = to_heading;
    }
    let length = primitives.iter().map(Primitive::length).sum();
    let min_clearance = primitives.iter().map(Primitive::clearance).fold(f64::INFINITY, f64::min);
    Ok(Drive { primitives, turns, length, min_clearance })
}

/// The heading of the first line, as near to the robot's as whole turns allow.
fn first_heading(route: &Route<'_>, line: &Tangent, given: Option<f64>) -> f64 {
    let along = line.along.y.atan2(line.along.x);
    match given {
        // whoever is at the goal already does not turn
        Some(given) if line.length <= 0.0 => given,
        Some(given) => given + wrapped(along - given),
        None if line.length > 0.0 => along,
        None => match route.corridors.axis_of(route.channels[0]) {
            Axis::X => 0.0,
            Axis::Y => FRAC_PI_2,
        },
    }
}

fn hits_on_line<E>(turns: &[TurnMade], driven: &DrivenLines, line: usize, wall: Wall) -> DriveError<E> {
    let junction = |touched: &Touched| End::Junction(turns[touched.turn()].facts.junction);
    let before = line.checked_sub(1).and_then(|before| driven.touched.get(before));
    DriveError::HitsOnLine {
        wall,
        from: before.map_or(End::Start, junction),
        a: driven.lines[line].from,
        to: driven.touched.get(line).map_or(End::Goal, junction),
        b: driven.lines[line].to,
    }
}

fn hits_in_turn<E>(turn: &TurnMade, wall: Wall) -> DriveError<E> {
    let TurnMade { facts, steer, corner, radius, .. } = *turn;
    DriveError::HitsInTurn {
        junction: facts.junction,
        rule: steer.rule,
        gap: steer.gap,
        corner,
        reach: facts.robot.reach_about(radius),
        wall,
        distance: corner.distance(corner.nearest_on(wall.a, wall.b)),
        safest: facts.safest,
    }
}

/// Tells the turns at circles that the way passes by where it is nearest to them.
fn pass_by(turns: &mut [TurnMade], driven: &DrivenLines) {
    if driven.touched.len() == turns.len() {
        return;
    }
    for (index, turn) in turns.iter_mut().enumerate() {
        let before = driven.touched.iter().take_while(|touched| touched.turn() < index).count();
        if driven.touched.get(before).is_some_and(|touched| touched.turn() == index) {
            continue;
        }
        let line = &driven.lines[before];
        turn.arriving = turn.corner.nearest_on(line.from, line.to);
        turn.leaving = turn.arriving;
    }
}

/// Of two circles, by index among start, junctions and goal, that no line touches both of.
fn too_near<E>(turns: &[TurnMade], circles: &[Circle], one: usize, other: usize) -> DriveError<E> {
    let (first, second) = (&circles[one], &circles[other]);
    let distance = first.centre.distance(second.centre);
    let inside = |what, point, turn: &TurnMade| DriveError::InsideCircle {
        junction: turn.facts.junction,
        rule: turn.steer.rule,
        what,
        point,
        corner: turn.corner,
        distance,
        radius: turn.radius,
    };
    if one == 0 {
        return inside(End::Start, first.centre, &turns[other - 1]);
    }
    if other > turns.len() {
        return inside(End::Goal, second.centre, &turns[one - 1]);
    }
    DriveError::TooNearEachOther {
        first: turns[one - 1].facts.junction,
        second: turns[other - 1].facts.junction,
        distance,
        needed: first.least_distance(second),
        first_turn: first.turn,
        second_turn: second.turn,
        first_radius: first.radius,
        second_radius: second.radius,
    }
}
