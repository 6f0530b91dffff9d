//! Real occupancy maps build end to end, and a route leads across each.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use std::path::Path;

use adit_tests::{TestSite, shared};

const ROBOTS: &str = r#"
[[robots]]
state = "DRIVE"
action = "DRIVE"
height = 1.2
width = 0.35
hardness = 1.0

[[robots]]
state = "TUCKED"
action = "CREEP"
height = 0.5
width = 0.22
hardness = 3.0
"#;

/// A site on a map of somebody else's; `places` are points on its floor.
fn site(map: &Path, places: &[(&str, [f64; 2])]) -> TestSite {
    let mut text =
        format!("name = \"{}\"\nmap = \"{}\"\nstarts = [\"here\"]\n", map.display(), map.display());
    for (name, [x, y]) in places {
        text = format!("{text}[[place]]\nname = \"{name}\"\nat = [{x}, {y}]\n");
    }
    TestSite::empty().with("robots.toml", ROBOTS).with("site.toml", &text)
}

#[track_caller]
fn leads_across(map: &str, here: [f64; 2], there: [f64; 2]) {
    let Some(map) = shared(map) else { return };
    let site = site(&map, &[("here", here), ("there", there)]).built();
    let rows = site.sqlite3("SELECT status, cost > 0 FROM route WHERE start = 'here' AND goal = 'there'");
    assert_eq!(rows, ["ok|1"]);
    let picture = site.path().join("map.png");
    site.adit("draw", &["-o", picture.to_str().unwrap(), "--route", "here", "there"]).expect_status(0);
    assert!(std::fs::metadata(picture).unwrap().len() > 10_000);
}

#[test]
fn nav2_depot() {
    leads_across("data/nav2/depot.yaml", [2.0, 7.0], [28.0, 7.0]);
}

#[test]
fn nav2_tb3_sandbox() {
    leads_across("data/nav2/tb3_sandbox.yaml", [-2.0, -0.5], [1.9, 0.6]);
}

#[test]
fn turtlebot3_world() {
    leads_across("data/turtlebot3/map.yaml", [-2.0, -0.5], [1.9, 0.6]);
}

#[test]
fn aws_bookstore() {
    leads_across("data/aws-robomaker/bookstore_map.yaml", [-2.5, 6.2], [3.0, -3.3]);
}

#[test]
fn aws_small_warehouse_rotated() {
    leads_across("data/aws-robomaker/small_warehouse_005_map.yaml", [-4.0, -2.85], [5.5, -4.35]);
}

#[test]
fn aws_small_warehouse_as_scanned() {
    let Some(image) = shared("data/aws-robomaker/small_warehouse_005_map.pgm") else { return };
    let yaml = format!(
        "image: {}\nresolution: 0.05\norigin: [0.0, 0.0, 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n",
        image.display()
    );
    let folder = TestSite::empty().with("warehouse.yaml", &yaml);
    let site =
        site(&folder.path().join("warehouse.yaml"), &[("here", [5.0, 2.7]), ("there", [15.0, 7.7])]).built();
    assert_eq!(site.sqlite3("SELECT status FROM route WHERE start = 'here' AND goal = 'there'"), ["ok"]);
}

#[test]
fn mir_maze() {
    leads_across("data/mir_robot/maze.yaml", [2.0, 2.0], [18.0, 18.0]);
}

#[test]
fn stage_lse_arena() {
    leads_across("data/stage/lse_arena.yaml", [0.6, 0.6], [3.4, 2.4]);
}

/// A body that is slim at eight facings, on a floor that was cut into many small rooms by an area with another hardness: there are
/// more ways through them than can be followed, and whoever asked waited until memory was used up.
#[test]
fn a_body_of_eight_facings_is_led_past_an_area_of_its_own_hardness() {
    let Some(map) = shared("data/nav2/depot.yaml") else { return };
    let site = TestSite::empty();
    let folder = site.path().join("depot");
    let depot = folder.to_str().unwrap();
    let adit = |arguments: &[&str]| {
        let ran =
            std::process::Command::new("timeout").arg("60").arg(adit_tests::adit()).args(arguments).output();
        adit_tests::Ran::new(&ran.unwrap()).expecting(0).stdout
    };
    adit(&["new", depot, "--map", map.to_str().unwrap(), "--robot", "quadruped"]);
    adit(&["build", depot]);
    let without = adit(&["route", depot, "2,2", "27,13"]);
    assert!(without.contains("hardness 27.484"), "{without}");
    adit(&["lay", depot, "area", "wet", "10,1 14,5", "--with", "hardness_factor=2"]);
    assert_eq!(adit(&["route", depot, "2,2", "27,13"]), without, "the way does not lead through the area");
    adit(&["route", depot, "2,2", "15.3,8"]);
}

/// A way that bends at an area, where no wall is, kept off no wall from its beginning to its end.
#[test]
fn a_way_past_an_area_of_its_own_hardness_keeps_off_walls_elsewhere() {
    let Some(map) = shared("data/nav2/depot.yaml") else { return };
    let site = TestSite::empty();
    let folder = site.path().join("depot");
    let depot = folder.to_str().unwrap();
    let adit = |arguments: &[&str]| {
        let ran = std::process::Command::new(adit_tests::adit()).args(arguments).output();
        adit_tests::Ran::new(&ran.unwrap()).expecting(0).stdout
    };
    adit(&["new", depot, "--map", map.to_str().unwrap(), "--robot", "cart"]);
    adit(&["build", depot]);
    adit(&["lay", depot, "area", "wet", "10,1 14,5", "--with", "hardness_factor=2"]);
    let route: serde_json::Value =
        serde_json::from_str(&adit(&["route", depot, "2,2", "28,3", "--json"])).unwrap();
    let clearances = route["waypoints"].as_array().unwrap().iter().filter_map(|at| at["clearance"].as_f64());
    let least = clearances.fold(f64::INFINITY, f64::min);
    assert!(least > 0.049, "{least}: {route}");
}
