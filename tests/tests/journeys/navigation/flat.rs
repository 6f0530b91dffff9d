//! The flat, in a folder of its own.

use std::fs;
use std::process::Command;

use adit_tests::{Ran, TestSite, adit, repository};

pub fn flat() -> TestSite {
    let folder = TestSite::empty();
    for name in ["flat.toml", "flat.json"] {
        folder.write(name, fs::read(repository().join("kb/worlds").join(name)).expect("the flat"));
    }
    folder
}

/// Runs a verb on the flat.
pub fn run(folder: &TestSite, verb: &str, args: &[&str]) -> Ran {
    on(folder, verb, "flat.toml", args)
}

/// Runs a verb on a file of the folder.
pub fn on(folder: &TestSite, verb: &str, file: &str, args: &[&str]) -> Ran {
    let mut command = Command::new(adit());
    command.current_dir(folder.path()).args([verb, file]).args(args);
    Ran::new(&command.output().expect("adit runs"))
}

/// Gives the flat rules of its own, as they are shipped.
pub fn copy_rules(folder: &TestSite) {
    for entry in fs::read_dir(repository().join("rules/navigation")).expect("the rule base") {
        let file = entry.expect("a file").path();
        if file.is_file() {
            let name = file.file_name().expect("a name").to_string_lossy().into_owned();
            folder.write(&format!("rules/{name}"), fs::read(&file).expect("readable"));
        }
    }
    folder.write("flat.toml", format!("rules = \"rules\"\n{}", folder.read("flat.toml")));
}

/// Asks a database of the folder by a plain client.
pub fn sql(folder: &TestSite, database: &str, query: &str) -> Vec<String> {
    let output = Command::new("sqlite3")
        .args(["-readonly", database, query])
        .current_dir(folder.path())
        .output()
        .expect("runs");
    String::from_utf8_lossy(&output.stdout).lines().map(str::to_owned).collect()
}
