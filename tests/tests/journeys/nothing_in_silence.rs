//! What people say and may not mean is answered, and what is as it was is not told anew.

use std::process::Command;

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

/// Two rooms, 6 m and 5.7 m wide, with a named door between them.
fn two_rooms() -> TestSite {
    let map = "width = 12.0\ndepth = 7.0\n\
        [[obstacle]]\nrect = [6.0, 0.0, 6.3, 3.0]\n[[obstacle]]\nrect = [6.0, 4.0, 6.3, 7.0]\n";
    let robots = "[[robots]]\nstate = \"STAND\"\naction = \"WALK\"\nheight = 1.7\nwidth = 0.6\nhardness = 1.0\n\
        [[robots]]\nstate = \"SIDE\"\naction = \"SIDE-WALK\"\nheight = 1.7\nwidth = 0.3\nhardness = 2.0\n";
    let site = "name = \"two rooms\"\n\
        [[place]]\nname = \"home\"\nat = [1.0, 1.0]\n[[place]]\nname = \"window\"\nat = [11.0, 6.0]\n\
        [[door]]\nname = \"middle\"\nfrom = [6.15, 3.0]\nto = [6.15, 4.0]\n";
    TestSite::empty().with("map.toml", map).with("robots.toml", robots).with("site.toml", site)
}

#[test]
fn a_door_or_a_space_that_nothing_closes_is_not_told_to_be_open() {
    let site = two_rooms().built();
    for what in ["middle", "home"] {
        site.adit("open", &[what]).expecting(2).complains(&[&format!("`{what}` is open already")]);
    }
    assert_eq!(site.sqlite3("SELECT count(*) FROM told"), ["0"]);
}

#[test]
fn a_space_without_a_doorway_is_not_said_to_be_closed() {
    let map = "width = 9.0\ndepth = 4.0\n";
    let site =
        "[[place]]\nname = \"charger\"\nat = [1.0, 1.0]\n[[place]]\nname = \"shelf\"\nat = [8.0, 3.0]\n";
    let site = TestSite::example("starter").with("map.toml", map).with("site.toml", site).built();
    let refused = ["has no doorway that could be closed", "lay an area"];
    let name = site.sqlite3("SELECT name FROM spaces").concat();
    for what in ["charger", &name] {
        site.adit("close", &[what]).expecting(2).complains(&refused);
    }
    assert_eq!(site.sqlite3("SELECT count(*) FROM told"), ["0"]);
}

#[test]
fn why_a_named_door_is_shut_is_why_its_doorway_is() {
    let rule = "rule \"shut\" priority 3 each d in DOORWAYS then { d.closed = true; }\n";
    let site = two_rooms().with("rules/shut.rhai", rule).built();
    let why = site.adit("why", &["middle"]).expecting(0).stdout;
    assert!(why.contains("middle closed is true, by rule \"shut\""), "{why}");
}

#[test]
fn an_errand_that_keeps_away_names_no_fact_that_there_is_not() {
    let site = two_rooms().built();
    let said = site.adit("route", &["home", "window", "--avoid", "middle"]).expecting(1).stdout;
    assert!(said.contains("this errand keeps away from `middle`") && !said.contains("fact"), "{said}");
    let said = site.adit("route", &["home", "window", "--avoid", "6,3.5@0"]).expecting(1).stdout;
    assert!(said.contains("keeps away from `6,3.5@0`") && !said.contains("fact"), "{said}");
    // what a service tells that runs as `nobody` is a fact like any other
    site.outside_edit(
        "INSERT INTO told (class, x, y, x0, y0, x1, y1, property, kind, value, who)
         VALUES ('DOORWAYS', 9, 4, 9, 0, 9, 8, 'closed', 'truth', 1, 'nobody')",
    );
    let said = site.adit("route", &["home", "window"]).expecting(1).stdout;
    assert!(said.contains("is told to be closed (fact 1)"), "{said}");
}

#[test]
fn an_edit_is_taken_back_before_those_that_came_before_it_of_the_same_cell() {
    let site = two_rooms().built();
    for hardness in ["3", "5", "3"] {
        site.adit("tune", &["robots", "SIDE", "hardness", hardness]).expect_status(0);
    }
    let refused = ["edit 1 cannot be taken back: edit 3 changed the same later"];
    site.adit("undo", &["1"]).expecting(2).complains(&refused);
    for _ in 0..3 {
        site.adit("undo", &[]).expect_status(0);
    }
    assert_eq!(site.sqlite3("SELECT hardness FROM robots WHERE state = 'SIDE'"), ["2.0"]);
}

#[test]
fn rules_that_react_to_rooms_and_doorways_do_so_from_the_first_build_on() {
    let rules = "property DOORWAYS.seen from table, default false;\n\
        on \"seen\" each d in DOORWAYS where !d.seen then { d.seen = true; }\n\
        property ROOMS.seen from table, default false;\n\
        on \"entered\" each r in ROOMS where r.width > 5.0 && !r.seen then { r.seen = true; }\n";
    let first = two_rooms().with("rules/seen.rhai", rules).built();
    let facts = "SELECT class, x, y FROM told ORDER BY class, x, y";
    let told = first.sqlite3(facts);
    assert!(told.iter().any(|fact| fact.starts_with("DOORWAYS|6.15")), "{told:?}");
    assert!(told.iter().any(|fact| fact.starts_with("ROOMS|")), "{told:?}");
    let later = two_rooms().built().with("rules/seen.rhai", rules).built();
    assert_eq!(later.sqlite3(facts), told);
    // a doorway that comes is met as it is now
    first.adit("lay", &["obstacle", "shelf", "3,1 3.2,7"]).expect_status(0);
    let doorways = "SELECT x FROM told WHERE class = 'DOORWAYS' ORDER BY x";
    assert_eq!(first.sqlite3(doorways), ["3.1", "6.15"]);
}

#[test]
fn what_is_laid_over_the_map_takes_no_name_that_means_something_else() {
    let site = two_rooms().with("site.toml", "name = \"two rooms\"\n").built();
    let lay = |name: &str, more: &[&str]| site.adit("lay", &[&["area", name, "8,1 9,2"], more].concat());
    lay("doorway 1", &[]).expecting(2).complains(&["two things: this area and the doorway at"]);
    lay("room 2", &[]).expecting(2).complains(&["two things: this area and the room at"]);
    lay("3,4", &[]).expecting(2).complains(&["two things: this area and a point"]);
    lay("wet", &["--kind", "keep-out", "--with", "kind=wet"]).expecting(2).complains(&["say it by `--kind`"]);
    let twice = ["--with", "hardness_factor=2", "--with", "hardness_factor=3"];
    lay("wet", &twice).expecting(2).complains(&["`hardness_factor` of `wet` is said twice"]);
    assert_eq!(site.sqlite3("SELECT count(*) FROM laid"), ["0"]);
}

#[test]
fn a_kind_of_areas_that_no_rule_knows_is_noted() {
    let site = two_rooms().built();
    let lay =
        |name: &str, kind: &str| site.adit("lay", &["area", name, "8,1 9,2", "--kind", kind]).expecting(0);
    lay("one", "keep_out").complains(&["no rule speaks of areas of the kind `keep_out`, as `one` is"]);
    let said = lay("two", "keep-out").stderr;
    assert!(!said.contains("kind `keep-out`"), "{said}");
    let one_way = ["area", "three", "1,5 2,6", "--kind", "lane", "--with", "heading=90"];
    let said = site.adit("lay", &one_way).expecting(0).stderr;
    assert!(!said.contains("kind `lane`"), "{said}");
}

#[test]
fn a_space_is_found_by_the_name_that_it_had_before_somebody_named_it() {
    let site = two_rooms().with("site.toml", "name = \"two rooms\"\n").built();
    site.adit("close", &["room 1"]).expect_status(0);
    site.adit("lay", &["place", "home", "1,1"]).expect_status(0);
    assert_eq!(site.sqlite3("SELECT name FROM spaces WHERE space = 1"), ["home"]);
    site.adit("open", &["room 1"]).expect_status(0);
    site.adit("close", &["home"]).expect_status(0);
    // with two places it has the name of neither
    site.adit("lay", &["place", "desk", "2,2"]).expect_status(0);
    assert_eq!(site.sqlite3("SELECT name FROM spaces WHERE space = 1"), ["room 1"]);
    site.adit("open", &["home"]).expect_status(0);
    assert_eq!(site.sqlite3("SELECT count(*) FROM told"), ["0"]);
    let said = ["desk is a place in room 1, and all of that is closed"];
    site.adit("close", &["desk", "--dry-run"]).expecting(0).complains(&said);
    // a wet spot is no name for the room around it
    site.adit("lay", &["area", "puddle", "9,1 10,2"]).expect_status(0);
    assert_eq!(site.sqlite3("SELECT name FROM spaces WHERE space = 2"), ["room 2"]);
}

#[test]
fn a_site_file_that_is_empty_is_refused() {
    let site = two_rooms().built();
    site.write("site.toml", "");
    site.adit("build", &[]).expecting(2).complains(&["site.toml is empty"]);
}

#[test]
fn that_no_state_fits_anywhere_any_more_is_said() {
    let site = two_rooms().built();
    let wide = |state: &str| site.adit("tune", &["robots", state, "width", "20"]).expecting(0).stdout;
    wide("SIDE");
    let said = wide("STAND");
    assert!(said.contains("no room is left: no state fits anywhere on the map"), "{said}");
}

#[test]
fn what_another_program_drew_amiss_counts_for_nothing_and_the_rest_goes_on() {
    let site = two_rooms().built();
    let values = "'area', '[[1,1],[2,1],[2,2]]', '{\"closed\":null}', 'gis', '', '2026-01-01T00:00:00Z'";
    let insert = format!(
        "INSERT INTO laid (name, what, outline, properties, who, why, at) VALUES ('spill', {values})"
    );
    let drawn = Command::new("sqlite3").arg(site.path().join("site.db")).arg(insert).status();
    assert!(drawn.expect("sqlite3 runs").success());
    let note = "the area `spill`, laid over the map, counts for nothing: its `closed` is no number, text or truth value";
    site.adit("build", &[]).expecting(0).complains(&[note]);
    site.adit("route", &["home", "window"]).expect_status(0);
}
