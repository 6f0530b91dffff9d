//! The curves of Chen's Figure 5 on the scenarios of a file, at a few tasks: evaluations with their standard error, over the
//! peer's of the file where it tells them, and over Solve alone; then by how much one strategy exceeds another on the same
//! tasks, run by run.
//! `cargo run --release -p adit-planners --example adapt_curve -- FILE.json [RUNS] [NAME] [SEED]`
#![allow(clippy::print_stdout, missing_docs)]

#[path = "../tests/specification/adapt/arm_scenario.rs"]
mod arm_scenario;

use std::time::Instant;

use adit_planners::adapt::{
    ChangeFacts, Curve, EdgeFacts, Experiment, Judge, KeepNothing, LandmarkFacts, Method, Plugins, Scenario,
    Settings, Strategy, TOUCHING_M, Trust,
};
use arm_scenario::ArmScenario;

const METHODS: [Method; 5] = [
    Method::Solve,
    Method::Adapt(Strategy::Forget),
    Method::Adapt(Strategy::VerifyAll),
    Method::Adapt(Strategy::RepairAll),
    Method::Adapt(Strategy::OnDemand),
];

/// Of `METHODS`, which are compared.
const PAIRS: [(usize, usize); 6] = [(1, 2), (2, 4), (3, 1), (3, 2), (3, 4), (1, 4)];

struct Table;

impl Judge for Table {
    fn strategy(&mut self, _: &ChangeFacts) -> Strategy {
        Strategy::OnDemand
    }

    fn landmark(&mut self, facts: &LandmarkFacts<'_>) -> Option<f64> {
        Some(facts.distance_m)
    }

    fn trust(&mut self, _: &EdgeFacts) -> Trust {
        Trust::Verify
    }
}

fn main() {
    let args: Vec<String> = std::env::args().collect();
    let text = std::fs::read_to_string(args.get(1).expect("FILE is told")).expect("the file can be read");
    let json: serde_json::Value = serde_json::from_str(&text).expect("the file is JSON");
    let runs = args.get(2).map_or(100, |count| count.parse().expect("RUNS is a number"));
    let seed = args.get(4).map_or(1000, |seed| seed.parse().expect("SEED is a number"));
    let several = json["scenarios"].as_array();
    for entry in several.map_or_else(|| std::slice::from_ref(&json), Vec::as_slice) {
        let file: ArmScenario = serde_json::from_value(entry.clone()).expect("it is a scenario of an arm");
        if args.get(3).is_none_or(|name| *name == file.name) {
            let scenario = Scenario::try_from(&file).expect("the scenario is sound");
            let peer = entry["reference"]["baseline_cumulative"].as_array();
            let peer: Vec<f64> = peer.into_iter().flatten().filter_map(serde_json::Value::as_f64).collect();
            print_curves(&scenario, runs, seed, &peer);
        }
    }
}

fn print_curves(scenario: &Scenario, runs: u32, seed: u64, peer: &[f64]) {
    let began = Instant::now();
    let experiment = Experiment {
        scenario,
        plugins: &Plugins::standard(),
        settings: &Settings::default(),
        touching_m: TOUCHING_M,
        runs,
        seed,
        judge: &|| Box::new(Table),
        keeper: &|_, _| Box::new(KeepNothing),
        clock: &|| began.elapsed().as_secs_f64(),
        progress: &|| (),
    };
    let alone = experiment.run(Method::Solve).expect("names differ");
    let mut curves = Vec::new();
    for method in METHODS {
        let curve = experiment.run(method).expect("names differ");
        println!("{} {method:?}: {}", scenario.name, line(&curve, &alone, runs, peer));
        curves.push(curve);
    }
    for (dear, cheap) in PAIRS {
        let (of, over) = (METHODS[dear], METHODS[cheap]);
        println!("{} {of:?} over {over:?}: {}", scenario.name, excess(&curves[dear], &curves[cheap]));
    }
}

/// How much more a method needs than another one on the same tasks, with the standard error of the difference.
fn excess(dear: &Curve, cheap: &Curve) -> String {
    let tasks = dear.rows.iter().map(|row| row.task).filter(|task| is_told(*task));
    let told = tasks.map(|task| {
        let at = task as usize - 1;
        let runs = dear.evaluations.iter().zip(&cheap.evaluations);
        let more: Vec<f64> = runs.map(|(a, b)| a[at] as f64 - b[at] as f64).collect();
        let count = more.len() as f64;
        let mean = more.iter().sum::<f64>() / count;
        let squares: f64 = more.iter().map(|x| (x - mean).powi(2)).sum();
        format!("{task}: {mean:.1}±{:.1}", (squares / (count - 1.0).max(1.0) / count).sqrt())
    });
    told.collect::<Vec<_>>().join(" | ")
}

fn line(curve: &Curve, alone: &Curve, runs: u32, peer: &[f64]) -> String {
    let told = curve.rows.iter().zip(&alone.rows).filter(|(row, _)| is_told(row.task));
    let told: Vec<String> = told
        .map(|(row, solve)| {
            let over_peer = row.evaluations / peer.get(row.task as usize - 1).copied().unwrap_or(f64::NAN);
            let over_solve = row.evaluations / solve.evaluations;
            let error = row.evaluations_sd / f64::from(runs).sqrt();
            format!("{}: {:.0}±{error:.0} {over_peer:.4} {over_solve:.2}", row.task, row.evaluations)
        })
        .collect();
    let tasks = curve.rows.len() as f64;
    let length = curve.rows.iter().map(|row| row.path_length).sum::<f64>() / tasks;
    let failures: u32 = curve.rows.iter().map(|row| row.failures).sum();
    let last = curve.rows.last().copied().unwrap_or_default();
    let per_task_ms = last.seconds * 1e3 / tasks;
    format!(
        "{} | length {length:.3}, {failures} failures, {:.1} calls of Solve, {per_task_ms:.2} ms a task",
        told.join(" | "),
        last.solves
    )
}

fn is_told(task: u32) -> bool {
    [1, 16, 40, 41, 60, 80, 100].contains(&task)
}
