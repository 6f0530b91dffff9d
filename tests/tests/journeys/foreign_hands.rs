//! Other programs write into the database, remove it, or fill the disk.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use std::fs::File;
use std::process::Command;

use adit_tests::{Ran, TestSite};

const STARTER: &str = "map = \"map.toml\"\nrobots = \"robots.toml\"\n";

/// A cleaning job deletes doors. Once, the rows that were left were taken for what the planner had made: every later
/// build kept them, and every route avoided half of the doors.
#[test]
fn deleted_rooms_and_doors_come_back_with_the_next_build() {
    let site = TestSite::example("clinic").built();
    let whole = site.sqlite3("SELECT door, room1, room2, x0, hardness FROM doors ORDER BY door");
    for edit in [
        "DELETE FROM doors WHERE door % 2 = 0",
        "UPDATE doors SET x0 = x0 - 1",
        "DELETE FROM rooms WHERE room = 1",
        "DELETE FROM doors; DELETE FROM rooms",
    ] {
        site.outside_edit(edit);
        site.adit("build", &[]).expect_status(0);
        assert_eq!(site.sqlite3("SELECT door, room1, room2, x0, hardness FROM doors ORDER BY door"), whole);
    }
}

const ROWS: &str = "SELECT * FROM rooms; SELECT * FROM doors";
const BLOCKS: &str = "SELECT class, part, at, first, hex(bytes) FROM blocks ORDER BY class, part, at";
/// Between two points no route is kept: rooms and doors are read.
const ASK: [&str; 2] = ["2,2.05", "15,4.05"];
const TUNE: [&str; 4] = ["robots", "SQUAT", "hardness", "4.5"];

/// Rooms and doors are read from blocks beside the rows: never from those of rows that somebody else has changed.
#[test]
fn a_row_that_another_program_changed_is_seen_by_route_and_tune() {
    let site = TestSite::example("clinic").built();
    let (rows, blocks) = (site.sqlite3(ROWS), site.sqlite3(BLOCKS));
    assert!(blocks.iter().any(|block| block.starts_with("doors|cut|0|1|")), "{blocks:?}");
    let answer = site.adit("route", &ASK).expecting(0).stdout;
    let tuned = site.copied();
    tuned.adit("tune", &TUNE).expect_status(0);
    let (tuned_rows, tuned_blocks) = (tuned.sqlite3(ROWS), tuned.sqlite3(BLOCKS));
    assert!(tuned_rows != rows && tuned_blocks != blocks);
    for edit in [
        "UPDATE doors SET hardness = 0.001, passable = 0",
        "UPDATE rooms SET hardness = 99 WHERE room = 2",
        "DELETE FROM doors WHERE door = 3",
        "REPLACE INTO rooms SELECT * FROM rooms WHERE room = 1",
    ] {
        let other = site.copied();
        other.outside_edit(edit);
        assert_eq!(other.adit("route", &ASK).expecting(0).stdout, answer, "{edit}");
        assert_eq!((other.sqlite3(ROWS), other.sqlite3(BLOCKS)), (rows.clone(), blocks.clone()), "{edit}");
        other.outside_edit(edit);
        other.adit("tune", &TUNE).expect_status(0);
        assert_eq!(other.sqlite3(ROWS), tuned_rows, "{edit}");
        assert_eq!(other.sqlite3(BLOCKS), tuned_blocks, "{edit}");
    }
}

/// A block that is damaged, or none, is no other answer: the rows are read.
#[test]
fn damaged_blocks_change_no_answer() {
    let site = TestSite::example("clinic").built();
    let answer = site.adit("route", &ASK).expecting(0).stdout;
    let tuned = site.copied();
    tuned.adit("tune", &TUNE).expect_status(0);
    for edit in [
        "UPDATE blocks SET bytes = CAST(substr(bytes, 1, 40) || x'2a2a' || substr(bytes, 43) AS BLOB)",
        "DELETE FROM blocks WHERE part = 'weights'",
        "DELETE FROM blocks",
    ] {
        let other = site.copied();
        other.outside_edit(edit);
        assert_eq!(other.adit("route", &ASK).expecting(0).stdout, answer, "{edit}");
        other.adit("tune", &TUNE).expect_status(0);
        assert_eq!(other.sqlite3(ROWS), tuned.sqlite3(ROWS), "{edit}");
    }
}

/// Untouched rooms are still kept: an edit of a hardness does not cut the map anew.
#[test]
fn untouched_rooms_are_kept() {
    let site = TestSite::example("clinic").built();
    let again = site.adit("build", &["--json"]).expecting(0).json();
    let stages = again["stages"].as_array().unwrap();
    let rooms = stages.iter().find(|stage| stage["stage"] == "rooms by state").unwrap();
    assert_eq!(rooms["kept"], true, "{again:#}");
}

#[test]
fn doctor_misses_a_table() {
    let site = TestSite::example("paper").built();
    site.outside_edit("PRAGMA foreign_keys = OFF; DROP TABLE doors; DROP TABLE stale_marks");
    let ran = site.adit("doctor", &[]).expecting(1);
    assert!(ran.stdout.contains("doors is missing"), "{}", ran.stdout);
}

#[test]
fn a_text_that_is_no_utf_8_is_found_by_table_and_column() {
    let site = TestSite::example("paper");
    site.copy_rules("paper");
    let site = site.built();
    site.outside_edit("CREATE TABLE wet (spot TEXT, x); INSERT INTO wet VALUES (CAST(x'ff' AS TEXT), 1.0)");
    site.write(
        "rules/wet.rhai",
        "revise \"wet\" each door in DOORS some spot in WET where spot.x == door.x set door.hardness by * 2.0 level 1\n",
    );
    site.adit("build", &[]).expecting(2).complains(&["wet", "spot", "row 1"]);
}

/// The disk is full: what was asked for cannot be written. Once, the program said nothing and ended with 0.
#[test]
fn an_answer_that_cannot_be_written_is_no_success() {
    let site = TestSite::example("paper").built();
    let full = File::options().write(true).open("/dev/full").unwrap();
    let mut command = Command::new(adit_tests::adit());
    command.args(["route"]).arg(site.path()).args(["f", "e"]).stdout(full);
    let ran = Ran::new(&command.output().unwrap());
    ran.expecting(2).complains(&["cannot write"]);
}

#[test]
fn a_folder_in_place_of_the_database() {
    let site = TestSite::example("paper");
    std::fs::create_dir(site.path().join("site.db")).unwrap();
    for verb in ["build", "history", "doctor"] {
        site.adit(verb, &[]).expecting(2).complains(&["site.db", "cannot be opened"]);
    }
}

#[test]
fn what_is_written_by_hand_and_counts_for_nothing_is_refused_or_said() {
    let site = TestSite::example("starter").with("site.toml", STARTER).built();
    for (sql, said) in [
        ("UPDATE doorways SET closed = 1", "doorways follow from the map"),
        ("DELETE FROM doorways", "doorways follow from the map"),
        ("UPDATE spaces SET name = 'salon'", "spaces follow from the map"),
        (
            "INSERT INTO spaces (space, area, breadth, x, y, outline) VALUES (9, 1, 1, 1, 1, '[]')",
            "spaces follow",
        ),
    ] {
        let ran = Command::new("sqlite3").arg(site.path().join("site.db")).arg(sql).output();
        let refused = String::from_utf8(ran.unwrap().stderr).unwrap();
        assert!(refused.contains(said), "{sql}: {refused}");
    }
    site.outside_edit("INSERT INTO places VALUES ('sink', 3, 7)");
    site.outside_edit("UPDATE rooms SET hardness = 50");
    site.outside_edit("UPDATE robots SET state = 'KNEEL' WHERE state = 'SQUAT'");
    site.outside_edit("INSERT INTO active_tunings VALUES ('nigth')");
    site.adit("build", &[]).expecting(0).complains(&[
        "another program wrote rows of rooms and places",
        "changes has rows of states that robots does not have: robot/SQUAT; they count for nothing",
        "the tuning `nigth` is on and sets nothing",
    ]);
    assert_eq!(site.sqlite3("SELECT count(*) FROM rooms WHERE hardness = 50"), ["0"]);
    site.outside_edit("INSERT INTO tuning_cells VALUES ('nigth', 'robots', 'STAND', 'hardness', 9)");
    site.adit("build", &[]).expecting(0).complains(&["a key is whole: `robot/STAND`"]);
    site.outside_edit("INSERT INTO tuning_cells VALUES ('nigth', 'rooms', '3', 'hardness', 9)");
    site.outside_edit("INSERT INTO loads VALUES ('robbot', 'bed', 1, 1, 0)");
    site.adit("build", &[]).expecting(0).complains(&[
        "tunings set what nobody tunes",
        "rooms.3.hardness; it counts for nothing",
        "loads has rows of robots that do not exist: robbot; they count for nothing",
    ]);
    site.outside_edit("DELETE FROM robots");
    site.adit("build", &[]).expecting(0).complains(&[
        "the table robots was empty: robots, changes and loads are as",
        "robots.toml has them again",
    ]);
}

#[test]
fn a_fact_that_its_property_cannot_hold_or_that_nobody_reads_is_said_and_stops_nothing() {
    let site = TestSite::example("starter").with("site.toml", STARTER).built();
    let before = site.sqlite3("SELECT * FROM doors");
    let told = "INSERT INTO told (class, key, x, y, property, kind, value) VALUES";
    site.outside_edit(&format!(
        "{told} ('DOORS', NULL, 6, 3.5, 'passable', 'text', 'no'), ('ROBOTS', 'robot/STAND', NULL, NULL, 'hardnes', \
         'number', 3), ('DOORWAYS', NULL, 6, 3.5, 'closed_to', 'truth', 1)"
    ));
    site.adit("build", &[]).expecting(0).complains(&[
        "DOORS.passable holds truth values, and `no` is none",
        "no rule reads ROBOTS.hardnes, and nothing gives it; did you mean `hardness`?",
        "DOORWAYS.closed_to holds texts, and `true` is none",
    ]);
    assert_eq!(site.sqlite3("SELECT * FROM doors"), before);
    assert_eq!(site.sqlite3("SELECT told || state FROM told_states"), ["1lost", "2attached", "3lost"]);
    site.adit("check", &[]).expecting(1).complains(&["counts for nothing", "--retract ID"]);
    site.adit("tell", &["--retract", "1"]).expect_status(0);
    site.adit("tell", &["--retract", "3"]).expect_status(0);
    assert_eq!(site.sqlite3("SELECT told || state FROM told_states"), ["2attached"]);
}

#[test]
fn a_row_of_told_names_a_doorway_or_a_space_as_people_do_or_by_a_point() {
    let site = TestSite::example("starter").with("site.toml", STARTER).built();
    let by = |class: &str, column: &str, value: &str| {
        let columns = format!("class, {column}, property, kind, value");
        site.outside_edit(&format!(
            "INSERT INTO told ({columns}) VALUES ('{class}', {value}, 'closed', 'truth', 1)"
        ));
        site.adit("build", &[]).expect_status(0);
        let closed = site.sqlite3("SELECT closed FROM doorways");
        site.outside_edit("DELETE FROM told");
        site.adit("build", &[]).expect_status(0);
        closed
    };
    assert_eq!(by("DOORWAYS", "key", "'doorway 1'"), ["1"]);
    assert_eq!(by("DOORWAYS", "x, y", "6, 3.5"), ["1"]);
    assert_eq!(by("DOORWAYS", "x, y", "6, 6"), [""]);
    assert_eq!(by("SPACES", "key", "'home'"), ["1"]);
}

#[test]
fn what_others_edited_is_no_part_of_what_an_edit_is_said_to_change() {
    let site = TestSite::example("starter").with("site.toml", STARTER).built();
    let said = |args: &[&str]| {
        let ran = site.adit(args[0], &args[1..]).expecting(0);
        ran.complains(&["edited by others since the last build: that was taken in first"]);
        ran.stdout
    };
    let close = "INSERT INTO told (class, x, y, property, kind, value) VALUES ('DOORWAYS', 6, 3.5, 'closed', 'truth', 1)";
    site.outside_edit("UPDATE robots SET hardness = 9 WHERE state = 'SQUAT'");
    site.outside_edit(close);
    let tune = ["tune", "robots", "SIDE-STAND", "hardness", "2.5"];
    for more in [&["--dry-run"][..], &[]] {
        let said = said(&[&tune[..], more].concat());
        assert!(said.contains("2 → 2.5") && !said.contains("→ 9"), "{said}");
        assert!(!said.contains("lost") && !said.contains("is closed"), "{said}");
        if more.is_empty() {
            break;
        }
    }
    assert_eq!(
        site.sqlite3("SELECT status FROM route WHERE start = 'home' AND goal = 'window'"),
        ["no_route"]
    );
    site.outside_edit("DELETE FROM told");
    let undone = said(&["undo"]);
    assert!(undone.contains("2.5 → 2") && !undone.contains("possible again"), "{undone}");
}
