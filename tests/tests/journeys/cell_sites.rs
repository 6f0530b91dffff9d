//! Cells (Chen) as sites: objects and goals are rows, motions are routes, and one cell that is changed moves an object.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use std::path::PathBuf;
use std::process::Command;

use adit_tests::service::Service;
use adit_tests::{Ran, TestSite, adit};
use serde_json::{Value, json};

/// A site of a world of cells, as `adit new --map` makes it.
fn site_of(name: &str) -> TestSite {
    let file = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../kb/worlds").join(name);
    let site = TestSite::empty();
    let folder = site.path().join("new");
    let made = Command::new(adit()).arg("new").arg(&folder).arg("--map").arg(file).output().unwrap();
    Ran::new(&made).expect_status(0);
    for file in ["site.toml", "rules/own.rhai", name] {
        site.write(file, std::fs::read(folder.join(file)).unwrap());
    }
    site
}

const MOTION: &str = "SELECT step, kind, action, state FROM action_sequence
                      WHERE start = 'load' AND goal = 'unload' ORDER BY step";

#[test]
fn an_arm_moves_between_goals_and_one_cell_moves_an_object() {
    let site = site_of("cell.toml");
    let built = site.adit("build", &[]).expecting(0);
    assert!(built.stdout.contains("4 objects, 4 goals, routes from 5 starts"), "{}", built.stdout);
    assert!(!built.stderr.contains("waits for"), "{}", built.stderr);
    assert_eq!(site.sqlite3("SELECT count(*) FROM route WHERE status = 'ok'"), ["20"]);
    let first = site.sqlite3(MOTION);
    assert!(first.iter().all(|step| step.contains("|motion|MOVE|")), "{first:?}");
    let sums = site.sqlite3(
        "SELECT count(*) FROM route AS r WHERE abs(r.cost - (SELECT sum(hardness) FROM action_sequence AS a
         WHERE a.start = r.start AND a.goal = r.goal)) > 1e-9",
    );
    assert_eq!(sums, ["0"]);
    // the tool begins where the last point of the way to the start ends
    let tool = "SELECT round(x, 6), round(y, 6) FROM waypoints WHERE start = 'load' AND goal = 'unload' AND waypoint = 1";
    let before = site.sqlite3(tool);
    let moved =
        site.adit("tune", &["objects", "bin", "x", "1.0", "--why", "the bin was moved"]).expecting(0).stdout;
    assert!(moved.contains("load"), "{moved}");
    assert_ne!(site.sqlite3(tool), before, "the goal goes along with the bin");
    let all = "SELECT * FROM route; SELECT * FROM action_sequence; SELECT * FROM waypoints";
    let edited = site.sqlite3(all);
    site.adit("build", &[]).expect_status(0);
    assert_eq!(site.sqlite3(all), edited, "what was edited is what is built");
    site.adit("undo", &[]).expect_status(0);
    assert_eq!(site.sqlite3(MOTION), first);
    let why = site.adit("why", &["goals.unload.action"]).expecting(0).stdout;
    assert!(why.contains("a robot moves to a goal"), "{why}");
    site.adit("check", &[]).expect_status(0);
    site.adit("test", &[]).expect_status(0);
}

#[test]
fn a_configuration_is_an_end_and_what_is_in_the_way_is_said() {
    let site = site_of("cell.toml").built();
    let route = site.adit("route", &["home", "2.8,-0.5", "--json"]).expecting(0).json();
    assert_eq!(route["status"], "ok", "{route}");
    assert_eq!(route["waypoints"][0]["state"], "1.6, 0", "{route}");
    site.adit("route", &["home", "9,9"]).expecting(2).complains(&["lies outside of the robot's limits"]);
    site.adit("route", &["home", "lode"]).expecting(2).complains(&["`lode` is no goal"]);
    // the post is set upon the goal at the press
    let blocked = site.adit("tune", &["objects", "post", "x", "0.9", "--dry-run"]).expecting(0).stdout;
    assert!(blocked.contains("→"), "{blocked}");
    for (edit, words) in [
        (["joints", "1", "low", "4"], "must go from a lower to a higher angle"),
        (["objects", "bin", "outline", "[[0,0],[1,1]]"], "objects bin"),
        (["objects", "bin", "outline", "round"], "expected corners as [[x,y],…]"),
        (["goals", "load", "object", "bim"], "there is no object `bim`"),
        (["goals", "inspect", "configuration", "[9,9]"], "expected 2 numbers within"),
        (["arms", "robot", "margin", "-1"], "margin is `-1`, expected more than 0"),
    ] {
        let before = site.sqlite3("SELECT * FROM objects; SELECT * FROM goals; SELECT * FROM joints; SELECT * FROM arms; SELECT * FROM route");
        site.adit("tune", &edit).expecting(2).complains(&[words]);
        let after = site.sqlite3("SELECT * FROM objects; SELECT * FROM goals; SELECT * FROM joints; SELECT * FROM arms; SELECT * FROM route");
        assert_eq!(after, before, "{edit:?}");
    }
}

#[test]
fn a_route_is_the_same_whatever_was_asked_before_and_back_as_long_as_there() {
    let site = site_of("cell.toml").built();
    let kept = site.sqlite3("SELECT start, goal, cost FROM route ORDER BY start, goal");
    let back = "SELECT count(*) FROM route AS a JOIN route AS b ON a.start = b.goal AND a.goal = b.start
                WHERE abs(a.cost - b.cost) > 1e-9";
    assert_eq!(site.sqlite3(back), ["0"]);
    // nearer than straight is nothing, and where straight is free it is taken
    let straight = site.adit("route", &["home", "1.5,0.2", "--json"]).expecting(0).json();
    assert!((straight["cost"].as_f64().unwrap() - 0.05_f64.sqrt()).abs() < 1e-9, "{straight}");
    // goals that go first in the alphabet are planned first, and change nothing of the others
    site.adit("tune", &["goals", "aside", "--add", "configuration=[2.0,0.5]"]).expect_status(0);
    let others =
        "SELECT start, goal, cost FROM route WHERE 'aside' NOT IN (start, goal) ORDER BY start, goal";
    assert_eq!(site.sqlite3(others), kept);
}

#[test]
fn a_wider_margin_keeps_farther_off() {
    let site = site_of("cell.toml").built();
    let total = "SELECT sum(cost) FROM route";
    let near = site.sqlite3(total)[0].parse::<f64>().unwrap();
    site.adit("tune", &["arms", "robot", "margin", "0.02"]).expect_status(0);
    let far = site.sqlite3(total)[0].parse::<f64>().unwrap();
    assert!(far > near, "{near} {far}");
    let status = "SELECT DISTINCT status FROM route";
    assert_eq!(site.sqlite3(status), ["ok"]);
    // at three of the goals the arm is nearer to an object than 6 cm, and so there are no motions to them
    site.adit("tune", &["arms", "robot", "margin", "0.06"]).expect_status(0);
    let words = "SELECT DISTINCT reason FROM route WHERE start = 'home' AND reason IS NOT NULL ORDER BY goal";
    assert_eq!(
        site.sqlite3(words),
        ["post at goal inspect", "bin at goal load", "rack at goal shelf"]
            .map(|what| format!("the robot would touch {what}"))
    );
}

#[test]
fn a_disc_is_a_robot_too_and_a_cell_is_served() {
    let site = site_of("cell-point.toml").built();
    assert_ne!(site.sqlite3("SELECT count(*) FROM route WHERE status = 'ok'"), ["0"]);
    site.adit("draw", &["-o", site.path().join("cell.svg").to_str().unwrap()]).expect_status(0);
    let service = Service::start(&site);
    let (status, of) = service.ask("GET", "/api/site", None);
    assert_eq!((status, &of["layout_kind"]), (200, &json!("cell")), "{of}");
    let names = site.sqlite3("SELECT replace(goal, ' ', '%20') FROM goals LIMIT 1");
    let (status, route) = service.ask("GET", &format!("/api/route?start=home&goal={}", names[0]), None);
    assert_eq!((status, &route["status"]), (200, &json!("ok")), "{route}");
}

/// An arm that gets past a post with its elbow far bent.
const BENT: &str = r#"[cell]
links = [1.0, 0.7]
link_radius = 0.04
joint_limits = [[-3.0, 3.0], [-2.5, 2.5]]
home = [1.57, 0]
[[cell.object]]
name = "table"
polygon = [[-0.2, -0.2], [0.2, -0.2], [0.2, 0.2], [-0.2, 0.2]]
at = [1.35, 0.2]
[[cell.object]]
name = "post"
polygon = [[-0.05, -0.05], [0.05, -0.05], [0.05, 0.05], [-0.05, 0.05]]
at = [0.3, 1.3]
[[cell.goal]]
name = "pick"
object = "table"
tool = [0, 0.3]
[[cell.goal]]
name = "place"
configuration = [-1.0, 0.5]
"#;

#[test]
fn what_lies_beyond_limits_that_are_tuned_is_forgotten_and_another_robot_is_refused() {
    let site = TestSite::empty();
    site.write("bent.toml", BENT);
    site.write("site.toml", "map = \"bent.toml\"\n");
    site.adit("build", &[]).expect_status(0);
    let tasks = |args: &[&str]| site.adit("tasks", args);
    let elbow = || -> f64 {
        let last = "SELECT max(json_extract(value, '$[1]')) FROM tasks, json_each(tasks.path)
                    WHERE task = (SELECT max(task) FROM tasks)";
        site.sqlite3(last)[0].parse().unwrap()
    };
    tasks(&["pick", "place", "pick"]).expect_status(0);
    assert!(elbow() > 1.5, "it learned a way with its elbow bent: {}", elbow());
    site.adit("tune", &["joints", "2", "high", "1.0"]).expect_status(0);
    let ran = tasks(&["place", "pick"]).expecting(0);
    ran.complains(&["the robot's limits are others than when it learned"]);
    assert!(elbow() <= 1.0, "{}", elbow());
    let beyond = "SELECT count(*) FROM subgoals WHERE removed_task IS NULL AND json_extract(configuration, '$[1]') > 1.0";
    assert_eq!(site.sqlite3(beyond), ["0"]);
    // said once: what is kept is of these limits now
    assert_eq!(tasks(&["place"]).expecting(0).stderr, "");
    site.adit("tune", &["joints", "2", "length", "0.75"]).expect_status(0);
    tasks(&["pick"]).expecting(2).complains(&["is of another robot", "forget what the other one learned"]);
}

#[test]
fn a_cell_of_a_site_is_learned_in_as_it_is_tuned_and_experience_follows() {
    let site = site_of("cell.toml").built();
    let tasks = |args: &[&str]| site.adit("tasks", args).expecting(0);
    let first = tasks(&["load", "unload", "load", "--json"]).json();
    let again = tasks(&["unload", "load", "--json"]).json();
    let cost = |ran: &Value| ran["tasks"][0]["evaluations"].as_f64().unwrap();
    assert!(cost(&again) < cost(&first) / 4.0, "{first} {again}");
    assert_eq!(site.sqlite3("SELECT tasks FROM cells"), ["5"]);
    // one cell of a table moves the bin; what hangs on it goes along
    site.adit("tune", &["objects", "bin", "x", "0.95"]).expect_status(0);
    let moved = tasks(&["unload", "--json"]).json();
    assert_eq!(moved["change"]["facts"]["moved"], 1.0, "{moved}");
    assert!(moved["change"]["facts"]["subgoals_moved"].as_f64().unwrap() >= 1.0, "{moved}");
    // the margin is that of the table, and a figure of the planner is a cell, too
    site.adit("tune", &["learning", "cuts_corners", "value", "0"]).expect_status(0);
    site.adit("tune", &["learning", "cuts_corners", "value", "2"])
        .expecting(2)
        .complains(&["1 (yes) or 0 (no)"]);
    tasks(&["load"]);
    // and the experience outlives a build
    site.adit("build", &[]).expect_status(0);
    assert_eq!(site.sqlite3("SELECT tasks FROM cells"), ["7"]);
}
