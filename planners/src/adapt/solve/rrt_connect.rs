//! Two trees that grow towards each other (Kuffner and LaValle 2000).

use super::{Configuration, Probe, Solve};
use crate::adapt::nearest::Nearest;
use crate::adapt::robot::{any_configuration, between, distance};
use crate::random::Random;

/// RRT-Connect over motions that are free by what is known of clearances.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RrtConnect {
    /// The longest motion that is added to a tree, by the distance of configurations.
    pub step: f64,
    /// After so many samples it gives up.
    pub samples: u32,
}

impl Default for RrtConnect {
    /// A step of 0.6 and at most 2,000 samples.
    fn default() -> Self {
        Self { step: 0.6, samples: 2_000 }
    }
}

struct Tree {
    nodes: Vec<(Configuration, usize)>,
    nearest: Nearest,
}

impl Tree {
    fn new(root: &[f64]) -> Self {
        let mut tree = Self { nodes: Vec::new(), nearest: Nearest::default() };
        tree.add(root.to_vec(), 0);
        tree
    }

    fn add(&mut self, at: Configuration, parent: usize) -> usize {
        let index = self.nodes.len();
        self.nearest.insert(&at, index as u32);
        self.nodes.push((at, parent));
        index
    }

    fn near(&self, at: &[f64]) -> usize {
        self.nearest.from(at).next().map_or(0, |(number, _)| number as usize)
    }

    /// From a node to the root, both included.
    fn path(&self, mut index: usize) -> Vec<Configuration> {
        let mut path = vec![self.nodes[index].0.clone()];
        while index != 0 {
            index = self.nodes[index].1;
            path.push(self.nodes[index].0.clone());
        }
        path
    }
}

impl RrtConnect {
    /// Goes from a tree's nearest node towards a configuration by one step; the new node, if the motion is free.
    fn extend(&self, probe: &mut Probe<'_>, tree: &mut Tree, near: usize, to: &[f64]) -> Option<usize> {
        let from = &tree.nodes[near].0;
        let far = distance(from, to);
        let at = if far <= self.step { to.to_vec() } else { between(from, to, self.step / far) };
        probe.is_motion_free(from, &at).then(|| tree.add(at, near))
    }
}

impl Solve for RrtConnect {
    fn solve(
        &self,
        probe: &mut Probe<'_>,
        from: &[f64],
        to: &[f64],
        random: &mut Random,
    ) -> Option<Vec<Configuration>> {
        if !probe.is_free(from) || !probe.is_free(to) {
            return None;
        }
        if probe.is_motion_free(from, to) {
            return Some(vec![from.to_vec(), to.to_vec()]);
        }
        let mut trees = [Tree::new(from), Tree::new(to)];
        for sample in 0..self.samples as usize {
            let grown = sample % 2;
            let target = any_configuration(probe.robot(), random);
            let near = trees[grown].near(&target);
            let Some(new) = self.extend(probe, &mut trees[grown], near, &target) else { continue };
            let target = trees[grown].nodes[new].0.clone();
            let other = &mut trees[1 - grown];
            let mut end = other.near(&target);
            while let Some(next) = self.extend(probe, other, end, &target) {
                end = next;
                if other.nodes[end].0 == target {
                    let mut halves = [trees[grown].path(new), trees[1 - grown].path(end)];
                    halves.swap(0, grown);
                    let [mut start, rest] = halves;
                    start.reverse();
                    start.extend(rest.into_iter().skip(1));
                    return Some(start);
                }
            }
        }
        None
    }
}
