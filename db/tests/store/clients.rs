//! Plain clients with nothing of ours loaded.

use std::path::Path;
use std::process::{Command, Output};

use sqlx::{Connection, SqliteConnection};

use crate::paper;

fn run(command: &mut Command, name: &str) -> Option<Output> {
    if let Ok(output) = command.output() {
        return Some(output);
    }
    println!("SKIPPED: there is no {name} here");
    None
}

/// Runs a script with the database as its argument; false where there is no Python.
pub fn python(script: &str, database: &Path) -> bool {
    let Some(output) = run(Command::new("python3").arg("-c").arg(script).arg(database), "python3") else {
        return false;
    };
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    true
}

/// Runs SQL as a program would that knows nothing of ours; makes the file where there is none.
pub fn outside(database: &Path, sql: &'static str) {
    let runtime = tokio::runtime::Builder::new_current_thread().build().unwrap();
    runtime.block_on(async {
        let url = format!("sqlite://{}?mode=rwc", database.display());
        let mut connection = SqliteConnection::connect(&url).await.unwrap();
        sqlx::raw_sql(sql).execute(&mut connection).await.unwrap();
        connection.close().await.unwrap();
    });
}

const QUERY: &str = "SELECT step, kind, place, action, cost FROM action_sequence WHERE start = 'f' AND goal = 'e' ORDER BY step;";

#[test]
fn the_sqlite3_shell_reads_the_sequence() {
    let (_folder, store) = paper::site();
    let Some(output) = run(Command::new("sqlite3").arg("-readonly").arg(store.path()).arg(QUERY), "sqlite3")
    else {
        return;
    };
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let lines: Vec<&str> = text.lines().map(|line| &line[..line.rfind('|').unwrap()]).collect();
    assert_eq!(
        lines,
        [
            "1|room|f|WALK",
            "2|door|7|WALK",
            "3|room|d|WALK",
            "4|door|3|WALK-ON-KNEE",
            "5|room|b|WALK-ON-KNEE",
            "6|door|4|WALK-ON-KNEE",
            "7|room|e|WALK",
        ]
    );
}

#[test]
fn python_reads_every_view() {
    let (_folder, store) = paper::site();
    let script = "import sqlite3, sys
c = sqlite3.connect('file:' + sys.argv[1] + '?mode=ro', uri=True)
count = lambda view: c.execute('SELECT count(*) FROM ' + view).fetchone()[0]
assert count('prime_areas') == 7 and count('routes') == 14, (count('prime_areas'), count('routes'))
assert count('route') == 64 and count('conclusions') == 31, (count('route'), count('conclusions'))
steps = c.execute('SELECT * FROM action_sequence WHERE start = ? AND goal = ? ORDER BY step', ('home', 'e')).fetchall()
assert len(steps) == 7 and abs(steps[-1][9] - 92.007434) < 1e-9, steps";
    python(script, store.path());
}

/// Its SQLite may be one of before 3.45, to which `json_valid(NULL)` is false.
#[test]
fn to_the_sqlite3_shell_a_room_without_an_outline_is_whole_and_may_be_written() {
    let (_folder, store) = paper::site();
    let statements =
        "UPDATE rooms SET hardness = 2 WHERE outline IS NULL; SELECT changes() > 0; PRAGMA integrity_check";
    let Some(output) = run(Command::new("sqlite3").arg(store.path()).arg(statements), "sqlite3") else {
        return;
    };
    let told = [output.stdout, output.stderr].concat();
    assert_eq!(String::from_utf8(told).unwrap(), "1\nok\n");
}
