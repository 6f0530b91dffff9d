//! The public view stays a key search: what EXPLAIN QUERY PLAN says of it.

use adit_db::query::Limits;
use adit_db::{Cell, Store};

use crate::paper;

/// The plan's lines about tables (not about the view's own subqueries).
fn scans(store: &Store, condition: &str) -> Vec<String> {
    let sql = format!("EXPLAIN QUERY PLAN SELECT * FROM action_sequence WHERE {condition} ORDER BY step");
    let plan = store.query(&sql, &Limits::default()).unwrap();
    let line = |row: &Vec<Cell>| row.last().unwrap().to_string();
    let lines: Vec<String> = plan.rows.iter().map(line).collect();
    assert!(
        lines.iter().any(|line| line.contains("SEARCH t USING PRIMARY KEY (tree=? AND node=?)")),
        "{lines:#?}"
    );
    // the last two read the few rows that both parts of the view give, and what one row says of measures
    let harmless = ["SCAN CONSTANT ROW", "SCAN walk", "SCAN j VIRTUAL TABLE", "SCAN e VIRTUAL TABLE"];
    lines
        .into_iter()
        .filter(|line| line.starts_with("SCAN") && !harmless.iter().any(|start| line.starts_with(start)))
        .collect()
}

#[test]
fn a_start_and_a_goal_reach_every_table_by_key() {
    let (_folder, store) = paper::site();
    assert_eq!(scans(&store, "start = 'f' AND goal = 'e'"), Vec::<String>::new());
    assert_eq!(scans(&store, "robot = 'robot' AND start = 'f' AND goal = 'e'"), Vec::<String>::new());
}

#[test]
fn an_open_goal_still_reaches_the_tree_by_key() {
    let (_folder, store) = paper::site();
    assert_eq!(scans(&store, "start = 'f'"), ["SCAN e"]);
}
