//! Edits by hand, the history, and undo.

use adit_db::history::Author;
use adit_db::{Cell, Error, Store};

use crate::made::Led;
use crate::paper;

fn author() -> Author {
    Author { who: "ada".into(), why: "it is slippery".into() }
}

fn tune(
    store: &mut Store,
    key: &str,
    column: &str,
    value: impl Into<Cell>,
) -> Result<adit_db::edit::Edited, Error> {
    let value = value.into();
    store.led().transaction(|tx| tx.set_cell(("robots", key, column), &value, &author()))
}

#[test]
fn one_cell_is_set_and_remembered() {
    let (_folder, mut store) = paper::site();
    let edited = tune(&mut store, "SQUAT", "hardness", 3.0).unwrap();
    assert_eq!(
        (edited.key.as_str(), edited.old, edited.new),
        ("robot/SQUAT", Cell::Real(4.0), Cell::Real(3.0))
    );
    store
        .snapshot(|tx| {
            assert_eq!(tx.states()?[2].hardness, 3.0);
            let history = tx.history(10)?;
            assert_eq!((history.len(), history[0].who.as_str(), history[0].undone), (1, "ada", None));
            assert_eq!(tx.route("robot", "f", "e")?.unwrap().status, "stale");
            Ok::<_, Error>(())
        })
        .unwrap();
}

#[test]
fn text_that_reads_as_a_number_is_one_and_other_text_is_refused() {
    let (_folder, mut store) = paper::site();
    assert_eq!(tune(&mut store, "robot/SQUAT", "hardness", "3").unwrap().new, Cell::Real(3.0));
    let refused = tune(&mut store, "SQUAT", "hardness", "hard").unwrap_err().to_string();
    assert_eq!(refused, "robots.SQUAT.hardness: cannot store TEXT value in REAL column robots.hardness");
}

#[test]
fn values_out_of_range_are_refused_in_words() {
    let (_folder, mut store) = paper::site();
    for value in [-1.0, f64::INFINITY] {
        let refused = tune(&mut store, "SQUAT", "height", value).unwrap_err().to_string();
        assert_eq!(refused, "robots.SQUAT.height: height must be finite and not negative");
    }
    assert!(matches!(tune(&mut store, "SQUAT", "height", f64::NAN), Err(Error::Refused { .. })));
    assert!(matches!(tune(&mut store, "SQUAT", "action", ""), Err(Error::Refused { .. })));
    assert!(store.snapshot(|tx| tx.history(9)).unwrap().is_empty());
}

#[test]
fn names_that_are_not_there_are_named() {
    let (_folder, mut store) = paper::site();
    let said = |store: &mut Store, key, column| tune(store, key, column, 1.0).unwrap_err().to_string();
    assert_eq!(said(&mut store, "HOP", "hardness"), "table `robots` has no row `HOP`");
    assert!(said(&mut store, "SQUAT", "hard").contains("no column `hard`; it has robot, state, action"));
    let table = |store: &mut Store, table: &str| {
        store
            .led()
            .transaction(|tx| tx.set_cell((table, "7", "hardness"), &Cell::Real(1.0), &author()))
            .unwrap_err()
    };
    assert!(matches!(table(&mut store, "doors"), Error::NotEditable(_)));
    assert!(matches!(table(&mut store, "walls"), Error::UnknownTable(_)));
}

#[test]
fn a_state_of_two_robots_needs_its_whole_key() {
    let (_folder, mut store) = paper::site();
    let cart = [("robot", "cart"), ("state", "SQUAT"), ("action", "ROLL")].map(|(c, v)| (c, Cell::from(v)));
    let sizes = [("height", 1.0), ("width", 1.0), ("hardness", 0.1)].map(|(c, v)| (c, Cell::from(v)));
    let row: Vec<(&str, Cell)> = cart.into_iter().chain(sizes).collect();
    store.led().transaction(|tx| tx.add_row("robots", &row, &author())).unwrap();
    assert!(matches!(tune(&mut store, "SQUAT", "hardness", 3.0), Err(Error::AmbiguousKey { .. })));
    tune(&mut store, "cart/SQUAT", "hardness", 3.0).unwrap();
}

#[test]
fn undo_takes_back_cells_and_rows_exactly() {
    let (_folder, mut store) = paper::site();
    let before = store.snapshot(|tx| tx.states()).unwrap();
    tune(&mut store, "SQUAT", "hardness", 0.1 + 0.2).unwrap();
    tune(&mut store, "SQUAT", "state", "CROUCH").unwrap();
    store.led().transaction(|tx| tx.remove_row("robots", "CROUCH", &author())).unwrap();
    store
        .led()
        .transaction(|tx| {
            for id in tx.undoable(3)? {
                tx.undo(id, &author())?;
            }
            assert_eq!(tx.states()?, before);
            assert!(tx.undoable(9)?.is_empty());
            assert_eq!(tx.history(9)?.len(), 6);
            Ok::<_, Error>(())
        })
        .unwrap();
}

#[test]
fn an_undo_never_overwrites_a_later_edit() {
    let (_folder, mut store) = paper::site();
    let first = tune(&mut store, "SQUAT", "hardness", 3.0).unwrap();
    tune(&mut store, "SQUAT", "hardness", 5.0).unwrap();
    let refused = store.led().transaction(|tx| tx.undo(first.id, &author())).unwrap_err();
    assert_eq!(
        refused.to_string(),
        "edit 1 cannot be taken back: edit 2 changed the same later; take that one back first"
    );
    let again = store.led().transaction(|tx| {
        tx.undo(2, &author())?;
        tx.undo(2, &author())
    });
    assert!(again.unwrap_err().to_string().contains("edit 3 has taken it back already"));
}

#[test]
fn a_change_goes_with_its_state() {
    let (_folder, mut store) = paper::site();
    let row =
        [("robot", "robot"), ("from_state", "STAND"), ("to_state", "SQUAT")].map(|(c, v)| (c, Cell::from(v)));
    let row: Vec<(&str, Cell)> = row.into_iter().chain([("hardness", Cell::Real(2.0))]).collect();
    store
        .led()
        .transaction(|tx| {
            tx.add_row("changes", &row, &author())?;
            tx.set_cell(("changes", "STAND/SQUAT", "hardness"), &Cell::Real(1.0), &author())?;
            tx.remove_row("robots", "SQUAT", &author())?;
            assert!(tx.changes()?.is_empty());
            Ok::<_, Error>(())
        })
        .unwrap();
}
