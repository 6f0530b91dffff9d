//! Edits from outside make the routes stale; a build makes them fresh.

use adit_db::stale::Mark;
use adit_db::{Error, Store};

use crate::clients;
use crate::paper::{self, ROBOT};

fn outside(store: &Store, sql: &'static str) {
    clients::outside(store.path(), sql);
}

fn status(store: &mut Store) -> String {
    store.snapshot(|tx| tx.route(ROBOT, "f", "e")).unwrap().unwrap().status
}

fn marks(store: &mut Store) -> Vec<(String, String)> {
    let marks = store.snapshot(|tx| tx.stale_marks()).unwrap();
    marks.into_iter().map(|Mark { table, key }| (table, key)).collect()
}

#[test]
fn each_edit_from_outside_is_noticed_and_named() {
    let edits = [
        ("UPDATE robots SET hardness = 3 WHERE state = 'SQUAT'", ("robots", "robot/SQUAT")),
        (
            "INSERT INTO changes (robot, from_state, to_state, hardness) VALUES ('robot', 'STAND', 'SQUAT', 2)",
            ("changes", "robot/STAND/SQUAT"),
        ),
        ("UPDATE doors SET passable = 0 WHERE door = 7", ("doors", "7")),
        ("DELETE FROM doors WHERE door = 3", ("doors", "3")),
        ("UPDATE rooms SET action = 'HOP' WHERE name = 'd'", ("rooms", "4")),
        ("INSERT INTO places VALUES ('shelf', 1, 2)", ("places", "shelf")),
    ];
    for (sql, (table, key)) in edits {
        let (_folder, mut store) = paper::site();
        assert_eq!(status(&mut store), "ok");
        outside(&store, sql);
        assert_eq!(status(&mut store), "stale", "{sql}");
        assert_eq!(marks(&mut store), [(table.to_owned(), key.to_owned())], "{sql}");
        store.transaction(paper::fill).unwrap();
        assert_eq!(status(&mut store), "ok");
    }
}

#[test]
fn a_bulk_write_that_nobody_follows_up_leaves_one_mark() {
    let (_folder, mut store) = paper::site();
    store.transaction(|tx| tx.replace_doors(&paper::doors())).unwrap();
    assert_eq!(marks(&mut store), [("doors".to_owned(), String::new())]);
}

#[test]
fn a_failed_bulk_write_leaves_the_triggers_awake() {
    let (_folder, mut store) = paper::site();
    store
        .transaction(|tx| {
            let mut doors = paper::doors();
            doors[0].side1.room = 99;
            assert!(tx.replace_doors(&doors).is_err());
            tx.replace_doors(&paper::doors())?;
            tx.mark_fresh()
        })
        .unwrap();
    outside(&store, "UPDATE doors SET hardness = 1 WHERE door = 1");
    assert_eq!(status(&mut store), "stale");
}

#[test]
fn a_watched_table_of_the_expert_counts_too() {
    let (_folder, mut store) = paper::site();
    outside(
        &store,
        "CREATE TABLE \"wet \"\"floors\" (room TEXT); CREATE TABLE other (a); CREATE VIEW seen AS SELECT 1",
    );
    store.transaction(|tx| tx.watch_tables(&["wet \"floors"])).unwrap();
    outside(&store, "INSERT INTO other VALUES (1)");
    assert_eq!(status(&mut store), "ok");
    outside(&store, "INSERT INTO \"wet \"\"floors\" VALUES ('d')");
    assert_eq!(marks(&mut store), [("wet \"floors".to_owned(), String::new())]);

    store.transaction(|tx| tx.watch_tables(&["seen"]).and_then(|()| tx.mark_fresh())).unwrap();
    outside(&store, "UPDATE other SET a = 2");
    assert_eq!(status(&mut store), "stale");

    store.transaction(|tx| tx.watch_tables(&[]).and_then(|()| tx.mark_fresh())).unwrap();
    outside(&store, "UPDATE other SET a = 3");
    assert_eq!(status(&mut store), "ok");
    let unknown = store.transaction(|tx| tx.watch_tables(&["nothing"]));
    assert!(matches!(unknown, Err(Error::UnknownTable(name)) if name == "nothing"));
}
