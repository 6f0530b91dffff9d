//! Which segment of a scan lies on which of the model.

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
    pub overlap_m: f64,
}

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
    let offset = fit.sigma_m.powi(2)
        + segment.sigma_m.powi(2)
        + (lever * segment.sigma_angle).powi(2)
        + driven
        + heading * arm.powi(2);
    let angle = fit.sigma_angle.powi(2) + segment.sigma_angle.powi(2) + heading;
    (offset, angle)
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
    let largest_sine = settings.match_angle.sin();
    let (fit, length_m) = (&seen.fit, seen.line.length());
    for wall in near {
        let sine = fit.along.cross(wall.along);
        if sine.abs() > largest_sine {
            continue;
        }
        let offset = wall.offset(fit.centre);
        if offset.abs() > settings.match_offset_m {
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
        let (by_offset, by_angle) = variances(seen, &segments[wall.model], estimate, settings);
        let across = fit.along.perpendicular();
        let reach = fit.centre - estimate.pose.at;
        let lever = reach.cross(across);
        let row = nalgebra::RowVector3::new(across.x, across.y, lever);
        let offset_variance = by_offset + (row * estimate.covariance * row.transpose())[0];
        let angle_variance = by_angle + estimate.covariance[(2, 2)];
        let gate = settings.match_sigmas.powi(2);
        if offset_m.powi(2) <= gate * offset_variance && angle.powi(2) <= gate * angle_variance {
            found.push(Match { model: wall.model, offset_m, angle, overlap_m });
        }
    }
    found.sort_by(|a, b| b.overlap_m.total_cmp(&a.overlap_m).then(a.model.cmp(&b.model)));
    found
}
