//! Ways as straight lines between two values of a cell in which weights are linear, and where two of them cross.

use super::linear::Line;
use super::{Look, Path};

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

/// Where the way that holds at the one value comes to cost what the one costs that wins at the other; with that and its cost.
pub fn crossing(line: &Line, near: &At, far: &At) -> Option<(f64, Path, f64)> {
    let ((own, _), (rival, _)) = (near.look.own.as_ref()?, far.look.rival.as_ref()?);
    let (one, two) = (Straight::of(line, own, near, far)?, Straight::of(line, rival, near, far)?);
    let share = one.meets(&two)?.clamp(0.0, 1.0);
    Some((near.value + (far.value - near.value) * share, rival.clone(), two.at(share)))
}

/// Whether a value is another one than two about it.
pub fn is_inside(value: f64, near: &At, far: &At) -> bool {
    let is_other = |at: &At| (value - at.value).abs() > 1e-9 * value.abs().max(1e-6);
    is_other(near) && is_other(far)
}
