//! What the paper leaves to the application is decided by rules, and an edit of them counts without a build.

use std::fs;

use adit_tests::{TestSite, repository};

use super::support::{cell, learn, sql};

fn with_rules() -> TestSite {
    let folder = cell();
    for entry in fs::read_dir(repository().join("rules/adapt")).expect("the rule base") {
        let file = entry.expect("a file").path();
        if file.is_file() {
            let name = file.file_name().expect("a name").to_string_lossy().into_owned();
            folder.write(&format!("rules/{name}"), fs::read(&file).expect("readable"));
        }
    }
    folder.write("cell.toml", format!("rules = \"rules\"\n{}", folder.read("cell.toml")));
    folder
}

fn move_the_post(folder: &TestSite) {
    folder.edit("cell.toml", "at      = [-0.9, 0.6]", "at      = [-1.2, 0.6]");
}

#[test]
fn the_strategy_after_a_change() {
    let folder = with_rules();
    learn(&folder, &["--tasks", "6"]).expect_status(0);
    move_the_post(&folder);
    let ran = learn(&folder, &["load", "--explain"]).expect_status(0);
    assert!(ran.stdout.contains("repair a3"), "{}", ran.stdout);
    assert!(ran.stdout.contains("strategy: a3, by repair strategy, row 5"), "{}", ran.stdout);
    // Whoever has time repairs at once; whoever thinks nothing of experience forgets.
    for (strategy, row) in [
        ("a2", "[ any,   false, any,          any, \"a3\" ]"),
        ("a0", "[ any,   false, any,          any, \"a2\" ]"),
    ] {
        folder.edit(
            "rules/repair.rhai",
            row,
            &format!("[ any,   false, any,          any, \"{strategy}\" ]"),
        );
        let text = folder.read("cell.toml");
        let moved = if text.contains("[-1.2, 0.6]") {
            text.replace("[-1.2, 0.6]", "[-0.9, 0.6]")
        } else {
            text.replace("[-0.9, 0.6]", "[-1.2, 0.6]")
        };
        folder.write("cell.toml", moved);
        let ran = learn(&folder, &["--json"]).expect_status(0).json();
        assert_eq!(ran["change"]["strategy"], strategy);
    }
    assert_eq!(
        sql(&folder, "cell.db", "SELECT strategy FROM strategies ORDER BY revision"),
        ["a3", "a2", "a0"]
    );
    assert_eq!(sql(&folder, "cell.db", "SELECT count(*) FROM subgoals WHERE removed_task IS NULL"), ["1"]);
    assert_ne!(sql(&folder, "cell.db", "SELECT count(*) FROM subgoals WHERE because = 'forgotten'"), ["0"]);
}

#[test]
fn the_landmark_of_a_subgoal() {
    let folder = with_rules();
    folder.edit("rules/landmarks.rhai", "landmark.distance <= 0.6", "landmark.object == \"press\"");
    learn(&folder, &["load", "unload", "shelf"]).expect_status(0);
    let objects = "SELECT DISTINCT coalesce(object, '-') FROM subgoals ORDER BY 1";
    assert_eq!(sql(&folder, "cell.db", objects), ["-", "press"]);
}

#[test]
fn trust_in_an_edge() {
    let folder = with_rules();
    learn(&folder, &["--tasks", "8"]).expect_status(0);
    folder.edit(
        "rules/edges.rhai",
        "[ any, any,          any,        \"verify\" ]",
        "[ any, any,          any,        \"give up\" ]",
    );
    move_the_post(&folder);
    learn(&folder, &["--tasks", "4"]).expect_status(0);
    assert_ne!(sql(&folder, "cell.db", "SELECT count(*) FROM edges WHERE because = 'given up'"), ["0"]);
}

#[test]
fn a_word_that_means_nothing_is_an_error() {
    let folder = with_rules();
    learn(&folder, &["--tasks", "3"]).expect_status(0);
    folder.edit(
        "rules/repair.rhai",
        "[ any,   false, any,          any, \"a3\" ]",
        "[ any,   false, any,          any, \"a7\" ]",
    );
    move_the_post(&folder);
    learn(&folder, &["load"]).expect_status(2).complains(&[
        "rules do not say the strategy after a change",
        "a7",
        "\"a0\", \"a1\", \"a2\" or \"a3\"",
    ]);
}
