//! Files that are no good, and what is said about them.

use std::time::Duration;

use adit_db::history::Author;
use adit_db::{Cell, Error, Store, VERSION};

use crate::clients::outside;
use crate::paper;

fn altered(sql: &'static str) -> (tempfile::TempDir, std::path::PathBuf) {
    let (folder, store) = paper::site();
    let path = store.path().to_owned();
    drop(store);
    outside(&path, sql);
    (folder, path)
}

fn author() -> Author {
    Author { who: "ada".into(), why: "it is slippery".into() }
}

fn message<T>(result: Result<T, Error>) -> String {
    result.err().unwrap().to_string()
}

#[test]
fn a_newer_database_is_left_alone() {
    let (_folder, path) = altered("PRAGMA user_version = 99");
    let before = std::fs::read(&path).unwrap();
    let known = format!("has schema version 99; this program knows versions up to {VERSION}");
    assert!(message(Store::open(&path)).contains(&known));
    assert!(message(Store::open_read_only(&path)).contains("schema version 99"));
    assert_eq!(std::fs::read(&path).unwrap(), before);
}

#[test]
fn a_file_that_is_no_database_is_left_alone() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("site.db");
    std::fs::write(&path, "these are my notes, not a database\n".repeat(50)).unwrap();
    assert!(message(Store::open(&path)).contains("is not a SQLite database, or is damaged"));
    assert!(message(Store::open_or_create(&path)).contains("site.db"));
    assert!(message(Store::open_read_only(&path)).contains("is not a SQLite database"));
}

#[test]
fn a_truncated_database_is_told_from_a_sound_one() {
    let (_folder, path) = altered("SELECT 1");
    let whole = std::fs::read(&path).unwrap();
    std::fs::write(&path, &whole[..whole.len() / 2 + 100]).unwrap();
    let opened = Store::open(&path).and_then(|mut store| store.doctor());
    assert!(opened.is_err() || !opened.unwrap().is_sound());
}

#[test]
fn a_database_of_another_program_is_left_alone() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("site.db");
    let (_other, from) = altered("PRAGMA application_id = 7");
    std::fs::copy(from, &path).unwrap();
    assert!(message(Store::open_or_create(&path)).contains("not one of Adit"));
}

#[test]
fn what_is_missing_and_what_is_there_already_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("site.db");
    assert!(message(Store::open(&path)).starts_with("there is no database"));
    assert!(message(Store::open_read_only(&path)).starts_with("there is no database"));
    assert!(!path.exists());
    Store::create(&path).unwrap();
    assert!(message(Store::create(&path)).ends_with("exists already"));
    Store::open_or_create(&path).unwrap();
    assert!(
        message(Store::create(folder.path().join("no/such/folder/site.db"))).ends_with("cannot be opened")
    );
}

#[test]
fn a_locked_database_is_named_after_a_while() {
    let (_folder, mut store) = paper::site();
    let mut other = Store::open_waiting(store.path(), Duration::from_millis(50)).unwrap();
    store
        .transaction(|_| {
            let refused = other.transaction(|_| Ok::<_, Error>(()));
            assert!(message(refused).ends_with("site.db is locked by another program"));
            Ok::<_, Error>(())
        })
        .unwrap();
    other.transaction(|_| Ok::<_, Error>(())).unwrap();
}

/// Whoever comes right after a commit that failed does not meet a lock that is about to go.
#[test]
fn a_commit_that_fails_leaves_no_lock() {
    let (_folder, store) = paper::site();
    let mut reader = Store::open_read_only(store.path()).unwrap();
    let mut writer = Store::open_waiting(store.path(), Duration::ZERO).unwrap();
    let mut next = Store::open_waiting(store.path(), Duration::ZERO).unwrap();
    reader
        .snapshot(|tx| {
            tx.rooms()?;
            for _ in 0..30 {
                let refused = writer.transaction(|tx| {
                    tx.set_cell(("robots", "SQUAT", "hardness"), &Cell::Real(3.0), &author())
                });
                assert!(message(refused).ends_with("site.db is locked by another program"));
                next.rehearse(|_| Ok::<_, Error>(()))?;
            }
            Ok::<_, Error>(())
        })
        .unwrap();
}

#[test]
fn a_reader_refuses_to_write() {
    let (_folder, store) = paper::site();
    let mut reader = Store::open_read_only(store.path()).unwrap();
    assert!(message(reader.snapshot(paper::fill)).contains("read-only"));
}

#[test]
fn in_a_read_only_folder_one_reads_and_writes_are_refused() {
    use std::os::unix::fs::PermissionsExt;
    let (folder, store) = paper::site();
    let path = store.path().to_owned();
    drop(store);
    let mode = |bits| std::fs::set_permissions(folder.path(), std::fs::Permissions::from_mode(bits)).unwrap();
    mode(0o555);
    let root = std::fs::write(folder.path().join("probe"), "").is_ok();
    let steps = Store::open_read_only(&path).unwrap().snapshot(|tx| tx.action_sequence("robot", "f", "e"));
    let refused = Store::open(&path).and_then(|mut store| store.transaction(paper::fill));
    mode(0o755);
    assert_eq!(steps.unwrap().len(), 7);
    if root {
        println!("SKIPPED: this user may write into a read-only folder");
    } else {
        assert!(message(refused).contains("cannot be written"));
    }
}

#[test]
fn a_failed_build_leaves_the_old_state() {
    let (_folder, mut store) = paper::site();
    let failed = store.transaction(|tx| {
        tx.clear_trees()?;
        let mut rooms = paper::rooms();
        rooms[3].height = Some(-1.0);
        tx.replace_rooms(&rooms)
    });
    assert_eq!(message(failed), "rooms: height must be finite and not negative");
    let steps = store.snapshot(|tx| tx.action_sequence("robot", "f", "e")).unwrap();
    assert_eq!(steps.len(), 7);
}

#[test]
fn a_rehearsal_leaves_no_trace() {
    let (_folder, mut store) = paper::site();
    let rooms = store.rehearse(|tx| tx.replace_rooms(&[]).and_then(|()| tx.rooms())).unwrap();
    assert!(rooms.is_empty());
    assert_eq!(store.snapshot(|tx| tx.rooms()).unwrap().len(), 7);
}

#[test]
fn a_nan_is_refused_rather_than_stored_as_unknown() {
    let (_folder, mut store) = paper::site();
    let mut rooms = paper::rooms();
    rooms[2].height = Some(f64::NAN);
    assert_eq!(
        message(store.transaction(|tx| tx.replace_rooms(&rooms))),
        "column height of `rooms` got a NaN"
    );
}

#[test]
fn the_doctor_counts_and_a_backup_is_a_database() {
    let (folder, mut store) = paper::site();
    let health = store.doctor().unwrap();
    assert!(health.is_sound());
    assert_eq!((health.schema, health.journal.as_str()), (VERSION, "delete"));
    assert!(health.rows.contains(&("doors".to_owned(), 8)));
    let copy = folder.path().join("copy.db");
    store.backup(&copy).unwrap();
    assert_eq!(Store::open(&copy).unwrap().doctor().unwrap().rows, health.rows);
    assert!(message(store.backup(&copy)).ends_with("exists already"));
}
