//! The fast, local planner: Reach (Chen 1994, section 2).

use std::fmt;

use super::probe::Probe;
use super::robot::Configuration;

/// Fast, symmetric, and effective only nearby. The same configurations in the same cell give the same answer.
pub trait Reach: fmt::Debug + Send + Sync {
    /// A free path of straight motions with both ends in it; `None` where this planner finds none.
    fn reach(&self, probe: &mut Probe<'_>, from: &[f64], to: &[f64]) -> Option<Vec<Configuration>>;
}

/// Goes straight (section 3).
#[derive(Clone, Copy, Debug, Default)]
pub struct Straight;

impl Reach for Straight {
    fn reach(&self, probe: &mut Probe<'_>, from: &[f64], to: &[f64]) -> Option<Vec<Configuration>> {
        probe.is_motion_free(from, to).then(|| vec![from.to_vec(), to.to_vec()])
    }
}
