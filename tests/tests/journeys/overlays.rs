//! Named areas and doors, laid over any map, and what rules make of them.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use adit_planners::geometry::{Point, Segment};
use adit_tests::TestSite;

/// A hall of 12 x 8 m with a wall across it that has two doorways, one straight ahead and one out of the way.
const HALL: &str = r#"
width = 12.0
depth = 8.0
[[obstacle]]
rect = [5.9, 0.0, 6.1, 1.0]
[[obstacle]]
rect = [5.9, 2.2, 6.1, 6.0]
[[obstacle]]
rect = [5.9, 7.2, 6.1, 8.0]
[[place]]
name = "west"
at = [2.0, 1.6]
[[place]]
name = "east"
at = [10.0, 1.6]
"#;

const ROBOTS: &str = r#"
[[robots]]
state = "TALL"
action = "WALK"
height = 1.8
width = 0.6
hardness = 1.0
[[robots]]
state = "LOW"
action = "CRAWL"
height = 0.8
width = 0.5
hardness = 3.0
"#;

const SOUTH_DOOR: &str = "\n[[door]]\nname = \"south door\"\nfrom = [6.0, 1.0]\nto = [6.0, 2.2]\n";
const NORTH_DOOR: &str = "\n[[door]]\nname = \"north door\"\nfrom = [6.0, 6.0]\nto = [6.0, 7.2]\n";

/// The hall with these items laid over it by `site.toml`.
fn hall(items: &str) -> TestSite {
    TestSite::empty()
        .with("map.toml", HALL)
        .with("robots.toml", ROBOTS)
        .with("site.toml", &format!("name = \"hall\"\n{items}"))
}

fn route(site: &TestSite, status: i32) -> serde_json::Value {
    site.adit("route", &["west", "east", "--json"]).expecting(status).json()
}

fn cost(site: &TestSite) -> f64 {
    route(site, 0)["cost"].as_f64().unwrap()
}

/// The greatest y that the route comes to: beyond 5 it goes by the north doorway.
fn northmost(site: &TestSite) -> f64 {
    let route = route(site, 0);
    let steps = route["steps"].as_array().unwrap();
    steps.iter().filter_map(|step| step["y"].as_f64()).fold(0.0, f64::max)
}

#[test]
fn a_wet_spot_makes_itself_hard_and_not_the_hall() {
    let dry = hall("").built();
    assert!((cost(&dry) - 8.0).abs() < 0.1, "straight ahead: {}", cost(&dry));
    let spot =
        "[[area]]\nname = \"spot\"\nkind = \"wet\"\nhardness_factor = 3.0\nrect = [8.0, 0.8, 9.0, 2.4]\n";
    let wet = hall(spot).built();
    // through the metre of the spot it would cost 2 more; around it less
    assert!(cost(&wet) > 8.05 && cost(&wet) < 9.5, "{}", cost(&wet));
    let rooms = "SELECT count(*) > 0, min(x0) >= 8.0 - 0.05, max(x1) <= 9.0 + 0.05, min(hardness) FROM rooms
                 JOIN area_rooms USING (room) WHERE state = 'TALL'";
    assert_eq!(wet.sqlite3(rooms), ["1|1|1|3.0"]);
    assert_eq!(
        wet.sqlite3("SELECT count(*) FROM rooms WHERE state = 'TALL' AND hardness > 1 AND room NOT IN (SELECT room FROM area_rooms)"),
        ["0"]
    );
}

#[test]
fn nobody_enters_an_area_to_keep_out_of() {
    let keep_out =
        "[[area]]\nname = \"stairs\"\nkind = \"keep-out\"\npolygon = [[7, 0], [8, 0], [8.5, 5], [7, 5]]\n";
    let site = hall(keep_out).built();
    assert!(northmost(&site) > 4.5, "around it");
    let ran = site.adit("route", &["west", "7.5,2", "--json"]).expecting(1);
    let reason = ran.json()["reason"].as_str().unwrap().to_owned();
    assert!(reason.contains("is not entered (rule \"areas to keep out of are not entered\")"), "{reason}");
}

/// How near the middle of the robot comes to the pit's corners, metres.
fn nearest_to_the_pit(site: &TestSite) -> f64 {
    let route = route(site, 0);
    let at = |waypoint: &serde_json::Value| {
        let [x, y] = ["x", "y"].map(|axis| waypoint[axis].as_f64().unwrap());
        Point::new(x, y)
    };
    let points: Vec<Point> = route["waypoints"].as_array().unwrap().iter().map(at).collect();
    let legs = points.windows(2).map(|ends| Segment::new(ends[0], ends[1]));
    let corners = [(8.0, 1.0), (9.0, 1.0), (9.0, 3.0), (8.0, 3.0)].map(|(x, y)| Point::new(x, y));
    let gaps = legs.flat_map(|leg| corners.map(|corner| leg.distance(corner)));
    gaps.fold(f64::INFINITY, f64::min)
}

#[test]
fn nothing_of_the_robot_comes_into_an_area_to_keep_out_of_unless_its_middle_alone_is_meant() {
    let pit = |more: &str| {
        hall(&format!("[[area]]\nname = \"pit\"\nkind = \"keep-out\"\nrect = [8.0, 1.0, 9.0, 3.0]\n{more}"))
            .without_berth()
            .built()
    };
    let body = nearest_to_the_pit(&pit(""));
    assert!((0.3..0.31).contains(&body), "a robot 0.6 m wide passes it at {body}");
    let middle = nearest_to_the_pit(&pit("whole_body = false\n"));
    assert!(middle < 1e-3, "its middle passes it at {middle}");
    let told = pit("whole_body = false\n");
    told.adit("tell", &["AREAS", "pit", "whole_body", "true"]).expect_status(0);
    assert!((0.3..0.31).contains(&nearest_to_the_pit(&told)), "as soon as it is told");
}

#[test]
fn any_area_may_be_for_the_whole_body() {
    // 0.7 m are left beside it, in which the robot's middle has 0.1
    let wet = |more: &str| {
        let area = "[[area]]\nname = \"wet\"\nhardness_factor = 5.0\nrect = [8.0, 0.7, 9.0, 8.0]\n";
        cost(&hall(&format!("{area}{more}")).built())
    };
    let (middle, body) = (wet(""), wet("whole_body = true\n"));
    assert!(body > middle + 0.1 && body < 9.0, "{middle}, then {body}");
}

#[test]
fn a_closed_door_is_shut_in_every_state_and_the_way_goes_by_another() {
    let open = hall(&format!("{SOUTH_DOOR}{NORTH_DOOR}")).built();
    assert!(northmost(&open) < 5.0);
    let states =
        "SELECT count(DISTINCT state) FROM rooms JOIN door_rooms USING (room) WHERE door = 'south door'";
    assert_eq!(open.sqlite3(states), ["2"]);
    let closed = format!("{SOUTH_DOOR}closed = true\n");
    let one = hall(&format!("{closed}{NORTH_DOOR}")).built();
    assert!(northmost(&one) > 5.0);
    let both = hall(&format!("{closed}{NORTH_DOOR}closed = true\n")).built();
    let reason = route(&both, 1)["reason"].as_str().unwrap().to_owned();
    assert!(reason.contains("is not entered (rule \"a closed door is shut\")"), "{reason}");
}

#[test]
fn passing_a_named_door_costs_its_hardness_once() {
    let free = cost(&hall(SOUTH_DOOR).built());
    let dear = cost(&hall(&format!("{SOUTH_DOOR}hardness = 1.5\n")).built());
    assert!((dear - free - 1.5).abs() < 0.02, "{dear} after {free}");
    let other_way = cost(&hall(&format!("{SOUTH_DOOR}hardness = 100.0\n")).built());
    assert!(other_way < free + 20.0, "by the other doorway: {other_way}");
}

#[test]
fn rules_of_a_site_read_what_it_says_of_areas_and_doors() {
    let squeaks = "\nrule \"at night nobody wakes the ward\"
        each door in NAMED_DOORS where door.squeaks
        then { door.hardness = 4.0; }\n";
    let site = hall(&format!("{SOUTH_DOOR}squeaks = true\nwhose = \"ward 6\"\n"));
    site.copy_rules("by-state");
    let site = site.built();
    let quiet = cost(&site);
    site.write("rules/night.rhai", squeaks);
    site.adit("build", &[]).expect_status(0);
    assert!((cost(&site) - quiet - 4.0).abs() < 0.05);
    assert_eq!(
        site.sqlite3("SELECT door, squeaks, whose, closed, width FROM named_doors"),
        ["south door|1|ward 6||1.2"]
    );
    // a slip in such a property is found before anything is written
    site.edit("rules/night.rhai", "door.squeaks", "door.squeeks");
    site.adit("build", &[]).expecting(2).complains(&["night.rhai", "squeeks", "squeaks"]);
}

#[test]
fn areas_and_doors_of_the_map_s_own_file_count_as_those_of_the_site() {
    let site = hall("").with("map.toml", &format!("{HALL}{SOUTH_DOOR}closed = true\n")).built();
    assert!(northmost(&site) > 5.0);
}

#[test]
fn over_a_ros_map_too() {
    let site = hall(&format!(
        "{SOUTH_DOOR}closed = true\n[[place]]\nname = \"west\"\nat = [2.0, 1.6]\n\
         [[place]]\nname = \"east\"\nat = [10.0, 1.6]\n[[area]]\nname = \"ward\"\nrect = [0.0, 5.0, 4.0, 8.0]\n"
    ));
    site.edit("site.toml", "name = \"hall\"", "name = \"hall\"\nmap = \"map.yaml\"");
    site.write("map.yaml", "image: map.pgm\nresolution: 0.1\norigin: [0.0, 0.0, 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n");
    let wall = |x: u32, y: u32| x == 60 && !(10..22).contains(&y) && !(60..72).contains(&y);
    let pixels = (0..80).rev().flat_map(|y| (0..120).map(move |x| if wall(x, y) { 0 } else { 254 }));
    let image: Vec<u8> = b"P5\n120 80\n255\n".iter().copied().chain(pixels).collect();
    site.write("map.pgm", image);
    let site = site.built();
    assert!(northmost(&site) > 5.0);
    assert_eq!(site.sqlite3("SELECT area, round(x, 3), round(y, 3) FROM areas"), ["ward|2.0|6.5"]);
}

/// What a door says of itself moves no wall: rooms are those of before, and only what the rules say changes.
#[test]
fn an_edit_after_a_build_keeps_the_rooms_and_their_areas() {
    let site = hall(&format!("{SOUTH_DOOR}hardness = 1.0\n")).built();
    let count = "SELECT (SELECT count(*) FROM door_rooms), (SELECT count(*) FROM rooms)";
    let before = (site.sqlite3(count), cost(&site));
    site.adit("tune", &["robots", "LOW", "hardness", "2.5"]).expect_status(0);
    let stages = site.adit("build", &["--json"]).expecting(0).json();
    let kept =
        stages["stages"].as_array().unwrap().iter().find(|stage| stage["stage"] == "rooms by state").cloned();
    assert_eq!(kept.map(|stage| stage["kept"].clone()), Some(serde_json::json!(true)), "{stages}");
    assert_eq!((site.sqlite3(count), cost(&site)), before);
}

#[test]
fn in_the_paper_s_modes_a_room_lies_where_more_than_half_of_it_does() {
    let site = hall("rooms = \"minimum\"\n[[area]]\nname = \"ward\"\nrect = [0.0, 0.0, 5.0, 8.0]\n").built();
    let rooms =
        "SELECT count(*) FROM rooms JOIN area_rooms USING (room) WHERE min(x1, 5.0) - x0 <= (x1 - x0) / 2";
    assert_eq!(site.sqlite3(rooms), ["0"]);
    assert_eq!(site.sqlite3("SELECT count(*) > 0 FROM area_rooms"), ["1"]);
    let said = site.adit("build", &[]).expecting(0);
    assert!((said.stdout + said.stderr.as_str()).contains("no rule reads AREA_ROOMS"));
}

#[test]
fn what_is_wrong_with_an_area_or_a_door_names_its_line_and_touches_nothing() {
    let cases: [(&str, &[&str]); 5] = [
        (
            "[[area]]\nname = \"a\"\npolygon = [[1, 1], [4, 4], [4, 1], [1, 4]]\n",
            &["site.toml:4", "crosses itself", "(1, 1) to (4, 4)", "(4, 1) to (1, 4)"],
        ),
        ("[[area]]\nname = \"a\"\nrect = [20, 1, 22, 2]\n", &["site.toml", "outside", "x 0 to 12"]),
        (
            "[[area]]\nname = \"west\"\nrect = [1, 1, 2, 2]\n",
            &["site.toml", "the map has a place `west` already"],
        ),
        ("[[door]]\nname = \"d\"\nfrom = [6, 1]\nto = [6, 1]\n", &["site.toml", "no width"]),
        (
            "[[door]]\nname = \"d\"\nfrom = [6, 1]\nto = [6, 2]\nclosed = \"yes\"\n",
            &["site.toml", "`closed`", "truth", "text"],
        ),
    ];
    let site = hall("").built();
    let before = std::fs::read(site.path().join("site.db")).unwrap();
    for (items, words) in cases {
        site.write("site.toml", format!("name = \"hall\"\n{items}"));
        site.adit("build", &[]).expecting(2).complains(words);
    }
    assert_eq!(std::fs::read(site.path().join("site.db")).unwrap(), before);
}
