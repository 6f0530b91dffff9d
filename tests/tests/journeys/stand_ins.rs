//! Robots of more states than ways have a use for: a state that another one stands in for is joined with that one alone, as long as
//! nothing that rules say makes it worth more.

use std::fmt::Write as _;

use adit_tests::TestSite;

/// Which states changes of shape join with the laden one.
const JOINED: &str = "SELECT DISTINCT one.state || ' ' || two.state FROM doors JOIN rooms one ON one.room = room1 \
                      JOIN rooms two ON two.room = room2 WHERE kind = 'change' AND 'LADEN' IN (one.state, two.state) ORDER BY 1";
const WITH_ALL: [&str; 6] =
    ["LADEN SIDE-STAND", "LADEN SQUAT", "LADEN STAND", "SIDE-STAND LADEN", "SQUAT LADEN", "STAND LADEN"];
const WITH_ONE: [&str; 2] = ["LADEN STAND", "STAND LADEN"];
const COST: &str = "SELECT round(cost, 9) FROM route WHERE start = 'home' AND goal = 'window'";

/// Beyond the doorway none but the laden one may go.
const EAST: &str = "rule \"the east is for who is laden\" priority 1\n    \
                    each room in ROOMS where room.state != \"LADEN\" && room.x0 >= 6.0\n    \
                    then { room.passable = false; }\n";

fn site() -> TestSite {
    let states = [("STAND", 1.7, 0.6, 1.0), ("SIDE-STAND", 1.7, 0.35, 2.0), ("SQUAT", 1.1, 0.8, 4.0)];
    let states = states.into_iter().chain([("LADEN", 1.7, 0.7, 5.0)]);
    let mut text = String::new();
    for (state, height, width, hardness) in states.clone() {
        writeln!(
            text,
            "[[robots]]\nstate = \"{state}\"\naction = \"{state}\"\nheight = {height}\nwidth = {width}\nhardness = {hardness}"
        )
        .expect("written to a string");
        for (other, ..) in states.clone().filter(|(other, ..)| *other != state) {
            writeln!(text, "[[changes]]\nfrom_state = \"{state}\"\nto_state = \"{other}\"\nhardness = 0.5")
                .expect("written to a string");
        }
    }
    TestSite::example("starter")
        .with(
            "site.toml",
            "name = \"starter\"\nmap = \"map.toml\"\nrobots = \"robots.toml\"\nrooms = \"by-state\"\n",
        )
        .with("robots.toml", &text)
        .built()
}

#[test]
fn a_state_that_another_stands_in_for_is_changed_into_from_that_one_alone() {
    let site = site();
    assert_eq!(site.sqlite3(JOINED), WITH_ONE);
    // as soon as it is the easier one it is joined with all, and after that with one again
    site.adit("tune", &["robots", "LADEN", "hardness", "0.5"]).expect_status(0);
    assert_eq!(site.sqlite3(JOINED), WITH_ALL);
    site.adit("undo", &[]).expect_status(0);
    assert_eq!(site.sqlite3(JOINED), WITH_ONE);
    // and so where it is cheaper to change into
    site.adit("tune", &["changes", "SQUAT/LADEN", "hardness", "0.2"]).expect_status(0);
    assert_eq!(site.sqlite3(JOINED), WITH_ALL);
}

#[test]
fn where_rules_have_a_use_for_a_state_nothing_stands_in_for_it() {
    let site = site();
    site.write("rules/east.rhai", EAST);
    site.adit("build", &[]).expect_status(0);
    assert_eq!(site.sqlite3(JOINED), WITH_ALL);
    let with_rule = site.sqlite3(COST);
    // as it costs where no rule lets anything stand in
    let without = "without \"an easier state that fits wherever another one does stands in for it\"\n";
    site.write("rules/east.rhai", format!("{EAST}{without}"));
    site.adit("build", &[]).expect_status(0);
    assert_eq!((site.sqlite3(JOINED), site.sqlite3(COST)), (WITH_ALL.map(str::to_owned).into(), with_rule));
    std::fs::remove_file(site.path().join("rules/east.rhai")).expect("it was written");
    site.adit("build", &[]).expect_status(0);
    assert_eq!(site.sqlite3(JOINED), WITH_ONE);
}
