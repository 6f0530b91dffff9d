//! What Adit says in many places: numbers, points, cells, how far long work has come, the name that somebody probably meant.

pub(crate) mod cells;
pub(crate) mod measure;
pub(crate) mod number;
pub(crate) mod point;
pub(crate) mod progress;
pub(crate) mod suggest;
