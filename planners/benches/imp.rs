//! A scan of 120 readings: simulated among walls, and taken into models of growing size.
//! `cargo bench -p adit-planners --bench imp`
#![allow(missing_docs)] // divan's macros

use adit_planners::body::{Body, Reading};
use adit_planners::geometry::Point;
use adit_planners::local_model::{Estimate, LocalModel, SegmentFacts, Settings, Transition};
use adit_planners::pose::Pose;
use adit_planners::segment::Segment;
use adit_planners::simulator::{self, Simulator};
use divan::Bencher;

fn main() {
    divan::main();
}

/// Rooms of 5 m by 5 m with a door of 1 m in the middle of each wall, in a spiral about the first until there are so many
/// walls: six of a room are its own.
fn building(count: usize) -> Vec<Segment> {
    let mut rooms: Vec<(i32, i32)> = (-20..=20).flat_map(|x| (-20..=20).map(move |y| (x, y))).collect();
    rooms.sort_by_key(|(x, y)| (x.abs().max(y.abs()), *x, *y));
    let mut walls = Vec::new();
    for (x, y) in rooms {
        let (x, y) = (5.0 * f64::from(x), 5.0 * f64::from(y));
        let wall = |x0: f64, y0: f64, x1: f64, y1: f64| {
            Segment::new(Point::new(x + x0, y + y0), Point::new(x + x1, y + y1))
        };
        walls.extend([wall(0.0, 0.0, 2.0, 0.0), wall(3.0, 0.0, 5.0, 0.0)]);
        walls.extend([wall(0.0, 0.0, 0.0, 2.0), wall(0.0, 3.0, 0.0, 5.0)]);
        // a cupboard's front and side
        walls.extend([wall(4.0, 4.0, 4.0, 5.0), wall(4.0, 4.0, 5.0, 4.0)]);
    }
    walls.truncate(count);
    walls
}

fn robot(walls: &[Segment]) -> Simulator {
    let start = Pose::new(1.5, 1.7, 0.2);
    Simulator::new(walls, Vec::new(), simulator::Settings::default(), start, 3).expect("the place is free")
}

fn table(facts: &SegmentFacts) -> Transition {
    let confidence = match facts {
        SegmentFacts { confidence: 0, .. } => 3,
        SegmentFacts { is_matched: true, .. } => (facts.confidence + 1).min(5),
        SegmentFacts { is_seen_free: true, .. } => facts.confidence.saturating_sub(2),
        SegmentFacts { is_visible: true, beams_on: 0, .. } => facts.confidence.saturating_sub(1),
        _ => facts.confidence,
    };
    Transition {
        confidence,
        source: facts.source,
        is_kept: confidence > 0,
        counts_for_pose: confidence >= 2,
        is_anchored: false,
        is_cut: facts.free_m > 0.2,
    }
}

fn model(walls: &[Segment]) -> LocalModel {
    let settings = Settings { recall_m: 1000.0, ..Settings::default() };
    let mut model = LocalModel::new(settings, Estimate::new(Pose::new(1.52, 1.69, 0.21), 0.03, 0.02));
    model.recall((0..).zip(walls.iter().copied()), table);
    model
}

#[divan::bench(args = [50, 200, 800, 3200])]
fn readings_of_a_turn(bencher: Bencher, walls: usize) {
    let mut robot = robot(&building(walls));
    bencher.bench_local(|| {
        (0..120).map(|_| robot.sense().reading).filter(|reading| reading.range_m.is_some()).count()
    });
}

#[divan::bench(args = [50, 200, 800, 3200])]
fn update_of_the_model(bencher: Bencher, segments: usize) {
    let walls = building(segments);
    let mut robot = robot(&walls);
    let scan: Vec<Reading> = (0..120).map(|_| robot.sense().reading).collect();
    let model = model(&walls);
    bencher.with_inputs(|| model.clone()).bench_local_values(|mut model| {
        let update = model.update(&scan, 1.0, table);
        (update, model)
    });
}

/// Robot and model in a hall with so many walls about it that all of them are within hearing.
#[divan::bench(args = [50, 200, 800, 3200])]
fn update_where_all_are_within_hearing(bencher: Bencher, segments: usize) {
    let ring = |i: usize| {
        let (layer, place) = (i / 50, i % 50);
        let radius = 2.0 + 0.08 * layer as f64;
        let angle = |part: f64| (place as f64 + part) / 50.0 * std::f64::consts::TAU;
        let at = |part: f64| Point::new(1.5 + radius * angle(part).cos(), 1.7 + radius * angle(part).sin());
        Segment::new(at(0.1), at(0.9))
    };
    let walls: Vec<Segment> = (0..segments).map(ring).collect();
    let mut robot = robot(&walls);
    let scan: Vec<Reading> = (0..120).map(|_| robot.sense().reading).collect();
    let model = model(&walls);
    bencher.with_inputs(|| model.clone()).bench_local_values(|mut model| {
        let update = model.update(&scan, 1.0, table);
        (update, model)
    });
}
