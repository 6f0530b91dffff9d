//! A planner from outside changes a route through a rule, and the stock program keeps the facts that it gave.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use std::process::Command;

use adit_tests::{Ran, TestSite, adit, cargo, repository};

const ROUTE: &str = "SELECT group_concat(place, ' ') FROM \
                     (SELECT place FROM action_sequence WHERE start = 'f' AND goal = 'e' ORDER BY step)";

fn site_with_a_kiosk() -> TestSite {
    let site = TestSite::example("paper");
    site.copy_rules("paper");
    let text = site.read("site.toml");
    site.write("site.toml", format!("{text}\n[[place]]\nname = \"kiosk\"\nat = [37.1, 17.5]\n"));
    site.write(
        "rules/crowds.rhai",
        r#"revise "a crowd is slow to pass"
    each door  in DOORS
    each crowd in CROWDS where hypot(door.x - crowd.x, door.y - crowd.y) <= crowd.radius + 0.5
    set door.hardness by * 3.0 level 10
"#,
    );
    site
}

fn build_with_the_example_planner(site: &TestSite) {
    let program = adit().with_file_name("adit-example-planner");
    let mut build = cargo();
    // of the whole workspace, as the tests are built: of one package alone, crates with fewer features would be built anew
    build.args([
        "build",
        "--quiet",
        "--locked",
        "--workspace",
        "--bin",
        "adit-example-planner",
        "--test",
        "peers",
    ]);
    if program.ancestors().nth(1).is_some_and(|profile| profile.ends_with("release")) {
        build.arg("--release");
    }
    assert!(build.status().unwrap().success());
    Ran::new(&Command::new(program).arg(site.path()).output().unwrap()).expect_status(0);
}

#[test]
fn the_example_is_at_most_sixty_lines() {
    let text = std::fs::read_to_string(repository().join("tests/example-planner/src/main.rs")).unwrap();
    assert!(text.lines().count() <= 60, "{}", text.lines().count());
}

#[test]
fn a_rule_about_a_class_that_nobody_gives_is_refused() {
    let site = site_with_a_kiosk();
    site.adit("build", &[]).expecting(2).complains(&["crowds.rhai", "CROWDS"]);
}

#[test]
fn a_planner_from_outside_changes_a_route_through_a_rule() {
    let site = site_with_a_kiosk();
    build_with_the_example_planner(&site);
    assert_eq!(site.sqlite3("SELECT kiosk, x, y FROM crowds"), ["kiosk|37.1|17.5"]);
    assert_eq!(site.sqlite3(ROUTE), ["f 7 d 8 g 6 c 5 e"]);
}

#[test]
fn the_stock_program_goes_on_with_the_facts_that_the_planner_gave() {
    let site = site_with_a_kiosk();
    build_with_the_example_planner(&site);
    site.adit("tune", &["robots", "STAND", "hardness", "1.5"]).expect_status(0);
    assert_eq!(site.sqlite3(ROUTE), ["f 7 d 8 g 6 c 5 e"]);
}
