//! Abstract (Chen 1994, section 2.3): from a path to a short chain of subgoals.

use super::Adapt;
use crate::adapt::robot::{Configuration, between, distance};

/// A link of the chain: what Reach gave from one subgoal to the next, both included.
type Chain = Vec<Vec<Configuration>>;

impl Adapt {
    /// A chain of subgoals that Reach can follow from the first to the last configuration of a path: from each of them, the
    /// farthest along the path is looked for by binary search. `None` where the chain would be longer than its bound.
    pub(super) fn abstracted(&mut self, path: &[Configuration]) -> Option<Chain> {
        let path = discretized(path, self.settings.chain_step);
        let mut chain = Chain::new();
        let mut here = 0;
        while here + 1 < path.len() {
            if chain.len() == self.settings.max_chain {
                return None;
            }
            let (next, reached) = self.farthest(&path, here)?;
            chain.push(reached);
            here = next;
        }
        Some(chain)
    }

    fn farthest(&mut self, path: &[Configuration], here: usize) -> Option<(usize, Vec<Configuration>)> {
        let last = path.len() - 1;
        if let Some(all) = self.reach(&path[here], &path[last]) {
            return Some((last, all));
        }
        let (mut low, mut high) = (here + 1, last);
        let mut found = self.reach(&path[here], &path[low]);
        while high - low > 1 {
            let middle = usize::midpoint(low, high);
            match self.reach(&path[here], &path[middle]) {
                Some(reached) => (low, found) = (middle, Some(reached)),
                None => high = middle,
            }
        }
        found.map(|reached| (low, reached))
    }
}

/// The path with configurations on it no farther apart than a step.
fn discretized(path: &[Configuration], step: f64) -> Vec<Configuration> {
    let mut fine = Vec::new();
    for ends in path.windows(2) {
        let parts = (distance(&ends[0], &ends[1]) / step).ceil().max(1.0) as u32;
        let share = |part: u32| f64::from(part) / f64::from(parts);
        fine.extend((0..parts).map(|part| between(&ends[0], &ends[1], share(part))));
    }
    fine.extend(path.last().cloned());
    fine
}
