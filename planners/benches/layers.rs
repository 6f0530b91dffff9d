//! Layers of a whole floor: `cargo bench -p adit-planners --bench layers`.

#![allow(missing_docs, reason = "benchmarks have no callers")]

use adit_planners::geometry::{Point, Rect};
use adit_planners::layers::{Layers, State, cut_layers, narrowest};
use adit_planners::world::{Bridge, Obstacle, Occupancy, Shape, World};
use divan::Bencher;

fn main() {
    divan::main();
}

fn states() -> Vec<State> {
    let state =
        |state: &str, height, width| State { robot: None, state: state.into(), height, width, length: None };
    vec![
        state("STAND", 1.7, 0.6),
        state("SIDE-STAND", 1.7, 0.35),
        state("SQUAT", 1.1, 0.8),
        state("LIE", 0.6, 0.8),
        state("SPREAD", 1.7, 1.0),
    ]
}

fn next(seed: &mut u64) -> f64 {
    *seed ^= *seed << 13;
    *seed ^= *seed >> 7;
    *seed ^= *seed << 17;
    (*seed >> 11) as f64 / (1u64 << 53) as f64
}

/// An office floor of 40 x 30 m: two rows of rooms on each of two corridors, doors of 0.5 to 1.2 m, desks, pipes.
fn office() -> World {
    let mut world = World { grid: Some(0.05), ..World::empty(Rect::new(0.0, 0.0, 40.0, 30.0)) };
    let mut seed = 7;
    let mut wall = |rect| world.obstacles.push(Obstacle { shape: Shape::Rect(rect) });
    for y in [6.0, 8.4, 14.4, 16.8, 22.8] {
        for room in 0..10 {
            let x = f64::from(room) * 4.0;
            let (door, width) = (x + 0.5 + next(&mut seed), 0.5 + 0.7 * next(&mut seed));
            wall(Rect::new(x, y, door, y + 0.15));
            wall(Rect::new(door + width, y, x + 4.0, y + 0.15));
        }
    }
    for y in [0.0, 8.55, 16.95, 22.95] {
        for room in 0..10 {
            let x = f64::from(room) * 4.0;
            wall(Rect::new(x + 3.9, y, x + 4.0, y + 5.85));
            let (u, v) = (x + 0.8 + next(&mut seed), y + 1.5 + 2.0 * next(&mut seed));
            wall(Rect::new(u, v, u + 1.4, v + 0.7));
        }
    }
    for x in [9.0, 21.0, 33.0] {
        world.bridges.push(Bridge { rect: Rect::new(x, 6.15, x + 1.0, 8.4), height: 1.3 });
    }
    world
}

/// The same floor as a scan: cells of 5 cm, one in 300 free ones a speck of noise.
fn scan() -> World {
    let drawn = office();
    let (columns, rows, resolution) = (800, 600, 0.05);
    let mut seed = 11;
    let mut blocked = vec![false; columns * rows];
    for (cell, blocked) in blocked.iter_mut().enumerate() {
        let (x, y) = ((cell % columns) as f64 + 0.5, (cell / columns) as f64 + 0.5);
        let p = Point::new(x * resolution, y * resolution);
        *blocked = next(&mut seed) < 1.0 / 300.0 || drawn.obstacles.iter().any(|o| o.shape.contains(p));
    }
    let occupancy = Some(Occupancy { origin: Point::default(), resolution, columns, rows, blocked });
    World { occupancy, obstacles: Vec::new(), ..drawn }
}

#[divan::bench(sample_count = 10)]
fn office_floor_5_states(bencher: Bencher<'_, '_>) {
    let (world, states) = (office(), states());
    bencher.bench(|| -> Result<Layers, String> { cut_layers(&world, &states) });
}

#[divan::bench(sample_count = 10)]
fn noisy_scan_5_states(bencher: Bencher<'_, '_>) {
    let (world, states) = (scan(), states());
    bencher.bench(|| cut_layers(&world, &states));
}

#[divan::bench(sample_count = 5)]
fn narrowest_point_across_the_office(bencher: Bencher<'_, '_>) {
    let world = office();
    bencher.bench(|| narrowest(&world, Point::new(0.3, 0.3), Point::new(38.0, 29.5), 0.05));
}
