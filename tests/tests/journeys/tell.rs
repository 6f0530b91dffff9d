//! What people and robots tell stands before what rules conclude, until it ends or is taken back.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use adit_tests::TestSite;

/// The paper's example: the route from f to e leads through door 7.
fn built() -> TestSite {
    TestSite::example("paper").built()
}

fn way(site: &TestSite) -> String {
    let doors = "SELECT group_concat(place, ' ') FROM (SELECT place FROM action_sequence
                 WHERE start = 'f' AND goal = 'e' AND kind = 'door' ORDER BY step)";
    site.sqlite3(doors).concat()
}

fn close(site: &TestSite, door: &str, more: &[&str]) -> adit_tests::Ran {
    site.adit("tell", &[&["doors", door, "passable", "false"], more].concat())
}

#[test]
fn a_closed_door_is_not_passed_until_it_is_taken_back() {
    let site = built();
    let before = way(&site);
    assert!(before.contains('7'), "{before}");
    let told = close(&site, "door 7", &["--why", "a spill", "--json"]).expecting(0).json();
    assert_eq!(told["doors"]["changed"], 1);
    assert!(!way(&site).contains('7'), "{}", way(&site));
    assert_eq!(site.sqlite3("SELECT passable, passable_rule FROM doors WHERE door = 7"), ["0|"]);
    let listed = site.adit("tell", &["--list", "--json"]).expecting(0).json();
    assert_eq!(listed[0]["state"], "attached");
    assert_eq!(listed[0]["objects"], "[\"7\"]");
    assert_eq!((&listed[0]["value"], &listed[0]["why"]), (&"false".into(), &"a spill".into()));
    site.adit("tell", &["--retract", "1"]).expect_status(0);
    assert_eq!(way(&site), before);
    assert_eq!(site.adit("tell", &["--list", "--json"]).expecting(0).json(), serde_json::json!([]));
}

#[test]
fn telling_and_retracting_are_in_the_history_and_can_be_undone() {
    let site = built();
    let before = way(&site);
    close(&site, "7", &[]).expect_status(0);
    let closed = way(&site);
    site.adit("undo", &[]).expect_status(0);
    assert_eq!(way(&site), before);
    close(&site, "7", &[]).expect_status(0);
    site.adit("tell", &["--retract", "2"]).expect_status(0);
    site.adit("undo", &[]).expect_status(0);
    assert_eq!(way(&site), closed, "taking a retraction back tells it again");
    assert_eq!(site.sqlite3("SELECT count(*) FROM history WHERE table_name = 'told'"), ["5"]);
}

#[test]
fn a_dry_run_tells_nothing() {
    let site = built();
    let before = way(&site);
    let dry = close(&site, "7", &["--dry-run", "--json"]).expecting(0).json();
    assert_eq!((&dry["dry_run"], &dry["doors"]["changed"]), (&true.into(), &1.into()));
    assert_eq!(way(&site), before);
    assert!(site.sqlite3("SELECT * FROM told").is_empty());
}

#[test]
fn a_state_is_told_by_its_key_and_the_newest_fact_that_holds_counts() {
    let site = built();
    let hardness =
        |site: &TestSite| site.sqlite3("SELECT round(hardness, 3) FROM doors WHERE door = 4").concat();
    let before = hardness(&site);
    site.adit("tell", &["ROBOTS", "SQUAT", "hardness", "3"]).expect_status(0);
    assert_eq!(hardness(&site), "23.55");
    site.adit("tell", &["Robots", "robot/SQUAT", "hardness", "4", "--until", "3 days"]).expect_status(0);
    assert_eq!(hardness(&site), before);
    site.adit("build", &["--at", "4 days"]).expect_status(0);
    assert_eq!(hardness(&site), "23.55", "the later fact is over, the first one holds again");
    assert_eq!(site.sqlite3("SELECT hardness FROM robots WHERE state = 'SQUAT'"), ["4.0"], "the table stays");
}

#[test]
fn a_fact_ends_by_itself() {
    let site = built();
    let before = way(&site);
    close(&site, "7", &["--until", "2h"]).expect_status(0);
    assert_eq!(site.sqlite3("SELECT status FROM route WHERE start = 'f' AND goal = 'e'"), ["no_route"]);
    let later = site.adit("route", &["f", "e", "--at", "3h", "--json"]).expecting(0).json();
    assert!(later["steps"].as_array().unwrap().iter().any(|step| step["place"] == "7"));
    assert!(!way(&site).contains('7'), "the question about later left the site as it is");
    // as if the two hours had passed since the last build
    let past = "UPDATE told SET until = '2020-01-01T00:00:00Z'; DELETE FROM stale_marks;
                UPDATE site SET value = '2020-01-01T00:00:00Z' WHERE key = 'valid_until'";
    site.outside_edit(past);
    assert_eq!(site.sqlite3("SELECT status FROM route WHERE start = 'f' AND goal = 'e'"), ["stale"]);
    site.adit("route", &["f", "e"]).expect_status(0);
    assert_eq!(way(&site), before);
    assert_eq!(site.sqlite3("SELECT state FROM facts_told"), ["expired"]);
    assert_eq!(site.sqlite3("SELECT status FROM route WHERE start = 'f' AND goal = 'e'"), ["ok"]);
}

#[test]
fn rules_read_what_is_told_of_a_property_that_they_declare() {
    let site = TestSite::example("paper");
    site.copy_rules("paper");
    site.write(
        "rules/spills.rhai",
        "property ROOMS.spill from table, default false\n\
         revise \"spills are slippery\"\n    each door in DOORS\n    \
         some room in ROOMS where (room.room == door.room1 || room.room == door.room2) && room.spill\n    \
         set door.hardness by * 10.0 level 10\n",
    );
    let site = site.built();
    let all = |site: &TestSite| site.sqlite3("SELECT sum(hardness) FROM doors").concat();
    let before = all(&site);
    site.adit("tell", &["ROOMS", "room d", "spill", "true"]).expect_status(0);
    assert_ne!(all(&site), before);
    site.adit("tell", &["--retract", "1"]).expect_status(0);
    assert_eq!(all(&site), before, "the rule still stands when nothing is told of its property");
}

#[test]
fn a_fact_about_an_object_that_is_gone_is_reported_and_found_again() {
    let site = built();
    site.outside_edit(
        "CREATE TABLE lifts (lift TEXT PRIMARY KEY, works BOOLEAN); INSERT INTO lifts VALUES ('north', 1)",
    );
    site.copy_rules("paper");
    site.write(
        "rules/lifts.rhai",
        "revise \"a lift that does not work makes doors harder\"\n    each door in DOORS\n    \
         some lift in LIFTS where !lift.works\n    set door.hardness by * 2.0 level 10\n",
    );
    site.adit("build", &[]).expect_status(0);
    let sum = |site: &TestSite| site.sqlite3("SELECT sum(hardness) FROM doors").concat();
    let before = sum(&site);
    site.adit("tell", &["LIFTS", "nort", "works", "false"])
        .expecting(2)
        .complains(&["LIFTS has no object `nort`", "did you mean `north`?"]);
    site.adit("tell", &["LIFTS", "north", "works", "false"]).expect_status(0);
    let told = sum(&site);
    assert_ne!(told, before);
    site.outside_edit("UPDATE lifts SET lift = 'south'");
    let built = site.adit("build", &["--json"]).expecting(0);
    assert!(built.json()["lost"][0].as_str().unwrap().contains("LIFTS has no `north`"), "{}", built.stdout);
    assert_eq!(sum(&site), before);
    site.adit("route", &["f", "e"]).expecting(0).complains(&["fact 1", "is lost"]);
    let found = site.adit("check", &["--json"]).expecting(1).json();
    assert!(found.as_array().unwrap().iter().any(|problem| problem["code"] == "tell/lost"), "{found}");
    assert_eq!(site.adit("doctor", &["--json"]).expecting(0).json()["lost"].as_array().unwrap().len(), 1);
    assert_eq!(site.sqlite3("SELECT state FROM facts_told"), ["lost"]);
    site.outside_edit("UPDATE lifts SET lift = 'north'");
    site.adit("build", &[]).expect_status(0);
    assert_eq!(sum(&site), told, "it is found again");
}

#[test]
fn what_cannot_be_told_is_refused_with_what_was_meant() {
    let site = built();
    for (words, said) in [
        (["DOOR", "7", "passable", "false"], "did you mean `DOORS`?"),
        (["DOORS", "99", "passable", "false"], "there are 8 doors"),
        (["DOORS", "2,2", "passable", "false"], "no door is within 0.5 m of 2,2"),
        (["DOORS", "7", "pasable", "false"], "did you mean `passable`?"),
        (["DOORS", "7", "passable", "maybe"], "holds truth values (true or false), and `maybe` is none"),
        (["DOORS", "7", "hardness", "soft"], "holds numbers, and `soft` is none"),
        (["DOORS", "7", "door", "3"], "says which object it is"),
        (["ROOMS", "zz", "hardness", "3"], "there is no room `zz`"),
        (["ROBOTS", "SQUATT", "hardness", "3"], "did you mean `SQUAT`?"),
        (["PRIME_AREAS", "3", "open", "true"], "numbered anew by each build"),
    ] {
        site.adit("tell", &words).expecting(2).complains(&[said]);
    }
    close(&site, "7", &["--until", "2020-01-01"]).expecting(2).complains(&["and that is over"]);
    close(&site, "7", &["--until", "soon"]).expecting(2).complains(&["`soon` is no time"]);
    site.adit("tell", &["--retract", "3"]).expecting(2).complains(&["there is no fact 3"]);
    site.adit("tell", &["DOORS", "7"]).expecting(2).complains(&["a fact is CLASS OBJECT PROPERTY VALUE"]);
    assert!(site.sqlite3("SELECT * FROM told").is_empty());
    assert!(site.sqlite3("SELECT * FROM history").is_empty());
}

/// The starter's two rooms, with the doorway named and the west room an area.
fn with_names() -> TestSite {
    let site = TestSite::example("starter");
    let text = "map = \"map.toml\"\nrobots = \"robots.toml\"\n[[door]]\nname = \"gate\"\nfrom = [6.0, 3.0]\n\
                to = [6.0, 4.0]\n[[area]]\nname = \"east\"\nrect = [6.5, 0.0, 12.0, 8.0]\n";
    site.write("site.toml", text);
    site
}

#[test]
fn a_named_door_is_closed_in_every_layer_and_stays_so_when_the_map_changes() {
    let site = with_names().built();
    let status =
        |site: &TestSite| site.sqlite3("SELECT status FROM route WHERE start = 'home' AND goal = 'window'");
    assert_eq!(status(&site), ["ok"]);
    site.adit("tell", &["named_doors", "gate", "closed", "true"]).expect_status(0);
    assert_eq!(status(&site), ["no_route"]);
    site.edit("map.toml", "rect = [5.9, 0.0, 6.1, 3.0]", "rect = [5.8, 0.0, 6.2, 2.9]");
    site.adit("build", &[]).expect_status(0);
    assert_eq!(status(&site), ["no_route"]);
    site.edit("site.toml", "\"gate\"", "\"door\"");
    site.adit("build", &[]).expecting(0).complains(&["NAMED_DOORS has no `gate`"]);
    assert_eq!(status(&site), ["ok"]);
}

#[test]
fn a_named_area_is_told_to_be_kept_out_of() {
    let site = with_names().built();
    site.adit("tell", &["AREAS", "east", "kind", "keep-out", "--until", "2h"]).expect_status(0);
    let where_kept_out = "SELECT state, round(min(x0), 2) FROM rooms WHERE NOT passable GROUP BY state";
    // The area begins at 6.5 m; each state's middle keeps its half width from it.
    assert_eq!(site.sqlite3(where_kept_out), ["SIDE-STAND|6.32", "SQUAT|6.1", "STAND|6.2"]);
    site.adit("route", &["home", "11,2"]).expect_status(1);
    site.adit("route", &["home", "11,2", "--at", "3h"]).expect_status(0);
}
