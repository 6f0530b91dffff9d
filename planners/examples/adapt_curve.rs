//! The curves of Chen's Figure 5 on the scenarios of a file, at a few tasks: evaluations with their standard error, over the
//! peer's of the file where it tells them, and over Solve alone.
//! `cargo run --release -p adit-planners --example adapt_curve -- FILE.json [RUNS] [NAME]`
#![allow(clippy::print_stdout, missing_docs)]

use std::time::Instant;

use adit_planners::adapt::{
    ArmScenario, ChangeFacts, Curve, EdgeFacts, Experiment, Judge, LandmarkFacts, Method, Plugins, Scenario,
    Settings, Strategy, TOUCHING_M, Trust,
};

const METHODS: [Method; 5] = [
    Method::Solve,
    Method::Adapt(Strategy::Forget),
    Method::Adapt(Strategy::VerifyAll),
    Method::Adapt(Strategy::RepairAll),
    Method::Adapt(Strategy::OnDemand),
];

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
    for entry in json["scenarios"].as_array().expect("the file has scenarios") {
        let file: ArmScenario = serde_json::from_value(entry.clone()).expect("it is a scenario of an arm");
        if args.get(3).is_none_or(|name| *name == file.name) {
            let scenario = Scenario::try_from(&file).expect("the scenario is sound");
            let peer = entry["reference"]["baseline_cumulative"].as_array();
            let peer: Vec<f64> = peer.into_iter().flatten().filter_map(serde_json::Value::as_f64).collect();
            print_curves(&scenario, runs, &peer);
        }
    }
}

fn print_curves(scenario: &Scenario, runs: u32, peer: &[f64]) {
    let began = Instant::now();
    let experiment = Experiment {
        scenario,
        plugins: &Plugins::standard(),
        settings: &Settings::default(),
        touching_m: TOUCHING_M,
        runs,
        seed: 1000,
        judge: &|| Box::new(Table),
        clock: &|| began.elapsed().as_secs_f64(),
        progress: &|| (),
    };
    let alone = experiment.run(Method::Solve).expect("names differ");
    for method in METHODS {
        let curve = experiment.run(method).expect("names differ");
        println!("{} {method:?}: {}", scenario.name, line(&curve, &alone, runs, peer));
    }
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
