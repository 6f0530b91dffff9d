//! The best way by its worst point.
//!
//! petgraph has no such search. Its `astar` finds the way where adding takes the larger lack, and as quickly, but over a
//! graph that has to be laid first (`cargo bench -p adit-planners --bench search`); here a value, which may take long to
//! find, is asked for when the search comes to a node.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Of all ways between two nodes one whose least value is greatest, as nodes from `start` to `goal`; `None` where there
/// is no way. Values are not negative.
///
/// # Arguments
/// `count` is the number of nodes, `value` what a node allows, `neighbours` the nodes that one leads to.
pub fn best_way<N: IntoIterator<Item = usize>>(
    count: usize,
    (start, goal): (usize, usize),
    mut value: impl FnMut(usize) -> f64,
    mut neighbours: impl FnMut(usize) -> N,
) -> Option<Vec<usize>> {
    // The bits of floats that are not negative are ordered as the floats.
    let mut queue = BinaryHeap::from([(value(start).to_bits(), Reverse(start), start)]);
    let mut came_from = vec![usize::MAX; count];
    while let Some((least, Reverse(node), from)) = queue.pop() {
        if came_from[node] != usize::MAX {
            continue;
        }
        came_from[node] = from;
        if node == goal {
            return Some(way_back(&came_from, goal));
        }
        for next in neighbours(node) {
            if came_from[next] == usize::MAX {
                queue.push((least.min(value(next).to_bits()), Reverse(next), node));
            }
        }
    }
    None
}

fn way_back(came_from: &[usize], goal: usize) -> Vec<usize> {
    let before = |&node: &usize| Some(came_from[node]).filter(|&before| before != node);
    let mut way: Vec<usize> = std::iter::successors(Some(goal), before).collect();
    way.reverse();
    way
}
