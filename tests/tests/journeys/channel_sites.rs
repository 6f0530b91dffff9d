//! Corridors, and a part in another one, as sites: built, asked by SQL, tuned, closed, asked why, undone and served like any
//! other.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use std::path::PathBuf;
use std::process::Command;

use adit_tests::service::Service;
use adit_tests::{Ran, TestSite, adit};
use serde_json::{Value, json};

fn world(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../kb/worlds").join(name)
}

/// A site of a map of channels, as `adit new --map` makes it.
fn site_of(name: &str) -> TestSite {
    let site = TestSite::empty();
    let folder = site.path().join("new");
    let made = Command::new(adit()).arg("new").arg(&folder).arg("--map").arg(world(name)).output().unwrap();
    Ran::new(&made).expect_status(0);
    for file in ["site.toml", "rules/own.rhai", name] {
        site.write(file, std::fs::read(folder.join(file)).unwrap());
    }
    site
}

/// What the map alone answers.
fn alone(name: &str, ends: [&str; 2]) -> Value {
    let ran = Command::new(adit()).arg("route").arg(world(name)).args(ends).arg("--json").output().unwrap();
    Ran::new(&ran).expecting(0).json()
}

const STEPS: &str = "SELECT step, kind, place, action, round(cost, 3), rule FROM action_sequence
                     WHERE start = 'start' AND goal = 'goal' ORDER BY step";

#[test]
fn corridors_are_built_routed_tuned_asked_why_and_undone() {
    let site = site_of("corridors.toml");
    let built = site.adit("build", &[]).expecting(0);
    assert!(built.stdout.contains("6 channels, 8 junctions, routes from 2 starts"), "{}", built.stdout);
    assert!(!built.stderr.contains("waits for"), "{}", built.stderr);
    let route = site.adit("route", &["start", "goal"]).expecting(0).stdout;
    assert!(route.contains("start to goal, hardness 49"), "{route}");
    let first = [
        "1|line|channel 1|DRIVE|8.5|a passage weighs its length",
        "2|arc|junction 1|TURN-RIGHT|8.5|Lee, Table 2, row 1",
        "3|line|channel 2|DRIVE|35.5|a passage weighs its length",
        "4|arc|junction 3|TURN-RIGHT|35.5|Lee, Table 2, row 7",
        "5|line|channel 3|DRIVE|49.0|a passage weighs its length",
    ];
    assert_eq!(site.sqlite3(STEPS), first);
    let arcs = "SELECT turn, round(centre_x, 3), round(centre_y, 3) FROM waypoints
                WHERE start = 'start' AND goal = 'goal' AND turn IS NOT NULL ORDER BY waypoint";
    assert_eq!(site.sqlite3(arcs), ["right|3.0|17.0", "right|27.0|17.0"]);
    assert_eq!(site.sqlite3("SELECT count(*), sum(x1 - x0) FROM junctions"), ["8|24.0"]);

    let why = site.adit("why", &["junction 3 from start to goal"]).expecting(0).stdout;
    assert!(why.contains("corner_x is min, by rule \"Lee, Table 2, row 7\""), "{why}");
    assert!(why.contains("Lee, Table 2, row 5 did not speak: turn.onward is down, not \"up\""), "{why}");

    let preview = site.adit("tune", &["channels", "2", "closed", "1", "--dry-run"]).expecting(0).stdout;
    assert!(preview.contains("start to goal: 49 → 58.5, another way"), "{preview}");
    assert_eq!(site.sqlite3(STEPS), first, "a preview changes nothing");
    let tuned = site.adit("tune", &["channels", "2", "closed", "1", "--why", "painters"]).expecting(0).stdout;
    assert!(tuned.contains("start to goal: 49 → 58.5, another way"), "{tuned}");
    assert!(site.sqlite3(STEPS).iter().any(|step| step.contains("channel 4")), "through the narrow one");
    let why_not = site.adit("why-not", &["start", "goal", "--through", "channel 2"]).expecting(0).stdout;
    assert!(why_not.contains("channel 2 is closed"), "{why_not}");
    site.adit("undo", &[]).expect_status(0);
    assert_eq!(site.sqlite3(STEPS), first);
    let why_not = site.adit("why-not", &["start", "goal", "--through", "channel 4"]).expecting(0).stdout;
    assert!(why_not.contains("the way through channel 4 costs"), "{why_not}");
    site.adit("check", &[]).expect_status(0);
    site.adit("test", &[]).expect_status(0);
    site.adit("doctor", &[]).expect_status(0);
}

#[test]
fn what_was_edited_is_what_is_built_from_the_tables() {
    let site = site_of("corridors.toml").built();
    for edit in [
        ["channels", "4", "y1", "5"],
        ["vehicles", "robot", "gap", "0.25"],
        ["places", "goal", "y", "4"],
        ["vehicles", "robot", "width", "0.8"],
    ] {
        site.adit("tune", &edit).expect_status(0);
    }
    let all = "SELECT * FROM route; SELECT * FROM action_sequence; SELECT * FROM waypoints; SELECT * FROM junctions";
    let edited = site.sqlite3(all);
    site.adit("build", &[]).expect_status(0);
    assert_eq!(site.sqlite3(all), edited);
    assert!(edited.iter().any(|row| row.contains("|goal|")), "{edited:?}");
}

#[test]
fn a_named_tuning_and_a_place_of_site_toml_count() {
    let site = site_of("corridors.toml");
    let text = site.read("site.toml");
    site.write("site.toml", format!("{text}\n[[place]]\nname = \"dock\"\nat = [14.5, 5.5]\n"));
    site.adit("build", &[]).expect_status(0);
    assert_eq!(site.sqlite3("SELECT count(*) FROM route WHERE status = 'ok'"), ["6"]);
    site.adit("tuning", &["night", "set", "channels", "1", "closed", "1"]).expect_status(0);
    let on = site.adit("tuning", &["night", "on"]).expecting(0).stdout;
    assert!(on.contains("no route"), "{on}");
    let refused = site.sqlite3("SELECT DISTINCT status, reason FROM route WHERE start = 'start'");
    assert!(
        refused.iter().all(|row| row.starts_with("no_route|") && row.contains("channel 1 is closed")),
        "{refused:?}"
    );
    let none = site.adit("route", &["start", "dock"]).expecting(1).stdout;
    assert!(none.contains("channel 1 is closed"), "{none}");
    site.adit("tuning", &["night", "off"]).expect_status(0);
    site.adit("route", &["start", "dock"]).expect_status(0);
}

#[test]
fn a_channel_is_closed_by_name_for_a_time_and_rules_may_join_any_table() {
    let site = site_of("corridors.toml")
        .with("tables/wet.csv", "channel,since\n5,morning\n")
        .with(
            "rules/wet.rhai",
            "revise \"wet channels weigh more\" each passage in PASSAGES
                 each spot in WET where spot.channel == passage.channel
                 set passage.weight by * 3
             property CHANNELS.blocked from table, default false
             on \"what a robot found blocked is closed for an hour\" each channel in CHANNELS where channel.blocked
                 then { channel.closed = lasting(true, 3600); channel.blocked = (); }\n",
        )
        .built();
    let cost = "SELECT round(cost, 2) FROM route WHERE start = 'start' AND goal = 'goal'";
    let dry = site.sqlite3(cost);
    site.adit("close", &["channel 2", "--until", "2h", "--why", "painters"]).expect_status(0);
    let wet = site.adit("route", &["start", "14.5,5.5", "--json"]).expecting(0).json();
    assert_ne!(site.sqlite3(cost), dry);
    site.adit("open", &["channel 2"]).expect_status(0);
    assert_eq!(site.sqlite3(cost), dry);
    // 14.5 metres to the left end of the wet channel, whose metres count three times
    assert!(wet["cost"].as_f64().unwrap() > wet["distance"].as_f64().unwrap() * 1.1, "{wet}");
    let told = site.adit("tell", &["CHANNELS", "2", "blocked", "true"]).expecting(0).stdout;
    assert!(told.contains("what a robot found blocked is closed for an hour"), "{told}");
    assert_ne!(site.sqlite3(cost), dry);
    site.adit("close", &["channel 9"]).expecting(2).complains(&["nothing called `channel 9`"]);
}

#[test]
fn every_map_of_channels_answers_alone_what_its_site_answers() {
    for (name, ends) in [
        ("corridors.toml", ["start", "goal"]),
        ("corridor-L.toml", ["start", "goal"]),
        ("corridor-S.toml", ["start", "goal"]),
        ("corridor-U.toml", ["start", "goal"]),
        ("part.toml", ["assembled", "disassembled"]),
        ("part-from-outline.toml", ["assembled", "disassembled"]),
        ("part-in-space.toml", ["assembled", "disassembled"]),
    ] {
        let site = site_of(name).built();
        let route = site.adit("route", &[ends[0], ends[1], "--json"]).expecting(0).json();
        assert_eq!(route, alone(name, ends), "{name}");
        let pieces = route["steps"].as_array().unwrap().len();
        let kept = site.sqlite3(&format!(
            "SELECT count(*) FROM action_sequence WHERE start = '{}' AND goal = '{}'",
            ends[0], ends[1]
        ));
        assert_eq!(kept, [pieces.to_string()], "{name}");
        // back again
        let back = site.adit("route", &[ends[1], ends[0], "--json"]).expecting(0).json();
        assert_eq!(back["status"], "ok", "{name}: {back}");
    }
}

#[test]
fn a_part_goes_in_as_it_comes_out_and_its_gap_is_tuned() {
    let site = site_of("part.toml").built();
    let points = |start: &str, goal: &str| {
        site.sqlite3(&format!(
            "SELECT round(x, 6), round(z, 6) FROM waypoints WHERE start = '{start}' AND goal = '{goal}' ORDER BY waypoint"
        ))
    };
    let (out, mut back) = (points("assembled", "disassembled"), points("disassembled", "assembled"));
    back.reverse();
    assert_eq!(out, back);
    assert_eq!(out.first().map(String::as_str), Some("4.5|1.01"));
    let clearance =
        "SELECT round(min(clearance), 6) FROM waypoints WHERE start = 'assembled' AND waypoint > 2";
    let before = site.sqlite3(clearance);
    let tuned = site.adit("tune", &["parts", "part", "gap_x", "0.25"]).expecting(0).stdout;
    assert!(tuned.contains("assembled to disassembled"), "{tuned}");
    assert_ne!(points("assembled", "disassembled"), out);
    site.adit("undo", &[]).expect_status(0);
    assert_eq!((points("assembled", "disassembled"), site.sqlite3(clearance)), (out, before));
    let too_wide = site.adit("tune", &["parts", "part", "gap_x", "0.3"]).expecting(0).stdout;
    assert!(too_wide.contains("no route"), "{too_wide}");
    let why = site.adit("route", &["assembled", "disassembled"]).expecting(1).stdout;
    assert!(why.contains("the gap in x at junction 2 is 0.3, and at most 0.255 is possible"), "{why}");
    site.adit("route", &["assembled", "outside"]).expecting(2).complains(&["neither `assembled` nor"]);
}

#[test]
fn what_cannot_be_is_refused_and_nothing_is_lost() {
    let site = site_of("corridors.toml").built();
    let before = site
        .sqlite3("SELECT * FROM route; SELECT * FROM channels; SELECT * FROM vehicles; SELECT * FROM places");
    for (edit, words) in [
        (["channels", "2", "x1", "-4"], "channel 2 is [0, 17, -4, 20], expected x0 < x1"),
        (["vehicles", "robot", "width", "0"], "vehicles robot: width is `0`, expected more than 0"),
        (["vehicles", "robot", "width", "wide"], "holds numbers, and `wide` is none"),
        (["vehicles", "robot", "gap_by", "luck"], "gap_by is `luck`, expected `rules` or `safest`"),
        (["places", "goal", "x", "100"], "lies in no channel"),
    ] {
        // where a gap is given, it is not asked by what it is chosen
        if edit[2] == "gap_by" {
            site.adit("tune", &["vehicles", "robot", "gap", ""]).expect_status(0);
        }
        site.adit("tune", &edit).expecting(2).complains(&[words]);
        if edit[2] == "gap_by" {
            site.adit("undo", &[]).expect_status(0);
        }
    }
    site.adit("tune", &["channels", "2", "--remove"]).expecting(2).complains(&["are numbered 1, 2, ..."]);
    let after = site
        .sqlite3("SELECT * FROM route; SELECT * FROM channels; SELECT * FROM vehicles; SELECT * FROM places");
    assert_eq!(after, before);
    site.adit("route", &["start", "gaol"]).expecting(2).complains(&["`gaol` is no place and no point"]);
    site.adit("route", &["start", "8,8"]).expecting(2).complains(&["lies in no channel"]);
    site.adit("firm", &["start", "goal"]).expecting(2).complains(&["not cut into rooms"]);
    site.adit("why-not", &["start", "goal", "--through", "door 7"]).expecting(2).complains(&["`channel 1`"]);
    let text = site.read("site.toml");
    site.write("site.toml", format!("{text}rooms = \"by-state\"\n"));
    site.adit("build", &[]).expecting(2).complains(&["`rooms` is not a key"]);
    let broken = TestSite::empty();
    broken.write("broken.toml", "[corridor]\nchannels = [[0, 0, 3]]\n");
    let folder = broken.path().join("site");
    let made = Command::new(adit())
        .arg("new")
        .arg(&folder)
        .arg("--map")
        .arg(broken.path().join("broken.toml"))
        .output()
        .unwrap();
    Ran::new(&made).expecting(2).complains(&["a channel has 3 numbers", "broken.toml:2"]);
    assert!(!folder.exists(), "nothing is left of a site that could not be made");
}

#[test]
fn a_site_of_corridors_is_served() {
    let site = site_of("corridors.toml").built();
    let service = Service::start(&site);
    let (status, of) = service.ask("GET", "/api/site", None);
    assert_eq!(
        (status, &of["layout_kind"], &of["robots"]),
        (200, &json!("corridors"), &json!(["robot"])),
        "{of}"
    );
    let (status, route) = service.ask("GET", "/api/route?start=start&goal=goal", None);
    assert_eq!((status, &route["cost"]), (200, &json!(49.0)), "{route}");
    assert_eq!(route["waypoints"][2]["turn"], "right", "{route}");
    let edit = json!({"kind": "set", "table": "channels", "key": "2", "column": "closed", "value": 1});
    let asked = json!({"edits": [edit], "start": "start", "goal": "goal"});
    let (status, preview) = service.ask("POST", "/api/preview", Some(&asked));
    assert_eq!((status, &preview["routes"]["rerouted"]), (200, &json!(2)), "{preview}");
    assert_eq!(
        (&preview["before"]["cost"], &preview["route"]["cost"]),
        (&json!(49.0), &json!(58.5)),
        "{preview}"
    );
    let (status, done) = service.ask("POST", "/api/edits", Some(&json!({"edit": edit})));
    assert_eq!(status, 200, "{done}");
    let (_, route) = service.ask("GET", "/api/route?start=start&goal=goal", None);
    assert_eq!(route["cost"], 58.5, "{route}");
    let (status, why) = service.ask("GET", "/api/why?what=junction%202%20from%20start%20to%20goal", None);
    assert_eq!(status, 200, "{why}");
    let (status, not) = service.ask("GET", "/api/why-not?start=start&goal=goal&through=channel%205", None);
    assert_eq!(status, 200, "{not}");
    let (status, no) = service.ask("GET", "/api/route?start=start&goal=gaol", None);
    assert_eq!(status, 404, "{no}");
}

#[test]
fn no_way_through_a_channel_is_better_than_the_route_and_none_is_found_where_there_is_no_route() {
    let site = site_of("corridors.toml").built();
    let service = Service::start(&site);
    let (mut routes, mut refused) = (0, 0);
    // points of all channels, some of them close to walls
    let points = [
        "1.2,2", "1.5,18.8", "8,17.9", "29,19", "27.9,7", "20,3.7", "5,3.8", "14.5,14", "15.2,4.1", "22,10",
        "26,11.2",
    ];
    for (place, start) in points.iter().enumerate() {
        let goal = points[(place * 4 + 3) % points.len()];
        if *start == goal {
            continue;
        }
        let (status, route) = service.ask("GET", &format!("/api/route?start={start}&goal={goal}"), None);
        assert_eq!(status, 200, "{route}");
        let best = route["cost"].as_f64();
        for channel in 1..=6 {
            let asked = format!("/api/why-not?start={start}&goal={goal}&through=channel%20{channel}");
            let (status, not) = service.ask("GET", &asked, None);
            assert_eq!(status, 200, "{not}");
            match (best, not["cost"].as_f64()) {
                (Some(best), Some(cost)) => assert!(cost >= best - 1e-9, "{start} to {goal}: {not}"),
                (None, Some(_)) => panic!("{start} to {goal}: {route} {not}"),
                (_, None) => {}
            }
        }
        routes += usize::from(best.is_some());
        refused += usize::from(best.is_none());
    }
    assert!(routes >= 8, "{routes} found, {refused} refused");
}

#[test]
fn rules_that_fail_are_refused_and_what_they_do_not_say_closes_one_channel_alone() {
    let site = site_of("corridors.toml").built();
    let before = site.sqlite3("SELECT * FROM route");
    site.write(
        "rules/own.rhai",
        "rule \"stop\" priority 9 each p in PASSAGES where p.channel == 2
             then { if p.length > 1 { throw \"x\"; } p.passable = false; }\n",
    );
    site.adit("build", &[]).expecting(2).complains(&["own.rhai", "x"]);
    assert_eq!(site.sqlite3("SELECT * FROM route"), before, "nothing is half done");
    site.write(
        "rules/own.rhai",
        "rule \"disagree\" each p in PASSAGES where p.channel == 2 then { p.weight = 1.0; }\n",
    );
    site.adit("build", &[]).expect_status(0);
    let round = site.sqlite3("SELECT round(cost, 1) FROM route WHERE start = 'start' AND goal = 'goal'");
    assert_eq!(round, ["58.5"], "the other channels stay");
    site.write("rules/own.rhai", "");
    site.adit("build", &[]).expect_status(0);
    for (value, cell) in [("true", "1"), ("no", "0"), ("yes", "1"), ("0", "0")] {
        site.adit("tune", &["channels", "2", "closed", value]).expect_status(0);
        assert_eq!(site.sqlite3("SELECT closed FROM channels WHERE channel = 2"), [cell]);
    }
    site.adit("tune", &["channels", "2", "closed", "maybe"]).expecting(2).complains(&["is true or false"]);
    let text = site.read("site.toml");
    site.write("site.toml", format!("starts = [\"start\"]\n{text}"));
    site.adit("build", &[]).expect_status(0);
    assert_eq!(site.sqlite3("SELECT start, goal FROM route"), ["start|goal"]);
    site.adit("tuning", &["n", "set", "channels", "2", "closed", "yes"]).expect_status(0);
    let compared = site.adit("tuning", &["compare", "base", "n"]).expecting(0).stdout;
    assert!(compared.contains("49") && compared.contains("58.5"), "{compared}");
    site.adit("lay", &["obstacle", "x", "0.1,0.1 0.5,0.5"]).expecting(2).complains(&["not cut into rooms"]);
}

#[test]
fn what_is_open_is_not_opened_again_and_a_blocked_robot_closes_where_it_is() {
    let site = site_of("corridors.toml").built();
    let cost = "SELECT round(cost, 2) FROM route WHERE start = 'start' AND goal = 'goal'";
    let free = site.sqlite3(cost);
    site.adit("tune", &["channels", "2", "closed", "1"]).expect_status(0);
    site.adit("open", &["channel 2"]).expect_status(0);
    assert_eq!(site.sqlite3(cost), free);
    site.adit("open", &["channel 2"]).expecting(2).complains(&["`channel 2` is open already"]);
    assert_eq!(site.sqlite3(cost), free, "it does not close what is open");
    let blocked = site.adit("close", &["8,18@0"]).expecting(0).stdout;
    assert!(blocked.contains("start to goal"), "{blocked}");
    assert_ne!(site.sqlite3(cost), free);
    site.adit("close", &["1.5,18"]).expecting(2).complains(&["lies in channel 1 and in channel 2"]);
    site.adit("close", &["channel 2", "--only", "robot"])
        .expecting(2)
        .complains(&["rule of PASSAGES to say"]);
    let channel = site.adit("why", &["channel 1 from start to goal"]).expecting(0).stdout;
    assert!(channel.contains("weight is"), "{channel}");
}

#[test]
fn a_slip_in_a_rule_a_cell_or_the_map_is_named_and_nothing_is_lost() {
    let site = site_of("corridors.toml").built();
    let before = site.sqlite3("SELECT * FROM route");
    site.write("rules/own.rhai", "rule \"slip\"\n    each p in PASSAGES\n    then { p.weigth = 1.0; }\n");
    let checked = site.adit("check", &[]);
    let said = format!("{}{}", checked.stdout, checked.stderr);
    assert!(said.contains("sets PASSAGES.weigth") && said.contains("PASSAGES.weight"), "{said}");
    site.write("rules/own.rhai", "");
    for (statement, back, words) in [
        (
            "UPDATE vehicles SET gap = 'wide'",
            "UPDATE vehicles SET gap = 0.3",
            "column `gap` of table `vehicles` holds `wide`",
        ),
        (
            "UPDATE channels SET closed = 'maybe' WHERE channel = 2",
            "UPDATE channels SET closed = 0 WHERE channel = 2",
            "holds `maybe`, expected true or false",
        ),
        (
            "UPDATE channels SET x1 = NULL WHERE channel = 2",
            "UPDATE channels SET x1 = 30 WHERE channel = 2",
            "channel 2 has no `x1`, expected a number",
        ),
    ] {
        site.outside_edit(statement);
        site.adit("build", &[]).expecting(2).complains(&[words]);
        site.outside_edit(back);
        site.adit("build", &[]).expect_status(0);
        assert_eq!(site.sqlite3("SELECT * FROM route"), before);
    }
    // a word in the place of a truth value counts as what it says
    site.outside_edit("UPDATE channels SET closed = 'true' WHERE channel = 2");
    site.adit("build", &[]).expect_status(0);
    assert_ne!(site.sqlite3("SELECT * FROM route"), before);
    site.edit("corridors.toml", "[0, 0, 3, 20],", "[0, 0, 3],     ");
    site.adit("build", &[]).expecting(2).complains(&["corridors.toml:6", "a channel has 3 numbers"]);
    site.adit("history", &[]).expect_status(0);
    assert_ne!(site.sqlite3("SELECT * FROM route"), before, "what was there stays");
}

/// A loop about a block, with a gap of its own at the junction of two channels.
const LOOP: &str = "[corridor]
channels = [[0, 0, 2, 10], [0, 8, 12, 10], [10, 0, 12, 10], [0, 0, 12, 1.6], [5, 8, 7, 14]]
robot = { width = 0.8, length = 1.2 }
gap = 0.2
start = [1, 5]
goal = [11, 4]
";

#[test]
fn gaps_that_no_file_could_have_are_refused_and_a_junction_that_gets_another_number_is_said() {
    let site = TestSite::empty();
    site.write("loop.toml", LOOP);
    site.write("site.toml", "map = \"loop.toml\"\n");
    site.adit("build", &[]).expect_status(0);
    let before = site.sqlite3("SELECT * FROM gaps; SELECT * FROM vehicles");
    for (edit, said) in [
        (&["gaps", "9", "--add", "gap=0.2"][..], "gaps 9: junction is `9`, expected 1 to 5"),
        (&["vehicles", "robot", "gap", "-1"], "gap is `-1`, expected 0 or more metres"),
        (&["vehicles", "robot", "gap_by", "saffe"], "gap_by is `saffe`, expected `rules` or `safest`"),
    ] {
        site.adit("tune", edit).expecting(2).complains(&[said]);
    }
    assert_eq!(site.sqlite3("SELECT * FROM gaps; SELECT * FROM vehicles"), before);
    site.adit("tune", &["gaps", "5", "--add", "gap=0.3"]).expect_status(0);
    let crossing = ["channels", "6", "--add", "x0=7", "y0=8", "x1=9", "y1=14"];
    site.adit("tune", &crossing)
        .expecting(0)
        .complains(&["the gap of junction 5 was that of channels 3 and 4, and is that of channels 2 and 6"]);
}
