//! What would be told after some edits: they are carried out in a transaction that is taken back.

use std::collections::BTreeMap;

use adit_db::{Cell as Value, Store, Tx};
use adit_planners::facts::Table;
use serde::Serialize;

use super::Edit;
use super::react::Recalled;
use crate::error::Result;
use crate::knowledge::tables;
use crate::knowledge::told::{Object, Told};
use crate::knowledge::{KnowledgeBase, generation};
use crate::state::State;
use crate::words::progress::Silent;

/// A cell that would count instead of another: of a table, with the named tunings that are on, or a fact.
#[derive(Clone, Debug, PartialEq, Serialize, utoipa::ToSchema)]
pub struct Cell {
    /// The table; `told` for a fact.
    pub table: String,
    /// The key of its row, joined by `/`; of a fact what it is about.
    pub key: String,
    /// The column; of a fact the property.
    pub column: String,
    /// The value of before; `null` where there is none.
    #[schema(value_type = serde_json::Value)]
    pub old: Value,
    /// The value of then; `null` where there is none.
    #[schema(value_type = serde_json::Value)]
    pub new: Value,
}

/// What is told before and after edits.
pub(crate) struct Rehearsed {
    /// Number of the state that the tables are of now.
    pub generation: u64,
    /// As the tables say now.
    pub before: Told,
    /// As they would say.
    pub after: Told,
}

impl State {
    /// What would be told after the edits, one after the other; they are checked as they would be if they were meant.
    pub(crate) fn rehearse(&self, edits: &[Edit]) -> Result<Rehearsed> {
        let author = KnowledgeBase::nobody();
        let (site, rules) = (&self.site, &self.inputs.rules);
        Store::open(site.database())?.rehearse(|tx: &mut Tx<'_>| {
            let (generation, before) = (generation::read(tx)?, site.told(tx, rules)?);
            for edit in edits {
                edit.apply(tx, site, rules, &author)?;
            }
            let after = site.told(tx, rules)?;
            if !rules.rules().iter().any(adit_engine::Rule::reacts) {
                return Ok(Rehearsed { generation, before, after });
            }
            // what rules would do then is a part of what would change
            self.fork().step_and_react(tx, after, Recalled::Nothing, &Silent)?;
            Ok(Rehearsed { generation, before, after: site.told(tx, rules)? })
        })
    }
}

/// The cells that count differently, table by table, then facts.
pub(crate) fn differences(before: &Told, after: &Told) -> Vec<Cell> {
    let mut found = Vec::new();
    let none = Table::default();
    let classes =
        before.classes.keys().chain(after.classes.keys().filter(|c| !before.classes.contains_key(*c)));
    for class in classes {
        let old = before.classes.get(class).unwrap_or(&none);
        let new = after.classes.get(class).unwrap_or(&none);
        if old != new {
            let keys = [before, after].map(|told| told.keys.get(class).map_or(&[][..], Vec::as_slice));
            table_differences(class, (old, new), keys, &mut found);
        }
    }
    fact_differences(before, after, &mut found);
    found
}

fn table_differences(class: &str, (old, new): (&Table, &Table), keys: [&[String]; 2], found: &mut Vec<Cell>) {
    let shape = if old.columns.is_empty() { new } else { old };
    let rows = |table: &Table, keys: &[String]| -> BTreeMap<String, usize> {
        let key = |row: usize| keys.get(row).cloned().unwrap_or_else(|| (row + 1).to_string());
        (0..table.len()).map(|row| (key(row), row)).collect()
    };
    let (old_rows, new_rows) = (rows(old, keys[0]), rows(new, keys[1]));
    let names = old_rows.keys().chain(new_rows.keys().filter(|key| !old_rows.contains_key(*key)));
    for key in names {
        for (column, _) in &shape.columns {
            let value = |table: &Table, rows: &BTreeMap<String, usize>| {
                let row = rows.get(key)?;
                Some(tables::cell(table.column(column)?, *row))
            };
            let (was, is) = (value(old, &old_rows), value(new, &new_rows));
            if was != is {
                found.push(Cell {
                    table: class.to_lowercase(),
                    key: key.clone(),
                    column: column.clone(),
                    old: was.unwrap_or(Value::Null),
                    new: is.unwrap_or(Value::Null),
                });
            }
        }
    }
}

fn fact_differences(before: &Told, after: &Told, found: &mut Vec<Cell>) {
    let cell = |fact: &crate::knowledge::told::Fact, is_new: bool| {
        let object = match &fact.object {
            Object::Key(key) => key.clone(),
            Object::Point([x, y], _) => {
                format!("{},{}", crate::words::number::number(*x), crate::words::number::number(*y))
            }
        };
        let value = match &fact.value {
            adit_engine::Value::Number(number) => Value::Real(*number),
            adit_engine::Value::Text(text) => Value::Text(text.to_string()),
            adit_engine::Value::Truth(truth) => Value::Integer((*truth).into()),
        };
        let (old, new) = if is_new { (Value::Null, value) } else { (value, Value::Null) };
        Cell {
            table: "told".to_owned(),
            key: format!("{} {object}", fact.class),
            column: fact.property.clone(),
            old,
            new,
        }
    };
    found
        .extend(before.facts.iter().filter(|fact| !after.facts.contains(fact)).map(|fact| cell(fact, false)));
    found.extend(after.facts.iter().filter(|fact| !before.facts.contains(fact)).map(|fact| cell(fact, true)));
}
