//! What edits did, in words for people.

use adit_db::Cell;
use adit_db::history::Edit as Entry;
use jiff::Span;
use serde_json::{Map, Value};

use super::cells::gone_with;
use super::file::{self, Write};
use super::tuning::{ACTIVE, CELLS};
use super::{Done, Edit};
use crate::knowledge::told::Whom;
use crate::site::journal::FILES;
use crate::words::number::number;

/// The table of told facts.
const FACTS: &str = "told";

impl Edit {
    /// In a few words, what an edit did.
    pub(crate) fn words(&self, Done { key, old, new, with, parts, .. }: &Done) -> String {
        match self {
            Self::Together(edits) => {
                let each = edits.iter().zip(parts).map(|(edit, done)| edit.words(done));
                each.collect::<Vec<_>>().join("; ")
            }
            Self::Set(table, _, column, _) | Self::SetFrom([table, _, column], ..) if old == new => {
                format!("{table}.{key}.{column} is {new} already")
            }
            Self::Set(table, _, column, _) | Self::SetFrom([table, _, column], ..) => {
                format!("{table}.{key}.{column}: {old} → {new}")
            }
            Self::Add(table, ..) => format!("{table}.{key} is new"),
            Self::Remove(table, ..) => format!("{table}.{key} is gone{}", gone_with(old)),
            Self::Table(table, sheet, _) => format!("{table} is as {} has it: {new}", sheet.path.display()),
            Self::Tell(fact) => {
                format!("fact {key}: {} {} {} = {}", fact.class, fact.object, fact.property, fact.value)
            }
            Self::Close(close) => {
                let until = close.until.as_deref().map_or_else(String::new, |until| ends(until, new));
                let whom = match (close.only.as_slice(), close.except.as_slice()) {
                    ([], []) => Whom::All,
                    (only, []) => Whom::Only(only.to_vec()),
                    (_, except) => Whom::Except(except.to_vec()),
                };
                let from = close.from.as_ref().map_or_else(String::new, |from| format!(" from {from}"));
                format!("{} is closed{from}{}{until} (fact {key})", close.what, whom.words())
            }
            Self::Open(what) => format!("{what} is open"),
            Self::Lay(lay) => {
                let until = lay.until.as_deref().map_or_else(String::new, |until| ends(until, new));
                format!("the {} `{key}` lies over the map{until}", lay.what.name())
            }
            Self::Lift(name) => format!("`{name}` no longer lies over the map"),
            Self::Retract(_) => {
                let fact = fact(old).map_or_else(String::new, |fact| format!(" ({fact})"));
                format!("fact {key}{fact} is taken back")
            }
            Self::SetInTuning(tuning, [table, row, column, value]) => {
                format!("tuning {tuning}: {table}.{row}.{column} = {value}")
            }
            Self::UnsetInTuning(tuning, [table, row, column]) => {
                format!("tuning {tuning}: no {table}.{row}.{column} any more")
            }
            Self::Switch(tuning, on) => format!("tuning {tuning} is {}", if *on { "on" } else { "off" }),
            Self::Write(Write { file: name, .. }) => {
                format!("{}: {}", file::called(name), file::change(old, new))
            }
            Self::Undo(_) => {
                let more = match with {
                    0 => String::new(),
                    1 => ", and one more that was made with it".to_owned(),
                    more => format!(", and {more} more that were made with it"),
                };
                match (row(old), row(new)) {
                    _ if file::is_called(key) => format!("undone: {key} is as it was before{more}"),
                    (Some(_), None) if is_switch(old) => format!("undone: tuning {key} is off again{more}"),
                    (None, Some(_)) if is_switch(new) => format!("undone: tuning {key} is on again{more}"),
                    (Some(_), None) => format!("undone: {} is gone again{more}", called(key, old)),
                    (None, Some(_)) => format!("undone: {} is back{more}", called(key, new)),
                    _ => format!(
                        "undone: {}: {old} → {new}{more}",
                        value_of_tuning(key).unwrap_or_else(|| key.clone())
                    ),
                }
            }
        }
    }
}

/// What an entry of the history is about.
pub(crate) fn subject(Entry { table, key, column, .. }: &Entry) -> String {
    match table.as_str() {
        FILES => return file::called(key),
        FACTS => return format!("fact {key}"),
        CELLS | ACTIVE => return format!("tuning {}", key.split('/').next().unwrap_or(key)),
        _ => {}
    }
    let column = column.as_ref().map_or_else(String::new, |column| format!(".{column}"));
    format!("{table}.{key}{column}")
}

/// What became of a cell or a row, of which the history keeps what it was and what it is.
pub(crate) fn change(old: &Cell, new: &Cell) -> String {
    match (is_switch(old), is_switch(new)) {
        (false, true) => return "off → on".to_owned(),
        (true, false) => return "on → off".to_owned(),
        _ => {}
    }
    let said =
        |cell: &Cell| fact(cell).or_else(|| laid(cell)).or_else(|| setting(cell)).or_else(|| row(cell));
    match (said(old), said(new)) {
        (None, Some(row)) => format!("new: {row}"),
        (Some(row), None) => format!("gone: {row}"),
        _ => format!("{old} → {new}"),
    }
}

/// What an entry of the history did.
pub(crate) fn changed(Entry { table, old, new, .. }: &Entry) -> String {
    if table == FILES { file::change(old, new) } else { change(old, new) }
}

/// An entry of the history.
pub(crate) fn entry(of: &Entry) -> String {
    let Entry { key, old, new, .. } = of;
    match (fact(old), fact(new)) {
        (None, Some(fact)) => format!("fact {key} ({fact}) is told"),
        (Some(fact), None) => format!("fact {key} ({fact}) is taken back"),
        _ => format!("{}: {}", subject(of), changed(of)),
    }
}

/// When a row ends, as it was said, and as it was understood where that says more:
/// ` until 18:00 (2026-11-28T18:00:00Z)`, ` for 2h (until 2026-11-28T11:30:00Z)`.
fn ends(said: &str, row: &Cell) -> String {
    let is_span = said.parse::<Span>().is_ok();
    let end = object(row).and_then(|row| Some(row.get("until")?.as_str()?.to_owned()));
    let understood = match end.filter(|end| !end.starts_with(said)) {
        Some(end) if is_span => format!(" (until {end})"),
        Some(end) => format!(" ({end})"),
        None => String::new(),
    };
    format!(" {} {said}{understood}", if is_span { "for" } else { "until" })
}

/// Whether a row says that a tuning is on.
fn is_switch(row: &Cell) -> bool {
    object(row).is_some_and(|row| row.len() == 1 && row.contains_key("tuning"))
}

/// A row by its key; a fact, of which that says nothing, with what it says, and a tuning's cell as people know it.
fn called(key: &str, row: &Cell) -> String {
    let cell = || setting(row).and_then(|_| cell_of_tuning(key)).unwrap_or_else(|| key.to_owned());
    fact(row).map_or_else(cell, |fact| format!("fact {key} ({fact})"))
}

/// A cell of a tuning by its key, `wet/robots/robot/SQUAT/hardness`: `tuning wet: robots.robot/SQUAT.hardness`.
fn cell_of_tuning(key: &str) -> Option<String> {
    let (tuning, rest) = key.split_once('/')?;
    let (table, rest) = rest.split_once('/')?;
    let (row, column) = rest.rsplit_once('/')?;
    Some(format!("tuning {tuning}: {table}.{row}.{column}"))
}

/// The same where its value is meant.
fn value_of_tuning(key: &str) -> Option<String> {
    cell_of_tuning(key.strip_prefix(CELLS)?.strip_prefix('.')?.strip_suffix(".value")?)
}

/// What a fact says, where a row is one: `DOORS 5,2 passable = false`.
fn fact(row: &Cell) -> Option<String> {
    let row = object(row)?;
    let text = |column: &str| row.get(column)?.as_str();
    let number = |column: &str| row.get(column)?.as_f64().map(number);
    let (class, property) = (text("class")?, text("property")?);
    let object = match (text("key"), number("x"), number("y")) {
        (Some(key), ..) => key.to_owned(),
        (None, Some(x), Some(y)) => format!("{x},{y}"),
        _ => return None,
    };
    let value = match (text("kind")?, row.get("value")?) {
        ("truth", value) => (value.as_i64() == Some(1)).to_string(),
        (_, Value::String(text)) => text.clone(),
        (_, value) => value.to_string(),
    };
    let until = text("until").map_or_else(String::new, |until| format!(" until {until}"));
    Some(format!("{class} {object} {property} = {value}{until}"))
}

/// What was laid over the map, where a row is such: `area 2,1 4,1 4,3, kind wet, hardness_factor 2`.
fn laid(row: &Cell) -> Option<String> {
    let row = object(row)?;
    let text = |column: &str| row.get(column)?.as_str();
    let corners: Vec<[f64; 2]> = serde_json::from_str(text("outline")?).ok()?;
    let corners = corners.iter().map(|&[x, y]| format!("{},{}", number(x), number(y)));
    let mut said = vec![format!("{} {}", text("what")?, corners.collect::<Vec<_>>().join(" "))];
    said.extend(text("kind").map(|kind| format!("kind {kind}")));
    let further: Map<String, Value> = serde_json::from_str(text("properties")?).ok()?;
    said.extend(further.iter().map(|(property, value)| pair(property, value)));
    said.extend(text("until").map(|until| format!("until {until}")));
    Some(said.join(", "))
}

/// What a cell of a tuning says, where a row is one: `robots.robot/SQUAT.hardness = 6`.
fn setting(row: &Cell) -> Option<String> {
    let row = object(row)?;
    let text = |column: &str| row.get(column)?.as_str();
    let (_, table, key, column) = (text("tuning")?, text("table_name")?, text("key")?, text("column_name")?);
    Some(format!("{table}.{key}.{column} = {}", plain(row.get("value")?)))
}

fn object(row: &Cell) -> Option<Map<String, Value>> {
    let Cell::Text(text) = row else { return None };
    serde_json::from_str(text).ok()
}

fn pair(name: &str, value: &Value) -> String {
    match value {
        // rows that came or went with this one
        Value::Array(rows) => format!("with {} {name}", rows.len()),
        value => format!("{name} {}", plain(value)),
    }
}

fn plain(value: &Value) -> String {
    match (value, value.as_f64()) {
        (Value::String(text), _) => text.clone(),
        (_, Some(value)) => number(value),
        (value, None) => value.to_string(),
    }
}

/// A row, which the history keeps as a JSON object, column by column; `None` for a cell.
fn row(cell: &Cell) -> Option<String> {
    let row = object(cell)?;
    let columns = row.iter().filter(|(_, value)| !value.is_null() && *value != "");
    Some(columns.map(|(column, value)| pair(column, value)).collect::<Vec<_>>().join(", "))
}
