//! Costs, compared but for rounding.

use super::mesh::EPSILON;

/// Costs that differ by no more than this share of them are the same but for rounding.
const SAME: f64 = 1e-13;

/// What is more than a cost but for rounding, however large it is.
pub(super) fn hardly_more(cost: f64) -> f64 {
    cost + rounding(cost)
}

/// What is less than a cost but for rounding, however large it is.
pub(super) fn hardly_less(cost: f64) -> f64 {
    cost - rounding(cost)
}

fn rounding(cost: f64) -> f64 {
    if cost.is_finite() { EPSILON.max(SAME * cost.abs()) } else { 0.0 }
}
