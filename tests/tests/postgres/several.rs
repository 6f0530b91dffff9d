//! Several services on one site: one edits at a time, all answer, and an edit on one is answered by all within a second.

use std::time::Duration;

use adit_tests::TestSite;
use adit_tests::cluster::Cluster;
use serde_json::json;

use super::{Served, copy, soon, squat, with_site};

const SECOND: Duration = Duration::from_secs(1);

#[test]
fn an_edit_on_any_is_answered_by_all_within_a_second_and_stepped_as_one_edit() {
    let (cluster, _site) = with_site("paper");
    let services: Vec<Served> = (0..3).map(|_| Served::start(&cluster.url("paper"))).collect();
    let mut events: Vec<_> = services.iter().map(|served| served.service.events()).collect();
    let mut slowest = Duration::ZERO;
    for round in 0..9 {
        let value = 2.0 + f64::from(round) / 10.0;
        let generation = services[round as usize % 3].edit(&squat(value));
        let cost = services[round as usize % 3].cost("f", "e");
        for served in &services {
            slowest = slowest.max(soon(SECOND, || served.cost("f", "e") == cost));
        }
        for events in &mut events {
            let changed = events.next("changed");
            assert_eq!(
                (changed["generation"].as_i64(), &changed["anew"]),
                (Some(generation), &json!(false)),
                "{changed}"
            );
            assert_eq!(changed["what"], json!(changed["what"].as_str().unwrap()), "{changed}");
        }
    }
    println!("the slowest of 27 answers after an edit elsewhere came after {slowest:?}");
    let history = |served: &Served| served.service.ask("GET", "/api/history", None).1["edits"].clone();
    let (first, rest) = services.split_first().unwrap();
    assert_eq!(history(first).as_array().unwrap().len(), 9);
    for served in rest {
        assert_eq!(history(first), history(served));
    }
    // and SQL says so, too, in each copy and in the database
    let sql = "SELECT hardness FROM robots WHERE state = 'SQUAT'";
    for served in &services {
        let answer = served.service.ask("POST", "/api/sql", Some(&json!({"query": sql}))).1;
        assert_eq!(answer["rows"][0][0], json!(2.8), "{answer}");
    }
    assert_eq!(
        cluster.ask("SELECT hardness FROM adit.robots WHERE site = 'paper' AND state = 'SQUAT'"),
        ["2.8"]
    );
}

#[test]
fn facts_rules_and_undo_are_everybodys() {
    let cluster = Cluster::start();
    let site = TestSite::example("paper");
    site.copy_rules_and_tests("paper");
    let site = site.built();
    copy(&[&site.path().display().to_string(), &cluster.url("paper")]).expect_status(0);
    let (one, other) = (Served::start(&cluster.url("paper")), Served::start(&cluster.url("paper")));
    let tell = json!({"edit": {"kind": "tell", "class": "DOORS", "object": "door 3", "property": "hardness", "value": 50.0}});
    one.edit(&tell);
    let told = one.cost("f", "e");
    soon(SECOND, || other.cost("f", "e") == told);
    other.edit(&json!({"edit": {"kind": "undo"}}));
    let back = other.cost("f", "e");
    assert!((told.1 - back.1).abs() > 1e-6);
    soon(SECOND, || one.cost("f", "e") == back);
    // a rule that is saved on one is in the other's folder, and counts there
    let (_, rules) = one.service.ask("GET", "/api/rules", None);
    let file = rules["files"].as_array().unwrap().iter().find(|file| file["file"] == "doors.rhai").unwrap();
    let text = format!("{}\n// saved\n", file["text"].as_str().unwrap());
    let body = json!({"text": text, "version": file["version"]});
    let (status, saved) = one.service.ask("PUT", "/api/rules/doors.rhai", Some(&body));
    assert_eq!(status, 200, "{saved}");
    soon(3 * SECOND, || {
        other.folder.path().join("rules/doors.rhai").exists() && other.folder.read("rules/doors.rhai") == text
    });
    soon(3 * SECOND, || other.generation() == one.generation());
    other.edit(&squat(2.0));
    let cost = other.cost("f", "e");
    soon(SECOND, || one.cost("f", "e") == cost);
    // a third one begins with all of that
    let third = Served::start(&cluster.url("paper"));
    assert_eq!(third.cost("f", "e"), cost);
    assert_eq!(third.folder.read("rules/doors.rhai"), text);
}

#[test]
fn a_service_that_is_killed_at_work_keeps_nobody_from_editing_for_long() {
    let (cluster, _site) = with_site("paper");
    let (one, other) = (Served::start(&cluster.url("paper")), Served::start(&cluster.url("paper")));
    one.edit(&squat(2.0));
    // as if it had been killed in the midst of an edit
    cluster.ask("UPDATE adit.sites SET owner = 'one', fence = fence + 1, until = now() + interval '3 seconds' WHERE site = 'paper'");
    one.service.kill();
    let began = std::time::Instant::now();
    other.edit(&squat(3.0));
    assert!(
        began.elapsed() > Duration::from_secs(2) && began.elapsed() < Duration::from_secs(6),
        "{:?}",
        began.elapsed()
    );
    assert_eq!(other.service.ask("GET", "/api/history", None).1["edits"].as_array().unwrap().len(), 2);
}

#[test]
fn edits_on_all_at_once_are_made_one_after_the_other_and_none_is_lost() {
    let (cluster, _site) = with_site("paper");
    let services: Vec<Served> = (0..3).map(|_| Served::start(&cluster.url("paper"))).collect();
    std::thread::scope(|scope| {
        for (number, served) in services.iter().enumerate() {
            scope.spawn(move || {
                for round in 0..10 {
                    let body = json!({"edit": squat(2.0 + f64::from(round) / 7.0 + number as f64)["edit"], "why": format!("{number}/{round}")});
                    served.edit(&body);
                }
            });
        }
    });
    let whys = cluster.ask("SELECT count(DISTINCT why), count(*) FROM adit.history WHERE site = 'paper'");
    assert_eq!(whys, ["30|30"]);
    // whichever was the last: all of them come to it
    soon(SECOND, || {
        let costs: Vec<(i64, f64)> = services.iter().map(|served| served.cost("f", "e")).collect();
        costs.iter().all(|cost| *cost == costs[0])
    });
}
