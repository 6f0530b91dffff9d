//! By how much numbers may differ that are meant to be equal.

/// What rounding leaves between lengths that are meant to be equal, metres: a hundred times what it is in a map of 50 km.
pub const ROUNDING_M: f64 = 1e-9;

/// The same as a share of the lengths, areas or weights that are compared.
pub const ROUNDING: f64 = 1e-9;

/// Points nearer than this are one, metres: far above what sums of coordinates lose, far below what anybody draws.
pub const SNAP_M: f64 = 1e-6;
