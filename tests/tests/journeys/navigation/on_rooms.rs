//! Missions on a site whose rooms are cut by state: the robot drives the site's own routes, in its shapes.

use adit_tests::TestSite;
use serde_json::Value;

fn rows(site: &TestSite, args: &[&str]) -> Vec<Value> {
    let ran = site.adit("simulate", &[args, &["--json"]].concat());
    ran.expect_status(0).json().as_array().expect("rows").clone()
}

#[test]
fn from_the_dock_to_ward_12_it_goes_on_its_knees_and_sideways_as_the_route_says() {
    let site = TestSite::example("clinic").built();
    let film = site.path().join("film.svg");
    let rows = rows(&site, &["dock", "ward 12", "--keep", "--film", film.to_str().unwrap()]);
    let row = &rows[0];
    assert_eq!(
        (&row["ending"], &row["right"], &row["collided"]),
        (&"arrived".into(), &true.into(), &false.into())
    );
    let driven: Vec<&String> = row["by_state"].as_object().expect("metres by state").keys().collect();
    assert_eq!(driven, ["SIDE-STAND", "SQUAT", "STAND"]);
    let over = row["cost"].as_f64().expect("hardness") / row["least_cost"].as_f64().expect("hardness");
    assert!((0.98..1.1).contains(&over), "{over}");
    // the film shows the pipe, and the robot in each of its shapes
    let film = site.read("film.svg");
    for shape in ["<circle r=\"0.3\"", "<circle r=\"0.175\"", "<circle r=\"0.4\"", "x=\"18.80\" y=\"7.00\""] {
        assert!(film.contains(shape), "{shape}");
    }
    // what happened is kept, and explained
    let shapes = "SELECT json_extract(detail, '$.state') FROM journal WHERE event = 'shape' ORDER BY entry";
    assert_eq!(site.sqlite3(shapes), ["SQUAT", "STAND", "SIDE-STAND", "STAND"]);
    let why = site.adit("why", &["mission 1"]).expect_status(0).stdout;
    assert!(why.contains("it arrived"), "{why}");
    // how long it took is there to fit hardness by
    let traversals = "SELECT state, abs(distance / measured / speed - 1) < 0.05 FROM traversals JOIN robots USING (robot, state)";
    assert_eq!(site.sqlite3(traversals), ["SIDE-STAND|1", "SQUAT|1", "STAND|1"]);
}

#[test]
fn who_is_longer_than_wide_goes_on_at_its_facings_and_touches_nothing() {
    let site = TestSite::barrow();
    let film = site.path().join("film.svg");
    let row = rows(&site, &["dock", "ward 12", "--keep", "--film", film.to_str().unwrap()])[0].clone();
    assert_eq!((&row["ending"], &row["right"]), (&"arrived".into(), &true.into()), "{row}");
    assert_eq!((&row["collided"], &row["touches"]), (&false.into(), &0.into()), "{row}");
    // a turn to the next facing is a change, as hard as the table of changes says
    let turns = row["changes"].as_u64().expect("changes");
    let by_route = "SELECT count(*) FROM (SELECT facing, lag(facing) OVER (ORDER BY waypoint) AS before FROM waypoints WHERE start = 'dock' AND goal = 'ward 12') WHERE facing <> before";
    let by_route: u64 = site.sqlite3(by_route)[0].parse().expect("a count");
    assert!(by_route > 0 && turns >= by_route, "{turns}, by the route {by_route}");
    let over = row["cost"].as_f64().expect("hardness") / row["least_cost"].as_f64().expect("hardness");
    assert!((0.98..1.1).contains(&over), "{over}");
    let film = site.read("film.svg");
    assert!(film.contains("<polygon points=\"-0.450,-0.200 0.450,-0.200"), "it is shown as long as it is");
    // with boxes that nobody told of
    let rows = rows(&site, &["--missions", "4", "--seed", "5"]);
    for row in &rows {
        assert_eq!((&row["right"], &row["collided"]), (&true.into(), &false.into()), "{row}");
    }
    assert!(rows.iter().any(|row| row["ending"] == "arrived"), "{rows:?}");
}

#[test]
fn it_goes_through_the_gap_with_room_where_that_costs_little_and_through_the_other_one_where_it_is_told_to() {
    // a wall with a gap that leaves STAND 1 cm on either side, on the straight way, and a wide one a little off
    let map = "width = 12.0\ndepth = 8.0\nobstacle = [\n  { rect = [5.8, 0, 6.2, 1.69] },\n  { rect = [5.8, 2.31, 6.2, 3.5] },\n  { rect = [5.8, 5.0, 6.2, 8] },\n]\n[[place]]\nname = \"dock\"\nat = [1.0, 2.0]\n[[place]]\nname = \"bench\"\nat = [11.0, 2.0]\n";
    let site = TestSite::example("clinic");
    site.write("map.toml", map);
    let settings = "name = \"two gaps\"\nmap = \"map.toml\"\nrobots = \"robots.toml\"\nrooms = \"by-state\"\nstarts = [\"dock\"]\ngrid = 0.05\n";
    site.write("site.toml", format!("{settings}\n[navigation]\nbeside = 0.02\n"));
    let site = site.built();
    let driven = || {
        let row = rows(&site, &["dock", "bench"])[0].clone();
        assert_eq!((&row["ending"], &row["touches"]), (&"arrived".into(), &0.into()), "{row}");
        row["length"].as_f64().expect("metres")
    };
    let with_room = driven();
    site.adit("tune", &["navigation", "beside", "value", "0"]).expect_status(0);
    let straight = driven();
    assert!(straight < 10.1 && with_room > 10.2, "{straight} and {with_room}");
    // and where the way with room is too long for its room
    site.adit("tune", &["navigation", "beside", "value", "0.02"]).expect_status(0);
    site.adit("tune", &["navigation", "room_worth", "value", "1.01"]).expect_status(0);
    assert!(driven() < 10.1, "room is not worth so much");
}

#[test]
fn boxes_that_nobody_knows_of_are_passed_or_said_to_shut_the_way_and_nothing_is_claimed_wrongly() {
    for (name, robot) in [("hospital", None), ("depot", Some("crawler"))] {
        let site = TestSite::example(name).built();
        let robot = robot.map_or_else(Vec::new, |robot| vec!["--robot", robot]);
        let before = site.sqlite3("SELECT count(*) FROM history");
        let rows = rows(&site, &[&robot[..], &["--missions", "8", "--seed", "5"]].concat());
        assert!(rows.iter().any(|row| row["obstacles"].as_u64() > Some(0)), "{rows:?}");
        assert!(rows.iter().all(|row| row["right"] == true && row["collided"] == false), "{rows:?}");
        assert!(rows.iter().any(|row| row["replans"].as_u64() > Some(0)), "none met anything");
        assert_eq!(site.sqlite3("SELECT count(*) FROM history"), before, "the site is as it was");
    }
}

#[test]
fn who_is_carried_off_finds_itself_again_or_says_that_it_does_not_know_where_it_is() {
    let site = TestSite::example("hospital").built();
    let rows = rows(&site, &["--missions", "5", "--seed", "1", "--kidnap"]);
    let kidnapped: Vec<&Value> = rows.iter().filter(|row| row["kidnapped"].is_array()).collect();
    assert!(kidnapped.len() > 2, "{rows:?}");
    assert!(kidnapped.iter().any(|row| row["ending"] == "arrived"), "{rows:?}");
    assert!(rows.iter().all(|row| row["right"] == true && row["collided"] == false), "{rows:?}");
    // what was driven before led elsewhere, and is compared with nothing
    assert!(kidnapped.iter().all(|row| row["least_cost"].is_null()), "{rows:?}");
}

#[test]
fn from_errand_to_errand_it_knows_where_it_is_to_some_centimetres() {
    let site = TestSite::example("clinic").built();
    let curve = site.path().join("curve.svg");
    let args = ["--curve", curve.to_str().unwrap(), "--metres", "80", "--seed", "3", "--json"];
    let drives = site.adit("simulate", &args).expect_status(0).json();
    let drive = &drives[0];
    let figure = |key: &str| drive[key].as_f64().unwrap_or_else(|| panic!("{key} of {drive}"));
    assert!(figure("length") >= 80.0 && drives.as_array().map(Vec::len) == Some(1), "{drives}");
    assert!(figure("error") < 0.05 && figure("heading_error") < 1.0, "{drive}");
    let picture = site.read("curve.svg");
    assert!(picture.contains("position, walls known") && !picture.contains("model built on the way"));
}

#[test]
fn what_it_meets_is_told_for_an_hour_so_that_everybody_goes_round_it_and_is_taken_back() {
    let site = TestSite::example("hospital").built();
    let told = site.adit("simulate", &["--missions", "1", "--seed", "20", "--tell"]);
    assert!(told.stderr.contains("laid over the map for an hour: something at"), "{}", told.stderr);
    let laid = "SELECT count(*) > 0, min(who), min(until) > strftime('%Y-%m-%dT%H:%M:%SZ', 'now', '+50 minutes') FROM laid";
    assert_eq!(site.sqlite3(laid), ["1|robot|1"]);
    let names = site.sqlite3("SELECT name FROM laid");
    assert!(names[0].starts_with("met by robot in mission 1"), "{names:?}");
    while !site.sqlite3("SELECT name FROM laid").is_empty() {
        site.adit("undo", &[]).expect_status(0);
    }
    site.adit("doctor", &[]).expect_status(0);
}

#[test]
fn rules_in_the_folder_navigation_of_the_site_drive_it() {
    let site = TestSite::example("depot").built();
    let cautious = "table \"hold\" first\n    each situation in SITUATIONS where situation.state == \"hold\"\n    given [ situation.mode ]\n    set   [ situation.next, situation.action ]\n    rows  [ [ any, \"hold\", \"no way\" ] ]\n;\n";
    site.write("navigation/own.rhai", cautious);
    let ends =
        site.adit("simulate", &["--robot", "crawler", "--missions", "1", "--json"]).expect_status(1).json();
    assert_eq!((&ends[0]["ending"], &ends[0]["right"]), (&"no_way".into(), &false.into()), "{ends}");
    // it is checked as the site's other rules are
    site.adit("check", &[]).expect_status(0);
    site.write("navigation/own.rhai.txt", "");
    site.adit("check", &[]).expect_status(1).complains(&["own.rhai.txt is not read"]);
    site.write(
        "navigation/own.rhai",
        "rule \"what\" priority 1\n    each situation in SITUATIONS\n    then { situation.nxt = 1; }\n+",
    );
    site.adit("simulate", &["--robot", "crawler"]).expect_status(2).complains(&["own.rhai", "4"]);
    site.adit("check", &[]).expect_status(1).complains(&["own.rhai", "4"]);
    // where nobody drives by them, that is said
    let paper = TestSite::example("paper").built();
    paper.write("navigation/own.rhai", cautious);
    paper.adit("check", &[]).complains(&["navigation is not read", "no robot drives missions by it here"]);
}

#[test]
fn what_cannot_be_driven_is_said() {
    let site = TestSite::example("depot").built();
    site.adit("simulate", &[]).expect_status(2).complains(&["several robots", "cart, crawler, dog"]);
    site.adit("simulate", &["--robot", "cart", "--learn", "1,1"])
        .expect_status(2)
        .complains(&["--learn", "cut into rooms"]);
    site.adit("simulate", &["--robot", "cart", "dok", "1,1"]).expect_status(2).complains(&["`dok`"]);
    site.adit("simulate", &["--robot", "cart", "-5,1", "1,1"]).expect_status(2);
    let paper = TestSite::example("paper").built();
    paper.adit("simulate", &[]).expect_status(2).complains(&["rooms in no state"]);
}
