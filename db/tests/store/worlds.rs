//! The tables of worlds stand in the databases that keep worlds, and in no others.

use std::path::Path;

use adit_db::floor_plan::FloorPlan;
use adit_db::query::Limits;
use adit_db::{Cell, Error, Store};
use sqlx::{Connection, SqliteConnection};

use crate::clients::outside;

const V1: &str = include_str!("../fixtures/schema-v1.sql");
const EXPERIENCE_V4: &str = include_str!("../fixtures/experience-v4.sql");

fn objects(store: &Store) -> Vec<Vec<Cell>> {
    let sql = "SELECT type, name, sql FROM sqlite_schema ORDER BY type, name";
    store.query(sql, &Limits::default()).unwrap().rows
}

/// How many rows a table has, and how many of them the table in another file has too.
fn rows_and_shared(database: &Path, other: &Path, table: &str) -> (i64, i64) {
    let runtime = tokio::runtime::Builder::new_current_thread().build().unwrap();
    runtime.block_on(async {
        let url = format!("sqlite://{}", database.display());
        let mut connection = SqliteConnection::connect(&url).await.unwrap();
        let attach = sqlx::query("ATTACH ? AS other").bind(other.to_str().unwrap());
        attach.execute(&mut connection).await.unwrap();
        let sql = format!(
            "SELECT (SELECT count(*) FROM main.{table}),
                    (SELECT count(*) FROM (SELECT * FROM main.{table} INTERSECT SELECT * FROM other.{table}))"
        );
        sqlx::query_as(sqlx::AssertSqlSafe(sql)).fetch_one(&mut connection).await.unwrap()
    })
}

#[test]
fn a_site_has_none_of_the_tables_until_a_world_is_kept_in_its_database() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("site.db");
    let alone = objects(&Store::create(&path).unwrap());
    assert!(!alone.iter().any(|object| object[1] == Cell::from("missions")));
    let mut store = Store::open_for_worlds(&path).unwrap();
    let plan = FloorPlan { world: "flat".into(), ..FloorPlan::default() };
    store.transaction(|tx| tx.keep_floor_plan(&plan)).unwrap();
    drop(store);
    let again = Store::open_for_worlds(&path).unwrap();
    assert!(alone.iter().all(|object| objects(&again).contains(object)));
    let kept = again.query("SELECT world FROM floor_plans", &Limits::default()).unwrap().rows;
    assert_eq!(kept, [[Cell::from("flat")]]);
    // and what earlier programs kept of plans is gone
    assert!(
        !objects(&again).iter().any(|object| ["plans", "junctions"].map(Cell::from).contains(&object[1]))
    );
}

#[test]
fn who_asks_a_site_for_worlds_is_told_that_there_are_none() {
    let folder = tempfile::tempdir().unwrap();
    let mut store = Store::create(folder.path().join("site.db")).unwrap();
    store
        .snapshot(|tx| {
            assert_eq!(tx.cells()?, [""; 0]);
            assert_eq!(tx.experience("bench")?, None);
            assert_eq!(tx.worlds_of_missions()?, [""; 0]);
            assert_eq!(tx.learned("flat")?, None);
            Ok::<_, Error>(())
        })
        .unwrap();
}

#[test]
fn what_earlier_programs_kept_is_there_after_the_migration_and_the_other_tables_beside_it() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("cell.db");
    outside(&path, V1);
    outside(&path, EXPERIENCE_V4);
    let mut store = Store::open(&path).unwrap();
    let experience = store.snapshot(|tx| tx.experience("cell")).unwrap().unwrap();
    assert_eq!((experience.subgoals.len(), experience.edges.len(), experience.clearances.len()), (8, 9, 4));
    let new = Store::open_for_worlds(folder.path().join("new.db")).unwrap();
    assert_eq!(objects(&store), objects(&new));
    drop(store);
    let before = folder.path().join("cell.db.bak-v1");
    for (table, rows) in [
        ("cells", 1),
        ("cell_objects", 4),
        ("subgoals", 8),
        ("edges", 9),
        ("subgoal_pairs", 2),
        ("clearances", 4),
        ("tasks", 2),
    ] {
        assert_eq!(rows_and_shared(&path, &before, table), (rows, rows), "{table}");
    }
}

#[test]
fn a_site_s_own_tables_of_such_names_stay_its_own() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("site.db");
    outside(&path, V1);
    outside(
        &path,
        "CREATE TABLE tasks (room TEXT PRIMARY KEY, what TEXT); INSERT INTO tasks VALUES ('d', 'sweep');",
    );
    let mut store = Store::open(&path).unwrap();
    let own = store.snapshot(|tx| tx.user_tables()).unwrap();
    assert_eq!(own.iter().map(|table| table.name.as_str()).collect::<Vec<_>>(), ["tasks"]);
    let before = objects(&store);
    let refused = Store::open_for_worlds(&path).err().unwrap().to_string();
    assert!(
        refused.ends_with(
            "site.db has a table `tasks` of its own, and one of that name is to be made: rename it"
        )
    );
    assert_eq!(objects(&store), before);
    let rows = store.query("SELECT * FROM tasks", &Limits::default()).unwrap().rows;
    assert_eq!(rows, [[Cell::from("d"), Cell::from("sweep")]]);
}

#[test]
fn a_migration_names_the_table_that_stands_in_its_way_and_leaves_everything() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("site.db");
    outside(&path, V1);
    outside(&path, "CREATE TABLE Hours (room TEXT, open TEXT)");
    let refused = Store::open(&path).err().unwrap().to_string();
    assert!(refused.contains("has a table `Hours` of its own"), "{refused}");
    outside(&path, "ALTER TABLE Hours RENAME TO room_hours");
    Store::open(&path).unwrap();
}
