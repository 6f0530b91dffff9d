//! Learning, restarts, changes of the cell, copies.

use super::support::{cell, experience, learn, run, sql};

#[test]
fn a_goal_that_was_reached_before_costs_next_to_nothing() {
    let folder = cell();
    let first = learn(&folder, &["load", "unload", "load", "unload", "--json"]).expect_status(0).json();
    let of = |task: usize, key: &str| first["tasks"][task][key].as_f64().expect("a number");
    assert!(of(0, "solve_calls") + of(1, "solve_calls") >= 1.0, "{first}");
    assert!(
        of(2, "evaluations") + of(3, "evaluations") < (of(0, "evaluations") + of(1, "evaluations")) / 4.0,
        "{first}"
    );
    // Another process goes on where this one ended.
    let second = learn(&folder, &["load", "unload", "--json"]).expect_status(0).json();
    assert_eq!(second["experience"]["tasks"], 6);
    assert_eq!(second["change"], serde_json::Value::Null);
    assert_eq!(second["tasks"][0]["solve_calls"], 0);
    assert_eq!(
        sql(&folder, "cell.db", "SELECT task, goal, found FROM tasks WHERE task > 4"),
        ["5|load|1", "6|unload|1"]
    );
}

#[test]
fn tasks_one_by_one_are_the_same_as_all_at_once() {
    let folder = cell();
    learn(&folder, &["--tasks", "12", "--seed", "3"]).expect_status(0);
    for _ in 0..12 {
        run(&folder, &["tasks", "cell.toml", "--db", "other.db", "--tasks", "1", "--seed", "3"])
            .expect_status(0);
    }
    assert_eq!(experience(&folder, "cell.db"), experience(&folder, "other.db"));
}

#[test]
fn nothing_is_kept_without_a_database_and_nothing_is_written_without_a_task() {
    let folder = cell();
    let ran = run(&folder, &["tasks", "cell.toml", "load"]).expect_status(0);
    assert!(ran.stdout.contains("nothing is kept without --db"), "{}", ran.stdout);
    assert!(!folder.path().join("cell.db").exists());
    learn(&folder, &["load"]).expect_status(0);
    let before = experience(&folder, "cell.db");
    learn(&folder, &[]).expect_status(0);
    assert_eq!(experience(&folder, "cell.db"), before);
}

#[test]
fn subgoals_go_along_with_an_object_that_moves() {
    let folder = cell();
    learn(&folder, &["load", "unload", "load", "shelf"]).expect_status(0);
    let of_bin = "SELECT count(*) FROM subgoals WHERE object = 'bin' AND removed_task IS NULL";
    assert_ne!(sql(&folder, "cell.db", of_bin), ["0"]);
    folder.edit("cell.toml", "at      = [0.9, -0.8]", "at      = [0.95, -0.75]");
    let ran = learn(&folder, &["unload", "load", "--json"]).expect_status(0).json();
    assert_eq!(ran["change"]["facts"]["moved"], 1.0);
    assert!(ran["change"]["facts"]["subgoals_moved"].as_f64().expect("a number") >= 1.0, "{ran}");
    assert_eq!(sql(&folder, "cell.db", "SELECT object, how FROM object_changes"), ["bin|moved"]);
    assert_eq!(sql(&folder, "cell.db", "SELECT times_moved FROM cell_objects WHERE object = 'bin'"), ["1"]);
    // The tool is over the bin where it is now.
    let tool = "SELECT configuration FROM tasks WHERE task = 6";
    let at: Vec<f64> = serde_json::from_str(&sql(&folder, "cell.db", tool)[0]).expect("numbers");
    let (x, y) =
        (0.9 * at[0].cos() + 0.8 * (at[0] + at[1]).cos(), 0.9 * at[0].sin() + 0.8 * (at[0] + at[1]).sin());
    assert!((x - 0.95).abs() < 1e-6 && (y + 0.57).abs() < 1e-6, "({x}, {y})");
}

#[test]
fn what_broke_can_be_asked_by_sql() {
    let folder = cell();
    learn(&folder, &["--tasks", "25", "--seed", "6"]).expect_status(0);
    // A wall where the arm swings.
    folder.write(
        "cell.toml",
        folder.read("cell.toml")
            + "
[[cell.object]]
name    = \"wall\"
polygon = [[0.25, 1.25], [0.35, 1.25], [0.35, 1.6], [0.25, 1.6]]
",
    );
    let ran = learn(&folder, &["--tasks", "15", "--seed", "6"]).expect_status(0);
    assert!(ran.stdout.contains("the cell changed: 1 object came"), "{}", ran.stdout);
    let broken = sql(
        &folder,
        "cell.db",
        "SELECT because, count(*), min(removed_task) > 25 FROM edges WHERE because = 'broken' GROUP BY because",
    );
    assert_eq!(broken.len(), 1, "the wall broke nothing: {broken:?}");
    assert!(broken[0].ends_with("|1"), "{broken:?}");
    let strategies = sql(
        &folder,
        "cell.db",
        "SELECT task, strategy, file IS NOT NULL, facts LIKE '%\"appeared\":1%' FROM strategies",
    );
    assert_eq!(strategies, ["25|a3|1|1"]);
}

#[test]
fn an_object_that_goes_takes_its_subgoals_and_that_is_said() {
    let folder = cell();
    learn(&folder, &["load", "unload", "load"]).expect_status(0);
    let text = folder.read("cell.toml");
    let (without, _) = text.split_once("[[cell.object]]\nname    = \"bin\"").expect("the bin");
    let (_, rest) = text.split_once("movable = true\n").expect("its end");
    let (goals_before, goals) = rest.split_once("# Where the tool is").expect("the goals");
    let (_, goals) = goals.split_once("[[cell.goal]]\nname   = \"unload\"").expect("the next goal");
    folder.write("cell.toml", format!("{without}{goals_before}[[cell.goal]]\nname   = \"unload\"{goals}"));
    let ran = learn(&folder, &["unload", "shelf"]).expect_status(0);
    assert!(ran.stdout.contains("1 object went"), "{}", ran.stdout);
    assert!(ran.stdout.contains("are dropped"), "{}", ran.stdout);
    let left = "SELECT count(*) FROM subgoals WHERE object = 'bin' AND removed_task IS NULL";
    assert_eq!(sql(&folder, "cell.db", left), ["0"]);
}

#[test]
fn a_goal_on_an_object_out_of_reach_is_a_clear_no() {
    let folder = cell();
    learn(&folder, &["load", "unload"]).expect_status(0);
    folder.edit("cell.toml", "at      = [0.9, -0.8]", "at      = [1.9, -0.8]");
    let ran = learn(&folder, &["load"]).expect_status(1);
    assert!(ran.stdout.contains("the tool cannot get to goal load"), "{}", ran.stdout);
    assert!(ran.stdout.contains("dropped"), "{}", ran.stdout);
}

#[test]
fn goals_by_chance_are_within_reach() {
    let folder = cell();
    let far = "\n[[cell.goal]]\nname = \"far\"\nobject = \"bin\"\ntool = [90.0, 0.0]\n";
    folder.write("cell.toml", format!("{}{far}", folder.read("cell.toml")));
    let ran =
        run(&folder, &["tasks", "cell.toml", "--tasks", "30", "--seed", "1", "--json"]).expect_status(0);
    let ran = ran.json();
    assert_eq!(ran["tasks"].as_array().map(Vec::len), Some(30));
}

#[test]
fn an_object_that_is_turned_is_said_to_be() {
    let folder = cell();
    learn(&folder, &["load"]).expect_status(0);
    folder.edit("cell.toml", "at      = [-0.9, 0.6]", "at      = [-0.9, 0.6]\nheading = 20.0");
    let ran = learn(&folder, &["load"]).expect_status(0);
    assert!(ran.stdout.contains("1 object moved (by up to 20 degrees)"), "{}", ran.stdout);
}

#[test]
fn a_variant_begins_with_a_copy_of_the_experience() {
    let folder = cell();
    learn(&folder, &["load", "unload", "shelf", "home"]).expect_status(0);
    let before = experience(&folder, "cell.db");
    folder.write(
        "variant.toml",
        folder.read("cell.toml").replace("at      = [-0.9, 0.6]", "at      = [-0.95, 0.6]"),
    );
    let variant = |args: &[&str]| run(&folder, &[&["tasks", "variant.toml", "--json"], args].concat());
    let ran = variant(&["load", "--db", "cell.db", "--from", "cell"]).expect_status(0).json();
    assert_eq!(ran["change"]["facts"]["moved"], 1.0);
    assert_eq!(ran["tasks"][0]["solve_calls"], 0, "{ran}");
    // What it was copied from is as it was.
    let now = experience(&folder, "cell.db");
    assert!(before.iter().all(|row| row.starts_with("cell_objects") || now.contains(row)));
    // From another database, too; and only once.
    variant(&["load", "--db", "new.db", "--from", "cell", "--from-db", "cell.db"]).expect_status(0);
    assert_eq!(sql(&folder, "new.db", "SELECT cell, copied_from FROM cells"), ["variant|cell in cell.db"]);
    variant(&["load", "--db", "cell.db", "--from", "cell"])
        .expect_status(2)
        .complains(&["there is experience of variant already"]);
}

#[test]
fn a_taught_path_saves_the_search() {
    let folder = cell();
    let evaluations =
        |answer: &serde_json::Value| answer["tasks"][0]["evaluations"].as_u64().expect("a number");
    let (mut with, mut without) = (0, 0);
    for seed in ["1", "2", "3", "4", "5"] {
        let searched = run(&folder, &["tasks", "cell.toml", "load", "--seed", seed, "--json"]);
        let searched = searched.expect_status(0).json();
        assert_eq!(searched["tasks"][0]["solve_calls"], 1, "nothing to teach: {searched}");
        folder.write("taught.json", searched["tasks"][0]["path"].to_string());
        let teach = ["tasks", "cell.toml", "load", "--seed", seed, "--teach", "taught.json", "--json"];
        let taught = run(&folder, &teach).expect_status(0).json();
        assert_eq!(taught["tasks"][0]["status"], "ok");
        with += evaluations(&taught);
        without += evaluations(&searched);
    }
    assert!(with * 4 < without * 3, "{with} evaluations, and {without} without");
}

#[test]
fn a_picture_shows_objects_path_and_experience() {
    let folder = cell();
    learn(&folder, &["load", "unload", "-o", "cell.svg"]).expect_status(0);
    let picture = folder.read("cell.svg");
    for part in ["workspace", "configurations", "press", "unload"] {
        assert!(picture.contains(part), "{part}");
    }
    learn(&folder, &["load", "-o", "cell.png"]).expect_status(0);
    assert!(folder.path().join("cell.png").exists());
}
