//! Ways through the experience graph.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet, BinaryHeap};

use super::experience::{Experience, VertexId};
use super::robot::distance;
use crate::search::ByValue;

/// How far a vertex is along the graph, and from which one it is reached.
type Reached = BTreeMap<VertexId, (f64, VertexId)>;

/// A* (Hart, Nilsson and Raphael 1968) from a vertex to another one; without another one Dijkstra's search of all. Of equally long
/// ways the same one is found in equal graphs, whatever their history.
fn search(experience: &Experience, from: VertexId, to: Option<VertexId>) -> Reached {
    let goal = to.and_then(|to| experience.vertex(to));
    let straight = |id: VertexId| match (goal, experience.vertex(id)) {
        (Some(goal), Some(vertex)) => distance(&vertex.at, &goal.at),
        _ => 0.0,
    };
    let mut reached = Reached::new();
    let mut done = BTreeSet::new();
    let mut open = BinaryHeap::new();
    if experience.vertex(from).is_some() {
        reached.insert(from, (0.0, from));
        open.push(Reverse((ByValue(straight(from)), from)));
    }
    while let Some(Reverse((_, here))) = open.pop() {
        if Some(here) == to {
            break;
        }
        if !done.insert(here) {
            continue;
        }
        let so_far = reached[&here].0;
        for edge in experience.edges_at(here) {
            let next = if edge.ends.0 == here { edge.ends.1 } else { edge.ends.0 };
            let length = so_far + edge.length;
            if reached.get(&next).is_none_or(|(known, _)| length < *known) {
                reached.insert(next, (length, here));
                open.push(Reverse((ByValue(length + straight(next)), next)));
            }
        }
    }
    reached
}

/// The shortest sequence of vertices from one to another, whether its edges still hold or not.
pub(super) fn sequence(experience: &Experience, from: VertexId, to: VertexId) -> Option<Vec<VertexId>> {
    experience.vertex(to)?;
    let reached = search(experience, from, Some(to));
    let mut sequence = vec![to];
    let mut here = to;
    while here != from {
        here = reached.get(&here)?.1;
        sequence.push(here);
    }
    sequence.reverse();
    Some(sequence)
}

/// How far vertices are along the graph from one; those that hang together with it.
pub(super) fn lengths(experience: &Experience, from: VertexId) -> BTreeMap<VertexId, f64> {
    search(experience, from, None).into_iter().map(|(id, (length, _))| (id, length)).collect()
}

pub(super) fn component(experience: &Experience, of: VertexId) -> BTreeSet<VertexId> {
    search(experience, of, None).into_keys().collect()
}
