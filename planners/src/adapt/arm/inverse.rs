//! Which configuration brings the tool somewhere. An arm answers by this, and this looks at the arm: a circle of two that
//! belong together, apart for their length only.

use std::f64::consts::TAU;

use nalgebra::{DMatrix, DVector};

use super::Arm;
use crate::adapt::robot::{Configuration, Robot, any_configuration, distance};
use crate::geometry::Point;
use crate::geometry::tolerance::ROUNDING;
use crate::pose::{Pose, wrapped};
use crate::random::Random;

/// How near the tool has to come.
pub(super) const TOLERANCE_M: f64 = 1e-6;

/// The configuration turned by whole turns into the limits, as near as may be.
fn unwound(arm: &Arm, at: Configuration, near: &[f64]) -> Option<Configuration> {
    let turned = at.into_iter().zip(near).zip(&arm.limits).map(|((angle, near), limit)| {
        let nearest = near + wrapped(angle - near);
        let within = |a: &f64| limit.low <= *a && *a <= limit.high;
        [nearest, nearest - TAU, nearest + TAU].into_iter().find(within)
    });
    turned.collect()
}

pub(super) fn one_link(arm: &Arm, tool: &Pose, near: &[f64]) -> Option<Configuration> {
    let angle = (tool.at - arm.base).angle();
    unwound(arm, vec![angle], near).filter(|at| arm.is_at(at, tool.at))
}

pub(super) fn two_links(arm: &Arm, tool: &Pose, branch: u8, near: &[f64]) -> Option<Configuration> {
    let [shoulder, elbow] = shoulder_and_elbow(arm, tool.at, branch)?;
    unwound(arm, vec![shoulder, elbow], near).filter(|at| arm.is_at(at, tool.at))
}

/// The heading of the tool says where the wrist is; the two links below it are as in an arm of two.
pub(super) fn three_links(arm: &Arm, tool: &Pose, branch: u8, near: &[f64]) -> Option<Configuration> {
    let (sin, cos) = tool.heading.sin_cos();
    let wrist = Point::new(tool.at.x - arm.lengths[2] * cos, tool.at.y - arm.lengths[2] * sin);
    let [shoulder, elbow] = shoulder_and_elbow(arm, wrist, branch)?;
    unwound(arm, vec![shoulder, elbow, tool.heading - shoulder - elbow], near)
        .filter(|at| residual(arm, tool, at).norm() <= TOLERANCE_M)
}

/// The angles of the first two joints that bring the end of the second link to a place, by the law of cosines (Craig 1989,
/// section 4.4); branch 0 has the elbow's angle positive, branch 1 negative.
fn shoulder_and_elbow(arm: &Arm, place: Point, branch: u8) -> Option<[f64; 2]> {
    let (first, second) = (arm.lengths[0], arm.lengths[1]);
    let (x, y) = (place.x - arm.base.x, place.y - arm.base.y);
    let cos = (x * x + y * y - first * first - second * second) / (2.0 * first * second);
    // A stretched arm's cosine may lie beside 1 by rounding alone.
    let stretched = if (1.0..1.0 + ROUNDING).contains(&cos.abs()) { cos.signum() } else { cos };
    if stretched.abs() > 1.0 {
        return None;
    }
    let elbow = if branch == 0 { stretched.acos() } else { -stretched.acos() };
    let shoulder = y.atan2(x) - (second * elbow.sin()).atan2(first + second * elbow.cos());
    Some([shoulder, elbow])
}

/// An arm of more links has many ways to bring its tool there: the descent begins near by, and where it ends beside the pose,
/// or at a limit, anew from elsewhere. Of some that are found the nearest is taken.
pub(super) fn many_links(arm: &Arm, tool: &Pose, near: &[f64]) -> Option<Configuration> {
    const BEGINNINGS: usize = 96;
    const ENOUGH: usize = 6;
    if let Some(at) = descent(arm, tool, near.to_vec()) {
        return Some(at);
    }
    // The same beginnings each time: the same question gets the same answer.
    let mut random = Random::new(1);
    let beginnings = (0..BEGINNINGS).map(|_| any_configuration(arm, &mut random));
    let found = beginnings.filter_map(|from| descent(arm, tool, from)).take(ENOUGH);
    found.min_by(|a, b| distance(a, near).total_cmp(&distance(b, near)))
}

/// Damped least squares (Wampler 1986) from a configuration, place and heading of the tool, inside the limits.
fn descent(arm: &Arm, tool: &Pose, mut at: Configuration) -> Option<Configuration> {
    const ROUNDS: usize = 200;
    const LEAST_DAMPING: f64 = 1e-9;
    let mut damping = 0.01;
    let mut left = residual(arm, tool, &at);
    for _ in 0..ROUNDS {
        if left.norm() < TOLERANCE_M {
            return Some(at);
        }
        let jacobian = jacobian(arm, &at);
        let square = jacobian.transpose() * &jacobian + DMatrix::identity(at.len(), at.len()) * damping;
        let step = square.cholesky()?.solve(&(jacobian.transpose() * &left));
        let moved: Configuration = (at.iter().zip(step.iter()).zip(&arm.limits))
            .map(|((angle, step), limit)| (angle + step).clamp(limit.low, limit.high))
            .collect();
        let after = residual(arm, tool, &moved);
        if after.norm() < left.norm() {
            (at, left, damping) = (moved, after, (damping * 0.3).max(LEAST_DAMPING));
        } else {
            damping *= 4.0;
        }
    }
    None
}

/// What the tool lacks of its pose: metres, metres, radians.
fn residual(arm: &Arm, tool: &Pose, at: &[f64]) -> DVector<f64> {
    let now = arm.tool(at);
    DVector::from_vec(vec![tool.at.x - now.at.x, tool.at.y - now.at.y, wrapped(tool.heading - now.heading)])
}

fn jacobian(arm: &Arm, at: &[f64]) -> DMatrix<f64> {
    let joints = arm.joints(at);
    let end = joints[joints.len() - 1];
    DMatrix::from_fn(3, at.len(), |row, joint| match row {
        0 => joints[joint].y - end.y,
        1 => end.x - joints[joint].x,
        _ => 1.0,
    })
}
