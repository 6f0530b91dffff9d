//! Edits that can be taken back.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::KnowledgeBase;
use super::pending::Pending;
use crate::class::Table;
use crate::column::Column;
use crate::value::{Cell, Value};

/// What was done to a class, with what takes it back.
#[derive(Debug)]
pub(super) enum Done {
    Class,
    /// A property was added, the last one.
    Property,
    Value {
        row: usize,
        property: usize,
        before: Cell,
    },
    Object,
    /// An object with these values was removed.
    Gone {
        row: usize,
        cells: Vec<Cell>,
    },
}

/// The edits of a run, oldest first: by class.
#[derive(Debug, Default)]
pub(super) struct Undo(pub(super) Vec<(String, Done)>);

impl Undo {
    pub(super) fn push(&mut self, class: &str, done: Done) {
        self.0.push((class.to_owned(), done));
    }
}

impl KnowledgeBase {
    pub(super) fn take_back(&mut self, undo: &mut Undo) {
        for (class, table) in self.before(undo) {
            match table {
                Some(table) => self.hold(table),
                None => self.retract(&class),
            }
        }
    }

    /// Takes back all that was told since the last inference: nothing has changed then.
    pub(super) fn take_back_all(&mut self, undo: &mut Undo) {
        for (class, table) in self.before(undo) {
            match (table, self.held.get_mut(&class)) {
                (Some(table), Some(held)) => (held.table, held.pending) = (table, Pending::default()),
                _ => self.retract(&class),
            }
        }
    }

    /// The tables before the edits; `None` of classes that there were not.
    fn before(&self, undo: &mut Undo) -> BTreeMap<String, Option<Table>> {
        let mut tables: BTreeMap<String, Option<Table>> = BTreeMap::new();
        while let Some((class, done)) = undo.0.pop() {
            let held = &self.held;
            let table = tables
                .entry(class)
                .or_insert_with_key(|class| held.get(class).map(|held| held.table.clone()));
            if let Done::Class = done {
                *table = None;
            } else if let Some(table) = table {
                done.take_back(table);
            }
        }
        tables
    }
}

impl Done {
    fn take_back(self, table: &mut Table) {
        match self {
            Self::Class => {}
            Self::Property => {
                table.names.pop();
                table.columns.pop();
            }
            Self::Value { row, property, before } => {
                Arc::make_mut(&mut table.columns[property]).set(row, before);
            }
            Self::Object => {
                table.len -= 1;
                table.columns.iter_mut().for_each(|column| Arc::make_mut(column).remove(table.len));
            }
            Self::Gone { row, cells } => {
                table.len += 1;
                let columns = table.columns.iter_mut().zip(cells);
                columns.for_each(|(column, cell)| Arc::make_mut(column).insert(row, cell));
            }
        }
    }
}

#[derive(Clone, Debug)]
pub(super) enum Edit {
    /// Tells a value; `None` takes back what was told.
    Value {
        class: String,
        row: usize,
        property: String,
        value: Option<Value>,
        /// Seconds, for a host that takes it back then.
        lasts: Option<f64>,
    },
    Gone {
        class: String,
        row: usize,
    },
    Object {
        class: String,
        properties: BTreeMap<String, Value>,
    },
}

impl KnowledgeBase {
    pub(super) fn edit(&mut self, edit: &Edit, undo: &mut Undo) -> Result<(), super::facts::FactError> {
        match edit {
            Edit::Value { class, row, property, value, .. } => {
                let before = self.held.get(class).map(|held| &held.table).and_then(|table| {
                    let at = table.names.iter().position(|name| name == property)?;
                    (*row < table.len).then(|| (at, table.columns[at].cell(*row)))
                });
                let columns = self.columns_of(class);
                self.tell_row(class, *row, property, value.clone())?;
                if self.columns_of(class) > columns {
                    undo.push(class, Done::Property);
                } else if let Some((property, before)) = before {
                    undo.push(class, Done::Value { row: *row, property, before });
                }
            }
            Edit::Gone { class, row } => {
                let columns = self.held.get(class).map(|held| &held.table.columns);
                let cell = |column: &Arc<Column>| column.cell(*row);
                let cells = columns.map_or(vec![], |columns| columns.iter().map(cell).collect());
                self.remove_row(class, *row)?;
                undo.push(class, Done::Gone { row: *row, cells });
            }
            Edit::Object { class, properties } => {
                let is_new = !self.held.contains_key(class);
                let columns = self.columns_of(class);
                let object: Vec<(&str, Value)> =
                    properties.iter().map(|(property, value)| (property.as_str(), value.clone())).collect();
                let added = self.add(class, &object);
                if is_new && self.held.contains_key(class) {
                    undo.push(class, Done::Class);
                }
                added?;
                for _ in columns..self.columns_of(class) {
                    undo.push(class, Done::Property);
                }
                undo.push(class, Done::Object);
            }
        }
        Ok(())
    }

    fn columns_of(&self, class: &str) -> usize {
        self.held.get(class).map_or(0, |held| held.table.columns.len())
    }
}
