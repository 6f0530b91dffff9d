//! The planners that are joined.

use std::sync::Arc;

use adit_planners::adapt::{Configuration, Plugins, RrtConnect, Taught};

/// The standard ones; taught paths are tried before Solve.
pub fn with_taught(taught: Vec<Vec<Configuration>>) -> Plugins {
    let standard = Plugins::standard();
    if taught.is_empty() {
        return standard;
    }
    Plugins { solve: Arc::new(Taught::new(taught, RrtConnect::default())), ..standard }
}
