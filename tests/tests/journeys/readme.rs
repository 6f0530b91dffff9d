//! What the README and the manual show works as it stands there.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use std::fs;
use std::process::Command;

use adit_tests::{Ran, TestSite, adit, repository};

/// The first block of a page in a language that contains these words.
fn block(page: &str, language: &str, words: &str) -> String {
    let text = fs::read_to_string(repository().join(page)).unwrap();
    let mut blocks = text.split("```").skip(1).step_by(2);
    let found = blocks.find(|block| block.starts_with(&format!("{language}\n")) && block.contains(words));
    found
        .unwrap_or_else(|| panic!("{page} has no {language} block with `{words}`"))
        .split_once('\n')
        .unwrap()
        .1
        .to_owned()
}

const RULES: &str = "manual/src/rules.md";

/// `adit new` and `adit build`, as the README begins.
fn starter() -> TestSite {
    let site = TestSite::empty();
    let folder = site.path().join("my-site");
    Ran::new(&Command::new(adit()).arg("new").arg(&folder).output().unwrap()).expect_status(0);
    for file in ["site.toml", "map.toml", "robots.toml", "rules/own.rhai"] {
        site.write(file, fs::read(folder.join(file)).unwrap());
    }
    site.built()
}

fn cost(site: &TestSite) -> f64 {
    site.adit("route", &["home", "window", "--json"]).expecting(0).json()["cost"].as_f64().unwrap()
}

#[test]
fn the_starter_builds_routes_and_draws() {
    let site = starter();
    assert!(site.adit("route", &["home", "window"]).expecting(0).stdout.contains("WALK-ON-KNEE"));
    let picture = site.path().join("floor.svg");
    site.adit("draw", &["-o", picture.to_str().unwrap(), "--route", "home", "window"]).expect_status(0);
    assert!(fs::read_to_string(picture).unwrap().contains("</svg>"));
}

#[test]
fn the_way_across_the_clinic_is_the_one_that_is_shown() {
    let route =
        TestSite::example("clinic").built().adit("route", &["dock", "ward 12"]).expecting(0).stdout.clone();
    assert_eq!(route, block("README.md", "text", "dock to ward 12, hardness"));
}

#[test]
fn why_the_way_across_the_clinic_is_as_it_is_is_shown() {
    let said =
        TestSite::example("clinic").built().adit("why", &["dock", "ward 12"]).expecting(0).stdout.clone();
    assert_eq!(said, block("manual/src/asking-why.md", "text", "Walk-on-knee in corridor 15"));
}

#[test]
fn the_sql_answers() {
    let rows = starter().sqlite3(&block("README.md", "sql", "action_sequence"));
    assert!(rows.len() > 3, "{rows:?}");
}

#[test]
fn wet_floors_make_a_way_harder() {
    let site = starter();
    let dry = cost(&site);
    let text =
        site.read("site.toml") + block(RULES, "toml", "by the tap").replace("hardness = 2.0", "").as_str();
    site.write("site.toml", text);
    site.adit("build", &[]).expect_status(0);
    assert!((cost(&site) - dry).abs() < 0.02 * dry, "rooms are cut, nothing is harder: {}", cost(&site));
    site.write("rules/wet.rhai", block(RULES, "rhai", "wet floors are slippery"));
    site.adit("check", &[]).expect_status(0);
    site.adit("build", &[]).expect_status(0);
    assert!(cost(&site) > dry, "{} after {dry}", cost(&site));
}

#[test]
fn the_recipe_that_forbids_a_state_in_a_region() {
    let site = starter();
    let recipe = block(RULES, "rhai", "a raised arm").replace("RAISED", "SQUAT").replace("10.0", "100.0");
    site.write("rules/arm.rhai", recipe);
    site.adit("build", &[]).expect_status(0);
    let answer = site.adit("route", &["home", "window", "--json"]).expecting(1).json();
    assert_eq!(answer["status"], "no_route", "only a squatting robot passes under the pipe");
}

#[test]
fn the_edits_of_the_table_work_as_written() {
    let site = starter();
    for line in block("manual/src/tuning.md", "sh", "new knee pads").lines() {
        let words = line.split('#').next().unwrap().split_whitespace().collect::<Vec<_>>();
        let joined = words.join(" ").replace("\"new knee pads\"", "pads");
        // a file of the reader's lies in the folder of the test, which goes
        let joined = joined.replace("robots.xlsx", &site.path().join("robots.xlsx").display().to_string());
        let words: Vec<&str> = joined.split(' ').collect();
        site.adit(words[1], &words[3..]).expect_status(0);
    }
}
