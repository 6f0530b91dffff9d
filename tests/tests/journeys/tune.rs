//! The domain expert tunes a table: one cell, one transaction, and what changed is said.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use adit_tests::TestSite;

const STARTER: &str = "map = \"map.toml\"\nrobots = \"robots.toml\"\n";

#[test]
fn a_hardness_is_tuned_and_what_follows_is_said() {
    let site = TestSite::example("paper").built();
    let change = site.adit("tune", &["robots", "SQUAT", "hardness", "3", "--json"]).expecting(0).json();
    assert_eq!(change["doors"]["changed"], 2);
    assert_eq!(change["rooms"]["changed"], 0);
    let doors = site.sqlite3("SELECT door, round(hardness, 3) FROM doors WHERE door IN (3, 4)");
    assert_eq!(doors, ["3|32.556", "4|23.55"]);
    assert_eq!(site.sqlite3("SELECT round(cost, 3) FROM route WHERE start = 'f' AND goal = 'e'"), ["83.107"]);
}

#[test]
fn a_dry_run_says_the_same_and_changes_nothing() {
    let site = TestSite::example("paper").built();
    let before = site.sqlite3("SELECT * FROM doors");
    let dry =
        site.adit("tune", &["robots", "SQUAT", "hardness", "3", "--dry-run", "--json"]).expecting(0).json();
    assert_eq!(dry["doors"]["changed"], 2);
    assert_eq!(site.sqlite3("SELECT * FROM doors"), before);
    assert!(site.sqlite3("SELECT * FROM history").is_empty());
    let wet = site.adit("tune", &["robots", "SQUAT", "hardness", "3", "--json"]).expecting(0).json();
    assert_eq!(wet["doors"], dry["doors"]);
}

#[test]
fn an_edit_is_in_the_history_and_undo_takes_it_back() {
    let site = TestSite::example("paper").built();
    let before = site.sqlite3("SELECT door, hardness FROM doors ORDER BY door");
    site.adit("tune", &["robots", "SQUAT", "hardness", "3", "--why", "new knee pads"]).expect_status(0);
    let history = site.adit("history", &["--json"]).expecting(0).json();
    assert_eq!(history[0]["old"].to_string().trim_matches('"'), "4.0");
    assert_eq!(history[0]["new"].to_string().trim_matches('"'), "3.0");
    assert_eq!(history[0]["why"], "new knee pads");
    site.adit("undo", &[]).expect_status(0);
    assert_eq!(site.sqlite3("SELECT door, hardness FROM doors ORDER BY door"), before);
    site.adit("undo", &[]).expecting(2).complains(&["nothing to undo"]);
}

#[test]
fn a_changed_width_cuts_the_layers_anew_as_a_fresh_build_would() {
    let site = TestSite::example("hospital").built();
    site.adit("tune", &["robots", "STAND", "width", "0.7"]).expect_status(0);
    let tuned = site.sqlite3("SELECT state, x0, y0, x1, y1, hardness FROM rooms ORDER BY room");
    let fresh = TestSite::example("hospital");
    fresh.edit("robots.toml", "width = 0.6", "width = 0.7");
    let fresh = fresh.built();
    assert_eq!(fresh.sqlite3("SELECT state, x0, y0, x1, y1, hardness FROM rooms ORDER BY room"), tuned);
}

#[test]
fn a_state_is_added_and_removed() {
    let site = TestSite::example("paper").built();
    let before = site.sqlite3("SELECT door, hardness, action FROM doors ORDER BY door");
    site.adit("tune", &["robots", "ROLL", "--add", "action=ROLL", "height=3", "width=2", "hardness=6"])
        .expect_status(0);
    assert_eq!(site.sqlite3("SELECT passable FROM doors WHERE door = 1"), ["1"]);
    site.adit("tune", &["robots", "ROLL", "--remove"]).expect_status(0);
    assert_eq!(site.sqlite3("SELECT door, hardness, action FROM doors ORDER BY door"), before);
    site.adit("undo", &[]).expect_status(0);
    assert_eq!(site.sqlite3("SELECT count(*) FROM robots WHERE state = 'ROLL'"), ["1"]);
}

#[test]
fn an_outside_edit_makes_routes_stale_until_the_next_build() {
    let site = TestSite::example("paper").built();
    site.outside_edit("UPDATE robots SET hardness = 3 WHERE state = 'SQUAT'");
    assert_eq!(site.sqlite3("SELECT status FROM route WHERE start = 'f' AND goal = 'e'"), ["stale"]);
    site.adit("build", &[]).expect_status(0);
    assert_eq!(
        site.sqlite3("SELECT status, round(cost, 3) FROM route WHERE start = 'f' AND goal = 'e'"),
        ["ok|83.107"]
    );
}

#[test]
fn the_robot_table_lives_in_the_database_after_the_first_build() {
    let site = TestSite::example("paper").built();
    site.edit("robots.toml", "hardness = 4.0", "hardness = 2.5");
    site.adit("build", &[]).expecting(0).complains(&["robots.toml", "SQUAT", "--reseed"]);
    assert_eq!(site.sqlite3("SELECT hardness FROM robots WHERE state = 'SQUAT'"), ["4.0"]);
    site.adit("build", &["--reseed"]).expect_status(0);
    assert_eq!(site.sqlite3("SELECT hardness FROM robots WHERE state = 'SQUAT'"), ["2.5"]);
}

#[test]
fn bad_edits_are_refused_and_nothing_is_half_done() {
    let site = TestSite::example("paper").built();
    let before = site.sqlite3("SELECT * FROM robots");
    for (edit, words) in [
        (["robots", "SQUAT", "hardness", "-3"], vec!["hardness", "-3"]),
        (["robots", "SQUAT", "hardness", "soft"], vec!["`hardness` of `robots` holds numbers", "soft"]),
        (["robots", "SQAT", "hardness", "3"], vec!["SQAT", "SQUAT"]),
        (["robots", "SQUAT", "hardnes", "3"], vec!["hardnes", "hardness"]),
        (["robot", "SQUAT", "hardness", "3"], vec!["robot", "robots"]),
        (["doors", "7", "hardness", "3"], vec!["doors", "rule"]),
    ] {
        site.adit("tune", &edit).expecting(2).complains(&words);
    }
    assert_eq!(site.sqlite3("SELECT * FROM robots"), before);
    assert!(site.sqlite3("SELECT * FROM history").is_empty());
}

/// The expert removes a state and thinks better of it. Once, the state came back without its changes of shape, and
/// every change from and to it was free from then on.
#[test]
fn a_removed_state_comes_back_with_its_changes() {
    let site = TestSite::example("clinic").built();
    let changes = "SELECT * FROM changes ORDER BY from_state, to_state";
    let route = "SELECT start, goal, cost FROM route WHERE status = 'ok' ORDER BY start, goal";
    let (before, costs) = (site.sqlite3(changes), site.sqlite3(route));
    for _ in 0..2 {
        site.adit("tune", &["robots", "STAND", "--remove"]).expect_status(0);
        assert!(site.sqlite3(changes).len() < before.len());
        site.adit("undo", &[]).expect_status(0);
        assert_eq!(site.sqlite3(changes), before);
        assert_eq!(site.sqlite3(route), costs);
    }
}

#[test]
fn a_column_of_a_new_row_is_given_once() {
    let site = TestSite::example("paper").built();
    let twice = ["robots", "ROLL", "--add", "action=ROLL", "height=1", "width=2", "hardness=6", "height=2"];
    site.adit("tune", &twice).expecting(2).complains(&["`height`", "twice"]);
    let key = ["robots", "ROLL", "--add", "state=FLY", "action=ROLL", "height=1", "width=2", "hardness=6"];
    site.adit("tune", &key).expecting(2).complains(&["`state`", "twice"]);
}

#[test]
fn a_removed_state_stays_away_while_a_state_that_it_changes_to_is_gone() {
    let site = TestSite::example("clinic").built();
    site.adit("tune", &["robots", "STAND", "--remove"]).expect_status(0);
    site.adit("tune", &["robots", "LIE", "--remove"]).expect_status(0);
    site.adit("undo", &["1"]).expecting(2).complains(&["edit 1 cannot be taken back", "changes", "LIE"]);
    site.adit("undo", &[]).expect_status(0);
    site.adit("undo", &["1"]).expect_status(0);
    assert_eq!(site.sqlite3("SELECT count(*) FROM changes"), ["12"]);
}

#[test]
fn a_changed_width_says_which_routes_between_places_follow() {
    // once, only "the rooms were cut anew" was said
    let site = TestSite::example("hospital").built();
    let change = site
        .adit("tune", &["robots", "SIDE-STAND", "width", "0.55", "--dry-run", "--json"])
        .expecting(0)
        .json();
    assert_eq!(change["cut_anew"], true);
    let routes = change["routes"]["changes"].as_array().unwrap();
    assert!(routes.iter().any(|route| route["start"] == "dock" && route["goal"] == "ward 6"), "{routes:?}");
}

#[test]
fn a_place_added_to_the_site_file_is_known_to_the_next_route() {
    let site = TestSite::example("hospital").built();
    let text = site.read("site.toml");
    site.write("site.toml", format!("{text}\n[[place]]\nname = \"store\"\nat = [11.0, 3.0]\n"));
    site.adit("route", &["dock", "store"]).expect_status(0);
}

#[test]
fn what_edits_did_is_said_in_words_also_of_whole_rows() {
    let site = TestSite::example("paper").built();
    let first = |verb, args: &[&str]| {
        let said = site.adit(verb, args).expecting(0).stdout;
        said.lines().next().unwrap_or_default().to_owned()
    };
    assert_eq!(first("tune", &["robots", "SQUAT", "hardness", "3"]), "robots.robot/SQUAT.hardness: 4 → 3");
    assert_eq!(
        first("tune", &["robots", "ROLL", "--add", "action=ROLL", "height=3", "width=2", "hardness=6"]),
        "robots.robot/ROLL is new"
    );
    assert_eq!(first("undo", &[]), "undone: robot/ROLL is gone again");
    assert_eq!(
        first("tuning", &["night", "set", "robots", "SQUAT", "hardness", "2"]),
        "tuning night: robots.SQUAT.hardness = 2"
    );
    assert_eq!(first("tuning", &["night", "on"]), "tuning night is on");
    let history = site.adit("history", &[]).expecting(0).stdout;
    assert!(history.contains("new: robot robot, state ROLL, action ROLL, height 3"), "{history}");
    assert!(!history.contains('{'), "{history}");
}

#[test]
fn an_undone_edit_takes_those_along_whose_rows_went_with_it() {
    let site = TestSite::example("starter").with("site.toml", STARTER).built();
    let crawl = ["robots", "CRAWL", "--add", "action=CREEP", "height=0.5", "width=0.8", "hardness=6"];
    site.adit("tune", &["robots", "SQUAT", "hardness", "9"]).expect_status(0);
    site.adit("tune", &crawl).expect_status(0);
    site.adit("tune", &["changes", "STAND/CRAWL", "--add", "hardness=1"]).expect_status(0);
    site.adit("undo", &["2"]).expect_status(0);
    site.adit("undo", &["3"]).expecting(2).complains(&["edit 4 has taken it back already"]);
    // brought back, they are in force, and are taken back like any other
    site.adit("undo", &["4"]).expect_status(0);
    assert_eq!(site.sqlite3("SELECT count(*) FROM changes WHERE to_state = 'CRAWL'"), ["1"]);
    let undone = site.adit("undo", &[]).expecting(0).stdout;
    assert!(undone.contains("robot/STAND/CRAWL is gone again"), "{undone}");
    site.adit("undo", &["2"]).expect_status(0);
    // the newest edit that is left
    let undone = site.adit("undo", &[]).expecting(0).stdout;
    assert!(undone.starts_with("undone: robots.robot/SQUAT.hardness: 9 → 4"), "{undone}");
    site.adit("undo", &["99"]).expecting(2).complains(&["there is no edit 99"]);
}

#[test]
fn what_files_replace_in_tables_is_in_the_history_and_comes_back() {
    let ores = "ore*,weight,hard\nlead,2,true\niron,3,false\n";
    let site = TestSite::example("starter").with("site.toml", STARTER).with("tables/ores.csv", ores).built();
    let all = |site: &TestSite| {
        let tables =
            ["robots", "changes", "ores"].map(|table| format!("SELECT * FROM {table} ORDER BY 1, 2, 3"));
        tables.map(|query| site.sqlite3(&query))
    };
    let seeded = all(&site);
    site.adit("tune", &["ores", "iron", "weight", "7"]).expect_status(0);
    site.adit("tune", &["ores", "gold", "--add", "weight=9", "hard=false"]).expect_status(0);
    site.adit("tune", &["robots", "SQUAT", "--remove"]).expect_status(0);
    let tuned = all(&site);
    site.adit("build", &["--reseed"]).expecting(0).complains(&["what the files replaced is in the history"]);
    assert_eq!(all(&site), seeded);
    site.adit("undo", &[]).expect_status(0);
    assert_eq!(all(&site), tuned);
    // a whole number that becomes another one is no other column
    site.write("tables/ores.csv", ores.replace(",2,", ",2.5,"));
    site.adit("build", &["--reseed"]).expect_status(0);
    site.adit("undo", &[]).expect_status(0);
    assert_eq!(all(&site)[0], tuned[0]);
    assert_eq!(site.sqlite3("SELECT weight FROM ores WHERE ore = 'lead'"), ["2.0"]);
    // what the files have already is no edit
    let before = site.sqlite3("SELECT count(*) FROM history");
    site.adit("build", &[]).expect_status(0);
    assert_eq!(site.sqlite3("SELECT count(*) FROM history"), before);
    // other columns are another table
    let other = site.with("tables/ores.csv", "ore*,weight\nlead,2\n");
    other
        .adit("build", &["--reseed"])
        .expecting(0)
        .complains(&["the table ores has other columns than before"]);
}
