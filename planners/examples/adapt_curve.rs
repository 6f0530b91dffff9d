//! The curve of a scenario file, as figures at a few tasks.
//! `cargo run --release -p adit-planners --example adapt_curve -- FILE.json [RUNS] [NAME]`
#![allow(clippy::print_stdout, missing_docs)]

use std::sync::Arc;
use std::time::Instant;

use adit_planners::adapt::*;

struct Table;

impl Judge for Table {
    fn strategy(&mut self, _: &ChangeFacts) -> Strategy {
        Strategy::OnDemand
    }

    fn landmark(&mut self, facts: &LandmarkFacts<'_>) -> Option<f64> {
        Some(facts.clearance_m)
    }

    fn trust(&mut self, _: &EdgeFacts) -> Trust {
        Trust::Verify
    }
}

fn env(name: &str, otherwise: f64) -> f64 {
    std::env::var(name).ok().and_then(|v| v.parse().ok()).unwrap_or(otherwise)
}

fn main() {
    let args: Vec<String> = std::env::args().collect();
    let text = std::fs::read_to_string(&args[1]).expect("the file can be read");
    let json: serde_json::Value = serde_json::from_str(&text).expect("the file is JSON");
    let runs = args.get(2).map_or(100, |n| n.parse().expect("a number of runs"));
    for entry in json["scenarios"].as_array().expect("scenarios") {
        let file: ArmScenario = serde_json::from_value(entry.clone()).expect("a scenario");
        if args.get(3).is_some_and(|name| *name != file.name) {
            continue;
        }
        let scenario = Scenario::try_from(&file).expect("a scenario");
        let base: Vec<f64> = entry["reference"]["baseline_cumulative"]
            .as_array()
            .map(|a| a.iter().filter_map(serde_json::Value::as_f64).collect())
            .unwrap_or_default();
        let plugins = Plugins {
            reach: Arc::new(Straight),
            solve: Arc::new(RrtConnect { step: env("STEP", 0.6), samples: 20_000 }),
        };
        let settings = Settings {
            heuristic: if env("H", 0.0) > 0.0 { Heuristic::ShortestWay } else { Heuristic::NearestToGoal },
            tries: env("TRIES", 1e9) as usize,
            chain_step: env("CHAIN", 0.1),
            tightens: env("TIGHT", 1.0) > 0.0,
            cuts_corners: env("CUT", 1.0) > 0.0,
            keeps_goals: env("KEEP", 1.0) > 0.0,
            ..Settings::default()
        };
        let began = Instant::now();
        let experiment = Experiment {
            scenario: &scenario,
            plugins: &plugins,
            settings: &settings,
            touching_m: env("TOUCH", 0.005),
            runs,
            seed: env("SEED", 1000.0) as u64,
            judge: &|| Box::new(Table),
            clock: &|| began.elapsed().as_secs_f64(),
            progress: &|| (),
        };
        let methods = [
            Method::Solve,
            Method::Adapt(Strategy::Forget),
            Method::Adapt(Strategy::VerifyAll),
            Method::Adapt(Strategy::RepairAll),
            Method::Adapt(Strategy::OnDemand),
        ];
        let mut alone = Curve::default();
        for method in methods {
            let curve = experiment.run(method).expect("a cell");
            if method == Method::Solve {
                alone = curve.clone();
            }
            let length = curve.rows.iter().map(|row| row.path_length).sum::<f64>() / curve.rows.len() as f64;
            let failures: u32 = curve.rows.iter().map(|row| row.failures).sum();
            print!("{} {:18}", file.name, format!("{method:?}"));
            for task in [1, 16, 40, 41, 60, 80, 100] {
                let (row, solve) = (&curve.rows[task - 1], &alone.rows[task - 1]);
                print!(
                    " | {task}: {:.0}±{:.0} {:.3} {:.2}",
                    row.evaluations,
                    row.evaluations_sd / f64::from(runs).sqrt(),
                    row.evaluations / base.get(task - 1).copied().unwrap_or(f64::NAN),
                    row.evaluations / solve.evaluations
                );
            }
            let last = curve.rows.last().expect("rows");
            println!(
                " | len {length:.3} fail {failures} solves {:.2} ms/task {:.3}",
                last.solves,
                last.seconds * 1e3 / curve.rows.len() as f64
            );
        }
    }
}
