//! Floor plans (Crowley) as sites: built, asked by SQL, closed, tuned, asked why, undone and served like any other.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use std::path::PathBuf;
use std::process::Command;

use adit_tests::service::Service;
use adit_tests::{Ran, TestSite, adit};
use serde_json::{Value, json};

fn world() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../kb/worlds/flat.toml")
}

/// A site of the flat, as `adit new --map` makes it.
fn flat() -> TestSite {
    let site = TestSite::empty();
    let folder = site.path().join("new");
    let made = Command::new(adit()).arg("new").arg(&folder).arg("--map").arg(world()).output().unwrap();
    Ran::new(&made).expect_status(0);
    for file in ["site.toml", "rules/own.rhai", "flat.toml", "flat.json"] {
        site.write(file, std::fs::read(folder.join(file)).unwrap());
    }
    site
}

/// What the map alone answers.
fn alone(start: &str, goal: &str) -> Value {
    let ran = Command::new(adit()).arg("route").arg(world()).args([start, goal, "--json"]).output().unwrap();
    Ran::new(&ran).expecting(0).json()
}

const PLACES: [&str; 7] = ["bed", "bath", "desk", "hall", "kitchen", "living room", "store"];

#[test]
fn all_routes_of_a_flat_are_those_of_the_map_alone() {
    let site = flat();
    let built = site.adit("build", &[]).expecting(0);
    assert!(
        built.stdout.contains("11 regions, 12 doorways, 24 adits, routes from 7 starts"),
        "{}",
        built.stdout
    );
    assert!(!built.stderr.contains("waits for"), "{}", built.stderr);
    assert_eq!(site.sqlite3("SELECT count(*) FROM route WHERE status = 'ok'"), ["42"]);
    for (start, goal) in PLACES.into_iter().zip(PLACES.into_iter().skip(1)) {
        assert_eq!(site.adit("route", &[start, goal, "--json"]).expecting(0).json(), alone(start, goal));
        let sum = site.sqlite3(&format!(
            "SELECT abs(sum(hardness) - max(cost)) < 1e-6 FROM action_sequence WHERE start = '{start}' AND goal = '{goal}'"
        ));
        assert_eq!(sum, ["1"], "{start} to {goal}: what steps weigh adds up");
    }
    let near = site.sqlite3("SELECT min(clearance) > -1e-9 FROM waypoints");
    assert_eq!(near, ["1"], "no way comes nearer to a wall than the robot is wide");
    let said = site.sqlite3("SELECT DISTINCT action, rule FROM action_sequence WHERE kind = 'region'");
    assert_eq!(said, ["DRIVE|a way weighs its length"]);
}

#[test]
fn a_doorway_is_closed_where_it_is_and_a_wall_is_moved() {
    let site = flat().built();
    let route = "SELECT status, round(cost, 3) FROM route WHERE start = 'store' AND goal = 'desk'";
    let before = site.sqlite3(route);
    let closed = site.adit("close", &["doorway 5", "--until", "2h"]).expecting(0).stdout;
    assert!(closed.contains("doorway 5 at (9.00, 1.70) is closed"), "{closed}");
    let round = site.sqlite3(route);
    assert_ne!(round, before);
    let why = site.adit("why", &["doorway 5"]).expecting(0).stdout;
    assert!(why.contains("closed is true until"), "{why}");
    let not = site.adit("why-not", &["store", "desk", "--through", "doorway 5"]).expecting(0).stdout;
    assert!(not.contains("no way leads through doorway 5"), "{not}");
    // numbers of doorways may become others; the closing stays where it was told
    site.adit("tune", &["vehicles", "robot", "radius", "0.2"]).expect_status(0);
    assert_eq!(site.sqlite3("SELECT doorway FROM doorways WHERE closed"), ["5"]);
    site.adit("undo", &[]).expect_status(0);
    site.adit("undo", &[]).expect_status(0);
    assert_eq!(site.sqlite3(route), before);
    let all = "SELECT * FROM route; SELECT * FROM action_sequence; SELECT * FROM waypoints";
    let edited = site.sqlite3(all);
    site.adit("build", &[]).expect_status(0);
    assert_eq!(site.sqlite3(all), edited, "what was edited is what is built");
    let leg = site.adit("why", &["region 2 from bed to bath"]).expecting(0).stdout;
    assert!(leg.contains("weight is") && leg.contains("a way weighs its length"), "{leg}");
    let other = site.adit("why-not", &["bed", "bath", "--through", "doorway 0"]).expecting(0).stdout;
    assert!(!other.is_empty());
    // what a way through another doorway is said to cost is what it costs once the one that is passed is closed
    let through = site.adit("why-not", &["bed", "bath", "--through", "doorway 10"]).expecting(0).stdout;
    let closed = site.adit("close", &["doorway 6"]).expecting(0).stdout;
    assert!(closed.contains("bed to bath: 13.42 → 13.541, another way"), "{closed}");
    let route = site.adit("route", &["bed", "bath"]).expecting(0).stdout;
    assert!(route.contains("doorway 10") && route.contains("hardness 13.541"), "{route}");
    assert!(through.contains("costs 13.541 (by region 2, region 1, region 7)"), "{through}");
    site.adit("undo", &[]).expect_status(0);
    site.adit("check", &[]).expect_status(0);
    site.adit("doctor", &[]).expect_status(0);
}

#[test]
fn what_is_marked_at_a_doorway_is_told_to_the_rules_about_the_way_through_it() {
    let site = flat()
        .with(
            "rules/wet.rhai",
            "rule \"nobody crosses what is wet\" priority 2
                 each way in WAYS where way.floor == \"wet\"
                 then { way.passable = false; }\n",
        )
        .with("tables/notes.csv", "note,text\n1,none\n");
    // a rule may speak of what no mark says yet only once one does
    site.adit("build", &[]).expecting(2).complains(&["floor"]);
    std::fs::remove_file(site.path().join("rules/wet.rhai")).unwrap();
    site.adit("build", &[]).expect_status(0);
    let cost = "SELECT status, round(cost, 3) FROM route WHERE start = 'store' AND goal = 'desk'";
    let dry = site.sqlite3(cost);
    let mark = ["marks", "1", "--add", "what=doorway", "x=9", "y=1.7", "property=squeaks", "value=true"];
    let added = site.adit("tune", &mark).expecting(0).stdout;
    assert!(added.contains("store to desk: 5.025"), "{added}");
    assert_ne!(site.sqlite3(cost), dry, "a door that squeaks weighs more");
    let far = ["marks", "2", "--add", "what=doorway", "x=1", "y=1", "property=squeaks", "value=true"];
    site.adit("tune", &far).expecting(2).complains(&["no doorway is within 0.5 m of (1, 1)"]);
    site.adit("undo", &[]).expect_status(0);
    assert_eq!(site.sqlite3(cost), dry);
}

#[test]
fn what_cannot_be_is_refused() {
    let site = flat().built();
    let before = site.sqlite3("SELECT * FROM route; SELECT * FROM walls");
    for (edit, words) in
        [(["walls", "1", "x1", "0.2"], "its outline is open"), (["places", "bed", "x", "nowhere"], "numbers")]
    {
        site.adit("tune", &edit).expecting(2).complains(&[words]);
    }
    assert_eq!(site.sqlite3("SELECT * FROM route; SELECT * FROM walls"), before);
    // a robot that fits nowhere has no routes, and another one keeps its own
    site.adit("tune", &["vehicles", "wide", "--add", "radius=2"]).expect_status(0);
    let reasons = site.sqlite3("SELECT DISTINCT robot, status, reason FROM route ORDER BY robot");
    assert_eq!(reasons.len(), 2, "{reasons:?}");
    assert!(reasons[0].starts_with("robot|ok"), "{reasons:?}");
    assert!(reasons[1].contains("too wide for every doorway: it needs more than"), "{reasons:?}");
    site.adit("undo", &[]).expect_status(0);
    assert_eq!(site.sqlite3("SELECT * FROM route; SELECT * FROM walls"), before);
    site.adit("route", &["bed", "bat"]).expecting(2).complains(&["`bat` is no place and no point `x,y`"]);
    let none = site.adit("route", &["bed", "0.01,0.01"]).expecting(1).stdout;
    assert!(none.contains("cannot stand at the goal"), "{none}");
}

#[test]
fn a_flat_is_served_and_drawn() {
    let site = flat().built();
    site.adit("draw", &["-o", site.path().join("flat.svg").to_str().unwrap(), "--route", "bed", "bath"])
        .expect_status(0);
    assert!(site.read("flat.svg").contains("<svg"));
    let service = Service::start(&site);
    let (status, route) = service.ask("GET", "/api/route?start=bed&goal=bath", None);
    assert_eq!((status, &route["status"]), (200, &json!("ok")), "{route}");
    let close = json!({"edit": {"kind": "close", "what": "doorway 5"}});
    let (status, done) = service.ask("POST", "/api/edits", Some(&close));
    assert_eq!(status, 200, "{done}");
    let (_, around) = service.ask("GET", "/api/route?start=store&goal=desk", None);
    assert!(!around["steps"].to_string().contains("doorway 5\""), "{around}");
    let (status, of) = service.ask("GET", "/api/site", None);
    assert_eq!((status, &of["layout_kind"]), (200, &json!("floor plan")), "{of}");
}

#[test]
fn figures_of_missions_are_cells_of_a_table() {
    let site = flat().built();
    let figures = site.sqlite3("SELECT figure, value, unit FROM navigation WHERE figure IN ('patience', 'turning_resolution', 'most_waits')");
    assert_eq!(figures, ["most_waits|4.0|", "patience|3600.0|s", "turning_resolution|2.0|°"]);
    let meanings = site.sqlite3("SELECT count(*) > 30, min(length(meaning)) > 10 FROM navigation");
    assert_eq!(meanings, ["1|1"]);
    let mission = || site.adit("simulate", &["bed", "desk", "--json"]).json()[0].clone();
    assert_eq!(mission()["ending"], "arrived");
    site.adit("tune", &["navigation", "patience", "value", "5"]).expect_status(0);
    let impatient = mission();
    assert_eq!(impatient["ending"], "gave_up", "{impatient}");
    site.adit("undo", &[]).expect_status(0);
    assert_eq!(mission()["ending"], "arrived");
    for (figure, value, said) in [
        ("grain", "1e-9", "at least 0.01"),
        ("room", "1e300", "at most 10"),
        ("scan_readings", "1e5", "at most 1,000"),
        ("squeeze", "-1", "expected 0 or more"),
    ] {
        site.adit("tune", &["navigation", figure, "value", value]).expecting(2).complains(&[said]);
    }
    for (value, said) in [("-1", "more than 0"), ("nan", "`nan` is none")] {
        site.adit("tune", &["navigation", "patience", "value", value]).expecting(2).complains(&[said]);
    }
    site.adit("tune", &["navigation", "most_waits", "value", "1.5"])
        .expecting(2)
        .complains(&["a whole number from 0 on"]);
    site.adit("tune", &["navigation", "haste", "--add", "value=1"])
        .expecting(2)
        .complains(&["navigation haste", "patience"]);
}

#[test]
fn what_a_robot_meets_is_told_and_rules_that_react_change_where_all_go() {
    let site = flat().built();
    let ways = "SELECT start, goal, cost FROM route ORDER BY start, goal";
    let before = site.sqlite3(ways);
    // boxes that the robot does not know stand in a doorway on its way: found with this seed
    let drive = ["--missions", "3", "--seed", "5", "--tell", "--keep"];
    let said = site.adit("simulate", &drive);
    assert!(said.stderr.contains("closed = true until"), "{}{}", said.stdout, said.stderr);
    let rule = "rule \"a doorway that a robot found blocked is closed for an hour\"";
    assert!(said.stderr.contains(rule), "{}", said.stderr);
    let facts = "SELECT class, property, value, who FROM facts_told";
    assert_eq!(site.sqlite3(facts)[0], format!("DOORWAYS|closed|true|{rule}"));
    // the report is the robot's, in the history, and what the rule did belongs to it
    let report = "SELECT who, why FROM history WHERE id = change_set LIMIT 1";
    assert_eq!(site.sqlite3(report), ["robot|something stands there (mission 3)"]);
    let after = site.sqlite3(ways);
    assert_ne!(before, after, "routes of everybody lead round it");
    // and in the mission itself: what comes after the report passes that doorway no more
    let closed =
        site.sqlite3("SELECT json_extract(detail, '$.doorway') FROM journal WHERE event = 'way closed'");
    assert!(!closed.is_empty() && closed.len() <= 2, "it keeps off the closed doorway: {closed:?}");
    assert_eq!(site.sqlite3("SELECT count(*) FROM history WHERE who = 'robot'"), ["1"], "it is told once");
    let why = site.adit("why", &["mission 3"]).expecting(0).stdout;
    assert!(why.contains("it found no way"), "{why}");
    let doorway = site.adit("why", &[&format!("doorway {}", closed[0])]).expecting(0).stdout;
    assert!(doorway.contains("closed"), "{doorway}");
    // a site that wants none of it says so; a map alone cannot be told anything
    site.adit("undo", &[]).expect_status(0);
    assert_eq!(site.sqlite3(ways), before, "what the rule did is taken back");
    site.adit("undo", &[]).expect_status(0);
    assert_eq!(site.sqlite3(facts), [""; 0], "and the report");
    site.write("rules/own.rhai", "without \"a doorway that a robot found blocked is closed for an hour\"\n");
    site.adit("build", &[]).expect_status(0);
    let reported = site.adit("simulate", &drive);
    assert!(!reported.stderr.contains("closed = true"), "{}", reported.stderr);
    assert_eq!(site.sqlite3("SELECT property FROM facts_told"), ["blocked"]);
    let alone = Command::new(adit())
        .arg("simulate")
        .arg(world())
        .args(["--missions", "1", "--tell"])
        .output()
        .unwrap();
    Ran::new(&alone).expecting(2).complains(&["is a map alone"]);
}

#[test]
fn what_a_plan_says_of_doorways_and_no_rule_reads_is_told() {
    let site = TestSite::empty();
    for file in ["flat.toml", "flat.json"] {
        let text = std::fs::read_to_string(world().with_file_name(file)).unwrap();
        let slip = "\n[[doorway]]\nat = [6.5, 4.0]\nsqueeks = true\n";
        site.write(file, if file == "flat.toml" { text + slip } else { text });
    }
    let file = site.path().join("flat.toml");
    let ran = Command::new(adit()).arg("check").arg(&file).output().unwrap();
    let said = String::from_utf8(ran.stderr).unwrap().split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        said.contains("no rule reads `squeeks` of a doorway: it changes nothing (did you mean `squeaks`?)"),
        "{said}"
    );
}

#[test]
fn what_a_rule_speaks_of_is_not_taken_away_and_undo_works_where_it_was() {
    let site = flat();
    let rule = "rule \"nobody crosses what is wet\" priority 2\n\
        each way in WAYS where way.floor == \"wet\" then { way.passable = false; }\n";
    let mut map = std::fs::read_to_string(site.path().join("flat.toml")).unwrap();
    map.push_str("\n[[doorway]]\nat = [6.5, 4.0]\nfloor = \"wet\"\n");
    site.write("flat.toml", map);
    site.write("rules/wet.rhai", rule);
    site.adit("build", &["--reseed"]).expect_status(0);
    let marks = site.sqlite3("SELECT mark FROM marks");
    site.adit("tune", &["marks", &marks[0], "--remove"])
        .expecting(2)
        .complains(&["WAYS has no property `floor`"]);
    assert_eq!(site.sqlite3("SELECT mark FROM marks"), marks);
    // taken away while no rule spoke of it
    std::fs::remove_file(site.path().join("rules/wet.rhai")).unwrap();
    site.adit("build", &[]).expect_status(0);
    site.adit("tune", &["marks", &marks[0], "--remove"]).expect_status(0);
    site.write("rules/wet.rhai", rule);
    site.adit("build", &[]).expecting(2).complains(&["WAYS has no property `floor`"]);
    site.adit("undo", &[]).expect_status(0);
    assert_eq!(site.sqlite3("SELECT mark FROM marks"), marks);
}

#[test]
fn a_mission_of_what_was_learned_is_kept_where_that_is_asked_for_and_no_other_is_lost() {
    let site = flat().built();
    let missions = || site.sqlite3("SELECT mission, goal_x, goal_y FROM missions ORDER BY mission");
    site.adit("simulate", &["bed", "desk", "--keep"]).expect_status(0);
    site.adit("simulate", &["--learn", "bed"])
        .expecting(0)
        .complains(&["nothing of what was learned is kept without --keep"]);
    site.adit("simulate", &["bed", "desk", "--learned"]).expecting(2).complains(&["--learn START --keep"]);
    site.adit("simulate", &["--learn", "bed", "--keep"]).expect_status(0);
    let before = missions();
    assert_eq!(before.len(), 1);
    site.adit("simulate", &["bed", "kitchen", "--learned"]).expect_status(0);
    assert_eq!(missions(), before);
    site.adit("simulate", &["bed", "kitchen", "--learned", "--keep"]).expect_status(0);
    assert_eq!(missions().len(), 2);
}
