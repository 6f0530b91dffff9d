//! The planners that are joined, and how they are set.

use std::sync::Arc;

use adit_planners::adapt::{Configuration, Plugins, RrtConnect, Settings, Solve, Straight, Taught};

/// What comes nearer to an object than so many metres touches it.
pub const TOUCHING_M: f64 = 1e-4;

/// Reach goes straight; Solve is RRT-Connect.
pub fn plugins() -> Plugins {
    Plugins { reach: Arc::new(Straight), solve: Arc::new(solve()) }
}

/// The same, where taught paths are tried before Solve.
pub fn with_taught(taught: Vec<Vec<Configuration>>) -> Plugins {
    let solve: Arc<dyn Solve> =
        if taught.is_empty() { Arc::new(solve()) } else { Arc::new(Taught::new(taught, solve())) };
    Plugins { solve, ..plugins() }
}

const fn solve() -> RrtConnect {
    RrtConnect { step: 0.4, samples: 5_000 }
}

/// How the planner is set.
pub fn settings(seed: u64) -> Settings {
    Settings { seed, ..Settings::default() }
}
