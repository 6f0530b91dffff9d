//! `adit experiment`: the table, the picture, and the paper's Figure 5.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use adit_tests::{Ran, TestSite, shared};
use serde_json::Value;

use super::support::run;

/// The two scenarios of an arm of two links, five obstacles and nine goals; one obstacle and one goal come after task 40.
const TWO_LINK: &str = include_str!("two-link.json");

fn folder() -> TestSite {
    TestSite::empty().with("two-link.json", TWO_LINK)
}

fn experiment(folder: &TestSite, args: &[&str]) -> Ran {
    run(folder, &[&["experiment", "two-link.json"], args].concat())
}

/// Evaluations, ratio and path length by scenario, strategy and task.
type Rows = BTreeMap<(String, String, u32), [f64; 3]>;

fn rows(csv: &str) -> Rows {
    let mut lines = csv.lines();
    assert_eq!(
        lines.next(),
        Some("scenario,strategy,task,evaluations,evaluations_sd,ratio,path_length,seconds,seconds_ratio")
    );
    let row = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        let number = |at: usize| -> f64 { cells[at].parse().expect("a number") };
        let key = (cells[0].to_owned(), cells[1].to_owned(), cells[2].parse().expect("a task"));
        (key, [number(3), number(5), number(6)])
    };
    lines.map(row).collect()
}

#[test]
fn a_row_for_each_scenario_strategy_and_task() {
    let folder = folder();
    experiment(&folder, &["--runs", "2", "--seed", "7", "--csv", "one.csv", "--picture", "figure.svg"])
        .expect_status(0);
    let one = rows(&folder.read("one.csv"));
    assert_eq!(one.len(), 2 * 5 * 100);
    for strategy in ["a0", "a1", "a2", "a3", "solve"] {
        let row = one[&("two-link-B".to_owned(), strategy.to_owned(), 100)];
        assert!(row[0] > 0.0 && row[2] > 0.0, "{strategy}: {row:?}");
    }
    assert!((one[&("two-link-A".to_owned(), "solve".to_owned(), 60)][1] - 1.0).abs() < 1e-12);
    // Up to the change all strategies are the same.
    for scenario in ["two-link-A", "two-link-B"] {
        let at = |strategy: &str| one[&(scenario.to_owned(), strategy.to_owned(), 40)].map(f64::to_bits);
        assert_eq!(at("a0"), at("a3"));
        assert_eq!(at("a1"), at("a2"));
    }
    let picture = folder.read("figure.svg");
    for words in
        ["two-link-A: evaluations over Solve alone", "two-link-B: milliseconds, cumulative", "change", "a3"]
    {
        assert!(picture.contains(words), "{words}");
    }
    // The same seed gives the same evaluations; and a part gives a part.
    let part = experiment(
        &folder,
        &["--runs", "2", "--seed", "7", "--strategy", "a3", "--only", "two-link-B", "--json"],
    );
    let part = part.expect_status(0).json();
    let part = part.as_array().expect("rows");
    assert_eq!(part.len(), 100);
    let last = part.last().expect("a row");
    assert_eq!(last["evaluations"].as_f64(), Some(one[&("two-link-B".to_owned(), "a3".to_owned(), 100)][0]));
}

/// Figure 5's figures, and those of the rivals, on 100 runs: long, so it is run by hand or before a release.
#[test]
#[ignore = "a minute or more; run with --release"]
fn figure_5_and_the_rivals_figures() {
    let Some(golden) = shared("golden/chen-two-link.json") else { return };
    let golden: Value = serde_json::from_str(&fs::read_to_string(golden).expect("readable")).expect("JSON");
    let folder = folder();
    experiment(&folder, &["--runs", "100", "--seed", "1000", "--csv", "all.csv"]).expect_status(0);
    let rows = rows(&folder.read("all.csv"));
    for (scenario, limits, length) in [
        ("two-link-A", [(16, 0.214), (40, 0.104), (60, 0.114), (100, 0.071)], 4.295),
        ("two-link-B", [(16, 0.226), (40, 0.119), (100, 0.082), (100, 0.082)], 4.684),
    ] {
        let of = |strategy: &str, task: u32| rows[&(scenario.to_owned(), strategy.to_owned(), task)];
        let reference =
            golden["scenarios"].as_array().expect("scenarios").iter().find(|s| s["name"] == scenario);
        let reference = &reference.expect("the scenario")["reference"]["baseline_cumulative"];
        let baseline = |task: u32| reference[task as usize - 1].as_f64().expect("a number");
        for (task, limit) in limits {
            let ratio = of("a3", task)[0] / baseline(task);
            assert!(ratio <= limit, "{scenario}: {ratio} at task {task}, and {limit} is asked");
        }
        assert!(of("solve", 100)[0] <= 1.2 * baseline(100), "{scenario}: Solve alone is dear");
        for strategy in ["a0", "a1", "a2", "a3"] {
            assert!(of(strategy, 16)[1] <= 1.0 && of(strategy, 40)[1] <= 0.67, "{scenario} {strategy}");
        }
        let mean = (1..=100).map(|task| of("a3", task)[2]).sum::<f64>() / 100.0;
        assert!(mean <= length, "{scenario}: paths of {mean}, and {length} is asked");
    }
}

#[test]
fn what_is_no_scenario_is_refused() {
    let folder = folder();
    run(&folder, &["experiment", "nowhere.json"]).expect_status(2).complains(&["nowhere.json"]);
    experiment(&folder, &["--only", "two-link-C"])
        .expect_status(2)
        .complains(&["no scenario two-link-C", "two-link-A, two-link-B"]);
    folder.write("cell.toml", "[cell]\n");
    run(&folder, &["experiment", "cell.toml"]).expect_status(2).complains(&["expected a .json file"]);
    experiment(&folder, &["--csv", "no/such/folder.csv"]).expect_status(2).complains(&["cannot write"]);
    experiment(&folder, &["--picture", "figure.gif"]).expect_status(2).complains(&["neither .svg nor .png"]);
    assert!(!Path::new(&folder.path().join("figure.gif")).exists());
}
