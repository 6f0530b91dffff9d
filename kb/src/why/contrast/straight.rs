//! Ways as straight lines between two values of a cell in which weights are linear.

use super::{Look, Path};
use crate::state::tunable::Line;

/// A look at a value.
#[derive(Clone)]
pub struct At {
    pub value: f64,
    pub look: Look,
}

/// What a way costs between two values of a cell in which weights are linear.
pub struct Straight {
    pub from: f64,
    pub to: f64,
}

impl Straight {
    pub fn of(line: &Line, path: &Path, near: &At, far: &At) -> Option<Self> {
        let cost =
            |at: &At| line.at(at.value).map(|weights| path.cost(&weights)).filter(|cost| cost.is_finite());
        Some(Self { from: cost(near)?, to: cost(far)? })
    }

    pub fn at(&self, share: f64) -> f64 {
        self.from + (self.to - self.from) * share
    }

    /// At which share of both they cost the same.
    pub fn meets(&self, other: &Self) -> Option<f64> {
        let (begins, ends) = (self.from - other.from, self.to - other.to);
        let share = begins / (begins - ends);
        share.is_finite().then_some(share)
    }
}

/// Whether a value is another one than two about it.
pub fn is_inside(value: f64, near: &At, far: &At) -> bool {
    let is_other = |at: &At| (value - at.value).abs() > 1e-9 * value.abs().max(1e-6);
    is_other(near) && is_other(far)
}

/// By how much more a way costs for each that the value of a cell is more; `None` where it cannot be passed.
pub fn slope(line: &Line, path: &Path) -> Option<f64> {
    let [(from, present), (to, there)] = line.ends();
    let slope = (path.cost(&there) - path.cost(&present)) / (to - from);
    slope.is_finite().then_some(slope)
}
