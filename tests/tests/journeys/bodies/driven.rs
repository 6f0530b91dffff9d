//! Missions of bodies that other programs are, and what nobody knows of them.

use std::process::Command;

use adit_tests::{Ran, TestSite, adit, repository};
use serde_json::Value;

use super::{conform, floor, in_python, simulated};

/// What only who knows the truth can say.
const OF_JUDGES: [&str; 9] = [
    "miss",
    "worst_error",
    "right",
    "collided",
    "possible",
    "possible_with_room",
    "obstacles",
    "seed",
    "least_cost",
];

#[test]
fn one_that_is_longer_than_wide_is_driven_over_the_wire_to_the_bit_too() {
    let (site, ends) = (TestSite::barrow(), ["dock", "ward 12"]);
    let facing = "SELECT facing FROM waypoints WHERE start = 'dock' AND goal = 'ward 12' ORDER BY waypoint";
    let heading = ["--heading", &site.sqlite3(facing)[0]];
    let drawn = [&ends[..], &heading, &["--seed", "3", "--keep", "--json"]].concat();
    let within = site.adit("simulate", &drawn).expect_status(0).json()[0].clone();
    assert_eq!(within["ending"], "arrived");
    let body = simulated(&site, ends[0], &format!("--seed 3 {}", heading.join(" ")));
    let driven = drive(&site, ends, &body, &[&heading[..], &["--keep"]].concat());
    for key in ["ending", "seconds", "changes", "replans", "detours"] {
        assert_eq!(driven[key], within[key], "{key}: {driven}");
    }
    let poses = |mission: u8| {
        site.sqlite3(&format!("SELECT x, y, heading FROM journal WHERE mission = {mission} ORDER BY entry"))
    };
    assert_eq!(poses(1), poses(2));
}

#[test]
fn a_body_begins_at_any_facing_at_which_it_fits_and_is_told_where_it_does_not() {
    let site = TestSite::barrow();
    // 0.3 m off the edge of the map, which is a wall, it fits along that alone
    let start = "0.3,8.2";
    for heading in ["90", "-90"] {
        let ran = conform(&simulated(&site, start, &format!("--heading {heading}")), &["--json"]);
        assert_eq!(ran.json()["checks"][1]["held"], true, "{heading}: {}", ran.stdout);
    }
    site.adit("body", &[start, "--heading", "0"])
        .expect_status(2)
        .complains(&["the robot begins at 0.3, 8.2, where wall", "would be within it"]);
    // and one that is longer than the site has it is not driven
    site.adit("tune", &["robots", "barrow/GO", "length", "0.8"]).expect_status(0);
    let long = TestSite::barrow();
    let body = simulated(&long, "dock", "");
    let ran = site.adit("drive", &["dock", "ward 12", "--body", &body]);
    assert!(
        ran.stdout.contains("the body is 0.9 x 0.4 m in the shape `GO`, and ways are found for 0.8 x 0.4 m"),
        "{}",
        ran.stdout
    );
}

fn drive(site: &TestSite, ends: [&str; 2], body: &str, more: &[&str]) -> Value {
    let args = [&ends[..], &["--body", body, "--json"], more].concat();
    site.adit("drive", &args).expect_status(0).json()
}

#[test]
fn our_simulator_drives_over_the_wire_as_it_does_within_the_program_to_the_bit() {
    let (site, ends) = (floor(), ["home", "window"]);
    let within = site.adit("simulate", &[&ends[..], &["--seed", "3", "--keep", "--json"]].concat());
    let within = &within.expect_status(0).json()[0];
    let file = site.path().join("truth.json");
    let body = simulated(&site, ends[0], &format!("--seed 3 --truth '{}'", file.display()));
    let driven = drive(&site, ends, &body, &["--keep"]);
    let truth: Value = serde_json::from_str(&site.read("truth.json")).expect("JSON");
    for key in ["ending", "seconds", "changes", "replans", "detours"] {
        assert_eq!(driven[key], within[key], "{key}: {driven}");
    }
    assert_eq!(driven["changes"], 2);
    for key in ["length", "by_state", "touches", "seconds"] {
        assert_eq!(truth[key], within[key], "{key}: {truth}");
    }
    for key in OF_JUDGES {
        assert!(
            driven.get(key).is_none() && (key == "least_cost" || within.get(key).is_some()),
            "{key}: {driven}"
        );
    }
    // all that happened, and by which rule, is the same; only where the robot really was is not known
    let journal = |mission: u8| {
        let columns = "entry, time, event, state, next, action, rule, table_row, x, y, heading, detail";
        site.sqlite3(&format!("SELECT {columns} FROM journal WHERE mission = {mission} ORDER BY entry"))
    };
    assert!(journal(1).len() > 50);
    assert_eq!(journal(1), journal(2));
    let known = "SELECT mission, count(true_x) > 0, count(*) = count(true_x) FROM journal GROUP BY mission";
    assert_eq!(site.sqlite3(known), ["1|1|1", "2|0|0"]);
}

#[test]
fn the_body_in_python_goes_from_place_to_place_and_squats_on_the_way_and_really_is_there() {
    let site = floor();
    let file = site.path().join("truth.json");
    let body = in_python(&site, &format!("--truth '{}'", file.display()));
    let driven = drive(&site, ["home", "window"], &body, &["--keep"]);
    assert_eq!(driven["ending"], "arrived", "{driven}");
    let states: Vec<&String> = driven["by_state"].as_object().expect("metres").keys().collect();
    assert_eq!(states, ["SQUAT", "STAND"]);
    let truth: Value = serde_json::from_str(&site.read("truth.json")).expect("JSON");
    let number = |key: &str| truth[key].as_f64().expect("a number");
    let miss = (number("x") - 11.0).hypot(number("y") - 7.0);
    assert!(miss < number("radius") && truth["touches"] == 0, "{truth}");
    // what happened is kept, explained, and hardness is fitted by it
    let shapes = "SELECT json_extract(detail, '$.state') FROM journal WHERE event = 'shape' ORDER BY entry";
    assert_eq!(site.sqlite3(shapes), ["SQUAT", "STAND"]);
    let why = site.adit("why", &["mission 1"]).expect_status(0).stdout;
    assert!(why.contains("it arrived"), "{why}");
    assert_eq!(
        site.sqlite3("SELECT DISTINCT mission FROM traversals"),
        ["mission 1 of floor, in SQUAT", "mission 1 of floor, in STAND"]
    );
    let words =
        site.adit("drive", &["home", "1.5,6", "--body", &in_python(&site, "")]).expect_status(0).stdout;
    assert!(words.contains("it arrived, by its own account") && !words.contains("optimum"), "{words}");
}

#[test]
fn what_a_body_meets_is_told_to_the_site_and_it_goes_on_by_what_holds_then() {
    let site = floor();
    // in the body's own world a cupboard stands in the doorway, of which the site does not know: who comes by it goes sideways
    let world = TestSite::empty();
    let cupboard = "\n[[obstacle]]\nrect = [5.6, 2.9, 6.4, 3.5]\n";
    world.write("map.toml", site.read("map.toml") + cupboard);
    world.write("robots.toml", site.read("robots.toml"));
    let body = in_python(&world, "");
    let args = ["home", "window", "--body", &body, "--keep", "--tell", "--json"];
    let ran = site.adit("drive", &args).expect_status(0);
    assert!(ran.stderr.contains("laid over the map for an hour"), "{}", ran.stderr);
    assert!(ran.json()["by_state"]["SIDE-STAND"].as_f64() > Some(0.3), "{}", ran.stdout);
    assert_eq!(site.sqlite3("SELECT count(*) > 0, min(who) FROM laid"), ["1|robot"]);
    site.adit("doctor", &[]).expect_status(0);
}

#[test]
fn on_a_floor_plan_it_is_driven_over_the_network_as_it_is_simulated() {
    let folder = TestSite::empty();
    let (flat, db) = (repository().join("kb/worlds/flat.toml"), folder.path().join("site.db"));
    let (flat, db) = (flat.display().to_string(), db.display().to_string());
    let run = |verb: &str, more: &[&str]| {
        let ran = Command::new(adit())
            .args([verb, &flat, "bed", "bath", "--db", &db, "--json"])
            .args(more)
            .output();
        Ran::new(&ran.expect("adit runs")).expecting(0).json()
    };
    let within = run("simulate", &[]);
    let driven = run("drive", &["--body", &format!("'{}' body '{flat}' bed", adit().display())]);
    assert_eq!((&driven["mission"], &driven["seconds"]), (&2.into(), &within[0]["seconds"]), "{driven}");
    let columns = "entry, time, event, state, next, action, rule, x, y, heading, detail";
    let journal =
        |mission: u8| folder.sqlite3(&format!("SELECT {columns} FROM journal WHERE mission = {mission}"));
    assert_eq!(journal(1), journal(2));
}

#[test]
fn what_cannot_be_driven_is_said_before_anything_moves() {
    let site = floor();
    let body = in_python(&site, "");
    site.adit("drive", &["home", "nowhere", "--body", &body]).expect_status(2).complains(&["`nowhere`"]);
    site.adit("drive", &["6,2", "window", "--body", &body])
        .expect_status(2)
        .complains(&["fits there in no state"]);
    site.adit("drive", &["home", "window", "--body", &body, "--timeout=-1"])
        .expect_status(2)
        .complains(&["--timeout -1.0 is no time"]);
    site.adit("body", &["home", "--state", "LIE"])
        .expect_status(2)
        .complains(&["state `LIE`", "STAND, SIDE-STAND, SQUAT"]);
    site.adit("body", &["home", "--listen", "nowhere"])
        .expect_status(2)
        .complains(&["body/listen", "nowhere"]);
}
