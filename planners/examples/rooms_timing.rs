//! Times prime areas, rooms and doors on one of the peer's maps, on a line to set beside the peer's:
//! `cargo run --release -p adit-planners --example rooms_timing -- general 1000 1`. `tests/peers/rooms.sh` does so.
#![allow(clippy::print_stdout, reason = "its output is the measurement")]

#[path = "../benches/support/maps.rs"]
mod maps;

use std::time::Instant;

use adit_planners::doors::shared_edges;
use adit_planners::minimum::fewest_rects;
use adit_planners::prime_areas::maximal_rects;
use adit_planners::rooms::greedy_rooms;

fn main() {
    let arguments: Vec<_> = std::env::args().skip(1).collect();
    let [family, n, seed] = arguments.as_slice() else {
        panic!("usage: rooms_timing general OBSTACLES SEED");
    };
    assert_eq!(family, "general", "the only family");
    let map = maps::general(n.parse().expect("a number of obstacles"), seed.parse().expect("a seed"));

    let (areas, areas_ms) = timed(|| maximal_rects(map.bounds, &map.obstacles));
    let (rooms, rooms_ms) = timed(|| greedy_rooms(&[], &[&areas]));
    let (fewest, fewest_ms) = timed(|| fewest_rects(map.bounds, &map.obstacles));
    let (doors, doors_ms) = timed(|| shared_edges(&rooms));
    println!(
        "{family} {n} {seed} primes {} primes_ms {areas_ms:.3} greedy {} greedy_ms {rooms_ms:.3} \
         minimum {} minimum_ms {fewest_ms:.3} doors {} doors_ms {doors_ms:.3}",
        areas.len(),
        rooms.len(),
        fewest.len(),
        doors.len()
    );
}

/// The result and the milliseconds that it took.
fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = Instant::now();
    let result = work();
    (result, start.elapsed().as_secs_f64() * 1e3)
}
