//! A program that is killed in the middle leaves the experience whole, and learning goes on.

use std::process::Command;
use std::thread::sleep;
use std::time::Duration;

use super::support::{cell, command, experience, learn, run, sql};

#[test]
fn kill_9_loses_no_task_that_was_done() {
    let folder = cell();
    let tasks = |db: &str| -> usize {
        let found = sql(&folder, db, "SELECT tasks FROM cells");
        found.first().map_or(0, |count| count.parse().expect("a number"))
    };
    let mut done = 0;
    // on a machine that is busy it takes longer to come to the first task
    for round in 0..30_u64 {
        if round >= 6 && done > 0 {
            break;
        }
        let mut killed = command(
            &folder,
            &["tasks", "cell.toml", "--db", "killed.db", "--tasks", "100000", "--seed", "9"],
        )
        .stdout(std::process::Stdio::null())
        .stderr(std::process::Stdio::null())
        .spawn()
        .expect("adit runs");
        sleep(Duration::from_millis(120 + 70 * round));
        killed.kill().expect("killed");
        killed.wait().expect("ended");
        if !folder.path().join("killed.db").exists() {
            continue;
        }
        // The next program to open it, ours or not, finds it whole.
        let check = run(&folder, &["tasks", "cell.toml", "--db", "killed.db", "--seed", "9"]);
        check.expect_status(0);
        assert_eq!(sql(&folder, "killed.db", "PRAGMA integrity_check"), ["ok"]);
        assert!(sql(&folder, "killed.db", "PRAGMA foreign_key_check").is_empty());
        let dangling = "SELECT count(*) FROM edges e JOIN subgoals s ON s.cell = e.cell AND s.subgoal IN (e.subgoal1, e.subgoal2)
                        WHERE e.removed_task IS NULL AND s.removed_task IS NOT NULL";
        assert_eq!(sql(&folder, "killed.db", dangling), ["0"]);
        let now = tasks("killed.db");
        assert!(now >= done, "{now} tasks after {done}");
        let journal = sql(&folder, "killed.db", "SELECT count(*), max(task) FROM tasks");
        assert_eq!(journal, [if now == 0 { "0|".to_owned() } else { format!("{now}|{now}") }]);
        done = now;
    }
    assert!(done > 0, "it was always killed before the first task");
    // What was learned with all those ends is what would have been learned without.
    let all = (done + 1).to_string();
    run(&folder, &["tasks", "cell.toml", "--db", "killed.db", "--tasks", "1", "--seed", "9"])
        .expect_status(0);
    run(&folder, &["tasks", "cell.toml", "--db", "whole.db", "--tasks", &all, "--seed", "9"])
        .expect_status(0);
    assert_eq!(experience(&folder, "killed.db"), experience(&folder, "whole.db"));
}

#[test]
fn a_task_that_another_program_kept_is_not_written_over() {
    let folder = cell();
    learn(&folder, &["load"]).expect_status(0);
    let another = "INSERT INTO tasks (cell, task, goal, found, evaluations, solve_calls, reach_calls)
                   VALUES ('cell', 2, 'load', 1, 0, 0, 0)";
    let shell = Command::new("sqlite3").arg(folder.path().join("cell.db")).arg(another).status();
    assert!(shell.expect("the sqlite3 shell is installed").success());
    learn(&folder, &["unload"])
        .expect_status(2)
        .complains(&["another program keeps experience of cell in this database, too"]);
    assert_eq!(sql(&folder, "cell.db", "SELECT goal FROM tasks WHERE task = 2"), ["load"]);
    assert_eq!(sql(&folder, "cell.db", "SELECT tasks FROM cells"), ["1"]);
}
