//! Edits of named tunings.

use adit_db::Tx;
use adit_db::cell::Cell;
use adit_db::edit::Edited;
use adit_db::history::Author;

use super::cells::{cell_of, columns, explain};
use crate::error::{Code, Error, Result};
use crate::words::suggest::did_you_mean;

pub(super) const CELLS: &str = "tuning_cells";
pub(super) const ACTIVE: &str = "active_tunings";

/// Sets a cell of a tuning. The table must take the value, as if it were its own.
pub fn set(tx: &mut Tx<'_>, tuning: &str, cell: &[String; 4], author: &Author) -> Result<Edited> {
    let [table, key, column, value] = cell;
    if tuning.trim().is_empty() || tuning.contains(['/', '\n']) {
        let message = format!("a tuning cannot be called {tuning:?}");
        return Err(Error::said(Code::TuningName, message, Some("a word like `night` is one".to_owned())));
    }
    let known = columns(tx, table)?;
    let given = cell_of(table, column, value, &known)?;
    let tried = tx.try_cell((table, key, column), &given);
    let (key, new) = tried.map_err(|error| explain(tx, error, table, key, value))?;
    let place = [tuning, table, &key, column].join("/");
    if has(tx, tuning, table, &key, column)? {
        return Ok(tx.set_cell((CELLS, &place, "value"), &new, author)?);
    }
    let row = [
        ("tuning", Cell::from(tuning)),
        ("table_name", table.as_str().into()),
        ("key", key.as_str().into()),
        ("column_name", column.as_str().into()),
        ("value", new),
    ];
    Ok(tx.add_row(CELLS, &row, author)?)
}

fn has(tx: &mut Tx<'_>, tuning: &str, table: &str, key: &str, column: &str) -> Result<bool> {
    let place = (tuning, table, key, column);
    Ok(tx
        .tuning_cells()?
        .iter()
        .any(|cell| (&*cell.tuning, &*cell.table, &*cell.key, &*cell.column) == place))
}

/// Takes a cell out of a tuning; the robot may be left out of its key where that leaves one.
pub fn unset(tx: &mut Tx<'_>, tuning: &str, cell: &[String; 3], author: &Author) -> Result<Edited> {
    known(tx, tuning)?;
    let [table, key, column] = cell;
    let cells = tx.tuning_cells()?;
    let is_key = |full: &str| full == key || full.split_once('/').is_some_and(|(_, rest)| rest == key);
    let meant: Vec<_> = cells
        .iter()
        .filter(|cell| {
            cell.tuning == tuning && cell.table == *table && cell.column == *column && is_key(&cell.key)
        })
        .collect();
    match meant.as_slice() {
        [cell] => {
            let place = [tuning, table, &cell.key, column].join("/");
            Ok(tx.remove_row(CELLS, &place, author)?)
        }
        found => {
            let why = if found.is_empty() { "does not set" } else { "sets for several robots" };
            let message = format!("the tuning `{tuning}` {why} {table}.{key}.{column}");
            Err(Error::said(
                Code::TuningNoSuchCell,
                message,
                Some(format!("`adit tuning SITE {tuning}` shows what it sets")),
            ))
        }
    }
}

pub fn switch(tx: &mut Tx<'_>, tuning: &str, on: bool, author: &Author) -> Result<Edited> {
    let is_on = tx.active_tunings()?.iter().any(|active| active == tuning);
    // one that is on and has lost its cells can still be switched off
    if on || !is_on {
        known(tx, tuning)?;
    }
    if is_on == on {
        let state = if on { "on" } else { "off" };
        return Err(Error::said(
            Code::TuningAlready,
            format!("the tuning `{tuning}` is {state} already"),
            None,
        ));
    }
    if on {
        return Ok(tx.add_row(ACTIVE, &[("tuning", Cell::from(tuning))], author)?);
    }
    Ok(tx.remove_row(ACTIVE, tuning, author)?)
}

/// An error, unless there is such a tuning.
pub fn known(tx: &mut Tx<'_>, tuning: &str) -> Result<()> {
    let cells = tx.tuning_cells()?;
    if cells.iter().any(|cell| cell.tuning == tuning) {
        return Ok(());
    }
    let help = did_you_mean(tuning, cells.iter().map(|cell| cell.tuning.as_str()));
    let help =
        help.unwrap_or_else(|| format!("`adit tuning SITE {tuning} set TABLE KEY COLUMN VALUE` starts it"));
    Err(Error::said(Code::TuningUnknown, format!("there is no tuning `{tuning}`"), Some(help)))
}
