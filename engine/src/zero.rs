//! Zero has no sign. Whole numbers have none below it, and rules mean the same by those and by others.

#[inline]
pub(crate) fn product(a: f64, b: f64) -> f64 {
    a * b + 0.0
}

#[inline]
pub(crate) fn negated(a: f64) -> f64 {
    0.0 - a
}

/// A number in a text.
pub(crate) fn written(number: f64) -> String {
    (number + 0.0).to_string()
}
