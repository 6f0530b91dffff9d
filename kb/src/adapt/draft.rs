//! What a file says of a cell, each value with its place, and what is wrong with it.

use std::f64::consts::PI;
use std::ops::Range;
use std::sync::Arc;

use adit_planners::adapt::{Arm, ArmError, Configuration, Limit, Object, PointRobot, Shape, ShapeError};
use adit_planners::geometry::Point;
use adit_planners::pose::Pose;
use adit_planners::read::{Code, Located, Problem, Text};

use super::cell::{Goal, RobotKind, Target};
use crate::words::number::{counted, number};

/// No cell is larger: metres from the origin of its frame.
const LARGEST_M: f64 = 1e4;

/// No arm is longer, metres: links of more are most likely in millimetres, and would be searched for hours.
const LONGEST_M: f64 = 100.0;

/// Joints do not turn farther, radians: four times each way. Degrees are more.
const FARTHEST_RAD: f64 = 8.0 * PI;

/// Reads on where something is wrong, and gathers what.
pub(super) struct Draft<'t> {
    pub text: &'t Text,
    pub problems: Vec<Problem>,
}

/// Links, their radius, the base and the joints' limits.
pub(super) struct ArmDraft {
    pub lengths: Located<Vec<f64>>,
    pub radius: Located<f64>,
    pub base: Located<[f64; 2]>,
    pub limits: Located<Vec<[f64; 2]>>,
}

impl Draft<'_> {
    pub fn refuse(&mut self, code: Code, span: &Range<usize>, message: impl Into<String>) {
        self.problems.push(self.text.problem(code, span, message));
    }

    /// Refuses numbers that no cell has; those that are none are left to others.
    fn within(&mut self, what: &str, span: &Range<usize>, numbers: &[f64], most: f64) -> bool {
        let far = numbers.iter().find(|number| number.abs() > most);
        if let Some(far) = far {
            self.refuse(
                Code::Impossible,
                span,
                format!("{what} has {far:e}; expected numbers up to {}", number(most)),
            );
        }
        far.is_none()
    }

    /// An arm, if it can be one.
    pub fn arm(&mut self, draft: &ArmDraft) -> Option<RobotKind> {
        let limits: Vec<f64> = draft.limits.value.iter().flatten().copied().collect();
        let reach: f64 = draft.lengths.value.iter().sum();
        let are_sane = [
            self.within("the sum of the links in metres", &draft.lengths.span, &[reach], LONGEST_M),
            self.within(
                "the radius of the links in metres",
                &draft.radius.span,
                &[draft.radius.value],
                LONGEST_M,
            ),
            self.within("the base", &draft.base.span, &draft.base.value, LARGEST_M),
            self.within("`joint_limits` in radians", &draft.limits.span, &limits, FARTHEST_RAD),
        ];
        if are_sane.contains(&false) {
            return None;
        }
        let limits = draft.limits.value.iter().map(|&[low, high]| Limit { low, high }).collect();
        let [x, y] = draft.base.value;
        match Arm::new(Point::new(x, y), draft.lengths.value.clone(), draft.radius.value, limits) {
            Ok(arm) => Some(RobotKind::Arm(Arc::new(arm))),
            Err(error) => {
                let (code, span) = match error {
                    ArmError::Radius(_) => (Code::NotPositive, &draft.radius.span),
                    ArmError::Base => (Code::NotFinite, &draft.base.span),
                    ArmError::Limits { .. } | ArmError::Limit(..) => (Code::Impossible, &draft.limits.span),
                    _ => (Code::NotPositive, &draft.lengths.span),
                };
                self.refuse(code, span, error.to_string());
                None
            }
        }
    }

    pub fn disc(&mut self, bounds: &Located<[f64; 4]>, radius: &Located<f64>) -> Option<RobotKind> {
        if !self.within("`bounds`", &bounds.span, &bounds.value, LARGEST_M)
            || !self.within("`radius`", &radius.span, &[radius.value], LARGEST_M)
        {
            return None;
        }
        let [x0, y0, x1, y1] = bounds.value;
        if !(x0 < x1 && y0 < y1) {
            self.refuse(
                Code::Degenerate,
                &bounds.span,
                format!("`bounds` [{x0}, {y0}, {x1}, {y1}] has no area; expected [x0, y0, x1, y1] with x0 < x1 and y0 < y1"),
            );
            return None;
        }
        if radius.value < 0.0 {
            self.refuse(
                Code::NotPositive,
                &radius.span,
                format!("`radius` is {}, and must be 0 at least", radius.value),
            );
            return None;
        }
        let limits = [Limit { low: x0, high: x1 }, Limit { low: y0, high: y1 }];
        Some(RobotKind::Point(Arc::new(PointRobot::new(limits, radius.value))))
    }

    /// An outline, if it is a simple polygon.
    pub fn shape(&mut self, name: &str, corners: &Located<Vec<Located<[f64; 2]>>>) -> Option<Shape> {
        let mut are_near = true;
        for corner in &corners.value {
            are_near &= self.within(&format!("a corner of {name}"), &corner.span, &corner.value, LARGEST_M);
        }
        if !are_near {
            return None;
        }
        let points =
            corners.value.iter().map(|corner| Point::new(corner.value[0], corner.value[1])).collect();
        let error = match Shape::new(points) {
            Ok(shape) => return Some(shape),
            Err(error) => error,
        };
        let at = |corner: usize| &corners.value[corner].span;
        let side = |corner: usize| {
            let next = (corner + 1) % corners.value.len();
            let [[x0, y0], [x1, y1]] = [corners.value[corner].value, corners.value[next].value];
            format!("({x0}, {y0}) to ({x1}, {y1})")
        };
        let problem = match error {
            ShapeError::TooFewCorners(count) => {
                let message = format!("the polygon of {name} has {count} corners, and needs three at least");
                self.text.problem(Code::FewCorners, &corners.span, message)
            }
            ShapeError::NotFinite(corner) => {
                let message = format!("corner {} of {name} is not at a finite place", corner + 1);
                self.text.problem(Code::NotFinite, at(corner), message)
            }
            ShapeError::SameCorner(one, other) => {
                let message =
                    format!("corners {} and {} of {name} are at the same place", one + 1, other + 1);
                self.text.problem(Code::Degenerate, at(other), message)
            }
            ShapeError::SelfCrossing(one, other) => {
                let message = format!(
                    "the polygon of {name} crosses itself: the side {} meets the side {}",
                    side(one),
                    side(other)
                );
                self.text
                    .problem(Code::SelfCrossing, at(one), message)
                    .and_at(at(other), "the other side begins here")
                    .with_help("give the corners in order, round the outline once")
            }
            other => self.text.problem(Code::Impossible, &corners.span, format!("{name}: {other}")),
        };
        self.problems.push(problem);
        None
    }

    /// A configuration within the limits.
    pub fn configuration(
        &mut self,
        what: &str,
        robot: Option<&RobotKind>,
        at: &Located<Vec<f64>>,
    ) -> Option<Configuration> {
        let kind = robot?;
        let robot = kind.robot();
        if robot.admits(&at.value) {
            return Some(at.value.clone());
        }
        let limits = robot.limits();
        let message = if at.value.len() == limits.len() {
            let outside =
                (1..).zip(at.value.iter().zip(limits)).find(|(_, (q, l))| !(l.low <= **q && **q <= l.high));
            outside.map_or_else(
                || format!("{what} is no configuration"),
                |(joint, (q, limit))| {
                    let joint = kind.coordinate(joint);
                    format!(
                        "{what} has {joint} at {q}, outside of its limits {} to {}",
                        limit.low, limit.high
                    )
                },
            )
        } else {
            let (found, joints) = (counted(at.value.len(), "number"), counted(limits.len(), "joint"));
            format!("{what} has {found}, and the robot {joints}")
        };
        self.refuse(Code::Impossible, &at.span, message);
        None
    }

    /// Refuses names that are empty or stand for two things, or for something else.
    pub fn names<'n>(&mut self, what: &str, names: impl Iterator<Item = (&'n str, Range<usize>)>) {
        let mut seen: Vec<(&str, Range<usize>)> = Vec::new();
        for (name, span) in names {
            if name.trim().is_empty() {
                self.refuse(Code::EmptyName, &span, format!("{what} needs a name with a character in it"));
            }
            match seen.iter().find(|(known, _)| *known == name) {
                Some((_, first)) => {
                    let message = format!("two are called `{name}`; each {what} needs a name of its own");
                    let problem = self.text.problem(Code::DuplicateName, &span, message);
                    self.problems.push(problem.and_at(first, "the first one"));
                }
                None => seen.push((name, span)),
            }
        }
    }

    /// Refuses goals at objects that are not there, and `home`, which is a goal of every cell.
    pub fn goals(&mut self, goals: &[(Goal, Range<usize>)], objects: &[Object]) {
        for (goal, span) in goals {
            if goal.name == "home" {
                self.refuse(Code::DuplicateName, span, "`home` is a goal already: where the robot begins");
            }
            if let Target::Tool { object, .. } = &goal.target
                && !objects.iter().any(|known| known.name == *object)
            {
                let message = format!("goal {} is at object `{object}`, which is not in the cell", goal.name);
                let names: Vec<&str> = objects.iter().map(|object| object.name.as_str()).collect();
                let problem = self.text.problem(Code::Impossible, span, message);
                self.problems.push(problem.with_help(format!("objects: {}", names.join(", "))));
            }
        }
    }
}

/// A pose from metres and degrees.
pub(super) fn pose([x, y]: [f64; 2], degrees: f64) -> Pose {
    Pose::new(x, y, degrees.to_radians())
}
