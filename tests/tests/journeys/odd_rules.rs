//! Rules that say nothing, or nonsense, of a room: no route leads through what nobody has weighed, and whoever wrote
//! the rule is told which one it is.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use adit_tests::TestSite;

const WEIGHED: &str = "room.hardness = state.hardness;";

/// The clinic with its rules copied, and another hardness of rooms.
fn clinic(hardness: &str) -> TestSite {
    let site = TestSite::example("clinic");
    site.copy_rules("by-state");
    site.edit("rules/rooms.rhai", WEIGHED, hardness);
    site
}

/// A rule file of another author begins with a byte order mark, as editors of Windows write it.
#[test]
fn a_byte_order_mark_is_no_part_of_a_rule_file() {
    let site = clinic(WEIGHED);
    site.write("rules/more.rhai", "\u{feff}// nothing yet\n");
    site.adit("build", &[]).expect_status(0);
}

/// The expert forgets a state: its rooms have no hardness. Once, such rooms cost nothing, and every route went there.
#[test]
fn a_room_of_unknown_hardness_is_not_entered() {
    let some = "if state.state != \"SQUAT\" { room.hardness = state.hardness; }";
    let site = clinic(some).built();
    let route = site.adit("route", &["dock", "ward 12", "--json"]).expecting(0).json();
    let steps = route["steps"].as_array().unwrap();
    assert!(steps.iter().all(|step| step["state"] != "SQUAT"), "{route:#}");
    assert_eq!(site.sqlite3("SELECT count(*) FROM action_sequence WHERE state = 'SQUAT'"), ["0"]);
}

#[test]
fn where_no_room_has_a_hardness_the_answer_says_so() {
    let site = clinic("room.hardness = ();").built();
    let route = site.adit("route", &["dock", "ward 12", "--json"]).expecting(1).json();
    assert!(route["reason"].as_str().unwrap().contains("has no hardness"), "{route:#}");
}

#[test]
fn a_negative_or_endless_hardness_names_its_rule() {
    for (hardness, found) in [("-1.0", "-1"), ("1.0 / 0.0", "inf"), ("1e308", "1e308")] {
        let site = clinic(&format!("room.hardness = {hardness};"));
        site.adit("build", &[]).expecting(2).complains(&["a room is as hard as its state", "room", found]);
        assert!(!site.path().join("site.db").exists());
    }
}

#[test]
fn a_hardness_in_words_names_its_rule() {
    let site = clinic("room.hardness = \"much\";");
    // where a rule revises the hardness, the revision that cannot be is said first
    site.adit("build", &[])
        .expecting(2)
        .complains(&["a revision changes numbers; `room.hardness` holds texts"]);
    for revising in ["overlays", "zones"] {
        std::fs::remove_file(site.path().join(format!("rules/{revising}.rhai"))).unwrap();
    }
    site.adit("build", &[]).expecting(2).complains(&["a room is as hard as its state", "numbers", "texts"]);
}

/// `check` said that all is in order where no build could work.
#[test]
fn check_finds_that_the_rule_base_is_empty() {
    let site = TestSite::example("clinic");
    std::fs::create_dir(site.path().join("empty")).unwrap();
    let empty = site.path().join("empty").display().to_string();
    site.adit("check", &["--rules", &empty]).expecting(1).complains(&["there is no rule in"]);
    site.adit("check", &[]).expect_status(0);
}
