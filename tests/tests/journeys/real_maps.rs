//! Real occupancy maps build end to end, and a route leads across each.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use std::path::Path;
use std::process::Command;

use adit_tests::{Ran, TestSite, shared};
use serde_json::Value;

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

/// A site on the depot with a kind of robot.
struct Depot(TestSite);

impl Depot {
    /// `None` where the map is not there.
    fn with(robot: &str) -> Option<Self> {
        let map = shared("data/nav2/depot.yaml")?;
        let site = Self(TestSite::empty());
        site.adit("new", &["--map", map.to_str().unwrap(), "--robot", robot]);
        site.adit("build", &[]);
        Some(site)
    }

    fn adit(&self, verb: &str, arguments: &[&str]) -> String {
        let mut program = Command::new("timeout");
        program.arg("60").arg(adit_tests::adit()).arg(verb).arg(self.0.path().join("depot")).args(arguments);
        Ran::new(&program.output().unwrap()).expecting(0).stdout
    }

    /// In which each metre is twice as hard.
    fn lay_an_area(&self) {
        self.adit("lay", &["area", "wet", "10,1 14,5", "--with", "hardness_factor=2"]);
    }
}

/// There are more ways through the many small rooms about an area than can be followed: whoever asked for a route waited until
/// memory was used up.
#[test]
fn a_body_of_eight_facings_is_led_past_an_area_of_its_own_hardness() {
    let Some(depot) = Depot::with("quadruped") else { return };
    let without = depot.adit("route", &["2,2", "27,13"]);
    depot.lay_an_area();
    assert_eq!(depot.adit("route", &["2,2", "27,13"]), without, "the way does not lead through the area");
    depot.adit("route", &["2,2", "15.3,8"]);
}

/// A way that bends at an area, where no wall is, kept off no wall from its beginning to its end.
#[test]
fn a_way_past_an_area_of_its_own_hardness_keeps_off_walls_elsewhere() {
    let Some(depot) = Depot::with("cart") else { return };
    depot.lay_an_area();
    let route: Value = serde_json::from_str(&depot.adit("route", &["2,2", "28,3", "--json"])).unwrap();
    let clearances = route["waypoints"].as_array().unwrap().iter().filter_map(|at| at["clearance"].as_f64());
    let least = clearances.fold(f64::INFINITY, f64::min);
    assert!(least > 0.049, "{least}: {route}");
}
