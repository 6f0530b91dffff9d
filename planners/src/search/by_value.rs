//! Numbers as keys of a heap.

use std::cmp::Ordering;

/// A number in the total order of numbers, for keys (IEEE 754, 5.10).
#[derive(Clone, Copy, Debug)]
pub struct ByValue(pub f64);

impl Ord for ByValue {
    fn cmp(&self, other: &Self) -> Ordering {
        self.0.total_cmp(&other.0)
    }
}

impl PartialOrd for ByValue {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for ByValue {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for ByValue {}
