//! The knowledge base: what was told, what rules concluded, and why.

mod affected;
pub(crate) mod ask;
mod body;
mod conclude;
pub(crate) mod consultation;
mod derived;
mod difference;
mod dirty;
pub(crate) mod dominated;
mod evaluate;
pub(crate) mod facts;
mod memory;
mod merge;
pub(crate) mod misspelt;
mod network;
mod pending;
mod react;
mod replay;
mod report;
mod reshape;
mod revise;
mod undo;
pub(crate) mod unmet;
mod voices;
mod why;
mod why_not;

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::agenda::Agenda;
use crate::changes::Changes;
use crate::class::{Class, ClassError, Table, value};
use crate::column::Column;
use crate::rule::PropertyName;
use crate::schema::Schema;
use crate::script::limits::Limits;
use crate::symbols::Lexicon;
use crate::value::{Cell, Type, Value};
use derived::Derived;
use network::Network;
use pending::{Held, Pending};

/// Classes of objects with what is told and concluded of them.
///
/// A value that was told stands before a concluded one. Facts are told class by class ([`assert`](Self::assert)), or
/// one by one ([`tell`](Self::tell), [`add`](Self::add), [`remove`](Self::remove)); the next
/// [`conclude`](Self::conclude) or [`update`](Self::update) makes everything right that follows from what changed, at
/// a cost by what depends on it.
#[derive(Debug, Default)]
pub struct KnowledgeBase {
    symbols: Lexicon,
    held: BTreeMap<String, Held>,
    derived: BTreeMap<PropertyName, Derived>,
    agenda: Agenda,
    /// What changed since the host last asked.
    unreported: Changes,
    generation: u64,
    network: Network,
    limits: Limits,
}

impl KnowledgeBase {
    pub fn new() -> Self {
        Self::default()
    }

    pub fn with_limits(limits: Limits) -> Self {
        Self { limits, ..Self::default() }
    }

    /// A copy to try things on: what is told and concluded, with what is kept between inferences, so that an
    /// [`update`](Self::update) of the copy costs what depends on the change. The agenda is not taken along: in the
    /// copy no reaction was carried out yet.
    ///
    /// Columns are shared until one of the two changes them.
    #[must_use]
    pub fn fork(&self) -> Self {
        Self {
            symbols: self.symbols.clone(),
            held: self.held.clone(),
            derived: self.derived.clone(),
            agenda: Agenda::default(),
            unreported: self.unreported.clone(),
            generation: self.generation,
            network: self.network.clone(),
            limits: self.limits,
        }
    }

    /// Adds a class, or replaces it: objects are told apart by their key, and only what differs counts as changed.
    pub fn assert(&mut self, class: Class) -> Result<(), ClassError> {
        let table = Table::new(class, self.symbols.get_mut())?;
        self.hold(table);
        Ok(())
    }

    fn hold(&mut self, table: Table) {
        if let Some(held) = self.held.get_mut(&table.name) {
            held.pending.join(difference::difference(&held.table, &table));
            self.network.recheck |= held.pending.anew;
            held.table = table;
        } else {
            self.network.recheck = true;
            self.held.insert(table.name.clone(), Held { table, pending: Pending::anew() });
        }
    }

    /// Takes a class away, and what rests on it.
    pub fn retract(&mut self, class: &str) {
        if self.held.remove(class).is_some() {
            self.network.retracted.insert(class.to_owned());
            self.network.recheck = true;
        }
    }

    pub fn schema(&self) -> Schema {
        let mut schema = Schema::default();
        for (name, Held { table, .. }) in &self.held {
            let key: Vec<&str> = table.key.iter().map(|&column| table.names[column].as_str()).collect();
            schema = schema.class(name, &[]);
            schema.set_key(name, &key);
            for (property, column) in table.names.iter().zip(&table.columns) {
                schema.add(name, property, column.kind());
            }
        }
        schema
    }

    /// How many objects a class has; `None` if it was not asserted.
    pub fn len(&self, class: &str) -> Option<usize> {
        self.held.get(class).map(|held| held.table.len)
    }

    pub fn is_empty(&self) -> bool {
        self.held.is_empty()
    }

    /// The key of an object as text: the values of the key properties joined with `/`.
    pub fn key(&self, class: &str, row: usize) -> Option<String> {
        let table = &self.held.get(class)?.table;
        (row < table.len).then(|| table.key_text(row, &self.symbols.read()))
    }

    /// The row of the object with this key. Looks through the class.
    pub fn row(&self, class: &str, key: &str) -> Option<usize> {
        self.held.get(class)?.table.row(key, &self.symbols.read())
    }

    /// One value, told or concluded; `None` if it is unknown, or there is no such object or property.
    pub fn value(&self, class: &str, key: &str, property: &str) -> Option<Value> {
        self.value_at(class, self.row(class, key)?, property)
    }

    /// As [`value`](Self::value), by the object's row from 0.
    pub fn value_at(&self, class: &str, row: usize, property: &str) -> Option<Value> {
        let column = self.column(&PropertyName::new(class, property))?;
        value(column.cell(row), &self.symbols.read())
    }

    /// The type of a property's values; `None` where nobody has told or concluded any.
    pub fn kind_of(&self, class: &str, property: &str) -> Option<Type> {
        self.column(&PropertyName::new(class, property)).map(Column::kind)
    }

    /// As [`value_at`](Self::value_at), of several rows.
    pub fn values_at(&self, class: &str, rows: &[u32], property: &str) -> Vec<Option<Value>> {
        let Some(column) = self.column(&PropertyName::new(class, property)) else {
            return vec![None; rows.len()];
        };
        let symbols = self.symbols.read();
        rows.iter().map(|row| value(column.cell(*row as usize), &symbols)).collect()
    }

    /// A property of all objects as numbers; `None` if it does not hold numbers.
    pub fn numbers(&self, class: &str, property: &str) -> Option<Vec<Option<f64>>> {
        match self.column(&PropertyName::new(class, property))? {
            Column::Numbers(values) => {
                Some(values.iter().map(|&number| Some(number).filter(|number| !number.is_nan())).collect())
            }
            _ => None,
        }
    }

    /// A property of all objects as texts; `None` if it does not hold texts.
    pub fn texts(&self, class: &str, property: &str) -> Option<Vec<Option<Arc<str>>>> {
        match self.column(&PropertyName::new(class, property))? {
            Column::Texts(values) => {
                let symbols = self.symbols.read();
                Some(values.iter().map(|&symbol| symbols.text(symbol).cloned()).collect())
            }
            _ => None,
        }
    }

    /// A property of all objects as truth values; `None` if it does not hold truth values.
    pub fn truths(&self, class: &str, property: &str) -> Option<Vec<Option<bool>>> {
        match self.column(&PropertyName::new(class, property))? {
            Column::Truths(values) => Some(values.iter().map(|truth| truth.known()).collect()),
            _ => None,
        }
    }

    fn column(&self, name: &PropertyName) -> Option<&Column> {
        self.view(name, None)
    }

    /// The column as revised by levels below the given one (`None`: by all).
    fn view(&self, name: &PropertyName, below: Option<i64>) -> Option<&Column> {
        let held = self.held.get(&name.class)?;
        match self.known_derived(name) {
            Some(derived) => derived.stages.get(derived.stage(below)).map(Arc::as_ref),
            None => held.table.column(&name.property),
        }
    }

    /// A property that rules conclude or revise, if it has values yet.
    fn known_derived(&self, name: &PropertyName) -> Option<&Derived> {
        self.derived.get(name).filter(|derived| !derived.stages.is_empty())
    }

    fn told_column(&self, name: &PropertyName) -> Option<&Column> {
        self.held.get(&name.class)?.table.column(&name.property)
    }

    fn host_value(&self, cell: Cell) -> Option<Value> {
        value(cell, &self.symbols.read())
    }
}
