//! What a robot does with a scan of 120 readings, decided by a plain table, as the model grows:
//! `cargo bench -p adit-planners --bench scan`
//!
//! With the shipped rules: `cargo bench -p adit --bench scan`
#![allow(missing_docs)] // divan's macros

#[path = "support/scan.rs"]
mod scan;
#[path = "../tests/specification/navigation/table.rs"]
mod table;
#[path = "support/walls.rs"]
mod walls;

use divan::Bencher;
use scan::measure;
use table::Table;
use walls::{building, within_hearing};

fn main() {
    divan::main();
}

/// Most rooms are out of hearing.
#[divan::bench(args = [50, 100, 200, 400, 800])]
fn update_and_decision_in_a_building(bencher: Bencher, segments: usize) {
    measure(bencher, building(segments), Table);
}

/// The whole model is about the robot.
#[divan::bench(args = [50, 100, 200, 400, 800])]
fn update_and_decision_where_all_is_within_hearing(bencher: Bencher, segments: usize) {
    measure(bencher, within_hearing(segments), Table);
}
