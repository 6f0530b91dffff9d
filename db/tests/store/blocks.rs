//! Rooms and doors are read from blocks beside the rows, and nobody can tell but by the time that it takes.

use adit_db::door::Door;
use adit_db::query::Limits;
use adit_db::room::Room;
use adit_db::schema::Row;
use adit_db::weight::Weight;
use adit_db::{Cell, Derived, Store};

use crate::clients::outside;
use crate::paper;

fn all(store: &mut Store) -> (Vec<Room>, Vec<Door>) {
    store.snapshot(|tx| -> adit_db::Result<_> { Ok((tx.rooms()?, tx.doors()?)) }).unwrap()
}

fn count(store: &Store, class: &str) -> Cell {
    let sql = format!("SELECT count(*) FROM blocks WHERE class = '{class}'");
    store.query(&sql, &Limits::default()).unwrap().rows[0][0].clone()
}

/// A site of many rooms in two layers, so that there are several blocks of each kind, with a row of each unusual sort.
fn many() -> (tempfile::TempDir, Store, Vec<Room>, Vec<Door>) {
    let folder = tempfile::tempdir().unwrap();
    let mut store = Store::create(folder.path().join("site.db")).unwrap();
    let rooms: Vec<Room> = (1..=5_000_i64).map(room).collect();
    let doors: Vec<Door> = (1..5_000_i64).map(door).collect();
    store
        .transaction(|tx| -> adit_db::Result<_> {
            tx.replace_rooms(&rooms)?;
            tx.replace_doors(&doors)?;
            tx.mark_fresh()
        })
        .unwrap();
    (folder, store, rooms, doors)
}

fn room(number: i64) -> Room {
    let x = number as f64 / 3.0;
    Room {
        room: number,
        name: format!("r{number} é"),
        layer: (number % 2 == 0).then(|| ("cart".to_owned(), format!("state {}", number % 4))),
        facing: (number % 2 == 0).then_some(22.5),
        rect: [x, -0.0, x + 0.1, 1.0],
        outline: (number % 13 == 0).then(|| format!("[[{x:?},0.0],[{:?},0.0],[{x:?},1.0]]", x + 0.1)),
        radius: (number % 3 == 0).then_some(0.35),
        berth: (number % 4 == 0).then_some(0.05),
        berth_cost: (number % 4 == 0).then_some(0.01),
        height: (number % 3 > 0).then_some(2.5),
        width: 0.1,
        space: (number % 4 > 0).then_some(number % 4),
        hardness: if number % 5 == 0 {
            Derived::default()
        } else {
            Derived::by(7, Some(i64::MAX - number % 3), x)
        },
        action: Derived::by(7, None, if number % 7 == 0 { "crawl" } else { "walk" }.to_owned()),
        passable: Derived { value: Some(number % 11 > 0), rule: None, witness: None },
        measures: (number % 3 > 0).then(|| format!("{{\"seconds\":{}.5}}", number % 3)),
    }
}

fn door(number: i64) -> Door {
    let mut door = paper::doors()[0].clone();
    (door.door, door.side1.room, door.side2.room) = (number * 3, number, number + 1);
    (door.side1.height, door.one_way) = ((number % 2 == 0).then_some(1.0), number % 9 == 0);
    door
}

#[test]
fn blocks_hold_what_the_rows_hold() {
    let (_folder, mut store, rooms, doors) = many();
    assert_ne!(count(&store, "rooms"), Cell::Integer(0));
    assert_eq!(all(&mut store), (rooms, doors));
    let from_blocks = all(&mut store);
    outside(store.path(), "DELETE FROM blocks");
    assert_eq!(all(&mut store), from_blocks);
}

#[test]
fn what_rules_say_anew_of_some_rows_is_in_their_blocks() {
    let (_folder, mut store, mut rooms, doors) = many();
    let weight = Weight {
        hardness: Derived::by(2, Some(5), 0.25),
        action: Derived::by(3, None, "hop".to_owned()),
        passable: Derived::default(),
        measures: Some("{\"joules\":9.5}".to_owned()),
    };
    let changed: Vec<usize> = vec![0, 127, 128, 2_000, 4_999];
    let weights = changed.iter().map(|row| (rooms[*row].room, &weight));
    assert_eq!(store.transaction(|tx| tx.put_weights::<Room>(weights)).unwrap(), 5);
    for row in changed {
        (rooms[row].hardness, rooms[row].action) = (weight.hardness.clone(), weight.action.clone());
        rooms[row].passable = weight.passable.clone();
        rooms[row].measures = weight.measures.clone();
    }
    let before = count(&store, "rooms");
    assert_eq!(all(&mut store), (rooms.clone(), doors.clone()));
    outside(store.path(), "DELETE FROM blocks");
    assert_eq!(all(&mut store), (rooms.clone(), doors));
    store.transaction(|tx| tx.restore_blocks(&rooms)).unwrap();
    assert_eq!(count(&store, "rooms"), before);
}

#[test]
fn an_edit_of_another_client_is_seen_at_once_whatever_it_does() {
    let edits = [
        "UPDATE rooms SET action = 'HOP' WHERE room = 77",
        "DELETE FROM doors WHERE door = 6",
        "DELETE FROM rooms WHERE room = 5000",
        "INSERT OR REPLACE INTO doors SELECT * FROM doors WHERE door = 9",
        "INSERT INTO rooms (room, name, x0, y0, x1, y1, width) VALUES (9000, 'new', 0, 0, 1, 1, 1)",
        "UPDATE doors SET hardness = 1 WHERE door = 9",
    ];
    for sql in edits {
        let (_folder, mut store, rooms, doors) = many();
        outside(store.path(), sql);
        let seen = all(&mut store);
        let is_replaced = sql.contains("REPLACE");
        assert!(is_replaced || seen != (rooms, doors), "{sql}");
        let class = if sql.contains(" rooms") { "rooms" } else { "doors" };
        assert_eq!(count(&store, class), Cell::Integer(0), "{sql}");
    }
}

#[test]
fn a_block_that_is_damaged_missing_or_of_other_columns_is_not_read() {
    let damages = [
        "UPDATE blocks SET bytes = CAST(substr(bytes, 1, 99) || x'2a' || substr(bytes, 101) AS BLOB)",
        "UPDATE blocks SET bytes = substr(bytes, 1, length(bytes) - 1)",
        "UPDATE blocks SET bytes = x'' WHERE at = 128",
        "DELETE FROM blocks WHERE at = 128",
        "DELETE FROM blocks WHERE part = 'cut' AND at > 0",
        "DELETE FROM blocks WHERE at > 0",
        "DELETE FROM blocks WHERE part = 'weights' AND at = (SELECT max(at) FROM blocks)",
        "UPDATE blocks SET bytes = (SELECT bytes FROM blocks WHERE class = 'doors' AND part = 'cut')",
        "UPDATE blocks SET bytes = (SELECT bytes FROM blocks AS b WHERE b.class = blocks.class AND b.part = 'weights')",
    ];
    let (_folder, mut store, rooms, doors) = many();
    let whole = store.path().with_file_name("whole.db");
    store.backup(&whole).unwrap();
    for (number, sql) in damages.into_iter().enumerate() {
        let path = whole.with_file_name(format!("{number}.db"));
        std::fs::copy(&whole, &path).unwrap();
        outside(&path, sql);
        let mut store = Store::open(&path).unwrap();
        assert_eq!(all(&mut store), (rooms.clone(), doors.clone()), "{sql}");
        // and rows that are written then are read as they are
        let weight = doors[200].weight();
        store.transaction(|tx| tx.put_weights::<Door>([(doors[300].door, &weight)])).unwrap();
        let mut doors = doors.clone();
        (doors[300].hardness, doors[300].action) = (weight.hardness, weight.action);
        doors[300].passable = weight.passable;
        assert_eq!(all(&mut store), (rooms.clone(), doors), "{sql}");
    }
}
