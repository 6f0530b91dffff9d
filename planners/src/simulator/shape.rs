//! Robots that change their shape: how large and how fast they are in each, and beneath what they do not fit.

use std::collections::BTreeMap;

use super::error::SimulationError;
use super::settings::Settings;
use crate::geometry::Rect;
use crate::rim::Rim;

/// A shape in which the robot can be.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    /// At heading 0.
    pub rim: Rim,
    pub greatest_speed_m_s: f64,
    /// What hangs so low that the robot does not fit beneath it. The sonar does not hear it.
    pub overhead: Vec<Rect>,
}

/// The shapes of a robot, by number.
#[derive(Clone, Debug, PartialEq)]
pub struct Shapes {
    pub all: Vec<Shape>,
    /// How long it takes to change from one into another, seconds; what is not said takes no time.
    pub seconds: BTreeMap<(usize, usize), f64>,
}

impl Shapes {
    /// A robot that stays as it is.
    pub(super) fn one(settings: &Settings) -> Self {
        let Settings { radius_m, greatest_speed_m_s, .. } = *settings;
        Self {
            all: vec![Shape { rim: Rim::disc(radius_m), greatest_speed_m_s, overhead: Vec::new() }],
            seconds: BTreeMap::new(),
        }
    }

    pub(super) fn seconds(&self, from: usize, to: usize) -> f64 {
        self.seconds.get(&(from, to)).copied().unwrap_or(0.0)
    }

    pub(super) fn check(&self, shape: usize) -> Result<(), SimulationError> {
        if shape >= self.all.len() {
            return Err(SimulationError::NoShape { shape, shapes: self.all.len() });
        }
        let of = |shape: &Shape| {
            [("inner_m", shape.rim.inner_m()), ("greatest_speed_m_s", shape.greatest_speed_m_s)]
        };
        let is_wrong = |(_, value): &(&str, f64)| !(value.is_finite() && *value > 0.0);
        let wrong = self.all.iter().flat_map(of).find(is_wrong);
        let times = self.seconds.values().map(|seconds| ("seconds of a change of shape", *seconds));
        let wrong =
            wrong.or_else(|| times.into_iter().find(|(_, value)| !(value.is_finite() && *value >= 0.0)));
        wrong.map_or(Ok(()), |(name, value)| Err(SimulationError::Setting { name, value }))
    }
}
