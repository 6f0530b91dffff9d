//! The least weights from a start and to a goal over all adits, and the paths that they make.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use petgraph::graph::{NodeIndex, UnGraph};
use petgraph::visit::EdgeRef;

use super::network::{Network, Spot};
use crate::geometry::Point;
use crate::search::ByValue;

/// A path over adits.
#[derive(Clone, Debug)]
pub(super) struct Route {
    pub adits: Vec<usize>,
    pub weight: f64,
}

/// The network with the weights of its ways.
pub(super) struct Trees<'n> {
    network: &'n Network,
    /// Adits; edges are ways, by index, with their weights.
    graph: UnGraph<(), (usize, f64)>,
}

impl<'n> Trees<'n> {
    pub fn new(network: &'n Network, weights: Vec<Option<f64>>) -> Self {
        let mut graph = UnGraph::with_capacity(network.adits.len() + 1, network.ways.len());
        for _ in &network.adits {
            graph.add_node(());
        }
        for ((number, way), weight) in network.ways.iter().enumerate().zip(weights) {
            if let (Spot::Adit(a), Spot::Adit(b), Some(weight)) = (way.from, way.to, weight) {
                graph.add_edge(NodeIndex::new(a), NodeIndex::new(b), (number, weight));
            }
        }
        Self { network, graph }
    }

    fn edge(&self, from: usize, to: usize) -> Option<(usize, f64)> {
        let edges = self.graph.edges_connecting(NodeIndex::new(from), NodeIndex::new(to));
        edges.map(|edge| *edge.weight()).min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// What the way between two adits weighs; `None` where none is open.
    pub fn between(&self, from: usize, to: usize) -> Option<f64> {
        self.edge(from, to).map(|edge| edge.1)
    }

    /// The points of the way from an adit to another one.
    pub fn points(&self, from: usize, to: usize) -> Option<Vec<Point>> {
        let way = &self.network.ways[self.edge(from, to)?.0];
        let mut points = way.points.clone();
        if way.from != Spot::Adit(from) {
            points.reverse();
        }
        Some(points)
    }

    /// The routes of least weight over each pair of twins that weigh at most a share more than the least of all, the
    /// least first; each passes other doorways.
    ///
    /// # Arguments
    /// `first` and `last` are the adits of the start and of the goal, with what the ways to them weigh.
    pub fn routes(&self, first: &[(usize, f64)], last: &[(usize, f64)], slack: f64) -> Vec<Route> {
        let (there, back) = (self.tree(first), self.tree(last));
        let twins = (0..self.network.adits.len()).filter_map(|adit| {
            let twin = self.network.adits[adit].twin;
            let (before, after) = (there.weight[adit]?, back.weight[twin]?);
            Some((before + self.between(adit, twin)? + after, adit, twin))
        });
        let mut twins: Vec<(f64, usize, usize)> = twins.collect();
        twins.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let least = twins.first().map_or(0.0, |twin| twin.0);
        let mut routes: Vec<Route> = Vec::new();
        for (weight, adit, twin) in twins.into_iter().take_while(|twin| twin.0 <= least * (1.0 + slack)) {
            let mut adits = there.way(adit);
            adits.reverse();
            adits.extend(back.way(twin));
            let mut doorways: Vec<usize> = adits.iter().map(|adit| adit / 2).collect();
            doorways.sort_unstable();
            let passes_twice = doorways.windows(3).any(|three| three[0] == three[2]);
            if !passes_twice && routes.iter().all(|route| route.adits != adits) {
                routes.push(Route { adits, weight });
                if slack == 0.0 {
                    break;
                }
            }
        }
        routes
    }

    /// The least weights from some adits, by Dijkstra's search; of equal ones that over the adit of lower number.
    ///
    /// petgraph's begins at one node, and tells neither ways nor which of equal ones it took; it is no slower (`cargo bench
    /// -p adit-planners --bench search`).
    fn tree(&self, ends: &[(usize, f64)]) -> Tree {
        let count = self.network.adits.len();
        let mut tree = Tree { weight: vec![None; count], before: vec![None; count] };
        let arrival =
            |weight: f64, adit: usize, before: Option<usize>| Reverse((ByValue(weight), adit, before));
        let mut queue: BinaryHeap<_> =
            ends.iter().map(|&(adit, weight)| arrival(weight, adit, None)).collect();
        while let Some(Reverse((ByValue(weight), adit, before))) = queue.pop() {
            if tree.weight[adit].is_some() {
                continue;
            }
            (tree.weight[adit], tree.before[adit]) = (Some(weight), before);
            for edge in self.graph.edges(NodeIndex::new(adit)) {
                let next = edge.target().index();
                if tree.weight[next].is_none() {
                    queue.push(arrival(weight + edge.weight().1, next, Some(adit)));
                }
            }
        }
        tree
    }
}

struct Tree {
    weight: Vec<Option<f64>>,
    /// For each adit the one before it on the way from the end.
    before: Vec<Option<usize>>,
}

impl Tree {
    /// The adits from one back to the end.
    fn way(&self, adit: usize) -> Vec<usize> {
        std::iter::successors(Some(adit), |&adit| self.before[adit]).collect()
    }
}
