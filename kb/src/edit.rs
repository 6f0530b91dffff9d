//! Edits of the tables that people tune.

use adit_db::Tx;
use adit_db::cell::Cell;
use adit_db::history::Author;
use adit_db::relation::RelationColumn;
use serde::Serialize;

use adit_engine::RuleBase;

use crate::error::{Code, Error, Result};
use crate::knowledge::KnowledgeBase;
use crate::knowledge::tunings;
use crate::site::robots::ONLY_ROBOT;
use crate::words::suggest::did_you_mean;

pub mod rehearse;
mod tell;
mod tuning;
mod words;

pub use tell::Tell;
pub(crate) use tuning::known as known_tuning;
pub(crate) use words::change;

/// What is to be edited. Values are as people write them; the column says what they must be.
#[derive(Clone, Debug, PartialEq)]
pub enum Edit {
    /// One cell: table, key, column, value.
    Set(String, String, String, String),
    /// One cell that must still hold what the editor saw: table, key and column, the value seen, the value from now on.
    SetFrom([String; 3], String, String),
    /// A new row: table, key, and the columns that the key does not say.
    Add(String, String, Vec<(String, String)>),
    /// A row that goes: table, key.
    Remove(String, String),
    Tell(Tell),
    /// A fact, by its number, that is no longer told.
    Retract(i64),
    /// A cell of a named tuning: the tuning, then table, key, column, value.
    SetInTuning(String, [String; 4]),
    /// A cell of a named tuning that goes: the tuning, then table, key, column.
    UnsetInTuning(String, [String; 3]),
    /// A named tuning that is switched on or off.
    Switch(String, bool),
    /// An entry of the history that is taken back; the latest one without a number.
    Undo(Option<i64>),
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Done {
    pub id: i64,
    pub key: String,
    /// The value, or the row, of before.
    pub old: Cell,
    /// The value, or the row, of now.
    pub new: Cell,
}

impl Edit {
    /// Carries it out and writes the history.
    pub fn apply(
        &self,
        tx: &mut Tx<'_>,
        site: &KnowledgeBase,
        rules: &RuleBase,
        author: &Author,
    ) -> Result<Done> {
        let done = match self {
            Self::Set(table, key, column, value) => {
                let columns = columns(tx, table)?;
                let cell = cell_of(table, column, value, &columns)?;
                let found = tx.set_cell((table, key, column), &cell, author);
                found.map_err(|error| explain(tx, &error, table, key, value))?
            }
            Self::SetFrom([table, key, column], seen, value) => {
                let set = Self::Set(table.clone(), key.clone(), column.clone(), value.clone());
                let done = set.apply(tx, site, rules, author)?;
                if !is_equal(&done.old, &cell(seen)) {
                    return Err(conflict(tx, (table, &done, column))?);
                }
                return Ok(done);
            }
            Self::Add(table, key, cells) => {
                let row = row(tx, table, key, cells)?;
                let named: Vec<(&str, Cell)> =
                    row.iter().map(|(name, value)| (name.as_str(), value.clone())).collect();
                tx.add_row(table, &named, author).map_err(|error| explain(tx, &error, table, key, ""))?
            }
            Self::Remove(table, key) => {
                columns(tx, table)?;
                let gone = tx.remove_row(table, key, author);
                gone.map_err(|error| explain(tx, &error, table, key, ""))?
            }
            Self::Tell(tell) => {
                let row = tell.row(tx, site, rules, author)?;
                tx.add_row("told", &row, author)?
            }
            Self::Retract(id) => {
                let gone = tx.remove_row("told", &id.to_string(), author);
                gone.map_err(|error| match error {
                    adit_db::Error::UnknownKey { .. } => {
                        let help = "`adit tell SITE --list` shows what is told".to_owned();
                        Error::said(Code::TellUnknownFact, format!("there is no fact {id}"), Some(help))
                    }
                    error => error.into(),
                })?
            }
            Self::SetInTuning(tuning, cell) => tuning::set(tx, tuning, cell, author)?,
            Self::UnsetInTuning(tuning, cell) => tuning::unset(tx, tuning, cell, author)?,
            Self::Switch(tuning, on) => tuning::switch(tx, tuning, *on, author)?,
            Self::Undo(Some(id)) => tx.undo(*id, author)?,
            Self::Undo(None) => match tx.undoable(1)?.first() {
                Some(id) => tx.undo(*id, author)?,
                None => return Err(Error::said(Code::EditNothingToUndo, "there is nothing to undo", None)),
            },
        };
        Ok(Done { id: done.id, key: done.key, old: done.old, new: done.new })
    }
}

impl Edit {
    /// A word about a cell that was set and does not count, since a tuning that is on says otherwise.
    pub(crate) fn overridden(&self, tx: &mut Tx<'_>, done: &Done) -> Result<Option<String>> {
        let (Self::Set(table, _, column, _) | Self::SetFrom([table, _, column], ..)) = self else {
            return Ok(None);
        };
        let cells = tunings::in_force(tx)?;
        let cell =
            cells.iter().find(|cell| cell.table == *table && cell.key == done.key && cell.column == *column);
        Ok(cell.map(|cell| {
            format!(
                "{table}.{}.{column} is {} while the tuning `{}` is on: what was set counts when it is off",
                done.key, cell.value, cell.tuning
            )
        }))
    }
}

/// Whether both are the same value; a whole number is the same with and without a point.
fn is_equal(one: &Cell, other: &Cell) -> bool {
    let number = |cell: &Cell| match cell {
        Cell::Integer(value) => Some(*value as f64),
        Cell::Real(value) => Some(*value),
        _ => None,
    };
    match (number(one), number(other)) {
        (Some(one), Some(other)) => one.total_cmp(&other).is_eq(),
        _ => one == other,
    }
}

/// That a cell is another one by now: who made it so, and when.
fn conflict(tx: &mut Tx<'_>, (table, done, column): (&str, &Done, &str)) -> Result<Error> {
    // the entry of the edit that is about to be taken back is the newest one
    let before = tx.history_before(Some(done.id), 1_000)?;
    let last = before.into_iter().find(|edit| {
        edit.table == table && edit.key == done.key && edit.column.as_deref().is_none_or(|of| of == column)
    });
    let by = last.map_or_else(String::new, |edit| format!(", set by {} at {}", edit.who, edit.at));
    let message = format!("{table}.{}.{column} is {} by now{by}", done.key, done.old);
    Ok(Error::said(
        Code::EditConflict,
        message,
        Some("look at the present value, then set it again".to_owned()),
    ))
}

/// A number where the text is one; no value where there is no text.
fn cell(text: &str) -> Cell {
    if text.is_empty() {
        return Cell::Null;
    }
    if let Ok(integer) = text.parse::<i64>() {
        return Cell::Integer(integer);
    }
    match text.parse::<f64>() {
        Ok(number) if number.is_finite() => Cell::Real(number),
        _ => Cell::Text(text.to_owned()),
    }
}

pub(crate) const TUNABLE: [&str; 4] = ["robots", "changes", "loads", "hours"];
const DERIVED: [&str; 17] = [
    "rooms",
    "doors",
    "routes",
    "route",
    "action_sequence",
    "conclusions",
    "prime_areas",
    "places",
    "frames",
    "strips",
    "areas",
    "named_doors",
    "area_rooms",
    "door_rooms",
    "history",
    "site_hours",
    "opening_hours",
];

/// The columns of a table that may be edited, its key's first.
fn columns(tx: &mut Tx<'_>, table: &str) -> Result<Vec<RelationColumn>> {
    let own: Vec<String> = tx.user_tables()?.into_iter().map(|known| known.name).collect();
    if DERIVED.contains(&table) {
        let message =
            format!("`{table}` is derived: what is in it follows from the map, the tables and a rule");
        let help = "tune `robots`, `changes` or `loads`, edit a rule, or edit the map and build".to_owned();
        return Err(Error::said(Code::EditDerived, message, Some(help)));
    }
    if !TUNABLE.contains(&table) && !own.iter().any(|known| known == table) {
        let help = did_you_mean(table, TUNABLE.into_iter().chain(own.iter().map(String::as_str)));
        return Err(Error::said(Code::EditUnknownTable, format!("there is no table `{table}`"), help));
    }
    Ok(tx.read_table(table)?.columns)
}

/// A value for a column, which must be there and hold such values.
fn cell_of(table: &str, column: &str, value: &str, columns: &[RelationColumn]) -> Result<Cell> {
    let Some(known) = columns.iter().find(|known| known.name == column) else {
        let help = did_you_mean(column, columns.iter().map(|known| known.name.as_str()));
        let message = format!("table `{table}` has no column `{column}`");
        return Err(Error::said(Code::EditUnknownColumn, message, help));
    };
    let cell = cell(value);
    let holds_numbers = ["REAL", "INTEGER"].contains(&known.declared.as_str());
    if holds_numbers && matches!(cell, Cell::Text(_)) {
        let message = format!("`{column}` of `{table}` holds numbers, and `{value}` is none");
        return Err(Error::said(Code::EditNotANumber, message, None));
    }
    Ok(cell)
}

/// The cells of a new row: the key's parts, then the others. A robot that is left out is the only one there is.
fn row(tx: &mut Tx<'_>, table: &str, key: &str, cells: &[(String, String)]) -> Result<Vec<(String, Cell)>> {
    let columns = columns(tx, table)?;
    let keys: Vec<&str> =
        columns.iter().filter(|column| column.key > 0).map(|column| column.name.as_str()).collect();
    let mut parts: Vec<String> = key.splitn(keys.len().max(1), '/').map(str::to_owned).collect();
    if parts.len() + 1 == keys.len() && keys.first() == Some(&"robot") {
        let robots = tx.states()?;
        parts.insert(0, robots.first().map_or(ONLY_ROBOT.to_owned(), |state| state.robot.clone()));
    }
    if parts.len() != keys.len() {
        let message = format!("the key of `{table}` is {}, and `{key}` is not that", keys.join("/"));
        return Err(Error::said(Code::EditKey, message, None));
    }
    let mut row: Vec<(String, Cell)> = Vec::new();
    for (name, part) in keys.iter().zip(parts) {
        row.push(((*name).to_owned(), cell(&part)));
    }
    for (name, value) in cells {
        let cell = cell_of(table, name, value, &columns)?;
        if row.iter().any(|(known, _)| known == name) {
            let message = format!("`{name}` is given twice: by {key} and by {name}={value}");
            let twice = format!("`{name}` is given twice, the second time as {name}={value}");
            let message = if keys.contains(&name.as_str()) { message } else { twice };
            return Err(Error::said(Code::EditUsage, message, None));
        }
        row.push((name.clone(), cell));
    }
    if table == "robots" && !cells.iter().any(|(name, _)| name == "position") {
        let last = tx.states()?.iter().map(|state| state.position).max().unwrap_or(0);
        row.push(("position".to_owned(), Cell::Integer(last + 1)));
    }
    Ok(row)
}

/// The store's error, with the row that was probably meant, or the value that was refused.
fn explain(tx: &mut Tx<'_>, error: &adit_db::Error, table: &str, key: &str, value: &str) -> Error {
    let help = match error {
        adit_db::Error::UnknownKey { .. } => {
            keys(tx, table).ok().and_then(|keys| did_you_mean(key, keys.iter().map(String::as_str)))
        }
        adit_db::Error::Refused { reason, .. } if reason.starts_with("FOREIGN KEY") => Some(
            "it names a row of another table that is not there: a state must stand in `robots` first"
                .to_owned(),
        ),
        _ => None,
    };
    let found = if matches!(error, adit_db::Error::Refused { .. }) && !value.is_empty() {
        format!(" (found {value})")
    } else {
        String::new()
    };
    Error::said(Code::EditRefused, format!("{error}{found}"), help)
}

/// The keys of a table's rows, whole and without the robot.
fn keys(tx: &mut Tx<'_>, table: &str) -> Result<Vec<String>> {
    let relation = tx.read_table(table)?;
    let parts: Vec<_> = relation.columns.iter().filter(|column| column.key > 0).collect();
    let rows = parts.first().map_or(0, |column| column.values.len());
    let mut keys = Vec::new();
    for row in 0..rows {
        let key: Vec<String> = parts.iter().map(|column| column.values[row].to_string()).collect();
        if parts.first().is_some_and(|column| column.name == "robot") && key.len() > 1 {
            keys.push(key[1..].join("/"));
        }
        keys.push(key.join("/"));
    }
    Ok(keys)
}
