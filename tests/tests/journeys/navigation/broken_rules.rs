//! Rules that fail, or do not say what they are asked, end a command: nothing comes of them that looks like a result.

use std::fs;

use adit_tests::{TestSite, repository};

use super::flat::{copy_rules, flat, on, run};

/// A flat with rules of its own, and one more.
fn with_rule(rule: &str) -> TestSite {
    let folder = flat();
    copy_rules(&folder);
    folder.write("rules/z.rhai", rule);
    folder
}

#[test]
fn rules_that_say_nothing_are_no_result_of_a_mission() {
    let folder = flat();
    let silent = "rule \"never\" each way in WAYS where way.length < 0.0 then { way.weight = 1.0; }\n";
    folder.write("silent/silent.rhai", silent);
    for (args, said) in [
        (&["desk", "bath"][..], "rules do not say what a way weighs"),
        (&["desk", "bath", "--db", "missions.db"], "rules do not say what a way weighs"),
        (&["--learn", "bed", "--db", "missions.db"], "rules do not say"),
        (&["--curve", "curve.svg", "--metres", "5", "--missions", "1"], "rules do not say"),
    ] {
        let args = [args, &["--rules", "silent"]].concat();
        let ran = run(&folder, "simulate", &args).expect_status(2);
        assert!(!ran.stdout.contains("no_way"), "{}", ran.stdout);
        ran.complains(&["simulate/rules", said]);
    }
    assert!(!folder.path().join("curve.svg").exists());
    assert!(!folder.path().join("missions.db").exists());
}

#[test]
fn a_state_table_of_segments_that_is_missing_is_missed() {
    let folder = flat();
    copy_rules(&folder);
    fs::remove_file(folder.path().join("rules/segments.rhai")).expect("it was there");
    run(&folder, "simulate", &["desk", "bath"])
        .expect_status(2)
        .complains(&["simulate/rules", "rules do not say what becomes of a segment"]);
}

#[test]
fn a_rule_that_fails_while_it_runs_is_named_with_its_file_and_line() {
    let weighs = |then: &str| {
        format!("rule \"low\" priority 5\n  each way in WAYS\n  then {{ {then} way.weight = 3.0; }}\n")
    };
    for (then, said) in [("throw \"a fit\";", "a fit"), ("loop { }", "more steps than a rule may take")] {
        let folder = with_rule(&weighs(then));
        for verb in ["route", "simulate"] {
            run(&folder, verb, &["desk", "bath"]).expect_status(2).complains(&[
                "plan/rules",
                "z.rhai:3",
                "low",
                said,
            ]);
        }
    }
    // The same of rules about situations, segments and openings.
    for (class, property, args) in [
        ("SITUATIONS", "next = \"hold\"", &["desk", "bath"][..]),
        ("SEGMENTS", "becomes = 1.0", &["desk", "bath"]),
        ("OPENINGS", "worth = 1.0", &["--learn", "bed"]),
    ] {
        let rule = format!(
            "rule \"low\" priority 5 each one in {class} then {{ throw \"a fit\"; one.{property}; }}\n"
        );
        let ran = run(&with_rule(&rule), "simulate", args).expect_status(2);
        ran.complains(&["simulate/rules", "z.rhai:1", "a fit"]);
    }
}

#[test]
fn a_rule_that_is_interpreted_and_does_not_fail_counts() {
    let rule = "rule \"low\" priority 5 each way in WAYS then { let n = 0; while n < 3 { n += 1; } way.weight = n; }\n";
    run(&with_rule(rule), "route", &["desk", "bath"]).expect_status(0);
}

#[test]
fn a_rule_that_fails_in_a_cell_is_named_as_well() {
    let folder = TestSite::empty();
    let world = fs::read_to_string(repository().join("kb/worlds/cell-point.toml")).expect("the cell");
    folder.write("cell.toml", world);
    for file in ["edges.rhai", "landmarks.rhai", "repair.rhai"] {
        let text = fs::read(repository().join("rules/adapt").join(file)).expect("the rule base");
        folder.write(&format!("rules/{file}"), text);
    }
    on(&folder, "tasks", "cell.toml", &["far", "--rules", "rules"]).expect_status(0);
    folder.write(
        "rules/z.rhai",
        "rule \"low\" priority 5 each o in LANDMARKS then { throw \"a fit\"; o.own = 3.0; }\n",
    );
    on(&folder, "tasks", "cell.toml", &["far", "--rules", "rules"]).expect_status(2).complains(&[
        "plan/rules",
        "z.rhai:1",
        "a fit",
    ]);
}
