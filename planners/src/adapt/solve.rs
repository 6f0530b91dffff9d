//! The global, slow planner: Solve (Chen 1994, section 2).

mod rrt_connect;
mod taught;

use std::fmt;

pub use rrt_connect::RrtConnect;
pub use taught::Taught;

use super::probe::Probe;
use super::robot::Configuration;
use crate::random::Random;

/// Much more effective than Reach, and slow; it may even be the human operator.
pub trait Solve: fmt::Debug + Send + Sync {
    /// A free path of straight motions with both ends in it; `None` where none was found.
    fn solve(
        &self,
        probe: &mut Probe<'_>,
        from: &[f64],
        to: &[f64],
        random: &mut Random,
    ) -> Option<Vec<Configuration>>;
}
