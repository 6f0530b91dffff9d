//! Searches of our own beside petgraph's on the same graphs: why each of them stays.
//! `cargo bench -p adit-planners --bench search`
//!
//! The any-angle search of routes has no counterpart: its nodes, what a corner sees of a door, are made as it goes.
#![allow(missing_docs)] // divan's macros

#[path = "support/building.rs"]
mod building;

use std::convert::Infallible;
use std::ops::Add;
use std::path::Path;

use adit_planners::channels::corridor::Corridors;
use adit_planners::floor_plan::{Disc, Network, Rule, Spot, read_floor_plan};
use adit_planners::geometry::{Point, Rect};
use adit_planners::routes::{Start, Walking};
use adit_planners::search::bottleneck::best_way;
use adit_planners::search::grid::{around, least_cost, least_costs};
use building::building;
use divan::Bencher;
use petgraph::algo::{astar, dijkstra};
use petgraph::graph::{DiGraph, NodeIndex, UnGraph};
use petgraph::visit::EdgeRef;

fn main() {
    divan::main();
}

const ROOMS: [usize; 2] = [32, 100];

#[divan::bench(args = ROOMS)]
fn rooms_ours(bencher: Bencher, side: usize) {
    let graph = building(side, Walking::OnDoors);
    let start = Start::within([NodeIndex::new(0)], Point::new(2.0, 2.0));
    bencher.bench(|| graph.tree(&start));
}

/// Without the doors and how many of them are passed.
#[divan::bench(args = ROOMS)]
fn rooms_petgraph(bencher: Bencher, side: usize) {
    let graph = building(side, Walking::OnDoors);
    bencher.bench(|| dijkstra(&graph, NodeIndex::new(0), None, |passage| *passage.weight()));
}

/// A grid of so many cells a side, with posts on it.
const GRID: (usize, usize) = (200, 200);
const CELLS: usize = GRID.0 * GRID.1;

fn is_free(cell: usize) -> bool {
    let (column, row) = (cell % GRID.0, cell / GRID.0);
    column % 7 > 2 || row % 5 > 1
}

fn next(cell: usize) -> impl Iterator<Item = (usize, u32)> {
    around(cell, GRID).filter(|(next, _)| is_free(*next))
}

fn left(cell: usize) -> u32 {
    least_cost(GRID.0 - 1 - cell % GRID.0, GRID.1 - 1 - cell / GRID.0)
}

/// The first cell that is free, and the last one.
fn ends() -> (usize, usize) {
    ((0..CELLS).find(|&cell| is_free(cell)).unwrap_or(0), CELLS - 1)
}

fn grid() -> UnGraph<(), u32, usize> {
    let edges = (0..CELLS).filter(|&cell| is_free(cell)).flat_map(|cell| {
        next(cell).filter(move |(next, _)| cell < *next).map(move |(next, cost)| (cell, next, cost))
    });
    let mut graph = UnGraph::from_edges(edges);
    while graph.node_count() < CELLS {
        graph.add_node(());
    }
    graph
}

#[divan::bench]
fn grid_to_all_cells_ours(bencher: Bencher) {
    bencher.bench(|| least_costs(CELLS, ends().0, None, |_| 0, next));
}

/// Without the ways.
#[divan::bench]
fn grid_to_all_cells_petgraph(bencher: Bencher) {
    let graph = grid();
    bencher.bench(|| dijkstra(&graph, NodeIndex::new(ends().0), None, |edge| *edge.weight()));
}

#[divan::bench]
fn grid_to_a_goal_ours(bencher: Bencher) {
    let (start, goal) = ends();
    bencher.bench(|| least_costs(CELLS, start, Some(goal), left, next).way(goal));
}

#[divan::bench]
fn grid_to_a_goal_petgraph(bencher: Bencher) {
    let ((start, goal), graph) = (ends(), grid());
    bencher.bench(|| {
        let is_goal = |node: NodeIndex<usize>| node.index() == goal;
        astar(&graph, NodeIndex::new(start), is_goal, |edge| *edge.weight(), |node| left(node.index()))
    });
}

/// How much a cell allows.
fn room(cell: usize) -> f64 {
    f64::from((cell as u32).wrapping_mul(2_654_435_761) >> 8)
}

#[divan::bench]
fn bottleneck_ours(bencher: Bencher) {
    bencher.bench(|| best_way(CELLS, ends(), room, |cell| next(cell).map(|(next, _)| next)));
}

/// What a way lacks: adding takes the larger lack.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
struct Lack(f64);

impl Add for Lack {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self(self.0.max(other.0))
    }
}

#[divan::bench]
fn bottleneck_petgraph(bencher: Bencher) {
    let ((start, goal), graph) = (ends(), grid());
    let lack = |cell: usize| Lack(f64::from(u32::MAX) - room(cell));
    bencher.bench(|| {
        let is_goal = |node: NodeIndex<usize>| node.index() == goal;
        let cost = |edge: petgraph::graph::EdgeReference<'_, u32, usize>| {
            lack(edge.source().index()) + lack(edge.target().index())
        };
        astar(&graph, NodeIndex::new(start), is_goal, cost, |_| Lack::default())
    });
}

fn network() -> (Network, [Point; 2]) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden/floorplans/plant-25.json");
    let plan = read_floor_plan(&path).expect("the plan is a good one");
    let network = Network::new(&plan, Disc { radius: 0.25, margin: 0.0 }).expect("the disc fits");
    let ends = [plan.places()[0].at, plan.places()[plan.places().len() - 1].at];
    (network, ends)
}

#[divan::bench]
fn adits_ours(bencher: Bencher) {
    let (network, [from, to]) = network();
    bencher.bench(|| network.path(from, to, Rule::AllAdits, |way| Some(way.length)));
}

/// Weights from both ends, as ours; without the ways, and from the first adit only.
#[divan::bench]
fn adits_petgraph(bencher: Bencher) {
    let (network, _) = network();
    bencher.bench(|| {
        let ways = network.ways.iter().filter_map(|way| match (way.from, way.to) {
            (Spot::Adit(a), Spot::Adit(b)) => Some((a as u32, b as u32, way.length)),
            _ => None,
        });
        let graph = UnGraph::<(), f64>::from_edges(ways);
        let last = NodeIndex::new(graph.node_count() - 1);
        [NodeIndex::new(0), last].map(|end| dijkstra(&graph, end, None, |edge| *edge.weight()))
    });
}

/// Twelve corridors along each axis: all cross.
fn corridors() -> Corridors {
    let lying = (0..12).map(|i| Rect::new(0.0, 10.0 * f64::from(i), 120.0, 10.0 * f64::from(i) + 3.0));
    let upright = (0..12).map(|i| Rect::new(10.0 * f64::from(i), 0.0, 10.0 * f64::from(i) + 3.0, 120.0));
    Corridors::new(&lying.chain(upright).collect::<Vec<_>>()).expect("all channels are orthogonal")
}

const START: Point = Point::new(5.0, 1.5);
const GOAL: Point = Point::new(116.0, 111.5);

#[divan::bench]
fn corridors_ours(bencher: Bencher) {
    let corridors = corridors();
    let weigh =
        |passage: &adit_planners::channels::corridor::Passage| Ok::<_, Infallible>(Some(passage.length));
    bencher.bench(|| corridors.route(START, GOAL, weigh).map(|route| route.weight()));
}

/// All passages have to be laid and weighed first; which junctions are fewest, and what may not be passed, is left out.
#[divan::bench]
fn corridors_petgraph(bencher: Bencher) {
    let corridors = corridors();
    let junctions = corridors.junctions();
    bencher.bench(|| {
        let mut graph = DiGraph::<(), f64>::new();
        let (start, goal) = (graph.add_node(()), graph.add_node(()));
        let states: Vec<_> = junctions.iter().map(|_| [graph.add_node(()), graph.add_node(())]).collect();
        for (number, junction) in junctions.iter().enumerate() {
            let at = junction.rect.centre();
            for (side, channel) in [junction.lying, junction.upright].into_iter().enumerate() {
                let holds = |point: Point| corridors.at(point).any(|held| held == channel);
                if holds(START) {
                    graph.add_edge(start, states[number][1 - side], START.distance(at));
                }
                if holds(GOAL) {
                    graph.add_edge(states[number][side], goal, at.distance(GOAL));
                }
                for (other, next) in junctions.iter().enumerate() {
                    if other != number && (next.lying == channel || next.upright == channel) {
                        let to = states[other][usize::from(next.lying == channel)];
                        graph.add_edge(states[number][side], to, at.distance(next.rect.centre()));
                    }
                }
            }
        }
        astar(&graph, start, |node| node == goal, |edge| *edge.weight(), |_| 0.0)
    });
}
