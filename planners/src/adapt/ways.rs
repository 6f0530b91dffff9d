//! Ways through the experience graph.

use std::collections::{BTreeMap, BTreeSet};

use petgraph::algo::{astar, dijkstra};
use petgraph::graph::{NodeIndex, UnGraph};

use super::experience::{Experience, VertexId};
use super::robot::distance;

/// The graph as petgraph has it: made anew for each search, so that equal graphs give equal ways, whatever their history.
struct Ways {
    graph: UnGraph<VertexId, f64>,
    nodes: BTreeMap<VertexId, NodeIndex>,
}

impl Ways {
    fn new(experience: &Experience) -> Self {
        let mut graph = UnGraph::default();
        let nodes: BTreeMap<VertexId, NodeIndex> =
            experience.vertices().map(|vertex| (vertex.id, graph.add_node(vertex.id))).collect();
        for edge in experience.edges() {
            graph.add_edge(nodes[&edge.ends.0], nodes[&edge.ends.1], edge.length);
        }
        Self { graph, nodes }
    }
}

/// The shortest sequence of vertices from one to another, whether its edges still hold or not.
pub(super) fn sequence(experience: &Experience, from: VertexId, to: VertexId) -> Option<Vec<VertexId>> {
    let goal = &experience.vertex(to)?.at;
    let ways = Ways::new(experience);
    let straight = |node: NodeIndex| {
        experience.vertex(ways.graph[node]).map_or(0.0, |vertex| distance(&vertex.at, goal))
    };
    let (start, end) = (*ways.nodes.get(&from)?, *ways.nodes.get(&to)?);
    let (_, nodes) = astar(&ways.graph, start, |node| node == end, |edge| *edge.weight(), straight)?;
    Some(nodes.into_iter().map(|node| ways.graph[node]).collect())
}

/// How far vertices are along the graph from one; those that hang together with it.
pub(super) fn lengths(experience: &Experience, from: VertexId) -> BTreeMap<VertexId, f64> {
    let ways = Ways::new(experience);
    let Some(&start) = ways.nodes.get(&from) else { return BTreeMap::new() };
    let lengths = dijkstra(&ways.graph, start, None, |edge| *edge.weight());
    ways.nodes.iter().filter_map(|(id, node)| Some((*id, *lengths.get(node)?))).collect()
}

pub(super) fn component(experience: &Experience, of: VertexId) -> BTreeSet<VertexId> {
    lengths(experience, of).into_keys().collect()
}
