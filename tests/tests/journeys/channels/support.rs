//! Maps of channels in files, alone as sites, and their routes.

use std::fs;
use std::process::Command;

use adit_tests::{Ran, TestSite, adit, repository};
use serde_json::{Value, json};

/// A folder for maps.
pub fn maps() -> TestSite {
    TestSite::empty()
}

/// The ends of the one route that a map without places has.
fn ends(map: &str) -> [&'static str; 2] {
    if map.contains("[assembly]") { ["assembled", "disassembled"] } else { ["start", "goal"] }
}

/// Runs a verb on a file of this folder.
pub fn on(folder: &TestSite, args: &[&str]) -> Ran {
    let mut command = Command::new(adit());
    command.current_dir(folder.path()).args(args);
    Ran::new(&command.output().expect("adit runs"))
}

/// The route over a map of this folder.
pub fn route(folder: &TestSite, map: &str, args: &[&str]) -> Ran {
    let [start, goal] = ends(&folder.read(map));
    on(folder, &[&["route", map, start, goal], args].concat())
}

/// As [`route`], over a map that is given as text.
pub fn route_of(text: &str, args: &[&str]) -> Ran {
    route(&maps().with("map.toml", text), "map.toml", args)
}

/// The answer as JSON.
pub fn answer(text: &str) -> Value {
    route_of(text, &["--json"]).expect_status(0).json()
}

/// A map with this gap instead of its own.
pub fn with_gap(text: &str, gap: &str) -> String {
    let kept: Vec<&str> = text.lines().filter(|line| !line.starts_with("gap")).collect();
    format!("{}\ngap = {gap}\n", kept.join("\n"))
}

fn at(waypoint: &Value) -> Value {
    json!([waypoint["x"], waypoint["y"]])
}

/// Lines and arcs from waypoint to waypoint.
pub fn primitives(route: &Value) -> Vec<Value> {
    let waypoints = route["waypoints"].as_array().expect("waypoints");
    let primitive = |pair: &[Value]| {
        let (a, b) = (at(&pair[0]), at(&pair[1]));
        if pair[1]["centre_x"].is_null() {
            return json!({"kind": "line", "a": a, "b": b});
        }
        let centre = json!([pair[1]["centre_x"], pair[1]["centre_y"]]);
        let off = |axis: usize| b[axis].as_f64().expect("metres") - centre[axis].as_f64().expect("metres");
        json!({"kind": "arc", "centre": centre, "radius": off(0).hypot(off(1)), "turn": pair[1]["turn"], "a": a, "b": b})
    };
    waypoints.windows(2).map(primitive).collect()
}

/// The rows of the table that decided, step by step: of turns, or of moves.
pub fn rows_of(route: &Value, table: &str) -> Vec<Value> {
    let steps = route["steps"].as_array().expect("steps").iter();
    let row =
        |step: &Value| step["rule"].as_str()?.strip_prefix(&format!("{table}, row "))?.parse::<u64>().ok();
    steps.filter_map(row).map(Value::from).collect()
}

/// The least clearance of a route.
pub fn clearance(route: &Value) -> Value {
    let of_legs = route["waypoints"].as_array().expect("waypoints").iter();
    json!(of_legs.filter_map(|at| at["clearance"].as_f64()).fold(f64::INFINITY, f64::min))
}

/// Copies a shipped rule base into the folder `rules` beside worlds.
pub fn copy_rules(folder: &TestSite, base: &str) {
    for entry in fs::read_dir(repository().join("rules/channels").join(base)).expect("a rule base") {
        let file = entry.expect("a file").path();
        if file.is_file() {
            let name = file.file_name().expect("a name").to_string_lossy().into_owned();
            folder.write(&format!("rules/{name}"), fs::read(&file).expect("readable"));
        }
    }
}

/// Whether two values are the same to 1e-5, number by number.
pub fn close(found: &Value, wanted: &Value) -> bool {
    match (found, wanted) {
        (Value::Number(found), Value::Number(wanted)) => {
            (found.as_f64().expect("a number") - wanted.as_f64().expect("a number")).abs() <= 1e-5
        }
        (Value::Array(found), Value::Array(wanted)) => {
            found.len() == wanted.len()
                && found.iter().zip(wanted).all(|(found, wanted)| close(found, wanted))
        }
        (Value::Object(found), Value::Object(wanted)) => {
            found.len() == wanted.len()
                && wanted.iter().all(|(key, wanted)| found.get(key).is_some_and(|found| close(found, wanted)))
        }
        (found, wanted) => found == wanted,
    }
}

/// Expects two values to be the same to 1e-5.
#[track_caller]
pub fn expect_close(what: &str, found: &Value, wanted: &Value) {
    assert!(close(found, wanted), "{what}: found {found}, expected {wanted}");
}

/// The example of section 4.
pub const SECTION_4: &str = r"
[assembly]
channels = [[1, 2, 5, 7], [1, 2, 7, 6], [4, 1, 7, 6]]
male = [[4.5, 1.01], [4.5, 4.0], [6.99, 4.0], [6.99, 1.01]]
";

/// The S of section 5.
pub const S: &str = r"
[corridor]
channels = [[0, 0, 3, 9], [0, 6, 12, 9], [9, 6, 12, 18]]
robot = { width = 1.0, length = 1.5 }
start = [1.5, 2.0]
goal  = [10.5, 16.0]
gap   = 0.2
";
