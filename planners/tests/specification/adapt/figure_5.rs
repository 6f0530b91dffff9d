//! Figure 5 on two cells of the kind of Figure 4, beside the peers that were measured on them.

use std::path::Path;

use adit_planners::adapt::{
    Curve, Experiment, KeepNothing, Method, Plugins, Scenario, Settings, Strategy, TOUCHING_M,
};

use super::arm_scenario::ArmScenario;
use super::support::Table;

/// Runs a method, and tells evaluations by task.
pub fn run(scenario: &Scenario, runs: u32, method: Method) -> Curve {
    let experiment = Experiment {
        scenario,
        plugins: &Plugins::standard(),
        settings: &Settings::default(),
        touching_m: TOUCHING_M,
        runs,
        seed: 4000,
        judge: &|| Box::new(Table(Strategy::OnDemand)),
        keeper: &|_, _| Box::new(KeepNothing),
        clock: &|| 0.0,
        progress: &|| (),
    };
    experiment.run(method).unwrap()
}

/// A few suffice: the figures are far from the bounds.
const RUNS: u32 = 4;

const STRATEGIES: [Strategy; 4] =
    [Strategy::Forget, Strategy::VerifyAll, Strategy::RepairAll, Strategy::OnDemand];

/// What the lazy roadmap of OMPL needs at a task, over RRT-Connect from scratch, and how long its paths are.
struct Peer(&'static str, &'static [(usize, f64)], f64);

const PEERS: [Peer; 2] = [
    Peer("two-link-A", &[(16, 0.214), (40, 0.104), (60, 0.114), (100, 0.071)], 4.295),
    Peer("two-link-B", &[(16, 0.226), (40, 0.119), (100, 0.082)], 4.684),
];

#[test]
fn adapt_learns_faster_than_the_peers_and_finds_shorter_paths() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/golden/chen-two-link.json");
    let file = std::env::var_os("ADIT_GOLDEN").map_or(file, |dir| Path::new(&dir).join("chen-two-link.json"));
    let Ok(text) = std::fs::read_to_string(&file) else {
        eprintln!("SKIPPED: there is no {}", file.display());
        return;
    };
    let json: serde_json::Value = serde_json::from_str(&text).unwrap();
    for (entry, Peer(name, ratios, length)) in json["scenarios"].as_array().unwrap().iter().zip(PEERS) {
        let file: ArmScenario = serde_json::from_value(entry.clone()).unwrap();
        assert_eq!(file.name, name);
        let scenario = Scenario::try_from(&file).unwrap();
        let peer = |task: usize| entry["reference"]["baseline_cumulative"][task - 1].as_f64().unwrap();
        let alone = run(&scenario, RUNS, Method::Solve);
        assert!(alone.rows[99].evaluations <= 1.2 * peer(100));
        for strategy in STRATEGIES {
            let curve = run(&scenario, RUNS, Method::Adapt(strategy));
            let over_solve =
                |task: usize| curve.rows[task - 1].evaluations / alone.rows[task - 1].evaluations;
            assert!(over_solve(16) <= 1.0 && over_solve(40) <= 0.67, "{name} {strategy:?}");
            assert_eq!(curve.rows.iter().map(|row| row.failures).sum::<u32>(), 0, "{name} {strategy:?}");
        }
        let curve = run(&scenario, RUNS, Method::Adapt(Strategy::OnDemand));
        for (task, ratio) in ratios.iter().copied() {
            assert!(curve.rows[task - 1].evaluations <= ratio * peer(task), "{name} at {task}");
        }
        let mean = curve.rows.iter().map(|row| row.path_length).sum::<f64>() / curve.rows.len() as f64;
        assert!(mean <= length, "{name}: {mean}");
    }
}
