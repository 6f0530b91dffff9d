//! The pose corrected by differences between what is seen and the model: weighted least squares in the form of
//! information, with the estimate so far as one more observation.

use nalgebra::{Matrix3, RowVector3, Vector3};

use super::beam::Beam;
use super::matching::{Match, variances};
use super::sensor_model::Seen;
use super::sight::Crossing;
use super::{Estimate, ModelSegment, Settings};
use crate::pose::{Pose, wrapped};

/// Observations of an error of the pose: dx, dy in metres, dheading in radians.
pub(super) struct Correction {
    information: Matrix3<f64>,
    weighted: Vector3<f64>,
    pub count: usize,
}

impl Correction {
    pub fn new() -> Self {
        Self { information: Matrix3::zeros(), weighted: Vector3::zeros(), count: 0 }
    }

    fn observe(&mut self, row: RowVector3<f64>, difference: f64, variance: f64) {
        self.information += row.transpose() * row / variance;
        self.weighted += row.transpose() * (difference / variance);
        self.count += 1;
    }

    /// A segment of the scan lies on one of the model: the error in orientation, and the one across the segment.
    pub fn by_match(
        &mut self,
        seen: &Seen,
        on: &Match,
        segment: &ModelSegment,
        estimate: &Estimate,
        settings: &Settings,
    ) {
        let (offset, angle) = variances(seen, segment, estimate, settings);
        self.observe(RowVector3::new(0.0, 0.0, 1.0), on.angle, angle);
        let (across, at) = ((-seen.fit.along.y, seen.fit.along.x), estimate.pose.at);
        let reach = (seen.fit.centre.x - at.x, seen.fit.centre.y - at.y);
        let lever = across.1 * reach.0 - across.0 * reach.1;
        self.observe(RowVector3::new(across.0, across.1, lever), on.offset_m, offset);
    }

    /// A beam whose reading the model predicts (section 4.6). A reading far from what is predicted is left out.
    pub fn by_reading(
        &mut self,
        beam: &Beam,
        crossing: &Crossing,
        segment: &ModelSegment,
        estimate: &Estimate,
        settings: &Settings,
    ) {
        let Some(range) = beam.range_m else { return };
        let (along, at) = (segment.line.direction(), estimate.pose.at);
        let across = (-along.y, along.x);
        let hit = beam.at(crossing.range_m);
        let lever = across.1 * (hit.x - at.x) - across.0 * (hit.y - at.y);
        // metres by which the echo lies short of the segment, measured across it
        let approach = beam.towards.x * across.0 + beam.towards.y * across.1;
        let difference = (crossing.range_m - range) * approach;
        let off_middle = crossing.place_m - segment.line.length() / 2.0;
        let heading = settings.heading_noise.powi(2) * beam.since_m;
        let variance = (beam.sigma_m * approach).powi(2)
            + segment.sigma_m.powi(2)
            + (off_middle * segment.sigma_angle).powi(2)
            + (settings.distance_noise * beam.since_m).powi(2)
            + heading * lever.powi(2);
        let row = RowVector3::new(across.0, across.1, lever);
        let expected = variance + (row * estimate.covariance * row.transpose())[0];
        if difference.powi(2) <= settings.match_sigmas.powi(2) * expected {
            self.observe(row, difference, variance);
        }
    }

    /// The estimate with all observations; as it was where there is none, or where they say nothing definite.
    pub fn apply(&self, estimate: &Estimate, settings: &Settings) -> Estimate {
        if self.count == 0 {
            return *estimate;
        }
        let mut prior = estimate.covariance;
        let least =
            Vector3::new(settings.least_sigma_m, settings.least_sigma_m, settings.least_sigma_heading);
        for i in 0..3 {
            prior[(i, i)] = prior[(i, i)].max(least[i].powi(2)).max(f64::MIN_POSITIVE);
        }
        let Some(covariance) = prior.try_inverse().and_then(|prior| (prior + self.information).try_inverse())
        else {
            return *estimate;
        };
        let step = covariance * self.weighted;
        if !step.iter().all(|part| part.is_finite()) {
            return *estimate;
        }
        let mut covariance = (covariance + covariance.transpose()) * 0.5;
        for i in 0..3 {
            covariance[(i, i)] = covariance[(i, i)].max(least[i].powi(2));
        }
        let at = estimate.pose.at;
        let heading = wrapped(estimate.pose.heading + step.z);
        Estimate { pose: Pose::new(at.x + step.x, at.y + step.y, heading), covariance }
    }
}
