//! The schema of each version is kept: old files must open for ever.

use adit_db::query::Limits;
use adit_db::room::Room;
use adit_db::{Cell, Store, VERSION};

use crate::clients::outside;

const V1: &str = include_str!("../fixtures/schema-v1.sql");

const OBJECTS: &str = "SELECT type, name, sql FROM sqlite_schema WHERE sql IS NOT NULL ORDER BY type, name";

fn objects(store: &Store) -> Vec<Vec<Cell>> {
    store.query(OBJECTS, &Limits::default()).unwrap().rows
}

#[test]
fn a_file_of_version_1_opens_with_its_rows() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("old.db");
    outside(&path, V1);
    let mut store = Store::open(&path).unwrap();
    assert_eq!(store.doctor().unwrap().schema, VERSION);
    let steps = store.snapshot(|tx| tx.action_sequence("robot", "f", "e")).unwrap();
    assert_eq!(steps.last().unwrap().place, "e");
}

/// A released step is never edited: a change of the schema is a new step.
#[test]
fn a_new_file_is_what_the_fixture_says() {
    let folder = tempfile::tempdir().unwrap();
    let fixture = folder.path().join("fixture.db");
    outside(&fixture, V1);
    let new = Store::create(folder.path().join("new.db")).unwrap();
    assert_eq!(objects(&Store::open(&fixture).unwrap()), objects(&new));
}

#[test]
fn nothing_of_ours_is_taken_for_the_user_s() {
    let folder = tempfile::tempdir().unwrap();
    let mut store = Store::create(folder.path().join("new.db")).unwrap();
    assert_eq!(store.snapshot(|tx| tx.user_tables()).unwrap(), []);
}

#[test]
fn an_outline_is_a_json_list_of_corners_or_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let mut store = Store::create(folder.path().join("new.db")).unwrap();
    let mut write = |outline: Option<&str>| {
        let outline = outline.map(str::to_owned);
        let room = Room { room: 1, name: "a".into(), rect: [0.0, 0.0, 1.0, 1.0], outline, ..Room::default() };
        store.transaction(|tx| tx.replace_rooms(&[room]))
    };
    write(None).unwrap();
    write(Some("[[0.0,0.0],[1.0,0.0],[0.0,1.0]]")).unwrap();
    for outline in ["round", "[[0,0],[1,0]]", "{}"] {
        let refused = write(Some(outline)).unwrap_err().to_string();
        assert!(refused.contains("outline"), "{refused}");
    }
}
