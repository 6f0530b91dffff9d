//! Tables that may be edited, and cells and rows of them as people write them.

use adit_db::Tx;
use adit_db::cell::Cell;
use adit_db::relation::RelationColumn;
use serde_json::{Map, Value};

use crate::error::{Code, Error, Result};
use crate::knowledge::LAYOUT;
use crate::knowledge::tables::truth_of;
use crate::site::robots::ONLY_ROBOT;
use crate::words::number::counted;
use crate::words::suggest::{did_you_mean, listed};

/// The largest number that tables take.
const LARGEST: f64 = 1e300;

/// A number where the text is one; no value where there is no text.
pub(super) fn cell(text: &str) -> Cell {
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

pub(crate) const TUNABLE: [&str; 5] = ["robots", "changes", "loads", "hours", "measures"];
const DERIVED: [&str; 19] = [
    "rooms",
    "doors",
    "spaces",
    "doorways",
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
pub(crate) fn columns(tx: &mut Tx<'_>, table: &str) -> Result<Vec<RelationColumn>> {
    let own: Vec<String> = tx.user_tables()?.into_iter().map(|known| known.name).collect();
    // where the map is not cut into rooms, its places stand in the table alone
    let is_map = table == "places" && tx.site_value(LAYOUT)?.is_some();
    if DERIVED.contains(&table) && !is_map {
        let message =
            format!("`{table}` is derived: what is in it follows from the map, the tables and a rule");
        let help = "tune `robots`, `changes` or `loads`, edit a rule, or edit the map and build".to_owned();
        return Err(Error::said(Code::EditDerived, message, Some(help)));
    }
    if !TUNABLE.contains(&table) && !is_map && !own.iter().any(|known| known == table) {
        if tx.relations()?.iter().any(|known| known.name == table) {
            let help = match table {
                "laid" | "drawn" => Some("`adit lay` and `adit lift` edit what lies over the map"),
                "told" => Some("`adit tell` tells facts, and takes them back"),
                _ => None,
            };
            let message = format!("`{table}` is not edited row by row");
            return Err(Error::said(Code::EditDerived, message, help.map(str::to_owned)));
        }
        let help = did_you_mean(table, TUNABLE.into_iter().chain(own.iter().map(String::as_str)));
        return Err(Error::said(Code::EditUnknownTable, format!("there is no table `{table}`"), help));
    }
    Ok(tx.read_table(table)?.columns)
}

/// A value for a column, which must be there and hold such values.
pub(super) fn cell_of(table: &str, column: &str, value: &str, columns: &[RelationColumn]) -> Result<Cell> {
    let Some(known) = columns.iter().find(|known| known.name == column) else {
        let help = did_you_mean(column, columns.iter().map(|known| known.name.as_str()));
        let message = format!("table `{table}` has no column `{column}`");
        return Err(Error::said(Code::EditUnknownColumn, message, help));
    };
    let holds_texts = ["TEXT", "CHAR", "CLOB"].iter().any(|kind| known.declared.contains(kind));
    if holds_texts && !value.is_empty() {
        return Ok(Cell::Text(value.to_owned()));
    }
    let cell = cell(value);
    let holds_numbers = ["REAL", "INTEGER"].contains(&known.declared.as_str());
    if holds_numbers && matches!(cell, Cell::Text(_)) {
        let message = format!("`{column}` of `{table}` holds numbers, and `{value}` is none");
        return Err(Error::said(Code::EditNotANumber, message, None));
    }
    if known.declared.contains("BOOL") {
        return match truth_of(value) {
            Some(truth) => Ok(Cell::Integer(truth.into())),
            None if value.is_empty() => Ok(Cell::Null),
            None => {
                let message = format!("`{column}` of `{table}` is true or false, and `{value}` is neither");
                Err(Error::said(Code::EditNotANumber, message, None))
            }
        };
    }
    Ok(cell)
}

/// The cells of a new row: the key's parts, then the others. A robot that is left out is the only one there is.
pub(super) fn row(
    tx: &mut Tx<'_>,
    table: &str,
    key: &str,
    cells: &[(String, String)],
) -> Result<Vec<(String, Cell)>> {
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
        row.push(((*name).to_owned(), cell_of(table, name, &part, &columns)?));
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

/// The rows that went with one, which the history keeps as JSON: `, with 4 rows of changes`.
pub(super) fn gone_with(row: &Cell) -> String {
    let Cell::Text(text) = row else { return String::new() };
    let row: Map<String, Value> = serde_json::from_str(text).unwrap_or_default();
    let rows = row.iter().filter_map(|(table, value)| match value {
        Value::Array(rows) => Some(format!(", with {} of {table}", counted(rows.len(), "row"))),
        _ => None,
    });
    rows.collect()
}

/// The store's error; of what the table does not take, with the row that was probably meant, or the value that was refused.
pub(super) fn explain(tx: &mut Tx<'_>, error: adit_db::Error, table: &str, key: &str, value: &str) -> Error {
    if Code::from(&error) != Code::DatabaseRefused {
        return error.into();
    }
    let help = match &error {
        adit_db::Error::UnknownKey { .. } => keys(tx, table).ok().and_then(|keys| {
            let names = || keys.iter().map(String::as_str);
            did_you_mean(key, names()).or_else(|| listed("rows", names()))
        }),
        adit_db::Error::Refused { reason, .. } if reason.starts_with("FOREIGN KEY") => Some(
            "it names a row of another table that is not there: a state must stand in `robots` first"
                .to_owned(),
        ),
        adit_db::Error::Refused { .. } if value.parse().is_ok_and(|value: f64| value.abs() > LARGEST) => {
            Some(format!("numbers up to {LARGEST:e} are kept"))
        }
        _ => None,
    };
    if let adit_db::Error::Refused { reason, .. } = &error {
        if let Some(cell) = reason.strip_prefix("NOT NULL constraint failed: ") {
            let message = format!("{cell} must have a value, and `{key}` has none");
            return Error::said(Code::EditRefused, message, None);
        }
        if reason.starts_with("UNIQUE constraint failed") {
            return Error::said(Code::EditRefused, format!("`{table}` has a row `{key}` already"), None);
        }
    }
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

/// Whether both are the same value; a whole number is the same with and without a point.
pub(super) fn is_equal(one: &Cell, other: &Cell) -> bool {
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
