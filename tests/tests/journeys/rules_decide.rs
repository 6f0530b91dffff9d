//! Rules decide, Rust computes: what a domain expert changes in a text editor changes the answer, with no build.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use std::process::Command;

use adit_tests::{Ran, TestSite, repository};

const ROUTE: &str = "SELECT group_concat(place, ' ') FROM \
                     (SELECT place FROM action_sequence WHERE start = 'f' AND goal = 'e' ORDER BY step)";

fn example_with_own_rules() -> TestSite {
    let site = TestSite::example("paper");
    site.copy_rules("paper");
    site
}

#[test]
fn a_changed_rule_changes_the_route() {
    let site = example_with_own_rules().built();
    assert_eq!(site.sqlite3(ROUTE), ["f 7 d 3 b 4 e"]);
    // somebody finds that walking on the knees wears the joints, and says so in the rule
    site.edit(
        "rules/doors.rhai",
        "second.hardness + through.hardness;",
        "second.hardness + through.hardness + if through.action == \"WALK-ON-KNEE\" { 100.0 } else { 0.0 };",
    );
    site.adit("build", &[]).expect_status(0);
    assert_eq!(site.sqlite3(ROUTE), ["f 7 d 8 g 6 c 5 e"]);
}

#[test]
fn rules_from_another_folder_are_tried_without_touching_the_site() {
    let site = example_with_own_rules();
    site.edit("rules/doors.rhai", "door.distance1 * first.hardness +", "1.0 +");
    let shipped = repository().join("rules/rooms/paper");
    site.adit("build", &["--rules", shipped.to_str().unwrap()]).expect_status(0);
    assert_eq!(site.sqlite3("SELECT round(hardness, 3) FROM doors WHERE door = 7"), ["27.002"]);
}

#[test]
fn without_the_hardness_rule_doors_have_no_hardness_and_a_message_says_so() {
    let site = example_with_own_rules();
    std::fs::remove_file(site.path().join("rules/doors.rhai")).unwrap();
    let ran = site.adit("build", &[]).expecting(0);
    ran.complains(&["DOORS.hardness", "8 doors"]);
    assert_eq!(site.sqlite3("SELECT count(*), count(hardness), count(action) FROM doors"), ["8|0|0"]);
    assert_eq!(site.sqlite3("SELECT status FROM route WHERE start = 'f' AND goal = 'e'"), ["no_route"]);
}

#[test]
fn no_rust_file_knows_a_state_or_its_hardness() {
    let words = ["IMPOSSIBLE", "NO-ACTION", "10000", "STAND", "SQUAT"];
    for folder in ["engine/src", "planners/src", "db/src", "db/sql", "kb/src"] {
        let ran =
            Command::new("grep").arg("-rnE").arg(words.join("|")).arg(repository().join(folder)).output();
        let found: Vec<String> = Ran::new(&ran.unwrap())
            .stdout
            .lines()
            .filter(|line| {
                !line.contains("/tests/")
                    && !line.contains("//")
                    && !line.contains("100000")
                    && !line.contains("BASE64_STANDARD")
                    && !line.contains("adit tune")
                    && !line.contains("{adit} tune")
            })
            .map(str::to_owned)
            .collect();
        assert!(found.is_empty(), "{found:#?}");
    }
}

/// A table of the site's own, filled by any program, is a class that rules use by its name.
const WET_FLOORS: &str = "import sqlite3, sys
db = sqlite3.connect(sys.argv[1])
db.execute('CREATE TABLE IF NOT EXISTS wet_floors (spot INTEGER PRIMARY KEY, room TEXT)')
db.execute('INSERT INTO wet_floors (room) VALUES (?)', ('b',))
db.commit()";

#[test]
fn a_table_filled_from_python_changes_a_route_through_a_rule() {
    let site = example_with_own_rules().built();
    let mut python = Command::new("python3");
    python.args(["-c", WET_FLOORS]).arg(site.path().join("site.db"));
    Ran::new(&python.output().unwrap()).expect_status(0);
    site.write(
        "rules/wet.rhai",
        r#"rule "where a door stands"
    each door   in DOORS
    some first  in ROOMS where first.room == door.room1
    some second in ROOMS where second.room == door.room2
    then { door.name1 = first.name; door.name2 = second.name; }

revise "wet floors are slippery"
    each door in DOORS
    some spot in WET_FLOORS where spot.room == door.name1 || spot.room == door.name2
    set door.hardness by * 3.0 level 10
"#,
    );
    site.adit("build", &[]).expect_status(0);
    assert_eq!(site.sqlite3(ROUTE), ["f 7 d 8 g 6 c 5 e"]);
    let why =
        site.sqlite3("SELECT witness FROM conclusions WHERE object = 'doors.3' AND property = 'hardness'");
    assert!(why[0].contains("\"revised by\":[\"wet floors are slippery\"]"), "{why:?}");
    // from now on an edit of that table marks the routes stale, whoever makes it
    site.outside_edit("DELETE FROM wet_floors");
    assert_eq!(site.sqlite3("SELECT status FROM route WHERE start = 'f' AND goal = 'e'"), ["stale"]);
    site.adit("build", &[]).expect_status(0);
    assert_eq!(site.sqlite3(ROUTE), ["f 7 d 3 b 4 e"]);
}

#[test]
fn a_misspelt_property_is_found_by_check() {
    let site = example_with_own_rules().built();
    site.edit("rules/doors.rhai", "door.hardness = door.distance1", "door.hardnes = door.distance1");
    site.adit("check", &[]).expecting(1).complains(&["DOORS.hardnes", "DOORS.hardness"]);
}

#[test]
fn a_state_that_another_one_beats_everywhere_is_found_by_check() {
    let site = TestSite::example("paper").built();
    site.adit("check", &[]).expect_status(0);
    // lying down fits wherever squatting fits, and now it is less hard
    site.adit("tune", &["robots", "LIE-FACE-DOWN", "hardness", "3"]).expect_status(0);
    let said = site.adit("check", &[]).expecting(1);
    said.complains(&["robot/SQUAT can never be `first`, `second` or `through` in rule \"weigh a door\""]);
    let problems = site.adit("check", &["--json"]).expecting(1).json();
    let never: Vec<&str> = problems
        .as_array()
        .unwrap()
        .iter()
        .filter(|problem| problem["code"] == "rule/never-chosen" && problem["severity"] == "warning")
        .map(|problem| problem["message"].as_str().unwrap())
        .collect();
    assert_eq!(never.len(), 2, "one a rule: {problems:#}");
    assert!(never.iter().all(|said| said.contains("robot/LIE-FACE-DOWN comes before it")), "{never:?}");
}

#[test]
fn rules_that_react_make_no_doors_and_rules_that_conclude_read_no_routes() {
    let site = example_with_own_rules();
    site.write(
        "rules/mine.rhai",
        "on \"a door is made\" each door in DOORS where door.width < 1 then { tell(\"DOORS\", #{ door: 1 }); }\n",
    );
    site.adit("build", &[]).expecting(2).complains(&["new objects of DOORS", "not for rules to say"]);
    site.write(
        "rules/mine.rhai",
        "rule \"far\" each room in ROOMS each route in ROUTES where route.cost > 5 then { room.hardness = 2; }\n",
    );
    site.adit("build", &[]).expecting(2).complains(&["rule \"far\" reads ROUTES", "say it with `on`"]);
}

#[test]
fn rules_that_disagree_close_a_room_instead_of_making_it_free() {
    // an expert added a second rule for the hardness of some rooms: unknown was walked for nothing
    let site = TestSite::example("hospital");
    site.copy_rules("by-state");
    site.write(
        "rules/mine.rhai",
        "rule \"the corridor is harder\"
    each room in ROOMS where room.state == \"STAND\" && room.y0 > 11.0 && room.y1 < 15.0
    then { room.hardness = 5.0; }
",
    );
    site.adit("build", &[]).expecting(0).complains(&["rules disagree", "no route enters them"]);
    let through = site.sqlite3(
        "SELECT count(*) FROM action_sequence s JOIN rooms r ON r.name = s.place
         WHERE start = 'dock' AND goal = 'ward 6' AND s.kind = 'room' AND r.hardness IS NULL",
    );
    assert_eq!(through, ["0"]);
}
