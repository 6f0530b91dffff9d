//! Edit without fear: a rule base is compiled, linted and run on its own tests before it is used, and one that fails
//! leaves everything as it was.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use adit_tests::TestSite;

const COSTS: &str =
    "SELECT group_concat(round(hardness, 3), ' ') FROM (SELECT hardness FROM doors ORDER BY door)";

fn example() -> TestSite {
    let site = TestSite::example("paper");
    site.copy_rules_and_tests("paper");
    site
}

/// A careless edit of the rule of Table 6.
fn forget_a_summand(site: &TestSite) {
    site.edit("rules/doors.rhai", "second.hardness + through.hardness;", "second.hardness;");
}

#[test]
fn the_shipped_rule_bases_hold_their_tests() {
    for (name, least) in [("paper", 10), ("clinic", 6)] {
        let ran = TestSite::example(name).adit("test", &["--json"]).expecting(0);
        let answer = ran.json();
        assert_eq!(answer["passed"], true);
        let tests = answer["tests"].as_array().unwrap();
        assert!(tests.len() >= least, "{name} has {} tests", tests.len());
        assert!(tests.iter().all(|test| test["passed"] == true && test["line"].as_u64() > Some(0)));
    }
}

#[test]
fn a_test_that_fails_is_shown_with_the_value_the_expected_one_and_why() {
    let site = example();
    forget_a_summand(&site);
    let ran = site.adit("test", &[]).expecting(1);
    assert!(ran.stdout.contains("FAILED room by room the least hard state"), "{}", ran.stdout);
    assert!(ran.stdout.contains("ok     a state fits where it is lower and narrower"), "{}", ran.stdout);
    ran.complains(&[
        "test \"room by room the least hard state is chosen, and one for the way through\": DOORS 1 hardness is 20 \
         and should be 22",
        "by rule \"weigh a door\"",
        "first = ROBOTS r/STAND",
        "doors.toml",
    ]);
    let answer = site.adit("test", &["--json"]).expecting(1).json();
    let failed: Vec<_> =
        answer["tests"].as_array().unwrap().iter().filter(|test| test["passed"] == false).collect();
    assert_eq!(failed[0]["failures"][0]["expected"], 37.005_533);
    assert!(failed[0]["failures"][0]["why"].as_str().unwrap().contains("weigh a door"));
}

#[test]
fn a_rule_base_that_fails_its_test_is_not_used_and_the_old_one_stays() {
    let site = example().built();
    let (doors, generation) = (site.sqlite3(COSTS), "SELECT value FROM site WHERE key = 'generation'");
    let before = site.sqlite3(generation);
    forget_a_summand(&site);
    site.adit("build", &[]).expecting(1).complains(&["should be 22", "weigh a door"]);
    site.adit("tune", &["robots", "SQUAT", "hardness", "3"]).expecting(1).complains(&["should be 22"]);
    let found = site.adit("check", &["--json"]).expecting(1).json();
    assert_eq!(found[0]["code"], "test/failed");
    assert_eq!(site.sqlite3(COSTS), doors);
    assert_eq!(site.sqlite3(generation), before);
    assert_eq!(site.sqlite3("SELECT hardness FROM robots WHERE state = 'SQUAT'"), ["4.0"]);
    assert_eq!(site.sqlite3("SELECT count(*) FROM history"), ["0"]);
}

#[test]
fn a_first_build_that_fails_its_tests_leaves_no_database() {
    let site = example();
    forget_a_summand(&site);
    site.adit("build", &[]).expect_status(1);
    assert!(!site.path().join("site.db").exists());
}

#[test]
fn whoever_means_the_change_changes_the_test_and_it_is_taken() {
    let site = example().built();
    forget_a_summand(&site);
    std::fs::remove_file(site.path().join("rules/tests/doors.toml")).unwrap();
    site.adit("build", &[]).expect_status(0);
    assert!(site.sqlite3(COSTS)[0].ends_with("33.002"), "{:?}", site.sqlite3(COSTS));
}

#[test]
fn a_test_file_that_cannot_be_right_is_shown_at_its_place() {
    let site = example();
    site.write(
        "rules/tests/own.toml",
        "[[test]]\nname = \"typo\"\n[test.given]\nDOORS = [{ door = 1, widht = 2.0 }]\n\
         [test.conclude]\nDOORS.1.passable = true\n",
    );
    let problems = site.adit("check", &["--json"]).expecting(1).json();
    let first = &problems[0];
    assert_eq!(first["code"], "rule/unknown-property");
    assert_eq!((first["line"].as_u64(), first["column"].as_u64()), (Some(4), Some(22)));
    assert!(first["file"].as_str().unwrap().ends_with("own.toml"));
    assert_eq!(first["help"], "did you mean `width`?");
    site.write("rules/tests/own.toml", "[[test]\n");
    site.adit("test", &[]).expecting(2).complains(&["own.toml"]);
}

#[test]
fn problems_for_programs_have_code_severity_message_file_line_column_and_help() {
    let site = example();
    site.edit("rules/doors.rhai", "first.hardness +", "first.hardnes +");
    let problems = site.adit("check", &["--json"]).expecting(1).json();
    let problem = &problems[0];
    assert_eq!(problem["code"], "rule/unknown-property");
    assert_eq!(problem["severity"], "error");
    assert!(problem["message"].as_str().unwrap().contains("hardnes"));
    assert!(problem["file"].as_str().unwrap().ends_with("rules/doors.rhai"));
    let text = site.read("rules/doors.rhai");
    let line = text.lines().nth(problem["line"].as_u64().unwrap() as usize - 1).unwrap();
    assert!(line[problem["column"].as_u64().unwrap() as usize - 1..].starts_with("hardnes "), "{problem}");
    assert_eq!(problem["help"], "did you mean `hardness`?");
}

#[test]
fn the_generation_grows_with_what_changed_and_with_nothing_else() {
    let site = example();
    let generation = |json: serde_json::Value| json["generation"].as_u64().unwrap();
    let build = || generation(site.adit("build", &["--json"]).expecting(0).json());
    assert_eq!((build(), build()), (1, 1));
    let tuned = site.adit("tune", &["robots", "SQUAT", "hardness", "3", "--json"]).expecting(0).json();
    assert_eq!(generation(tuned), 2);
    assert_eq!(generation(site.adit("route", &["f", "e", "--json"]).expecting(0).json()), 2);
    assert_eq!(generation(site.adit("test", &["--json"]).expecting(0).json()), 2);
    site.adit("tune", &["robots", "SQUAT", "hardness", "9", "--dry-run"]).expect_status(0);
    assert_eq!(build(), 2);
    site.adit("undo", &[]).expect_status(0);
    assert_eq!(build(), 3);
    site.edit("rules/rooms.rhai", "rule \"choose", "// a word more\nrule \"choose");
    assert_eq!(build(), 4, "the rule stands on another line, and the answers say so");
}
