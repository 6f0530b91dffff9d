//! A scan of 120 readings: simulated among walls, and taken into models of growing size.
//! `cargo bench -p adit-planners --bench imp`
#![allow(missing_docs)] // divan's macros

#[path = "support/walls.rs"]
mod walls;

use adit_planners::body::{Body, Reading};
use adit_planners::geometry::Segment;
use adit_planners::local_model::{Estimate, LocalModel, SegmentFacts, Settings, Transition};
use adit_planners::pose::Pose;
use adit_planners::simulator::{self, Simulator};
use divan::Bencher;
use walls::{building, within_hearing};

fn main() {
    divan::main();
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
        (0..120)
            .map(|_| robot.sense().expect("a simulated body answers").readings[0])
            .filter(|reading| reading.range_m.is_some())
            .count()
    });
}

#[divan::bench(args = [50, 200, 800, 3200])]
fn update_of_the_model(bencher: Bencher, segments: usize) {
    let walls = building(segments);
    let mut robot = robot(&walls);
    let scan: Vec<Reading> =
        (0..120).map(|_| robot.sense().expect("a simulated body answers").readings[0]).collect();
    let model = model(&walls);
    bencher.with_inputs(|| model.clone()).bench_local_values(|mut model| {
        let update = model.update(&scan, 1.0, table);
        (update, model)
    });
}

#[divan::bench(args = [50, 200, 800, 3200])]
fn update_where_all_are_within_hearing(bencher: Bencher, segments: usize) {
    let walls = within_hearing(segments);
    let mut robot = robot(&walls);
    let scan: Vec<Reading> =
        (0..120).map(|_| robot.sense().expect("a simulated body answers").readings[0]).collect();
    let model = model(&walls);
    bencher.with_inputs(|| model.clone()).bench_local_values(|mut model| {
        let update = model.update(&scan, 1.0, table);
        (update, model)
    });
}
