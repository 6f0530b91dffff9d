//! Worlds in files, and what `adit plan` says of them.

use std::fs;
use std::process::Command;

use adit_tests::{Ran, TestSite, adit, repository};
use serde_json::Value;

/// A folder for worlds.
pub fn worlds() -> TestSite {
    TestSite::empty()
}

/// Runs `adit plan` on a world of this folder.
pub fn plan(folder: &TestSite, world: &str, args: &[&str]) -> Ran {
    let mut command = Command::new(adit());
    command.current_dir(folder.path()).args(["plan", world]).args(args);
    Ran::new(&command.output().expect("adit runs"))
}

/// As [`plan`], of a world that is given as text.
pub fn plan_text(text: &str, args: &[&str]) -> Ran {
    plan(&worlds().with("world.toml", text), "world.toml", args)
}

/// What a plan answers as JSON.
pub fn answer(text: &str, args: &[&str]) -> Value {
    let args: Vec<&str> = args.iter().copied().chain(["--json"]).collect();
    plan_text(text, &args).expect_status(0).json()
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
