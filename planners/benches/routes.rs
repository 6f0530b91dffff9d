//! One start to all rooms, by metres; where all hardness lies on the doors, see bench `search`. Any pair of rooms: our
//! hierarchy beside crate `cch`, whose weights are whole numbers. `cargo bench -p adit-planners --bench routes`
#![allow(missing_docs)] // divan's macros

#[path = "support/building.rs"]
mod building;

use adit_planners::geometry::Point;
use adit_planners::routes::{DoorIndex, Goal, RoomIndex, RouteGraph, Start, Walking};
use building::building;
use cch::graph::Graph;
use divan::Bencher;

/// Of floors with about 1,000, 10,000 and 100,000 doors.
const FLOORS: [usize; 3] = [23, 71, 224];

fn main() {
    divan::main();
}

fn start() -> Start {
    Start::within([RoomIndex::new(0)], Point::new(2.0, 2.0))
}

#[divan::bench(args = [32, 100])]
fn ours_by_metres(bencher: Bencher, side: usize) {
    let graph = building(side, Walking::PerMetre(1.0));
    bencher.bench(|| graph.ways(&start(), &[], true));
}

fn prepared(side: usize) -> RouteGraph {
    let mut graph = building(side, Walking::OnDoors);
    graph.prepare();
    graph
}

/// Pairs of rooms, and other hardnesses, as if they were drawn.
fn drawn() -> impl FnMut(usize) -> usize {
    let mut state = 1_u64;
    move |below| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % below
    }
}

#[divan::bench(args = FLOORS, sample_count = 10)]
fn hierarchy_build(bencher: Bencher, side: usize) {
    let graph = building(side, Walking::OnDoors);
    bencher.with_inputs(|| graph.clone()).bench_local_refs(RouteGraph::prepare);
}

#[divan::bench(args = FLOORS, sample_count = 10)]
fn hierarchy_clone(bencher: Bencher, side: usize) {
    let graph = prepared(side);
    bencher.bench_local(|| graph.clone());
}

/// Weighs so many doors anew, on a floor.
fn reweigh(bencher: Bencher, side: usize, changed: usize) {
    let mut graph = prepared(side);
    let (count, mut draw) = (graph.doors().len(), drawn());
    let doors = move || {
        (0..changed).map(|_| (DoorIndex::new(draw(count)), Some(1.0 + draw(256) as f64), true)).collect()
    };
    bencher.with_inputs(doors).bench_local_values(|doors: Vec<_>| graph.reweigh([], doors));
}

#[divan::bench(args = FLOORS, sample_count = 10)]
fn hierarchy_weigh_all(bencher: Bencher, side: usize) {
    reweigh(bencher, side, building(side, Walking::OnDoors).doors().len());
}

#[divan::bench(args = FLOORS)]
fn hierarchy_weigh_1(bencher: Bencher, side: usize) {
    reweigh(bencher, side, 1);
}

#[divan::bench(args = FLOORS, sample_count = 20)]
fn hierarchy_weigh_100(bencher: Bencher, side: usize) {
    reweigh(bencher, side, 100);
}

#[divan::bench(args = [71, 224], sample_count = 10)]
fn hierarchy_weigh_10_000(bencher: Bencher, side: usize) {
    reweigh(bencher, side, 10_000);
}

/// Ways with all their legs.
fn ways(bencher: Bencher, graph: &RouteGraph) {
    let (count, mut draw) = (graph.rooms().len(), drawn());
    let ends = move || {
        let start = Start::within([RoomIndex::new(draw(count))], Point::new(2.0, 2.0));
        (start, Goal::within([RoomIndex::new(draw(count))], None))
    };
    bencher.with_inputs(ends).bench_local_values(|(start, goal)| graph.way(&start, &[goal]));
}

#[divan::bench(args = FLOORS, sample_count = 1000)]
fn hierarchy_way(bencher: Bencher, side: usize) {
    ways(bencher, &prepared(side));
}

#[divan::bench(args = FLOORS, sample_count = 20)]
fn dijkstra_way(bencher: Bencher, side: usize) {
    ways(bencher, &building(side, Walking::OnDoors));
}

/// The same floor as crate `cch` takes it.
fn as_whole_numbers(side: usize) -> (Graph, Vec<u32>) {
    let graph = building(side, Walking::OnDoors);
    let mut arcs: Vec<(u32, u32, u32)> = Vec::new();
    for door in graph.doors() {
        let [one, two] = [door.room1, door.room2].map(|room| room.index() as u32);
        let weight = door.hardness.unwrap_or(0.0) as u32;
        arcs.extend([(one, two, weight), (two, one, weight)]);
    }
    arcs.sort_unstable();
    let mut first_out = vec![0_u32; graph.rooms().len() + 1];
    for (tail, _, _) in &arcs {
        first_out[*tail as usize + 1] += 1;
    }
    for room in 1..first_out.len() {
        first_out[room] += first_out[room - 1];
    }
    let head: Vec<u32> = arcs.iter().map(|(_, head, _)| *head).collect();
    let tail: Vec<u32> = arcs.iter().map(|(tail, _, _)| *tail).collect();
    let at = graph.rooms().iter().map(|room| room.outline.centre());
    let (x, y): (Vec<f32>, Vec<f32>) = at.map(|at| (at.x as f32, at.y as f32)).unzip();
    let order = cch::inertial_order(graph.rooms().len() as u32, &tail, &head, &y, &x);
    let weight = arcs.iter().map(|(_, _, weight)| *weight).collect();
    (Graph { first_out, head, weight }, order)
}

#[divan::bench(args = FLOORS, sample_count = 3)]
fn cch_build(bencher: Bencher, side: usize) {
    bencher.bench_local(|| {
        let (graph, order) = as_whole_numbers(side);
        cch::Cch::build(&graph, &order)
    });
}

#[divan::bench(args = FLOORS, sample_count = 10)]
fn cch_weigh_all(bencher: Bencher, side: usize) {
    let (graph, order) = as_whole_numbers(side);
    let built = cch::Cch::build(&graph, &order);
    let customizer = built.customizer();
    let mut metric = customizer.customize(&graph.weight);
    bencher.bench_local(|| customizer.customize_into(&graph.weight, &mut metric));
}

#[divan::bench(args = FLOORS, sample_count = 1000)]
fn cch_way(bencher: Bencher, side: usize) {
    let (graph, order) = as_whole_numbers(side);
    let built = cch::Cch::build(&graph, &order);
    let metric = built.customize(&graph.weight);
    let (view, metric) = (built.view(), metric.view());
    let (mut query, mut draw) = (cch::PathQuery::new(&view), drawn());
    bencher
        .with_inputs(|| (draw(side * side) as u32, draw(side * side) as u32))
        .bench_local_values(|(from, to)| query.path(&metric, from, to));
}
