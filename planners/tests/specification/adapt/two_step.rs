//! The Solve of the paper's example: at most two straight motions (Chen 1994, section 3).

use adit_planners::adapt::{Configuration, Probe, Solve, between, distance};
use adit_planners::random::Random;

/// The shortest path of at most two straight motions whose corner lies on a grid over the limits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TwoStep {
    /// How many values a joint or axis has on the grid; 2 at least, or there is no corner to try.
    pub values: usize,
}

impl Solve for TwoStep {
    fn solve(
        &self,
        probe: &mut Probe<'_>,
        from: &[f64],
        to: &[f64],
        _random: &mut Random,
    ) -> Option<Vec<Configuration>> {
        if !probe.is_free(from) || !probe.is_free(to) {
            return None;
        }
        if probe.is_motion_free(from, to) {
            return Some(vec![from.to_vec(), to.to_vec()]);
        }
        let mut corners = self.grid(probe);
        let around = |corner: &Configuration| distance(from, corner) + distance(corner, to);
        corners.sort_by(|a, b| around(a).total_cmp(&around(b)));
        let is_way =
            |corner: &Configuration| probe.is_motion_free(from, corner) && probe.is_motion_free(corner, to);
        corners.into_iter().find(is_way).map(|corner| vec![from.to_vec(), corner, to.to_vec()])
    }
}

impl TwoStep {
    fn grid(self, probe: &Probe<'_>) -> Vec<Configuration> {
        let limits = probe.robot().limits();
        let low: Configuration = limits.iter().map(|limit| limit.low).collect();
        let high: Configuration = limits.iter().map(|limit| limit.high).collect();
        let last = self.values.saturating_sub(1).max(1);
        let shares: Vec<f64> = (0..self.values).map(|step| step as f64 / last as f64).collect();
        let mut corners = vec![low.clone()];
        for axis in 0..limits.len() {
            let spread = |corner: Configuration| {
                shares.iter().map(move |&share| (corner.clone(), share)).collect::<Vec<_>>()
            };
            corners = corners
                .into_iter()
                .flat_map(spread)
                .map(|(mut corner, share)| {
                    corner[axis] = between(&low, &high, share)[axis];
                    corner
                })
                .collect();
        }
        corners
    }
}
