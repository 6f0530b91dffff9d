//! What a robot does with a scan of 120 readings, decided by the shipped rules, as the model grows:
//! `cargo bench -p adit --bench scan`
#![allow(missing_docs)] // divan's macros

#[path = "../../planners/benches/support/scan.rs"]
mod scan;
#[path = "../../planners/benches/support/walls.rs"]
mod walls;

use std::path::Path;

use adit::navigation::judge::RuleJudge;
use adit::plan::rules::{self, Kind};
use divan::Bencher;
use scan::measure;
use walls::{building, within_hearing};

fn main() {
    divan::main();
}

fn judge() -> RuleJudge {
    let (rules, _) = rules::load(Kind::Navigation, "navigation", Path::new("")).expect("a shipped rule base");
    RuleJudge::new(&rules).expect("rules")
}

/// Most rooms are out of hearing.
#[divan::bench(args = [50, 100, 200, 400, 800])]
fn update_and_decision_in_a_building(bencher: Bencher, segments: usize) {
    measure(bencher, building(segments), judge());
}

/// The whole model is about the robot.
#[divan::bench(args = [50, 100, 200, 400, 800])]
fn update_and_decision_where_all_is_within_hearing(bencher: Bencher, segments: usize) {
    measure(bencher, within_hearing(segments), judge());
}
