//! A fleet in one site: robots of their own states, what they carry, and a body that cannot turn everywhere.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use adit_tests::TestSite;

fn cost(site: &TestSite, robot: &str, start: &str, goal: &str) -> Option<f64> {
    let ran = site.adit("route", &[start, goal, "--robot", robot, "--json"]);
    ran.json()["cost"].as_f64()
}

#[test]
fn each_robot_goes_its_own_way() {
    let site = TestSite::example("depot").built();
    assert_eq!(site.sqlite3("SELECT DISTINCT robot FROM rooms ORDER BY 1"), ["cart", "crawler", "dog"]);
    let by_gate = cost(&site, "cart", "dock", "gate").unwrap();
    let by_door = cost(&site, "dog", "dock", "gate").unwrap();
    assert!(by_door < by_gate, "the cart is too wide for the door");
    let dog = site.adit("route", &["charger", "shelf", "--robot", "dog", "--json"]).expecting(0).json();
    let steps = dog["steps"].as_array().unwrap();
    assert!(steps.iter().any(|step| step["action"] == "SIDE-STEP"), "through the slit of 0.4 m");
    assert!(steps.iter().all(|step| step["state"] != "DRIVE"), "no robot goes as another");
    let kept = "SELECT cost FROM route WHERE start = 'charger' AND goal = 'shelf' AND robot =";
    let costs = ["dog", "cart"].map(|robot| {
        let found = site.sqlite3(&format!("{kept} '{robot}'"));
        found[0].parse::<f64>().unwrap()
    });
    assert!(costs[0] * 2.0 < costs[1], "{costs:?}");
    site.adit("route", &["dock", "gate"]).expecting(2).complains(&["say which one: cart, crawler, dog"]);
    site.adit("route", &["dock", "gate", "--robot", "carts"]).expecting(2).complains(&["no robot `carts`"]);
}

#[test]
fn a_load_closes_a_way_and_taking_it_off_opens_it() {
    let site = TestSite::example("depot").built();
    let before = cost(&site, "cart", "dock", "gate");
    let of_others = "SELECT robot, start, goal, status, cost FROM route WHERE robot <> 'cart' \
                     AND start IN (SELECT place FROM places) AND goal IN (SELECT place FROM places)";
    let others = site.sqlite3(of_others);
    site.adit("tune", &["loads", "cart/crate", "carried", "1"]).expect_status(0);
    let answer = site.adit("route", &["dock", "gate", "--robot", "cart", "--json"]).expecting(1).json();
    let reason = answer["reason"].as_str().unwrap();
    assert!(reason.contains("1.6 m") && reason.contains("no state is lower"), "{reason}");
    assert_eq!(
        site.sqlite3(
            "SELECT round(value, 3), rule FROM conclusions WHERE object = 'robots.cart/DRIVE' AND property = 'height'"
        ),
        ["1.8|a robot is higher by what it carries"]
    );
    assert_eq!(site.sqlite3("SELECT height FROM robots WHERE robot = 'cart'"), ["1.2"], "as it was told");
    assert_eq!(site.sqlite3(of_others), others);
    site.adit("undo", &[]).expect_status(0);
    assert_eq!(cost(&site, "cart", "dock", "gate"), before);
    // an errand's load is as high as one that the table has
    let errand = ["route", "dock", "gate", "--robot", "cart", "--load", "crate", "--json"];
    let errand = site.adit(errand[0], &errand[1..]).expecting(1).json();
    assert_eq!(errand["reason"], reason);
    site.adit("tune", &["loads", "cart/crate", "carried", "2"])
        .expecting(2)
        .complains(&["carried", "0 or 1"]);
}

#[test]
fn turning_costs_what_the_table_says() {
    let site = TestSite::example("depot").built();
    let turns = "SELECT count(*), min(d.hardness), max(d.hardness), max(d.passable) FROM doors d \
                 JOIN rooms a ON a.room = d.room1 JOIN rooms b ON b.room = d.room2 \
                 WHERE a.state = 'SIDE-STEP' AND b.state = 'SIDE-STEP' AND d.kind = 'change'";
    let found = site.sqlite3(turns);
    assert!(found[0].ends_with("|0.2|0.2|1") && !found[0].starts_with("0|"), "{found:?}");
    let facings = site.sqlite3("SELECT count(DISTINCT facing) FROM rooms WHERE state = 'SIDE-STEP'");
    assert_eq!(facings, ["8"]);
    assert_eq!(
        site.sqlite3("SELECT count(*) FROM rooms WHERE state <> 'SIDE-STEP' AND facing IS NOT NULL"),
        ["0"]
    );
}

#[track_caller]
#[test]
fn a_long_body_turns_at_a_corner_facing_by_facing() {
    // once, no change from a facing to the next was thought to pay where neither has room for long: no route was found
    let site = TestSite::empty()
        .with("site.toml", "map = \"map.toml\"\nrobots = \"robots.toml\"\n")
        .with(
            "map.toml",
            "width = 6.0\ndepth = 6.0\nobstacle = [{ rect = [0.0, 0.6, 4.0, 6.0] }, { rect = [4.6, 2.2, 6.0, 6.0] }]\n\
             place = [{ name = \"below\", at = [0.6, 0.3] }, { name = \"above\", at = [4.3, 5.0] }]\n",
        )
        .with(
            "robots.toml",
            "[[robots]]\nstate = \"ROLL\"\naction = \"DRIVE\"\nheight = 1.0\nwidth = 0.3\nlength = 0.9\nhardness = 1.0\n\
             [[changes]]\nfrom_state = \"ROLL\"\nto_state = \"ROLL\"\nhardness = 5.0\n",
        )
        .built();
    for (start, goal) in [("below", "above"), ("above", "below")] {
        let route = site.adit("route", &[start, goal, "--json"]).expecting(0).json();
        let facings = route["waypoints"].as_array().unwrap().iter();
        let facings: Vec<f64> = facings.map(|waypoint| waypoint["facing"].as_f64().unwrap()).collect();
        let turned = |pair: &[f64]| (pair[0] - pair[1]).abs();
        assert!(facings.contains(&0.0) && facings.contains(&90.0), "{facings:?}");
        let is_next = |turn: f64| turn < 1e-9 || (turn - 22.5).abs() < 1e-9 || (turn - 157.5).abs() < 1e-9;
        assert!(facings.windows(2).all(|pair| is_next(turned(pair))), "{facings:?}");
    }
}

#[test]
fn a_body_longer_than_the_map_fits_nowhere() {
    let site = TestSite::example("depot");
    site.write(
        "robots.toml",
        "[[robots]]\nstate = \"S\"\naction = \"A\"\nheight = 1.0\nwidth = 0.6\nlength = 1e9\nhardness = 1.0\n",
    );
    site.adit("build", &[]).complains(&["no room"]);
}

fn refused(from: &str, to: &str, words: &[&str]) {
    let site = TestSite::example("depot");
    site.edit("robots.toml", from, to);
    site.adit("build", &[]).expecting(2).complains(words);
}

#[test]
fn two_robots_of_one_name_are_refused_at_their_place() {
    refused(
        "robot    = \"crawler\"\nstate    = \"UP\"",
        "robot    = \"cart\"\nstate    = \"UP\"",
        &["robots.toml", "robot `cart` stands here twice", "name of its own"],
    );
    refused(
        "state    = \"SIDE-STEP\"",
        "state    = \"TROT\"",
        &["state `TROT` of robot `dog` stands here twice"],
    );
}

#[test]
fn loads_and_lengths_that_cannot_be_are_refused() {
    refused("length   = 0.6", "length   = 0", &["robots.toml", "length", "more than 0"]);
    refused("load   = \"plank\"", "load   = \"crate\"", &["load `crate` of robot `cart` stands here twice"]);
    refused(
        "robot  = \"cart\"\nload   = \"plank\"",
        "robot  = \"crat\"\nload   = \"plank\"",
        &["plank", "crat", "no state"],
    );
    refused("width  = 2.8", "width  = 2.8\ncarried = 1", &["carried", "true or false"]);
    refused("width  = 2.8", "width  = -2.8", &["width", "-2.8"]);
}
