//! What people say and may not mean is answered, and what is as it was is not told anew.

use adit_tests::TestSite;

fn clinic() -> TestSite {
    TestSite::example("clinic").built()
}

#[test]
fn what_is_open_already_is_not_told_to_be_open() {
    let site = clinic();
    for what in ["30,8", "doorway 54", "37.9,30.3"] {
        site.adit("open", &[what]).expecting(2).complains(&[&format!("`{what}` is open already")]);
    }
    assert_eq!(site.sqlite3("SELECT count(*) FROM told"), ["0"]);
    site.adit("close", &["doorway 54"]).expect_status(0);
    site.adit("open", &["37.9,30.3"]).expect_status(0);
    assert_eq!(site.sqlite3("SELECT count(*) FROM told"), ["0"]);
}

#[test]
fn a_time_of_day_is_said_with_its_day() {
    let site = clinic();
    let said = site.adit("close", &["doorway 54", "--until", "18:00"]).expecting(0).stdout;
    let until = site.sqlite3("SELECT until FROM told").concat();
    assert!(until.ends_with("T18:00:00Z"), "{until}");
    assert!(said.contains(&format!("is closed until 18:00 ({until})")), "{said}");
    let said = site.adit("close", &["doorway 55", "--until", "2h"]).expecting(0).stdout;
    assert!(said.contains("is closed for 2h (until 2"), "{said}");
}

#[test]
fn a_hardness_below_nothing_is_refused_as_it_is_told() {
    let site = clinic();
    let refused = ["ROOMS.hardness holds numbers that are not negative", "`-5`"];
    site.adit("tell", &["ROOMS", "b", "hardness", "-5"]).expecting(2).complains(&refused);
}

#[test]
fn a_misspelt_property_of_an_area_is_named() {
    let site = TestSite::example("clinic");
    let map = site.read("map.toml");
    site.write(
        "map.toml",
        format!("{map}\n[[area]]\nname = \"puddle\"\nrect = [2, 2, 3, 3]\nhardnes_factor = 3\n"),
    );
    let note = ["no rule reads `hardnes_factor` of the area `puddle`", "did you mean `hardness_factor`?"];
    site.adit("build", &[]).expecting(0).complains(&note);
}

#[test]
fn a_state_without_a_price_of_its_changes_is_said_to_have_none() {
    let site = clinic();
    let roll = ["robots", "ROLL", "--add", "action=ROLL", "height=1", "width=0.5", "hardness=2"];
    site.adit("tune", &roll).expecting(0).complains(&["what it costs robot to change into ROLL"]);
}

#[test]
fn tables_that_come_from_their_files_again_say_what_that_replaced() {
    let site = clinic();
    site.adit("tune", &["robots", "SQUAT", "hardness", "5"]).expect_status(0);
    site.adit("build", &["--reseed"]).expecting(0).complains(&["they differed in SQUAT"]);
}

#[test]
fn why_of_what_the_route_does_not_lead_by_says_so() {
    let site = clinic();
    for (at, words) in [("500,500", "by 500,500"), ("archive", "through archive")] {
        let said = site.adit("why", &["dock", "ward 12", "--at", at]).expecting(0).stdout;
        assert_eq!(said.trim(), format!("The route from dock to ward 12 does not lead {words}."));
    }
}

#[test]
fn why_knows_what_the_building_calls_things() {
    let site = clinic();
    let said = site.adit("why", &["ward 12"]).expecting(0).stdout;
    assert!(said.starts_with("ward 12 kind is room, by rule"), "{said}");
    site.adit("why", &["ward 21"]).expecting(2).complains(&["names no object", "did you mean"]);
}

#[test]
fn the_history_is_in_words() {
    let site = clinic();
    site.adit("tune", &["robots", "LIE", "--remove"]).expect_status(0);
    site.adit("close", &["doorway 54"]).expect_status(0);
    site.adit("tuning", &["wet", "set", "robots", "SQUAT", "hardness", "6"]).expect_status(0);
    site.adit("tuning", &["wet", "on"]).expect_status(0);
    let history = site.adit("history", &[]).expecting(0).stdout;
    let rows: Vec<&str> = history.lines().skip(1).collect();
    for (row, words) in rows.iter().zip([
        ["tuning wet", "off → on"],
        ["tuning wet", "new: robots.robot/SQUAT.hardness = 6"],
        ["fact 1", "new: DOORWAYS 37.9,30.35 closed = true"],
        ["robots.robot/LIE", "with 6 changes"],
    ]) {
        assert!(words.iter().all(|words| row.contains(words)), "{row}");
    }
    assert!(!history.contains(['{', '"']), "{history}");
}
