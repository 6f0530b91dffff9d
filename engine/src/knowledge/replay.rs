//! Tells again what rules told.

use std::collections::BTreeSet;

use super::KnowledgeBase;
use super::facts::FactError;
use super::undo::{Edit, Undo};
use crate::reactions::Told;
use crate::value::Value;

impl KnowledgeBase {
    /// Tells what [`react`](Self::react) told once: with the same facts before, the same facts are there
    /// afterwards. It is done whole, or not at all.
    pub fn replay(&mut self, log: &[Told]) -> Result<(), FactError> {
        let mut undo = Undo::default();
        for told in log {
            let done = self.edit_of(told).and_then(|edit| self.edit(&edit, &mut undo));
            if let Err(wrong) = done {
                self.take_back(&mut undo);
                return Err(wrong);
            }
        }
        Ok(())
    }

    fn edit_of(&self, told: &Told) -> Result<Edit, FactError> {
        let row = |class: &String, key: &String| {
            let keyless = self.held.get(class).is_some_and(|held| held.table.key.is_empty());
            let row = if keyless {
                let row = key.parse::<usize>().ok().and_then(|row| row.checked_sub(1));
                row.filter(|&row| self.len(class).is_some_and(|len| row < len))
            } else {
                self.row(class, key)
            };
            row.ok_or_else(|| FactError::no_object(class, key))
        };
        Ok(match told {
            Told::Object { class, properties } => {
                Edit::Object { class: class.clone(), properties: properties.clone() }
            }
            Told::Value { class, key, property, value, lasts } => Edit::Value {
                row: row(class, key)?,
                class: class.clone(),
                property: property.clone(),
                value: value.clone(),
                lasts: *lasts,
            },
            Told::Gone { class, key } => Edit::Gone { row: row(class, key)?, class: class.clone() },
        })
    }

    /// Does all edits of one action, or none: values first, then objects that go, then new ones. Nothing else may
    /// have been told since the last inference.
    pub(super) fn act(&mut self, edits: &[Edit], undo: &mut Undo) -> Result<Vec<Told>, FactError> {
        let mut action = Undo::default();
        let mut told = vec![];
        for mut edit in ordered(edits) {
            self.number(&mut edit);
            told.push(self.told(&edit));
            if let Err(wrong) = self.edit(&edit, &mut action) {
                self.take_back_all(&mut action);
                return Err(wrong);
            }
        }
        undo.0.append(&mut action.0);
        Ok(told)
    }

    /// Gives a new object of a numbered class its number.
    fn number(&self, edit: &mut Edit) {
        let Edit::Object { class, properties } = edit else { return };
        if let Some((key, next)) = self.held.get(class).and_then(|held| held.table.next_number()) {
            properties.entry(key.to_owned()).or_insert(Value::Number(next));
        }
    }

    fn told(&self, edit: &Edit) -> Told {
        let key = |class: &String, row: usize| self.key(class, row).unwrap_or_default();
        match edit {
            Edit::Value { class, row, property, value, lasts } => Told::Value {
                key: key(class, *row),
                class: class.clone(),
                property: property.clone(),
                value: value.clone(),
                lasts: *lasts,
            },
            Edit::Gone { class, row } => Told::Gone { key: key(class, *row), class: class.clone() },
            Edit::Object { class, properties } => {
                Told::Object { class: class.clone(), properties: properties.clone() }
            }
        }
    }
}

/// Rows are those of before, so objects go last first, and each once.
fn ordered(edits: &[Edit]) -> Vec<Edit> {
    let mut gone: BTreeSet<(&String, std::cmp::Reverse<usize>)> = BTreeSet::new();
    let (mut values, mut objects) = (vec![], vec![]);
    for edit in edits {
        match edit {
            Edit::Value { .. } => values.push(edit.clone()),
            Edit::Object { .. } => objects.push(edit.clone()),
            Edit::Gone { class, row } => {
                gone.insert((class, std::cmp::Reverse(*row)));
            }
        }
    }
    values.extend(gone.into_iter().map(|(class, row)| Edit::Gone { class: class.clone(), row: row.0 }));
    values.extend(objects);
    values
}
