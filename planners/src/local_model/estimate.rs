//! The estimated pose with its covariance.
//!
//! Surfaces are placed by the estimate, and how sure it is hangs on which surface it looks at: a circle of these files.

use nalgebra::{Matrix3, RowVector3, Vector3};

use super::{ModelSegment, Settings};
use crate::geometry::Point;
use crate::pose::{Pose, wrapped};

/// Where no wall is known, errors of the distance are taken to be alike over such a stretch, metres.
const FINDING_STRETCH_M: f64 = 1.0;

/// Where the robot thinks it is, and how sure it is of that.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The most likely pose.
    pub pose: Pose,
    /// Covariance of x, y (square metres) and heading (square radians).
    pub covariance: Matrix3<f64>,
    /// The same as seen from the surfaces that the robot has found itself: they move with a pose that is wrong.
    pub relative: Matrix3<f64>,
}

impl Estimate {
    /// An estimate with independent standard deviations of place (metres) and heading (radians).
    pub fn new(pose: Pose, sigma_m: f64, sigma_heading: f64) -> Self {
        let variances = Vector3::new(sigma_m.powi(2), sigma_m.powi(2), sigma_heading.powi(2));
        let covariance = Matrix3::from_diagonal(&variances);
        Self { pose, covariance, relative: covariance }
    }

    /// An estimate of a robot that has found no surfaces yet: those that it finds from there are where it sees them.
    pub(super) fn placed(pose: Pose, covariance: Matrix3<f64>) -> Self {
        Self { pose, covariance, relative: Matrix3::zeros() }
    }

    /// Standard deviation of the place in the direction in which it is least certain, metres.
    pub fn sigma_m(&self) -> f64 {
        largest(&self.covariance).sqrt()
    }

    /// Standard deviation of the heading, radians.
    pub fn sigma_heading(&self) -> f64 {
        self.covariance[(2, 2)].max(0.0).sqrt()
    }

    /// Whether a place is within so many standard deviations, or nearer than some metres to what is.
    pub(super) fn may_be_at(&self, place: Point, sigmas: f64, slack_m: f64) -> bool {
        let off = place - self.pose.at;
        let length = off.length();
        let along = off * (1.0 / length.max(f64::MIN_POSITIVE));
        let row = RowVector3::new(along.x, along.y, 0.0);
        length <= slack_m + sigmas * (row * self.covariance * row.transpose())[0].max(0.0).sqrt()
    }

    /// This estimate, where each of some poses may be the right one.
    #[must_use]
    pub(crate) fn among<'p>(&self, poses: impl ExactSizeIterator<Item = &'p Pose>) -> Self {
        let share = 1.0 / poses.len().max(1) as f64;
        let mut covariance = self.covariance;
        for pose in poses {
            let off = pose.at - self.pose.at;
            let off = Vector3::new(off.x, off.y, wrapped(pose.heading - self.pose.heading));
            covariance += off * off.transpose() * share;
        }
        Self { covariance, ..*self }
    }

    /// Whether it cannot be told any more which of the known surfaces is seen, one by one.
    pub(super) fn is_vague(&self, settings: &Settings) -> bool {
        self.sigma_m() > settings.match_sigma_m || self.sigma_heading() > settings.match_sigma_heading
    }

    /// How sure the robot is of where it is as seen from a surface.
    pub(super) fn seen_from(&self, surface: &ModelSegment) -> &Matrix3<f64> {
        if surface.is_anchored { &self.covariance } else { &self.relative }
    }

    /// Variances of the place, in the direction in which it is least certain, and of the heading: as seen from a surface that the
    /// robot has found itself, and from one that scans leave where it is.
    pub(super) fn variances(&self) -> [[f64; 2]; 2] {
        [&self.relative, &self.covariance].map(|of| [largest(of), of[(2, 2)].max(0.0)])
    }

    /// Dead reckoning: the pose after a step of the wheels' count, less sure by what wheels do not tell.
    pub(super) fn advance(&mut self, step: &Pose, settings: &Settings) {
        let driven = step.at.length();
        let step = Pose { heading: step.heading - settings.heading_bias * driven, ..*step };
        let before = self.pose;
        self.pose = before.then(&step);
        let (dx, dy) = (self.pose.at.x - before.at.x, self.pose.at.y - before.at.y);
        let turn = Matrix3::new(1.0, 0.0, -dy, 0.0, 1.0, dx, 0.0, 0.0, 1.0);
        let heading = settings.heading_noise.powi(2) * driven;
        // Steps are many and short, so that variances have to add up to what a whole stretch has.
        // Where no wall is known the robot goes by what it finds itself, which is the better the surer it is of its wheels.
        let stretch = if settings.knows_walls { settings.distance_stretch_m } else { FINDING_STRETCH_M };
        let along = settings.distance_noise.powi(2) * stretch * driven;
        let (ux, uy) = if driven > 0.0 { (dx / driven, dy / driven) } else { (0.0, 0.0) };
        let step = Vector3::new(ux, uy, 0.0);
        let mut noise = step * step.transpose() * along;
        noise[(2, 2)] = heading;
        for covariance in [&mut self.covariance, &mut self.relative] {
            *covariance = turn * *covariance * turn.transpose() + noise;
        }
    }
}

/// The variance of the place in the direction in which it is least certain.
fn largest(covariance: &Matrix3<f64>) -> f64 {
    let place = covariance.fixed_view::<2, 2>(0, 0);
    let mean = f64::midpoint(place[(0, 0)], place[(1, 1)]);
    let spread = f64::midpoint(place[(0, 0)], -place[(1, 1)]).hypot(place[(0, 1)]);
    (mean + spread).max(0.0)
}
