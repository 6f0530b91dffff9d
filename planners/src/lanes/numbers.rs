//! Numbers of nodes and lanes: those that a file gives, or their order in it. They stay with the rows, so that what is written
//! has the same ones again.

use std::collections::BTreeSet;

use super::LaneGraph;

pub(super) fn fill(graph: &mut LaneGraph) {
    if graph.nodes.iter().all(|node| node.number.is_none()) {
        for (number, node) in (0..).zip(&mut graph.nodes) {
            node.number = Some(number);
        }
    }
    if graph.lanes.iter().all(|lane| lane.number.is_none()) {
        for (number, lane) in (0..).zip(&mut graph.lanes) {
            lane.number = Some(number);
        }
    }
}

/// A number up to `largest` for each, its own where no other before has it, else the next that is free; `None` where there
/// are too many.
pub(super) fn distinct(own: &[Option<u32>], largest: u32) -> Option<Vec<u32>> {
    let mut taken = BTreeSet::new();
    let mut numbers: Vec<Option<u32>> = own
        .iter()
        .map(|number| number.filter(|number| *number <= largest && taken.insert(*number)))
        .collect();
    let mut free = (0..=largest).filter(|number| !taken.contains(number));
    for number in numbers.iter_mut().filter(|number| number.is_none()) {
        *number = Some(free.next()?);
    }
    numbers.into_iter().collect()
}
