//! What the steps of the schema come to, for new databases to begin with; it stands in `sql/sum`, where `WRITE_SCHEMA=1 cargo test -p
//! adit-db --lib` writes it.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use sqlx::{AssertSqlSafe, Connection, SqliteConnection};

use super::{STEPS, Step, keep_worlds, migrate};
use crate::dynamic::identifier;

/// What there is besides rows, in the order in which it came: type, name, table, and the text that makes it.
type Objects = Vec<(String, String, String, String)>;

/// The rows of each table that has any, as texts of values.
type Rows = BTreeMap<String, Vec<String>>;

async fn objects(connection: &mut SqliteConnection) -> Objects {
    let sql = "SELECT type, name, tbl_name, sql FROM sqlite_schema
               WHERE sql IS NOT NULL AND name NOT LIKE 'sqlite%' ORDER BY rowid";
    sqlx::query_as(sql).fetch_all(connection).await.unwrap()
}

async fn rows(connection: &mut SqliteConnection, objects: &Objects) -> Rows {
    let mut rows = Rows::new();
    for (_, table, ..) in objects.iter().filter(|(kind, ..)| kind == "table") {
        let sql = "SELECT name FROM pragma_table_info(?) ORDER BY cid";
        let columns: Vec<String> =
            sqlx::query_scalar(sql).bind(table).fetch_all(&mut *connection).await.unwrap();
        let values: Vec<String> =
            columns.iter().map(|column| format!("quote({})", identifier(column))).collect();
        let sql = format!("SELECT {} FROM {}", values.join(" || ', ' || "), identifier(table));
        let of: Vec<String> =
            sqlx::query_scalar(AssertSqlSafe(sql)).fetch_all(&mut *connection).await.unwrap();
        if !of.is_empty() {
            rows.insert(table.clone(), of);
        }
    }
    rows
}

/// What a database has to which steps lead, and what it has more of where it keeps worlds.
async fn made(steps: &[Step]) -> [(Objects, Rows); 2] {
    let mut connection = SqliteConnection::connect("sqlite::memory:").await.unwrap();
    migrate(&mut connection, Path::new(""), steps).await.unwrap();
    let of_all = objects(&mut connection).await;
    let rows_of_all = rows(&mut connection, &of_all).await;
    keep_worlds(&mut connection, Path::new(""), steps).await.unwrap();
    let mut of_worlds = objects(&mut connection).await;
    let mut rows_of_worlds = rows(&mut connection, &of_worlds).await;
    assert!(
        of_all.iter().all(|object| of_worlds.contains(object)),
        "worlds change what is there without them"
    );
    of_worlds.retain(|object| !of_all.contains(object));
    for (table, rows) in &rows_of_all {
        assert_eq!(rows_of_worlds.remove(table).as_ref(), Some(rows), "{table}");
    }
    [(of_all, rows_of_all), (of_worlds, rows_of_worlds)]
}

/// Tables, each with its rows, its indexes and its triggers, which say nothing of those rows; then views, each with its triggers.
fn script(of: &str, (objects, rows): &(Objects, Rows)) -> String {
    let mut script = format!("-- {of}. Made of the steps by a test (src/migrate/sum_tests.rs).\n");
    for kind in ["table", "view"] {
        for (_, name, _, text) in objects.iter().filter(|object| object.0 == kind) {
            write!(script, "\n{text};\n").unwrap();
            if let Some(rows) = rows.get(name) {
                let rows: Vec<String> = rows.iter().map(|row| format!("({row})")).collect();
                let on_a_line = if rows.iter().all(|row| row.len() < 16) { 8 } else { 1 };
                let lines: Vec<String> = rows.chunks(on_a_line).map(|some| some.join(", ")).collect();
                write!(script, "INSERT INTO {name} VALUES\n  {};\n", lines.join(",\n  ")).unwrap();
            }
            let on_it = objects
                .iter()
                .filter(|(kind, _, table, _)| table == name && (kind == "index" || kind == "trigger"));
            for (.., text) in on_it {
                writeln!(script, "{text};").unwrap();
            }
        }
    }
    script
}

fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("sql/sum").join(name)
}

fn by_name((mut objects, rows): (Objects, Rows)) -> (Objects, Rows) {
    objects.sort();
    (objects, rows)
}

#[test]
fn a_new_database_is_what_the_steps_make() {
    let runtime = tokio::runtime::Builder::new_current_thread().build().unwrap();
    runtime.block_on(async {
        let newest = STEPS.iter().rposition(|step| step.sum.is_some()).unwrap() + 1;
        let without: Vec<Step> = STEPS.iter().map(|step| Step { sum: None, ..*step }).collect();
        let by_steps = made(&without[..newest]).await;
        let whose = ["What every database has", "What a database that keeps worlds has besides"];
        for ((name, of), whose) in ["all.sql", "worlds.sql"].into_iter().zip(&by_steps).zip(whose) {
            let wanted = script(whose, of);
            if std::env::var_os("WRITE_SCHEMA").is_some() {
                std::fs::write(file(name), &wanted).unwrap();
            }
            let there = std::fs::read_to_string(file(name)).unwrap();
            assert!(there == wanted, "{name} is not what the steps come to: WRITE_SCHEMA=1 writes it");
        }
        if std::env::var_os("WRITE_SCHEMA").is_none() {
            assert_eq!(made(STEPS).await.map(by_name), made(&without).await.map(by_name));
        }
    });
}
