//! Prime areas, rooms and doors on the maps of the peer: `cargo bench -p adit-planners --bench rooms`. Inputs
//! are equal to those of `peers/planning/rooms.rs`, seed 1; `tests/peers/rooms.sh` runs both side by side.

#[path = "support/maps.rs"]
mod maps;

use adit_planners::doors::shared_edges;
use adit_planners::geometry::Rect;
use adit_planners::minimum::fewest_rects;
use adit_planners::prime_areas::maximal_rects;
use adit_planners::rooms::greedy_rooms;
use divan::Bencher;

fn main() {
    divan::main();
}

#[divan::bench(args = [1_000, 5_000, 30_000], sample_count = 10)]
fn prime_areas(bencher: Bencher, obstacles: usize) {
    let map = maps::general(obstacles, 1);
    bencher.bench_local(|| maximal_rects(map.bounds, &map.obstacles));
}

#[divan::bench(args = [1_000, 30_000], sample_count = 5)]
fn rooms_of_the_paper(bencher: Bencher, obstacles: usize) {
    let map = maps::general(obstacles, 1);
    let areas = maximal_rects(map.bounds, &map.obstacles);
    bencher.bench_local(|| greedy_rooms(&[], &[&areas]));
}

#[divan::bench(args = [1_000, 5_000], sample_count = 10)]
fn fewest_rooms(bencher: Bencher, obstacles: usize) {
    let map = maps::general(obstacles, 1);
    bencher.bench_local(|| fewest_rects(map.bounds, &map.obstacles));
}

#[divan::bench(sample_count = 10)]
fn doors_of_100_000_rooms(bencher: Bencher) {
    let map = maps::general(33_333, 1);
    let rooms: Vec<Rect> = fewest_rects(map.bounds, &map.obstacles);
    assert_eq!(rooms.len(), 100_000);
    bencher.bench_local(|| shared_edges(&rooms));
}
