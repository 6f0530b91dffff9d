//! Configurations in order of their distance from one: a k-d tree (Bentley 1975), searched best first.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::robot::{Configuration, distance};
use crate::search::ByValue;

/// Numbered configurations, found by where they are.
#[derive(Clone, Debug, Default)]
pub(super) struct Nearest {
    nodes: Vec<Node>,
}

#[derive(Clone, Debug)]
struct Node {
    at: Configuration,
    number: u32,
    axis: usize,
    children: [Option<usize>; 2],
}

impl Nearest {
    pub fn insert(&mut self, at: &[f64], number: u32) {
        let new = self.nodes.len();
        let mut axis = 0;
        let mut here = (new > 0).then_some(0);
        while let Some(index) = here {
            let node = &mut self.nodes[index];
            let side = usize::from(at[node.axis] >= node.at[node.axis]);
            axis = (node.axis + 1) % at.len();
            here = node.children[side];
            node.children[side].get_or_insert(new);
        }
        self.nodes.push(Node { at: at.to_vec(), number, axis, children: [None; 2] });
    }

    /// All numbers with their distances, the nearest first; of equally near ones, the lowest number.
    pub fn from<'n>(&'n self, at: &'n [f64]) -> InOrder<'n> {
        let mut heap = BinaryHeap::new();
        if !self.nodes.is_empty() {
            heap.push(Reverse((ByValue(0.0), What::Subtree(0))));
        }
        InOrder { nearest: self, at, heap }
    }
}

#[derive(Debug)]
pub(super) struct InOrder<'n> {
    nearest: &'n Nearest,
    at: &'n [f64],
    heap: BinaryHeap<Entry>,
}

impl Iterator for InOrder<'_> {
    type Item = (u32, f64);

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            let Reverse((ByValue(bound), what)) = self.heap.pop()?;
            let index = match what {
                What::Found(number) => return Some((number, bound)),
                What::Subtree(index) => index,
            };
            let node = &self.nearest.nodes[index];
            self.heap.push(Reverse((ByValue(distance(&node.at, self.at)), What::Found(node.number))));
            let offset = self.at[node.axis] - node.at[node.axis];
            for (side, child) in node.children.iter().enumerate() {
                if let &Some(child) = child {
                    let is_near = (offset >= 0.0) == (side == 1);
                    let bound = if is_near { bound } else { bound.max(offset.abs()) };
                    self.heap.push(Reverse((ByValue(bound), What::Subtree(child))));
                }
            }
        }
    }
}

/// The nearest first, and subtrees before what is found, since they may hold as near ones.
type Entry = Reverse<(ByValue, What)>;

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum What {
    Subtree(usize),
    Found(u32),
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn the_order_is_that_of_a_sort(
            points in prop::collection::vec(prop::collection::vec(-4_i8..4, 3), 0..40),
            at in prop::collection::vec(-4_i8..4, 3),
        ) {
            let wide = |p: &Vec<i8>| p.iter().map(|&c| f64::from(c)).collect::<Configuration>();
            let points: Vec<Configuration> = points.iter().map(wide).collect();
            let at = wide(&at);
            let mut nearest = Nearest::default();
            for (number, point) in (0..).zip(&points) {
                nearest.insert(point, number);
            }
            let mut sorted: Vec<u32> = (0..points.len() as u32).collect();
            let far = |number: &u32| distance(&points[*number as usize], &at);
            sorted.sort_by(|a, b| far(a).total_cmp(&far(b)).then(a.cmp(b)));
            let found: Vec<u32> = nearest.from(&at).map(|(number, _)| number).collect();
            prop_assert_eq!(found, sorted);
        }
    }
}
