//! Why a robot stopped, by the journal of its mission.

use super::flat::{copy_rules, flat, on, run, sql};

#[test]
fn the_last_stop_is_explained_by_the_row_that_decided_and_by_what_kept_the_others_from_it() {
    let folder = flat();
    run(&folder, "simulate", &["bed", "desk", "--db", "missions.db"]).expect_status(0);
    let answer = on(&folder, "why", "missions.db", &["1"]).expect_status(0).stdout;
    for said in [
        "mission 1 of flat by robot, ",
        "it arrived",
        "from (1.50, 1.50) to (",
        ": decide -> hold",
        "because of decide, row 11 (line ",
        "execution.rhai",
        "goal_tolerance 0.08",
        "not decide, row 8: situation.needs_shape is false, not true",
        "not decide, row 15: the first row that matches is 11, not 15",
    ] {
        assert!(answer.contains(said), "`{said}` is not in:\n{answer}");
    }
}

#[test]
fn a_mission_without_a_way_is_explained_by_what_said_so() {
    let folder = flat();
    // The first moves before there is no way any more, the other one has none from the beginning.
    for args in [&["--missions", "1", "--seed", "2"][..], &["bath", "0,0"]] {
        let args = [args, &["--db", "missions.db", "--json"]].concat();
        let rows = run(&folder, "simulate", &args).expect_status(0).json();
        assert_eq!(rows[0]["ending"], "no_way", "{rows}");
        let answer = on(&folder, "why", "missions.db", &["1"]).expect_status(0).stdout;
        for said in
            [": blocked -> hold, no way", "it found no way", "because of blocked, row 14", "has_way false"]
        {
            assert!(answer.contains(said), "`{said}` is not in:\n{answer}");
        }
    }
    // Another moment of it is another question.
    let begun = on(&folder, "why", "missions.db", &["1", "--at", "0.5", "--json"]).expect_status(0).json();
    assert_eq!((&begun["next"], &begun["ending"]), (&"wait".into(), &"no_way".into()), "{begun}");
}

#[test]
fn every_decision_of_a_journal_is_found_again_with_its_rule() {
    let folder = flat();
    // boxes in the way: waits, detours, closed ways
    run(&folder, "simulate", &["--missions", "3", "--seed", "5", "--db", "missions.db"]);
    let kept = sql(
        &folder,
        "missions.db",
        "SELECT mission, max(entry), time, state, next, action, rule, table_row, file, line FROM journal
         WHERE event = 'state' GROUP BY mission, time ORDER BY mission, entry",
    );
    assert!(kept.len() > 60, "{}", kept.len());
    for row in kept.iter().step_by(7) {
        let [mission, entry, time, state, next, action, rule, line_of_table, file, line] =
            row.split('|').collect::<Vec<_>>()[..]
        else {
            panic!("{row}")
        };
        let answer =
            on(&folder, "why", "missions.db", &[mission, "--at", time, "--json"]).expect_status(0).json();
        let spoke = answer["considered"]
            .as_array()
            .expect("rules")
            .iter()
            .find(|one| one["spoke"] == true && one["row"].is_number());
        let spoke = spoke.unwrap_or_else(|| panic!("nothing spoke of {row}"));
        let found = [&answer["entry"], &spoke["row"], &spoke["line"]].map(ToString::to_string);
        assert_eq!(found, [entry, line_of_table, line]);
        assert_eq!([&answer["state"], &answer["next"], &answer["action"]], [state, next, action]);
        assert_eq!([&spoke["rule"], &spoke["file"]], [rule, file]);
        assert!(answer.get("now").is_none(), "the rules are the same: {answer}");
    }
}

#[test]
fn rules_that_were_changed_since_are_said_to_say_something_else() {
    let folder = flat();
    copy_rules(&folder);
    run(&folder, "simulate", &["bed", "desk", "--db", "missions.db"]).expect_status(0);
    folder.edit(
        "rules/execution.rhai",
        "any,  any,  true, any,  any,  any,  any,   any,   \"hold\",    \"none\" ],",
        "any,  any,  true, any,  any,  any,  any,   any,   \"wait\",    \"none\" ],",
    );
    let answer = on(&folder, "why", "missions.db", &["1"]).expect_status(0).stdout;
    assert!(answer.contains("the rules have changed since: now they say wait"), "{answer}");
    // The rules of the mission can be named.
    let answer = on(&folder, "why", "missions.db", &["1", "--rules", "navigation"]).expect_status(0).stdout;
    assert!(!answer.contains("changed since"), "{answer}");
}

#[test]
fn what_was_never_kept_cannot_be_asked_about() {
    let folder = flat();
    run(&folder, "simulate", &["bed", "desk", "--db", "missions.db"]).expect_status(0);
    let why = |args: &[&str]| on(&folder, "why", "missions.db", args).expect_status(2);
    why(&["2"]).complains(&["flat has no mission 2; its 1 are numbered 1 to 1"]);
    why(&["first"]).complains(&["`first` is no mission of missions.db: missions have numbers"]);
    why(&["1", "--at", "-1"]).complains(&["had decided nothing yet at -1 s"]);
    why(&["1", "--at", "nan"]).complains(&["--at NaN is no time; expected seconds"]);
    why(&["1", "--world", "flet"]).complains(&["no missions of a world `flet`", "flat"]);
    on(&folder, "why", "flat.json", &["1"]).expect_status(2).complains(&["is not a SQLite database"]);
    run(&folder, "route", &["bed", "desk", "--db", "site.db"]).expect_status(0);
    on(&folder, "why", "site.db", &["1"])
        .expect_status(2)
        .complains(&["site.db keeps no missions", "simulate"]);
    on(&folder, "why", ".", &["1", "--at", "3"]).expect_status(2).complains(&["--world for missions"]);
}
