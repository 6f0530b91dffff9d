//! The public views say the same in both databases, and are reached by key.

use std::collections::BTreeMap;

use adit_tests::TestSite;
use adit_tests::cluster::Cluster;
use serde_json::Value;

use super::{copy, with_site};

const VIEWS: [&str; 13] = [
    "action_sequence",
    "cells_in_force",
    "changes_in_force",
    "conclusions",
    "facts_told",
    "loads_in_force",
    "opening_hours",
    "robots_in_force",
    "route",
    "routes",
    "staleness",
    "tree_measures",
    "waypoints",
];

/// By so much numbers are moved before they are rounded: lengths are whole nanometres, and would lie on halves too often.
const OFF_HALVES: f64 = 1.000_000_003_14;

/// A value as both databases say it: numbers to nine digits, JSON without an order of its keys.
fn plain(value: &Value) -> String {
    match value {
        Value::Number(number) => format!("{:.8e}", number.as_f64().unwrap() * OFF_HALVES + 0.0),
        Value::String(text) => match serde_json::from_str::<Value>(text) {
            Ok(Value::Object(inner)) => {
                let sorted: BTreeMap<&String, String> =
                    inner.iter().map(|(key, value)| (key, plain(value))).collect();
                format!("{sorted:?}")
            }
            Ok(number @ Value::Number(_)) => plain(&number),
            _ => text.clone(),
        },
        other => other.to_string(),
    }
}

fn rows(rows: impl Iterator<Item = Vec<Value>>) -> Vec<String> {
    let mut rows: Vec<String> = rows.map(|row| row.iter().map(plain).collect::<Vec<_>>().join("|")).collect();
    rows.sort();
    rows
}

fn of_sqlite(site: &TestSite, view: &str) -> (Vec<String>, Vec<String>) {
    let columns = site.sqlite3(&format!("SELECT name FROM pragma_table_info('{view}')"));
    let answer = site
        .adit("sql", &[&format!("SELECT * FROM {view}"), "--json", "--limit", "1000000"])
        .expect_status(0)
        .json();
    let all = answer.as_array().unwrap().iter();
    let rows = rows(all.map(|row| columns.iter().map(|name| row[name].clone()).collect()));
    (columns, rows)
}

fn of_postgres(cluster: &Cluster, site: &str, view: &str, columns: &[String]) -> Vec<String> {
    let lines = cluster.ask(&format!("SELECT row_to_json(v) FROM adit.{view} AS v WHERE site = '{site}'"));
    let values = lines.iter().map(|line| {
        let row: Value = serde_json::from_str(line).unwrap();
        assert_eq!(row.as_object().unwrap().len(), columns.len() + 1, "{view}: {row}");
        columns
            .iter()
            .map(|name| row.get(name).unwrap_or_else(|| panic!("{view} has no {name}")).clone())
            .collect()
    });
    rows(values)
}

fn alike(cluster: &Cluster, site: &TestSite, name: &str) {
    for view in VIEWS {
        let (columns, ours) = of_sqlite(site, view);
        let theirs = of_postgres(cluster, name, view, &columns);
        let differs = ours.iter().zip(&theirs).find(|(one, other)| one != other);
        assert!(ours == theirs, "{view} of {name}: {} and {} rows, {differs:?}", ours.len(), theirs.len());
    }
}

#[test]
fn each_view_answers_as_in_sqlite() {
    let (cluster, paper) = with_site("paper");
    paper.adit("tell", &["DOORS", "3", "hardness", "1.5", "--for", "2h"]);
    paper.adit("tuning", &["set", "night", "robots", "SQUAT", "hardness", "9"]);
    paper.adit("tuning", &["on", "night"]);
    let depot = TestSite::example("depot").built();
    for (name, site) in [("paper", &paper), ("depot", &depot)] {
        copy(&[&site.path().display().to_string(), &cluster.url(name), "--replace"]).expect_status(0);
        alike(&cluster, site, name);
    }
}

#[test]
fn a_route_is_reached_by_key_in_a_database_of_many_sites() {
    let (cluster, site) = with_site("depot");
    let folder = site.path().display().to_string();
    for number in 0..12 {
        copy(&[&folder, &cluster.url(&format!("depot{number}"))]).expect_status(0);
    }
    cluster.ask("ANALYZE");
    let places = cluster
        .ask("SELECT name FROM adit.ends WHERE site = 'depot' AND kind = 'place' ORDER BY name LIMIT 2");
    for view in ["action_sequence", "route", "waypoints"] {
        let (start, goal) = (&places[0], &places[1]);
        let asked = format!(
            "EXPLAIN SELECT * FROM adit.{view} WHERE site = 'depot' AND start = '{start}' AND goal = '{goal}'
             AND robot = (SELECT min(robot) FROM adit.starts WHERE site = 'depot')"
        );
        let plan = cluster.ask(&asked).join("\n");
        assert!(plan.contains("tree_rows_pkey"), "{view}: {plan}");
        for large in ["tree_rows", "rooms", "doors"] {
            assert!(!plan.contains(&format!("Seq Scan on {large}")), "{view} reads all of {large}: {plan}");
        }
        // what is small here, and cheaper to be read whole, has a key by which it is reached where it is large
        let plan = cluster.ask(&format!("SET enable_seqscan = off; {asked}")).join("\n");
        assert!(!plan.contains("Seq Scan"), "{view} has no key for a table: {plan}");
    }
}

#[test]
fn who_only_asks_reads_views_and_nothing_more() {
    let (cluster, _site) = with_site("paper");
    let manual = std::fs::read_to_string(adit_tests::repository().join("manual/src/postgres.md")).unwrap();
    let role = manual.split_once("CREATE ROLE").and_then(|(_, rest)| rest.split("```").next()).unwrap();
    cluster.ask(&format!("CREATE ROLE{role}"));
    let ask = |sql: &str| cluster.ask_as("reader", sql);
    let steps = "SELECT action FROM action_sequence WHERE site = 'paper' AND start = 'f' AND goal = 'e' ORDER BY step";
    assert_eq!(ask(steps).unwrap().len(), 7);
    for refused in [
        "UPDATE robots SET hardness = 1",
        "SELECT * FROM files",
        "SELECT * FROM log",
        "INSERT INTO route VALUES ('x')",
        "CREATE TABLE mine (a int)",
    ] {
        assert!(ask(refused).is_err(), "{refused}");
    }
    let late = ask("SELECT pg_sleep(30)").unwrap_err();
    assert!(late.contains("statement timeout"), "{late}");
}
