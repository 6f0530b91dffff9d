//! A path that the operator taught.

use super::{Configuration, Probe, Solve};
use crate::adapt::robot::distance;
use crate::random::Random;

/// Paths as they were taught, used in either direction wherever both ends lie on one and it is free; else another planner.
#[derive(Debug)]
pub struct Taught<S> {
    paths: Vec<Vec<Configuration>>,
    otherwise: S,
}

/// How near to a taught configuration counts as being there, by the distance of configurations.
const AT: f64 = 1e-6;

impl<S: Solve> Taught<S> {
    /// Taught paths, in the order in which they are tried, and who is asked where none fits.
    pub const fn new(paths: Vec<Vec<Configuration>>, otherwise: S) -> Self {
        Self { paths, otherwise }
    }
}

impl<S: Solve> Solve for Taught<S> {
    fn solve(
        &self,
        probe: &mut Probe<'_>,
        from: &[f64],
        to: &[f64],
        random: &mut Random,
    ) -> Option<Vec<Configuration>> {
        for path in &self.paths {
            let part = part(path, from, to);
            if part.as_ref().is_some_and(|part| part.windows(2).all(|m| probe.is_motion_free(&m[0], &m[1]))) {
                return part;
            }
        }
        self.otherwise.solve(probe, from, to, random)
    }
}

/// The part of a path between two of its configurations, turned so that it goes the right way.
fn part(path: &[Configuration], from: &[f64], to: &[f64]) -> Option<Vec<Configuration>> {
    let find =
        |there: &[f64]| path.iter().position(|at| at.len() == there.len() && distance(at, there) <= AT);
    let (start, end) = (find(from)?, find(to)?);
    let mut part = path[start.min(end)..=start.max(end)].to_vec();
    if start > end {
        part.reverse();
    }
    Some(part)
}
