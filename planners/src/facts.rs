//! Facts as planners assert them: classes of objects, a column a property. Rules use both by name.

use std::collections::BTreeMap;

/// One property of all objects of a class; `None` is unknown, or what the class declares NULL to mean.
#[derive(Clone, Debug, PartialEq)]
pub enum Column {
    Number(Vec<Option<f64>>),
    Text(Vec<Option<String>>),
    Truth(Vec<Option<bool>>),
}

impl Column {
    /// How many objects it has a value (or an unknown) for.
    pub fn len(&self) -> usize {
        match self {
            Self::Number(v) => v.len(),
            Self::Text(v) => v.len(),
            Self::Truth(v) => v.len(),
        }
    }

    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Whether the value of each object is known.
    pub fn is_whole(&self) -> bool {
        match self {
            Self::Number(v) => v.iter().all(Option::is_some),
            Self::Text(v) => v.iter().all(Option::is_some),
            Self::Truth(v) => v.iter().all(Option::is_some),
        }
    }
}

impl FromIterator<f64> for Column {
    fn from_iter<I: IntoIterator<Item = f64>>(values: I) -> Self {
        Self::Number(values.into_iter().map(Some).collect())
    }
}

impl FromIterator<Option<f64>> for Column {
    fn from_iter<I: IntoIterator<Item = Option<f64>>>(values: I) -> Self {
        Self::Number(values.into_iter().collect())
    }
}

impl FromIterator<String> for Column {
    fn from_iter<I: IntoIterator<Item = String>>(values: I) -> Self {
        Self::Text(values.into_iter().map(Some).collect())
    }
}

impl FromIterator<Option<String>> for Column {
    fn from_iter<I: IntoIterator<Item = Option<String>>>(values: I) -> Self {
        Self::Text(values.into_iter().collect())
    }
}

impl FromIterator<bool> for Column {
    fn from_iter<I: IntoIterator<Item = bool>>(values: I) -> Self {
        Self::Truth(values.into_iter().map(Some).collect())
    }
}

/// The objects of one class. All columns have the same length.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Table {
    /// Property name and its values, in the order in which they are shown.
    pub columns: Vec<(String, Column)>,
}

impl Table {
    #[must_use]
    pub fn with(mut self, property: &str, column: impl Into<Column>) -> Self {
        self.columns.push((property.to_owned(), column.into()));
        self
    }

    pub fn column(&self, property: &str) -> Option<&Column> {
        self.columns.iter().find(|(name, _)| name == property).map(|(_, column)| column)
    }

    pub fn len(&self) -> usize {
        self.columns.first().map_or(0, |(_, column)| column.len())
    }

    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The property as numbers; an error names what is missing or of another type.
    pub fn numbers(&self, property: &str) -> Result<&[Option<f64>], String> {
        match self.column(property) {
            Some(Column::Number(values)) => Ok(values),
            other => Err(mismatch(property, "numbers", other)),
        }
    }

    pub fn texts(&self, property: &str) -> Result<&[Option<String>], String> {
        match self.column(property) {
            Some(Column::Text(values)) => Ok(values),
            other => Err(mismatch(property, "texts", other)),
        }
    }

    pub fn truths(&self, property: &str) -> Result<&[Option<bool>], String> {
        match self.column(property) {
            Some(Column::Truth(values)) => Ok(values),
            other => Err(mismatch(property, "truth values", other)),
        }
    }
}

fn mismatch(property: &str, wanted: &str, found: Option<&Column>) -> String {
    match found {
        None => format!("property `{property}` is missing"),
        Some(Column::Number(_)) => format!("property `{property}` holds numbers where {wanted} are needed"),
        Some(Column::Text(_)) => format!("property `{property}` holds texts where {wanted} are needed"),
        Some(Column::Truth(_)) => {
            format!("property `{property}` holds truth values where {wanted} are needed")
        }
    }
}

/// Classes by name (`DOORS`), with their objects.
pub type Facts = BTreeMap<String, Table>;
