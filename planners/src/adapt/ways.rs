//! Ways through the experience graph.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet, BinaryHeap};

use super::experience::{Experience, VertexId};
use super::robot::distance;
use crate::search::ByValue;

/// How far a vertex is along the graph, from which one it is reached, and whether that is the shortest way.
#[derive(Clone, Copy)]
struct Reached {
    length: f64,
    before: VertexId,
    is_done: bool,
}

/// The vertices that were reached, by number.
struct Searched(Vec<Option<Reached>>);

impl Searched {
    fn get(&self, id: VertexId) -> Option<&Reached> {
        self.0.get(id.0 as usize)?.as_ref()
    }

    fn all(&self) -> impl Iterator<Item = (VertexId, &Reached)> {
        (0..).map(VertexId).zip(&self.0).filter_map(|(id, reached)| Some((id, reached.as_ref()?)))
    }
}

/// A* (Hart, Nilsson and Raphael 1968) from a vertex to another one; without another one Dijkstra's search of all. Of equally long
/// ways the same one is found in equal graphs, whatever their history.
fn search(experience: &Experience, from: VertexId, to: Option<VertexId>) -> Searched {
    let goal = to.and_then(|to| experience.vertex(to));
    let straight = |id: VertexId| match (goal, experience.vertex(id)) {
        (Some(goal), Some(vertex)) => distance(&vertex.at, &goal.at),
        _ => 0.0,
    };
    let mut reached = vec![None; experience.next_numbers().0 as usize];
    let mut open = BinaryHeap::new();
    if experience.vertex(from).is_some() {
        reached[from.0 as usize] = Some(Reached { length: 0.0, before: from, is_done: false });
        open.push(Reverse((ByValue(straight(from)), from)));
    }
    while let Some(Reverse((_, here))) = open.pop() {
        if Some(here) == to {
            break;
        }
        let Some(at) = reached[here.0 as usize].as_mut().filter(|at| !at.is_done) else { continue };
        at.is_done = true;
        let so_far = at.length;
        for edge in experience.edges_at(here) {
            let next = if edge.ends.0 == here { edge.ends.1 } else { edge.ends.0 };
            let length = so_far + edge.length;
            let known = &mut reached[next.0 as usize];
            if known.is_none_or(|known| length < known.length) {
                *known =
                    Some(Reached { length, before: here, is_done: known.is_some_and(|known| known.is_done) });
                open.push(Reverse((ByValue(length + straight(next)), next)));
            }
        }
    }
    Searched(reached)
}

/// The shortest sequence of vertices from one to another, whether its edges still hold or not.
pub(super) fn sequence(experience: &Experience, from: VertexId, to: VertexId) -> Option<Vec<VertexId>> {
    experience.vertex(to)?;
    let reached = search(experience, from, Some(to));
    let mut sequence = vec![to];
    let mut here = to;
    while here != from {
        here = reached.get(here)?.before;
        sequence.push(here);
    }
    sequence.reverse();
    Some(sequence)
}

/// How far vertices are along the graph from one; those that hang together with it.
pub(super) fn lengths(experience: &Experience, from: VertexId) -> BTreeMap<VertexId, f64> {
    search(experience, from, None).all().map(|(id, reached)| (id, reached.length)).collect()
}

pub(super) fn component(experience: &Experience, of: VertexId) -> BTreeSet<VertexId> {
    search(experience, of, None).all().map(|(id, _)| id).collect()
}
