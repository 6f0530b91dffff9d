//! Other programs write into the database, remove it, or fill the disk.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use std::fs::File;
use std::process::Command;

use adit_tests::{Ran, TestSite};

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
