//! Classes of objects as a host asserts them.

use std::collections::HashSet;
use std::sync::Arc;

use thiserror::Error;

use crate::column::Column;
use crate::symbols::{Symbol, Symbols};
use crate::value::{Cell, Truth, Type, Value};

#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum ClassError {
    #[error("class {class} has the property `{property}` twice")]
    Twice { class: String, property: String },
    #[error("class {class} has {expected} objects, but `{property}` has {found} values")]
    Ragged {
        class: String,
        /// The property that differs from the first.
        property: String,
        expected: usize,
        found: usize,
    },
    /// The key, or what NULL means, names no property.
    #[error("class {class} has no property `{property}`")]
    Missing { class: String, property: String },
    #[error("class {class}: the key of object {row} is unknown")]
    UnknownKey {
        class: String,
        /// Row from 0.
        row: usize,
    },
    #[error("class {class} has two objects with the key {key}")]
    SameKey {
        class: String,
        /// The key, its parts joined with `/`.
        key: String,
    },
    /// What NULL means is of another type than the property.
    #[error("class {class}: NULL of `{property}` cannot mean {value}: it holds {}", holds.plural())]
    NullType { class: String, property: String, value: String, holds: Type },
    #[error("class {class} has more than 4 billion objects")]
    TooLarge { class: String },
}

#[derive(Clone, Debug)]
enum Given {
    Column(Column),
    /// Their numbers are the knowledge base's to give.
    Texts(Vec<Option<String>>),
}

/// A class under construction: its name, key, and a column for each property. `None` is unknown unless
/// [`Class::null_means`] says otherwise.
///
/// ```
/// use adit_engine::Class;
/// let plants = Class::new("PLANTS", &["pot"])
///     .texts("pot", [Some("fern"), Some("cactus")])
///     .numbers("days_dry", [Some(3.0), None]);
/// ```
#[derive(Clone, Debug)]
pub struct Class {
    name: String,
    key: Vec<String>,
    properties: Vec<(String, Given)>,
    nulls: Vec<(String, Value)>,
    numbered: bool,
}

impl Class {
    /// A class whose objects are told apart by the properties of `key`.
    pub fn new(name: impl Into<String>, key: &[&str]) -> Self {
        Self {
            name: name.into(),
            key: key.iter().map(ToString::to_string).collect(),
            properties: vec![],
            nulls: vec![],
            numbered: false,
        }
    }

    /// Objects that rules tell without a key get the next whole number; the key must be one property that holds numbers.
    #[must_use]
    pub fn numbered(mut self) -> Self {
        self.numbered = true;
        self
    }

    /// Adds a property that holds numbers. NaN is unknown.
    #[must_use]
    pub fn numbers(
        mut self,
        property: impl Into<String>,
        values: impl IntoIterator<Item = Option<f64>>,
    ) -> Self {
        let values = values.into_iter().map(|number| number.unwrap_or(f64::NAN)).collect();
        self.properties.push((property.into(), Given::Column(Column::Numbers(values))));
        self
    }

    #[must_use]
    pub fn texts<T: Into<String>>(
        mut self,
        property: impl Into<String>,
        values: impl IntoIterator<Item = Option<T>>,
    ) -> Self {
        let values = values.into_iter().map(|text| text.map(Into::into)).collect();
        self.properties.push((property.into(), Given::Texts(values)));
        self
    }

    #[must_use]
    pub fn truths(
        mut self,
        property: impl Into<String>,
        values: impl IntoIterator<Item = Option<bool>>,
    ) -> Self {
        let values = values.into_iter().map(|truth| truth.map_or(Truth::Unknown, Into::into)).collect();
        self.properties.push((property.into(), Given::Column(Column::Truths(values))));
        self
    }

    /// Adds a property that holds this type; a value of another type is unknown.
    #[must_use]
    pub fn values(
        self,
        property: impl Into<String>,
        kind: Type,
        values: impl IntoIterator<Item = Option<Value>>,
    ) -> Self {
        let values = values.into_iter();
        match kind {
            Type::Number => self.numbers(
                property,
                values.map(|value| if let Some(Value::Number(number)) = value { Some(number) } else { None }),
            ),
            Type::Text => self.texts(
                property,
                values.map(
                    |value| if let Some(Value::Text(text)) = value { Some(text.to_string()) } else { None },
                ),
            ),
            Type::Truth => self.truths(
                property,
                values.map(|value| if let Some(Value::Truth(truth)) = value { Some(truth) } else { None }),
            ),
        }
    }

    /// Declares that `None` of this property is not unknown but this value: a height without limit.
    #[must_use]
    pub fn null_means(mut self, property: impl Into<String>, value: impl Into<Value>) -> Self {
        self.nulls.push((property.into(), value.into()));
        self
    }
}

#[derive(Clone, Debug)]
pub(crate) struct Table {
    pub(crate) name: String,
    pub(crate) key: Vec<usize>,
    pub(crate) names: Vec<String>,
    /// Copies share each until one of them is told otherwise.
    pub(crate) columns: Vec<Arc<Column>>,
    /// Columns in which NULL is a value, with that value.
    pub(crate) nulls: Vec<(usize, Cell)>,
    pub(crate) len: usize,
    /// Whether objects that rules tell are numbered.
    numbered: bool,
}

impl Table {
    pub(crate) fn new(class: Class, symbols: &mut Symbols) -> Result<Self, ClassError> {
        let Class { name, key, properties, nulls, numbered } = class;
        let mut table =
            Self { name, key: vec![], names: vec![], columns: vec![], nulls: vec![], len: 0, numbered };
        for (property, given) in properties {
            let column = match given {
                Given::Column(column) => column,
                Given::Texts(texts) => {
                    let mut symbol =
                        |text: Option<String>| text.map_or(Symbol::UNKNOWN, |text| symbols.intern(&text));
                    Column::Texts(texts.into_iter().map(&mut symbol).collect())
                }
            };
            table.push(property, column)?;
        }
        if table.len > (u32::MAX - 1) as usize {
            return Err(ClassError::TooLarge { class: table.name });
        }
        for (property, value) in nulls {
            table.fill(&property, &value, symbols)?;
        }
        table.key = key.iter().map(|part| table.index(part)).collect::<Result<_, _>>()?;
        table.check_keys(symbols)?;
        Ok(table)
    }

    fn push(&mut self, property: String, column: Column) -> Result<(), ClassError> {
        let class = self.name.clone();
        if self.names.contains(&property) {
            return Err(ClassError::Twice { class, property });
        }
        if !self.columns.is_empty() && column.len() != self.len {
            return Err(ClassError::Ragged { class, property, expected: self.len, found: column.len() });
        }
        self.len = column.len();
        self.names.push(property);
        self.columns.push(Arc::new(column));
        Ok(())
    }

    fn fill(&mut self, property: &str, value: &Value, symbols: &mut Symbols) -> Result<(), ClassError> {
        let cell = symbols.cell(value);
        let index = self.index(property)?;
        let column = Arc::make_mut(&mut self.columns[index]);
        let holds = column.kind();
        if cell.kind().is_some_and(|kind| kind != holds) {
            let (class, property) = (self.name.clone(), property.to_owned());
            return Err(ClassError::NullType { class, property, value: value.to_string(), holds });
        }
        for row in 0..self.len {
            if column.is_unknown(row) {
                column.set(row, cell);
            }
        }
        self.nulls.push((index, cell));
        Ok(())
    }

    fn index(&self, property: &str) -> Result<usize, ClassError> {
        self.names
            .iter()
            .position(|name| name == property)
            .ok_or_else(|| ClassError::Missing { class: self.name.clone(), property: property.to_owned() })
    }

    fn check_keys(&self, symbols: &Symbols) -> Result<(), ClassError> {
        if let [column] = *self.key
            && let Column::Numbers(numbers) = &*self.columns[column]
            && numbers.first().is_none_or(|number| !number.is_nan())
            && numbers.is_sorted_by(|one, next| one < next)
        {
            return Ok(());
        }
        let mut seen = HashSet::with_capacity(self.len);
        for row in 0..self.len {
            let Some(parts) = self.key_bits(row) else {
                return Err(ClassError::UnknownKey { class: self.name.clone(), row });
            };
            if !self.key.is_empty() && !seen.insert(parts) {
                return Err(ClassError::SameKey {
                    class: self.name.clone(),
                    key: self.key_text(row, symbols),
                });
            }
        }
        Ok(())
    }

    /// The key of a row as bits; `None` where a part of it is unknown.
    pub(crate) fn key_bits(&self, row: usize) -> Option<Vec<u64>> {
        self.key.iter().map(|&column| self.columns[column].cell(row).bits()).collect()
    }

    /// Whether an object with these cells may be added: its key is known, and no other has it.
    pub(crate) fn check_new(&self, cells: &[Cell], symbols: &Symbols) -> Result<(), ClassError> {
        if self.key.is_empty() {
            return Ok(());
        }
        let class = || self.name.clone();
        if self.len >= (u32::MAX - 1) as usize {
            return Err(ClassError::TooLarge { class: class() });
        }
        if self.key.iter().any(|&column| cells[column] == Cell::Unknown) {
            return Err(ClassError::UnknownKey { class: class(), row: self.len });
        }
        let same =
            |row: &usize| self.key.iter().all(|&column| self.columns[column].cell(*row) == cells[column]);
        match (0..self.len).find(same) {
            Some(row) => Err(ClassError::SameKey { class: class(), key: self.key_text(row, symbols) }),
            None => Ok(()),
        }
    }

    /// The property that numbers the objects, and the next number; `None` where they are not numbered.
    pub(crate) fn next_number(&self) -> Option<(&str, f64)> {
        let &[at] = self.key.as_slice() else { return None };
        let Column::Numbers(numbers) = &*self.columns[at] else { return None };
        let next = numbers.iter().copied().fold(0.0, f64::max).floor() + 1.0;
        self.numbered.then(|| (self.names[at].as_str(), next))
    }

    pub(crate) fn column(&self, property: &str) -> Option<&Column> {
        self.names.iter().position(|name| name == property).map(|index| &*self.columns[index])
    }

    /// The key of an object as text, its parts joined with `/`; the row from 1 where the class has no key.
    pub(crate) fn key_text(&self, row: usize, symbols: &Symbols) -> String {
        if self.key.is_empty() {
            return (row + 1).to_string();
        }
        let parts: Vec<String> = self
            .key
            .iter()
            .map(|&column| match value(self.columns[column].cell(row), symbols) {
                Some(value) => value.to_string(),
                None => "?".to_owned(),
            })
            .collect();
        parts.join("/")
    }

    /// The row of the object with this key, as [`Table::key_text`] writes it.
    pub(crate) fn row(&self, key: &str, symbols: &Symbols) -> Option<usize> {
        if let [column] = *self.key {
            // One column is looked through by value, not by text.
            let cell = match &*self.columns[column] {
                Column::Numbers(_) => Cell::number(key.parse().ok()?),
                Column::Texts(_) => Cell::Text(symbols.find(key)?),
                Column::Truths(_) => Cell::Truth(key.parse().ok()?),
            };
            return (0..self.len).find(|&row| self.columns[column].cell(row) == cell);
        }
        (0..self.len).find(|&row| self.key_text(row, symbols) == key)
    }
}

pub(crate) fn value(cell: Cell, symbols: &Symbols) -> Option<Value> {
    match cell {
        Cell::Unknown => None,
        Cell::Number(number) => Some(Value::Number(number)),
        Cell::Text(symbol) => symbols.text(symbol).map(|text| Value::Text(text.clone())),
        Cell::Truth(truth) => Some(Value::Truth(truth)),
    }
}
