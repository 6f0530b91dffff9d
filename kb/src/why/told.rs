//! Who told what stands instead of what rules conclude: facts, and cells of tables that were edited.

use adit_db::told::Told as Row;
use adit_db::{Cell, Store};
use adit_engine::PropertyName;

use super::cell;
use super::subject::Subject;
use crate::error::Result;
use crate::state::State;

/// Entries of the history that are looked through for the last edit of each cell.
const ENTRIES: u32 = 5_000;

/// Tables of ours that people edit.
const EDITED: [&str; 3] = ["robots", "changes", "loads"];

/// A value that is told.
pub(super) struct Telling {
    pub property: String,
    pub value: Cell,
    /// All of it in one sentence.
    pub why: String,
}

/// What is told of an object, each with who told it, when and why.
pub(super) fn told(state: &State, subject: &Subject) -> Result<Vec<Telling>> {
    let (class, table) = (subject.class.to_uppercase(), subject.class.clone());
    let wanted = |property: &str| subject.property.as_deref().is_none_or(|wanted| wanted == property);
    let holds = |row: &Row| state.told.facts.iter().any(|fact| fact.id == row.id);
    let is_about = |row: &Row| {
        row.key.as_ref() == Some(&subject.key) || state.attached.keys(row.id).contains(&subject.key)
    };
    Store::open_read_only(state.site.database())?.snapshot(|tx| {
        let mut found = Vec::new();
        let is_meant = |row: &Row| row.class == class && wanted(&row.property) && is_about(row) && holds(row);
        for row in tx.facts_told()?.into_iter().filter(is_meant) {
            let value = if row.kind == "truth" { truth(&row.value) } else { row.value.to_string() };
            let until = row.until.as_ref().map_or_else(String::new, |until| format!(" until {until}"));
            let fact = format!("{until}, as fact {} tells", row.id);
            let why = said(&subject.name, (&row.property, &value), &fact, (&row.who, &row.told_at, &row.why));
            found.retain(|known: &Telling| known.property != row.property);
            found.push(Telling { property: row.property, value: row.value, why });
        }
        let is_table =
            EDITED.contains(&table.as_str()) || tx.user_tables()?.iter().any(|of| of.name == table);
        if is_table {
            for entry in tx.history_before(None, ENTRIES)? {
                let Some(column) = entry.column.filter(|column| wanted(column)) else { continue };
                let is_known = found.iter().any(|known| known.property == column);
                if entry.table == table && entry.key == subject.key && !is_known {
                    let value = entry.new.to_string();
                    let why = said(&subject.name, (&column, &value), "", (&entry.who, &entry.at, &entry.why));
                    found.push(Telling { property: column, value: entry.new, why });
                }
            }
        }
        if let Some(property) = subject.property.as_ref().filter(|_| found.is_empty()) {
            let name = PropertyName::new(&class, property);
            let is_concluded = state.inputs.rules.concluded().contains(&&name);
            let value = state.knowledge.value(&class, &subject.key, property);
            if let Some(value) = value.filter(|_| !is_concluded) {
                let from = if is_table { format!("the table {table}") } else { "the map".to_owned() };
                let why = format!("{} {property} is {value}, as {from} has it", subject.name);
                found.push(Telling { property: property.clone(), value: cell(&value), why });
            }
        }
        Ok(found)
    })
}

fn said(
    name: &str,
    (property, value): (&str, &str),
    as_told: &str,
    (who, at, why): (&str, &str, &str),
) -> String {
    let who = if who.is_empty() { "somebody" } else { who };
    let why = if why.is_empty() { String::new() } else { format!(" ({why})") };
    format!("{name} {property} is {value}{as_told}, told by {who} at {at}{why}")
}

fn truth(value: &Cell) -> String {
    (*value == Cell::Integer(1)).to_string()
}
