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
    /// What all surfaces say of the pose as seen from them.
    relative: Matrix3<f64>,
    /// The same, less of those that the robot has found: they moved with a pose that was wrong.
    information: Matrix3<f64>,
    /// What of it surfaces say that scans leave where they are.
    anchored: Matrix3<f64>,
    weighted: Vector3<f64>,
    /// What the robot has found makes it no surer than it was then: variances that stay, each in a direction.
    floors: Vec<(RowVector3<f64>, f64)>,
    pub count: usize,
}

impl Correction {
    pub fn new() -> Self {
        let none = Matrix3::zeros();
        Self {
            relative: none,
            information: none,
            anchored: none,
            weighted: Vector3::zeros(),
            floors: Vec::new(),
            count: 0,
        }
    }

    /// A difference with its variance as seen from a surface; `floor` is the variance of the surface itself where the robot has
    /// found it.
    fn observe(
        &mut self,
        row: RowVector3<f64>,
        (difference, variance): (f64, f64),
        floor: Option<f64>,
        estimate: &Estimate,
    ) {
        let of = |covariance: &Matrix3<f64>| (row * covariance * row.transpose())[0].max(f64::MIN_POSITIVE);
        let information = row.transpose() * row / variance;
        self.relative += information;
        // The pose follows such a surface as far as it does relative to it.
        let share = floor.map_or(1.0, |_| (of(&estimate.relative) / of(&estimate.covariance)).min(1.0));
        self.information += information * share;
        match floor {
            Some(floor) => self.floors.push((row, floor)),
            None => self.anchored += information,
        }
        self.weighted += row.transpose() * (difference / variance * share);
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
        let own = |sigma: f64| segment.is_own(settings).then_some(sigma.powi(2));
        let turned = (on.angle, angle);
        self.observe(RowVector3::new(0.0, 0.0, 1.0), turned, own(segment.sigma_angle), estimate);
        let (across, at) = ((-seen.fit.along.y, seen.fit.along.x), estimate.pose.at);
        let reach = (seen.fit.centre.x - at.x, seen.fit.centre.y - at.y);
        let lever = across.1 * reach.0 - across.0 * reach.1;
        let row = RowVector3::new(across.0, across.1, lever);
        self.observe(row, (on.offset_m, offset), own(segment.sigma_m), estimate);
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
        let [sigma_m, sigma_angle] = segment.relative_sigmas(settings);
        let off_middle = crossing.place_m - segment.line.length() / 2.0;
        let heading = settings.heading_noise.powi(2) * beam.since_m;
        let variance = (beam.sigma_m * approach).powi(2)
            + sigma_m.powi(2)
            + (off_middle * sigma_angle).powi(2)
            + (settings.distance_noise * beam.since_m).powi(2)
            + heading * lever.powi(2);
        let row = RowVector3::new(across.0, across.1, lever);
        let expected = variance + (row * estimate.seen_from(segment) * row.transpose())[0];
        if difference.powi(2) <= settings.match_sigmas.powi(2) * expected {
            let own = segment.is_own(settings).then_some(segment.sigma_m.powi(2));
            self.observe(row, (difference, variance), own, estimate);
        }
    }

    /// The estimate with all observations; as it was where there is none, or where they say nothing definite.
    pub fn apply(&self, estimate: &Estimate, settings: &Settings) -> Estimate {
        if self.count == 0 {
            return *estimate;
        }
        let fused = |information: &Matrix3<f64>| fused(&estimate.covariance, information, settings);
        let relative = self::fused(&estimate.relative, &self.relative, settings);
        let (Some(mut covariance), Some(anchored), Some(relative)) =
            (fused(&self.information), fused(&self.anchored), relative)
        else {
            return *estimate;
        };
        let step = covariance * self.weighted;
        if !step.iter().all(|part| part.is_finite()) {
            return *estimate;
        }
        for (row, floor) in &self.floors {
            let spread = anchored * row.transpose();
            let without = (row * spread)[0];
            let lack = floor.min(without) - (row * covariance * row.transpose())[0];
            if lack > 0.0 {
                covariance += spread * spread.transpose() * (lack / without.powi(2));
            }
        }
        let at = estimate.pose.at;
        let heading = wrapped(estimate.pose.heading + step.z);
        let pose = Pose::new(at.x + step.x, at.y + step.y, heading);
        let [covariance, relative] = [covariance, relative].map(|of| symmetric(&of, settings));
        Estimate { pose, covariance, relative }
    }
}

/// A covariance with further information; `None` where both say nothing definite.
fn fused(covariance: &Matrix3<f64>, information: &Matrix3<f64>, settings: &Settings) -> Option<Matrix3<f64>> {
    (symmetric(covariance, settings).try_inverse()? + information).try_inverse()
}

/// A covariance rid of rounding, and nowhere surer than can be.
fn symmetric(covariance: &Matrix3<f64>, settings: &Settings) -> Matrix3<f64> {
    let mut covariance = (covariance + covariance.transpose()) * 0.5;
    let least = [settings.least_sigma_m, settings.least_sigma_m, settings.least_sigma_heading];
    for (i, least) in least.into_iter().enumerate() {
        covariance[(i, i)] = covariance[(i, i)].max(least.powi(2)).max(f64::MIN_POSITIVE);
    }
    covariance
}
