//! Named sets of edits are laid over the tables, switched, previewed and compared.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use adit_tests::TestSite;

const DOOR_4: &str = "SELECT round(hardness, 3) FROM doors WHERE door = 4";

fn with_night() -> TestSite {
    let site = TestSite::example("paper").built();
    site.adit("tuning", &["night", "set", "robots", "SQUAT", "hardness", "3"]).expect_status(0);
    site
}

#[test]
fn a_tuning_counts_while_it_is_on_and_the_table_stays() {
    let site = with_night();
    let before = site.sqlite3(DOOR_4);
    let preview = site.adit("tuning", &["night", "preview", "--json"]).expecting(0).json();
    assert_eq!((&preview["doors"]["changed"], &preview["dry_run"]), (&2.into(), &true.into()));
    assert_eq!(site.sqlite3(DOOR_4), before);
    site.adit("tuning", &["night", "on"]).expect_status(0);
    assert_eq!(site.sqlite3(DOOR_4), ["23.55"]);
    assert_eq!(site.sqlite3("SELECT hardness FROM robots WHERE state = 'SQUAT'"), ["4.0"]);
    assert_eq!(site.sqlite3("SELECT hardness FROM robots_in_force WHERE state = 'SQUAT'"), ["3.0"]);
    let columns = "robot, state, action, height, width, length, hardness, position";
    let others = format!(
        "SELECT count(*) FROM (SELECT {columns} FROM robots EXCEPT SELECT {columns} FROM robots_in_force)"
    );
    assert_eq!(site.sqlite3(&others), ["1"], "nothing else differs");
    site.adit("tuning", &["night", "off"]).expect_status(0);
    assert_eq!(site.sqlite3(DOOR_4), before);
}

#[test]
fn switching_and_setting_are_undone_like_any_edit() {
    let site = with_night();
    let before = site.sqlite3(DOOR_4);
    site.adit("tuning", &["night", "on", "--why", "20:00"]).expect_status(0);
    site.adit("tuning", &["night", "set", "robots", "SQUAT", "hardness", "2"]).expect_status(0);
    let low = site.sqlite3(DOOR_4);
    site.adit("undo", &[]).expect_status(0);
    assert_eq!(site.sqlite3(DOOR_4), ["23.55"]);
    site.adit("undo", &[]).expect_status(0);
    assert_eq!(site.sqlite3(DOOR_4), before);
    assert_ne!(low, before);
    assert_eq!(
        site.sqlite3("SELECT why FROM history WHERE table_name = 'active_tunings' AND id = 2"),
        ["20:00"]
    );
    site.adit("tuning", &["night", "unset", "robots", "SQUAT", "hardness"]).expect_status(0);
    site.adit("tuning", &["night", "on"]).expecting(2).complains(&["there is no tuning `night`"]);
}

#[test]
fn a_base_value_that_does_not_count_now_is_said_to_be_so() {
    let site = with_night();
    site.adit("tuning", &["night", "on"]).expect_status(0);
    site.adit("tune", &["robots", "SQUAT", "hardness", "9"])
        .expecting(0)
        .complains(&["robots.robot/SQUAT.hardness is 3 while the tuning `night` is on"]);
    assert_eq!(site.sqlite3(DOOR_4), ["23.55"]);
}

#[test]
fn two_tunings_that_disagree_are_not_on_together() {
    let site = with_night();
    site.adit("tuning", &["loaded", "set", "robots", "robot/SQUAT", "hardness", "6"]).expect_status(0);
    site.adit("tuning", &["night", "on"]).expect_status(0);
    site.adit("tuning", &["loaded", "on"])
        .expecting(2)
        .complains(&["`loaded` and `night` are both on", "6 and 3"]);
    assert_eq!(site.sqlite3("SELECT tuning FROM active_tunings"), ["night"]);
    site.adit("tuning", &["loaded", "set", "robots", "SQUAT", "hardness", "3"]).expect_status(0);
    site.adit("tuning", &["loaded", "on"]).expect_status(0);
}

#[test]
fn routes_of_two_tunings_stand_side_by_side() {
    let site = TestSite::example("hospital").built();
    site.adit("tuning", &["night", "set", "robots", "STAND", "hardness", "2"]).expect_status(0);
    let compared = site.adit("tuning", &["compare", "base", "night", "--json"]).expecting(0).json();
    let routes = compared["routes"].as_array().unwrap();
    assert!(!routes.is_empty());
    assert!(routes.iter().all(|route| route["one"].as_f64() <= route["other"].as_f64()));
    assert!(routes.iter().any(|route| route["one"].as_f64() < route["other"].as_f64()));
    assert!(site.sqlite3("SELECT * FROM active_tunings").is_empty(), "nothing was switched");
    site.adit("tuning", &["compare", "base", "nigt"]).expecting(2).complains(&["did you mean `night`?"]);
}

#[test]
fn what_a_table_would_refuse_a_tuning_cannot_set() {
    let site = with_night();
    for (words, said) in [
        (["night", "set", "robots", "SQUAT", "hardness", "-3"], "hardness must be finite and not negative"),
        (["night", "set", "robots", "SQUAT", "hardness", "soft"], "holds numbers, and `soft` is none"),
        (["night", "set", "robots", "SQUATT", "hardness", "3"], "did you mean `SQUAT`?"),
        (["night", "set", "robots", "SQUAT", "hardnes", "3"], "did you mean `hardness`?"),
        (["night", "set", "robots", "SQUAT", "state", "KNEEL"], "it is a part of the key"),
        (["night", "set", "rooms", "1", "hardness", "3"], "`rooms` is derived"),
        (["base", "set", "robots", "SQUAT", "hardness", "3"], "`base` stands for no tuning"),
    ] {
        site.adit("tuning", &words).expecting(2).complains(&[said]);
    }
    site.adit("tuning", &["night", "onn"]).expecting(2).complains(&["did you mean `on`?"]);
    site.adit("tuning", &["night", "off"]).expecting(2).complains(&["`night` is off already"]);
    assert_eq!(site.sqlite3("SELECT value FROM tuning_cells"), ["3.0"]);
    assert_eq!(site.sqlite3("SELECT hardness FROM robots WHERE state = 'SQUAT'"), ["4.0"]);
}

#[test]
fn what_is_undone_of_a_tuning_is_called_as_people_know_it() {
    let site = with_night();
    site.adit("tuning", &["night", "set", "robots", "SQUAT", "hardness", "4"]).expect_status(0);
    let undone = || site.adit("undo", &[]).expecting(0).stdout;
    let value = undone();
    assert!(value.starts_with("undone: tuning night: robots.robot/SQUAT.hardness: 4 → 3"), "{value}");
    let cell = undone();
    assert!(cell.starts_with("undone: tuning night: robots.robot/SQUAT.hardness is gone again"), "{cell}");
}
