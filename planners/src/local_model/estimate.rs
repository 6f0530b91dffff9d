//! The estimated pose with its covariance.

use nalgebra::{Matrix3, Vector3};

use super::Settings;
use crate::pose::Pose;

/// Where the robot thinks it is, and how sure it is of that.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The most likely pose.
    pub pose: Pose,
    /// Covariance of x, y (square metres) and heading (square radians).
    pub covariance: Matrix3<f64>,
}

impl Estimate {
    /// An estimate with independent standard deviations of place (metres) and heading (radians).
    pub fn new(pose: Pose, sigma_m: f64, sigma_heading: f64) -> Self {
        let variances = Vector3::new(sigma_m.powi(2), sigma_m.powi(2), sigma_heading.powi(2));
        Self { pose, covariance: Matrix3::from_diagonal(&variances) }
    }

    /// Standard deviation of the place in the direction in which it is least certain, metres.
    pub fn sigma_m(&self) -> f64 {
        let place = self.covariance.fixed_view::<2, 2>(0, 0);
        let mean = f64::midpoint(place[(0, 0)], place[(1, 1)]);
        let spread = f64::midpoint(place[(0, 0)], -place[(1, 1)]).hypot(place[(0, 1)]);
        (mean + spread).max(0.0).sqrt()
    }

    /// Standard deviation of the heading, radians.
    pub fn sigma_heading(&self) -> f64 {
        self.covariance[(2, 2)].max(0.0).sqrt()
    }

    /// Dead reckoning: the pose after a step of the wheels' count, less sure by what wheels do not tell.
    pub(super) fn advance(&mut self, step: &Pose, settings: &Settings) {
        let driven = step.at.length();
        let step = Pose { heading: step.heading - settings.heading_bias * driven, ..*step };
        let before = self.pose;
        self.pose = before.then(&step);
        let (dx, dy) = (self.pose.at.x - before.at.x, self.pose.at.y - before.at.y);
        let turn = Matrix3::new(1.0, 0.0, -dy, 0.0, 1.0, dx, 0.0, 0.0, 1.0);
        self.covariance = turn * self.covariance * turn.transpose();
        let heading = settings.heading_noise.powi(2) * driven;
        // The deviation is a share of the distance for stretches of about a metre, which is how far a robot drives
        // between two scans; steps are many and short, so that variances have to add up.
        let along = settings.distance_noise.powi(2) * driven;
        let (ux, uy) = if driven > 0.0 { (dx / driven, dy / driven) } else { (0.0, 0.0) };
        self.covariance[(0, 0)] += along * ux * ux;
        self.covariance[(0, 1)] += along * ux * uy;
        self.covariance[(1, 0)] += along * ux * uy;
        self.covariance[(1, 1)] += along * uy * uy;
        self.covariance[(2, 2)] += heading;
    }
}
