//! A user's own SQL reads, and can do nothing else.

use std::time::{Duration, Instant};

use adit_db::query::Limits;
use adit_db::{Cell, Store};

use crate::paper;

fn refused(store: &Store, sql: &str) -> String {
    store.query(sql, &Limits::default()).expect_err(sql).to_string()
}

#[test]
fn a_query_answers_with_names_and_values() {
    let (_folder, store) = paper::site();
    let answer =
        store.query("SELECT name, height, room FROM rooms ORDER BY room -- all of them", &Limits::default());
    let answer = answer.unwrap();
    assert_eq!(answer.columns, ["name", "height", "room"]);
    assert_eq!(answer.rows[0], [Cell::from("a"), Cell::Real(4.0), Cell::Integer(1)]);
    assert_eq!(answer.rows[2][1], Cell::Null);
    let none = store.query("SELECT room FROM rooms WHERE 0;", &Limits::default()).unwrap();
    assert_eq!((none.columns.len(), none.rows.len()), (1, 0));
}

#[test]
fn nothing_is_written_attached_or_smuggled_in() {
    let (folder, store) = paper::site();
    let before = std::fs::read(store.path()).unwrap();
    for sql in [
        "DELETE FROM doors",
        "WITH x AS (SELECT 1) DELETE FROM doors",
        "CREATE TEMP TABLE t (a)",
        "DROP VIEW route",
        "PRAGMA journal_mode = WAL",
        "PRAGMA user_version",
        "PRAGMA query_only = 0",
        "VACUUM",
    ] {
        assert!(refused(&store, sql).contains("only statements that read"), "{sql}");
    }
    assert!(refused(&store, "SELECT 1; SELECT 2").contains("one statement at a time"));
    assert!(refused(&store, "SELECT 1; DELETE FROM doors").contains("one statement"));
    assert!(refused(&store, " -- nothing\n ; ").contains("empty"));
    assert!(refused(&store, "SELECT load_extension('x')").contains("not authorized"));
    assert_eq!(refused(&store, "SELECT a FROM nowhere"), "no such table: nowhere");
    let other = folder.path().join("other.db");
    assert!(
        refused(&store, &format!("ATTACH '{}' AS o", other.display())).contains("only statements that read")
    );
    assert!(store.query(&format!("VACUUM INTO '{}'", other.display()), &Limits::default()).is_err());
    assert!(!other.exists());
    assert_eq!(std::fs::read(store.path()).unwrap(), before);
}

#[test]
fn what_tables_and_columns_there_are_is_told() {
    let (_folder, store) = paper::site();
    for sql in ["PRAGMA table_info(robots)", "SELECT cid, name FROM pragma_table_info('robots')"] {
        let answer = store.query(sql, &Limits::default()).expect(sql);
        assert!(answer.rows.iter().any(|row| row[1] == Cell::from("hardness")), "{answer:?}");
    }
    assert!(refused(&store, " .tables").contains("a command of the sqlite3 shell"));
}

#[test]
fn an_endless_query_is_stopped() {
    let (_folder, store) = paper::site();
    let limits = Limits { deadline: Duration::from_millis(100), ..Limits::default() };
    let begin = Instant::now();
    let endless = "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) SELECT max(i) FROM n";
    assert!(store.query(endless, &limits).unwrap_err().to_string().contains("stopped after 100ms"));
    assert!(begin.elapsed() < Duration::from_secs(5));
}

#[test]
fn a_long_answer_says_that_it_is_cut() {
    let (_folder, store) = paper::site();
    let rows = |rows| Limits { rows, ..Limits::default() };
    let answer = store.query("SELECT room FROM rooms", &rows(3)).unwrap();
    assert_eq!((answer.rows.len(), answer.truncated), (3, true));
    let answer = store.query("SELECT room FROM rooms", &rows(7)).unwrap();
    assert_eq!((answer.rows.len(), answer.truncated), (7, false));
}
