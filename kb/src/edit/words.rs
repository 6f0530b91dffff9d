//! What edits did, in words for people.

use adit_db::Cell;
use serde_json::Value;

use super::{Done, Edit};
use crate::knowledge::told::Whom;

impl Edit {
    /// In a few words, what an edit did.
    pub(crate) fn words(&self, Done { key, old, new, .. }: &Done) -> String {
        match self {
            Self::Set(table, _, column, _) | Self::SetFrom([table, _, column], ..) => {
                format!("{table}.{key}.{column}: {old} → {new}")
            }
            Self::Add(table, ..) => format!("{table}.{key} is new"),
            Self::Remove(table, ..) => format!("{table}.{key} is gone"),
            Self::Tell(fact) => {
                format!("fact {key}: {} {} {} = {}", fact.class, fact.object, fact.property, fact.value)
            }
            Self::Close(close) => {
                let until = close.until.as_ref().map_or_else(String::new, |until| format!(" until {until}"));
                let whom = match (close.only.as_slice(), close.except.as_slice()) {
                    ([], []) => Whom::All,
                    (only, []) => Whom::Only(only.to_vec()),
                    (_, except) => Whom::Except(except.to_vec()),
                };
                format!("{} is closed{}{until} (fact {key})", close.what, whom.words())
            }
            Self::Open(what) => format!("{what} is open"),
            Self::Lay(lay) => {
                let until = lay.until.as_ref().map_or_else(String::new, |until| format!(" until {until}"));
                format!("the {} `{key}` lies over the map{until}", lay.what.name())
            }
            Self::Lift(name) => format!("`{name}` no longer lies over the map"),
            Self::Retract(_) => format!("fact {key} is taken back"),
            Self::SetInTuning(tuning, [table, row, column, value]) => {
                format!("tuning {tuning}: {table}.{row}.{column} = {value}")
            }
            Self::UnsetInTuning(tuning, [table, row, column]) => {
                format!("tuning {tuning}: no {table}.{row}.{column} any more")
            }
            Self::Switch(tuning, on) => format!("tuning {tuning} is {}", if *on { "on" } else { "off" }),
            Self::Undo(_) => match (row(old), row(new)) {
                (Some(_), None) => format!("undone: {key} is gone again"),
                (None, Some(_)) => format!("undone: {key} is back"),
                _ => format!("undone: {key}: {old} → {new}"),
            },
        }
    }
}

/// What became of a cell or a row, of which the history keeps what it was and what it is.
pub(crate) fn change(old: &Cell, new: &Cell) -> String {
    match (row(old), row(new)) {
        (None, Some(row)) => format!("new: {row}"),
        (Some(row), None) => format!("gone: {row}"),
        _ => format!("{old} → {new}"),
    }
}

/// A row, which the history keeps as a JSON object, column by column; `None` for a cell.
fn row(cell: &Cell) -> Option<String> {
    let Cell::Text(text) = cell else { return None };
    let Value::Object(row) = serde_json::from_str(text).ok()? else { return None };
    let columns = row.iter().filter(|(_, value)| !value.is_null() && *value != "");
    let said = columns.map(|(column, value)| match value {
        Value::String(text) => format!("{column} {text}"),
        value => format!("{column} {value}"),
    });
    Some(said.collect::<Vec<_>>().join(", "))
}
