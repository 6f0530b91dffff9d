//! Facts told one by one: a cell, a new object, an object that is gone.

use std::sync::Arc;

use thiserror::Error;

use super::KnowledgeBase;
use super::pending::Held;
use crate::class::{Class, ClassError, Table};
use crate::column::Column;
use crate::rule::PropertyName;
use crate::value::{Cell, Type, Value};

#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum FactError {
    #[error("there is no class {class}")]
    NoClass { class: String },
    #[error("class {class} has no object {key}")]
    NoObject {
        class: String,
        /// Its key, or its row from 0.
        key: String,
    },
    #[error("{class}.{property} holds {}, not {value}", holds.plural())]
    Type { class: String, property: String, holds: Type, value: String },
    /// A property of the key says which object it is and does not change.
    #[error("{class}.{property} is part of the key, which does not change")]
    Key { class: String, property: String },
    #[error(transparent)]
    Class(#[from] ClassError),
}

impl FactError {
    pub(super) fn no_object(class: &str, key: &impl ToString) -> Self {
        Self::NoObject { class: class.to_owned(), key: key.to_string() }
    }

    fn mistyped(class: &str, property: &str, holds: Type, value: String) -> Self {
        Self::Type { class: class.to_owned(), property: property.to_owned(), holds, value }
    }
}

impl KnowledgeBase {
    /// Tells one value of the object with this key; `None` takes back what was told, and what rules conclude
    /// holds again. A property that the class does not have yet is added, unknown for the other objects.
    pub fn tell(
        &mut self,
        class: &str,
        key: &str,
        property: &str,
        value: Option<Value>,
    ) -> Result<(), FactError> {
        let row = self.told_class(class)?.table.row(key, &self.symbols.read());
        self.tell_row(class, row.ok_or_else(|| FactError::no_object(class, &key))?, property, value)
    }

    /// As [`tell`](Self::tell), by the object's row from 0.
    pub fn tell_row(
        &mut self,
        class: &str,
        row: usize,
        property: &str,
        value: Option<Value>,
    ) -> Result<(), FactError> {
        let table = &self.told_class(class)?.table;
        if row >= table.len {
            return Err(FactError::no_object(class, &row));
        }
        let at = table.names.iter().position(|name| name == property);
        if at.is_some_and(|at| table.key.contains(&at)) {
            return Err(FactError::Key { class: class.to_owned(), property: property.to_owned() });
        }
        let cell = value.as_ref().map_or(Cell::Unknown, |value| self.symbols.get_mut().cell(value));
        if let (None, Some(kind)) = (at, cell.kind()) {
            self.may_widen(class, property, kind, value.as_ref())?;
        }
        let Some(held) = self.held.get_mut(class) else { return Ok(()) };
        let table = &mut held.table;
        let at = match (at, cell.kind()) {
            (Some(at), _) => at,
            (None, None) => return Ok(()),
            (None, Some(kind)) => {
                self.network.recheck = true;
                table.widen(property, kind)
            }
        };
        let cell = if cell == Cell::Unknown { table.null_of(at) } else { cell };
        let column = &mut table.columns[at];
        let before = column.cell(row);
        if cell.kind().is_some_and(|kind| kind != column.kind()) {
            let value = value.map_or_else(String::new, |value| value.to_string());
            return Err(FactError::mistyped(class, property, column.kind(), value));
        }
        Arc::make_mut(column).set(row, cell);
        if value.is_some() && !self.network.not_known.is_empty() {
            let key = held.table.key_text(row, &self.symbols.read());
            self.network.not_known.remove(&(PropertyName::new(class, property), key));
        }
        if !before.same(cell) {
            held.pending.change(property, row as u32);
        }
        Ok(())
    }

    /// Takes a property away that was told object by object, as if it had never been told: a rule that needs it waits,
    /// unless another concludes it. Of a property that is not there, nothing is left to take away.
    pub fn retract_property(&mut self, class: &str, property: &str) -> Result<(), FactError> {
        let Some(Held { table, pending }) = self.held.get_mut(class) else { return Ok(()) };
        let Some(at) = table.names.iter().position(|name| name == property) else { return Ok(()) };
        if table.key.contains(&at) {
            return Err(FactError::Key { class: class.to_owned(), property: property.to_owned() });
        }
        let column = table.narrow(at);
        for row in (0..column.len()).filter(|&row| !column.is_unknown(row)) {
            pending.change(property, row as u32);
        }
        self.network.recheck = true;
        Ok(())
    }

    /// Adds an object at the end of its class and gives its row. Properties that are left out are unknown; a class
    /// or property that is not there is made.
    pub fn add(&mut self, class: &str, object: &[(&str, Value)]) -> Result<usize, FactError> {
        if !self.held.contains_key(class) {
            self.assert(Class::new(class, &[]))?;
        }
        let mut cells = vec![];
        for (property, value) in object {
            cells.push((*property, self.symbols.get_mut().cell(value), value));
        }
        let table = &self.told_class(class)?.table;
        let mut row: Vec<Cell> = (0..table.columns.len()).map(|at| table.null_of(at)).collect();
        let mut new: Vec<(&str, Cell)> = vec![];
        for (property, cell, value) in cells {
            let Some(at) = table.names.iter().position(|name| name == property) else {
                new.push((property, cell));
                continue;
            };
            if cell.kind().is_some_and(|kind| kind != table.columns[at].kind()) {
                return Err(FactError::mistyped(
                    class,
                    property,
                    table.columns[at].kind(),
                    value.to_string(),
                ));
            }
            row[at] = cell;
        }
        table.check_new(&row, &self.symbols.read())?;
        for (property, cell) in &new {
            if let Some(kind) = cell.kind() {
                self.may_widen(class, property, kind, None)?;
            }
        }
        let Some(Held { table, pending }) = self.held.get_mut(class) else { return Ok(0) };
        for (property, cell) in new {
            if let Some(kind) = cell.kind() {
                self.network.recheck = true;
                let at = table.widen(property, kind);
                row.resize(table.columns.len(), Cell::Unknown);
                row[at] = cell;
            }
        }
        for (column, cell) in table.columns.iter_mut().zip(row) {
            Arc::make_mut(column).push(cell);
        }
        table.len += 1;
        let at = table.len - 1;
        pending.added.push(at as u32);
        Ok(at)
    }

    /// Removes the object with this key; those after it move up.
    pub fn remove(&mut self, class: &str, key: &str) -> Result<(), FactError> {
        let row = self.told_class(class)?.table.row(key, &self.symbols.read());
        self.remove_row(class, row.ok_or_else(|| FactError::no_object(class, &key))?)
    }

    /// As [`remove`](Self::remove), by the object's row from 0.
    pub fn remove_row(&mut self, class: &str, row: usize) -> Result<(), FactError> {
        let table = &self.told_class(class)?.table;
        if row >= table.len {
            return Err(FactError::no_object(class, &row));
        }
        if let Some(Held { table, pending }) = self.held.get_mut(class) {
            let before = table.len as u32;
            let moved: Vec<Option<u32>> = (0..before)
                .map(|at| match at.cmp(&(row as u32)) {
                    std::cmp::Ordering::Less => Some(at),
                    std::cmp::Ordering::Equal => None,
                    std::cmp::Ordering::Greater => Some(at - 1),
                })
                .collect();
            pending.move_rows(&moved);
            table.columns.iter_mut().for_each(|column| Arc::make_mut(column).remove(row));
            table.len -= 1;
        }
        Ok(())
    }

    fn told_class(&self, class: &str) -> Result<&Held, FactError> {
        self.held.get(class).ok_or_else(|| FactError::NoClass { class: class.to_owned() })
    }

    /// A new told property of a class must hold what rules conclude of it.
    fn may_widen(
        &self,
        class: &str,
        property: &str,
        kind: Type,
        value: Option<&Value>,
    ) -> Result<(), FactError> {
        let holds = self.view(&PropertyName::new(class, property), None).map(Column::kind);
        match holds {
            Some(holds) if holds != kind => {
                let value = value.map_or_else(|| kind.plural().to_owned(), ToString::to_string);
                Err(FactError::mistyped(class, property, holds, value))
            }
            _ => Ok(()),
        }
    }
}

impl Table {
    /// The number of a new property, unknown for all objects.
    pub(crate) fn widen(&mut self, property: &str, kind: Type) -> usize {
        self.names.push(property.to_owned());
        self.columns.push(Arc::new(Column::unknown(kind, self.len)));
        self.columns.len() - 1
    }

    /// Takes a property out that is no part of the key.
    fn narrow(&mut self, at: usize) -> Arc<Column> {
        self.nulls.retain(|(column, _)| *column != at);
        let later = self.key.iter_mut().chain(self.nulls.iter_mut().map(|(column, _)| column));
        later.filter(|column| **column > at).for_each(|column| *column -= 1);
        self.names.remove(at);
        self.columns.remove(at)
    }

    fn null_of(&self, at: usize) -> Cell {
        self.nulls.iter().find(|(column, _)| *column == at).map_or(Cell::Unknown, |&(_, cell)| cell)
    }
}
