//! Which segment of a scan lies on which of the model.

use std::f64::consts::FRAC_PI_6;

use super::sensor_model::Seen;
use super::{Estimate, ModelSegment, Settings};
use crate::geometry::Point;

/// A segment of a scan on one of the model, by what has to be told of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Match {
    /// The segment of the model, by its place.
    pub model: usize,
    /// How far the model's segment lies to the left of the scan's, at the middle of the latter, metres.
    pub offset_m: f64,
    /// Angle from the scan's segment to the model's, as lines: at most a quarter turn.
    pub angle: f64,
    /// Metres along which they lie side by side.
    overlap_m: f64,
    /// Square of the difference by its standard deviations.
    surprise: f64,
}

/// Up to this angle a segment of a scan may be one that scans leave where it is, if the standard deviations allow it.
const LARGEST_ANGLE: f64 = FRAC_PI_6;

/// What lies before a segment by less hides nothing: corners meet it there, metres.
const BEFORE_M: f64 = 0.02;

/// A direction and place of the model's segments near the robot, so that most are left out after a few operations.
#[derive(Clone, Copy)]
pub(super) struct Near {
    pub model: usize,
    pub a: Point,
    pub along: Point,
    pub length_m: f64,
}

impl Near {
    pub fn new(model: usize, segment: &ModelSegment) -> Self {
        let (line, length_m) = (&segment.line, segment.line.length());
        let share = 1.0 / length_m.max(f64::MIN_POSITIVE);
        let along = (line.b - line.a) * share;
        Self { model, a: line.a, along, length_m }
    }

    fn place(&self, p: Point) -> f64 {
        (p - self.a).dot(self.along)
    }

    /// How far a point lies to the left of the line.
    fn offset(&self, p: Point) -> f64 {
        self.along.cross(p - self.a)
    }
}

/// How sure the place of a segment is as seen from an estimated pose: variances across it at a point, and of its angle.
pub(super) fn variances(
    seen: &Seen,
    segment: &ModelSegment,
    estimate: &Estimate,
    settings: &Settings,
) -> (f64, f64) {
    let (fit, at) = (&seen.fit, estimate.pose.at);
    let arm = fit.place(at).abs();
    let heading = settings.heading_noise.powi(2) * seen.since_m;
    let driven = (settings.distance_noise * seen.since_m).powi(2);
    let middle = segment.line.middle();
    let lever = fit.place(middle);
    let [sigma_m, sigma_angle] = segment.relative_sigmas(settings);
    let offset = fit.sigma_m.powi(2)
        + sigma_m.powi(2)
        + (lever * sigma_angle).powi(2)
        + driven
        + heading * arm.powi(2);
    let angle = fit.sigma_angle.powi(2) + sigma_angle.powi(2) + heading;
    (offset, angle)
}

/// Whether another segment that stays where it is lies before one, seen from the robot towards what a scan shows of it:
/// of the two faces of a wall only the nearer one can be seen.
fn is_hidden(wall: &Near, seen: &Seen, near: &[Near], segments: &[ModelSegment], from: Point) -> bool {
    let on = wall.a + wall.along * wall.place(seen.fit.centre).clamp(0.0, wall.length_m);
    let far = on.distance(from);
    let towards = (on - from) * (1.0 / far.max(f64::MIN_POSITIVE));
    let mut others = near.iter().filter(|other| other.model != wall.model);
    others.any(|other| {
        let segment = &segments[other.model];
        segment.is_anchored
            && segment.line.hit(from, towards).is_some_and(|(range_m, _)| range_m < far - BEFORE_M)
    })
}

/// All segments of the model on which one of a scan may lie, the best first.
pub(super) fn matches(
    seen: &Seen,
    near: &[Near],
    segments: &[ModelSegment],
    estimate: &Estimate,
    settings: &Settings,
) -> Vec<Match> {
    let mut found = Vec::new();
    let (largest_sine, least_sine) = (LARGEST_ANGLE.sin(), settings.match_angle.sin());
    let (fit, length_m) = (&seen.fit, seen.line.length());
    let is_vague = estimate.is_vague(settings);
    for wall in near {
        let sine = fit.along.cross(wall.along);
        if sine.abs() > largest_sine {
            continue;
        }
        let segment = &segments[wall.model];
        let offset = wall.offset(fit.centre);
        let is_off = offset.abs() > settings.match_offset_m || sine.abs() > least_sine;
        let is_out = if segment.is_anchored { is_vague } else { is_off };
        if is_out {
            continue;
        }
        let (from, to) = (wall.place(seen.line.a), wall.place(seen.line.b));
        let overlap_m = from.max(to).min(wall.length_m) - from.min(to).max(0.0);
        if overlap_m < settings.match_overlap * length_m.min(wall.length_m) {
            continue;
        }
        let is_along = fit.along.dot(wall.along) >= 0.0;
        // measured to the left of the scan's segment, whose direction may be the other one
        let offset_m = if is_along { -offset } else { offset };
        let angle = if is_along { sine } else { -sine }.asin();
        let (by_offset, by_angle) = variances(seen, segment, estimate, settings);
        let across = fit.along.perpendicular();
        let reach = fit.centre - estimate.pose.at;
        let lever = reach.cross(across);
        let row = nalgebra::RowVector3::new(across.x, across.y, lever);
        let covariance = estimate.seen_from(segment);
        let offset_variance = by_offset + (row * covariance * row.transpose())[0];
        let angle_variance = by_angle + covariance[(2, 2)];
        let gate = settings.match_sigmas.powi(2);
        let (off, turned) = (offset_m.powi(2) / offset_variance, angle.powi(2) / angle_variance);
        if off > gate || turned > gate {
            continue;
        }
        if !(segment.is_anchored && is_hidden(wall, seen, near, segments, estimate.pose.at)) {
            found.push(Match { model: wall.model, offset_m, angle, overlap_m, surprise: off + turned });
        }
    }
    // Of known walls the nearest one is seen; of what the robot has found, the longest is the surest.
    let rank = |one: &Match| {
        if segments[one.model].is_anchored { (0, one.surprise) } else { (1, -one.overlap_m) }
    };
    let order = |a: &Match, b: &Match| {
        let ((kind, a_by), (other_kind, b_by)) = (rank(a), rank(b));
        kind.cmp(&other_kind).then(a_by.total_cmp(&b_by)).then(a.model.cmp(&b.model))
    };
    found.sort_by(order);
    found
}
