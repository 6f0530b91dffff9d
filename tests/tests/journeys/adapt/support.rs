//! The example cell in a folder of its own.

use std::fs;
use std::process::Command;

use adit_tests::{Ran, TestSite, adit, repository};

/// The example cell.
pub fn cell() -> TestSite {
    let folder = TestSite::empty();
    folder.write("cell.toml", fs::read(repository().join("kb/worlds/cell.toml")).expect("the cell"));
    folder
}

/// A command that runs the program in the folder.
pub fn command(folder: &TestSite, args: &[&str]) -> Command {
    let mut command = Command::new(adit());
    command.current_dir(folder.path()).args(args);
    command
}

pub fn run(folder: &TestSite, args: &[&str]) -> Ran {
    Ran::new(&command(folder, args).output().expect("adit runs"))
}

/// `adit tasks cell.toml ARGS... --db cell.db`
pub fn learn(folder: &TestSite, args: &[&str]) -> Ran {
    let mut all = vec!["tasks", "cell.toml", "--db", "cell.db"];
    all.extend(args);
    run(folder, &all)
}

/// The rows that the plain `sqlite3` shell prints of a database in the folder.
pub fn sql(folder: &TestSite, db: &str, query: &str) -> Vec<String> {
    let ran = Command::new("sqlite3").arg("-readonly").arg(folder.path().join(db)).arg(query).output();
    let ran = Ran::new(&ran.expect("the sqlite3 shell is installed (tests/run installs it)"));
    ran.expect_status(0).stdout.lines().map(str::to_owned).collect()
}

/// Everything that is kept of experience, but for the times of day.
pub fn experience(folder: &TestSite, db: &str) -> Vec<String> {
    let tables = [
        ("cells", "cell, robot, tasks, revision, next_subgoal, next_edge, configuration, stands, figures"),
        ("cell_objects", "object, revision, times_moved, x, y, heading_rad, polygon"),
        ("subgoals", "*"),
        ("edges", "*"),
        (
            "tasks",
            "cell, task, goal, configuration, found, evaluations, solve_calls, reach_calls, length, path",
        ),
        ("clearances", "*"),
    ];
    let rows = |(table, columns): (&str, &str)| {
        sql(folder, db, &format!("SELECT '{table}', {columns} FROM {table}"))
    };
    tables.into_iter().flat_map(rows).collect()
}
