//! A derived value and who derived it.

use serde::Serialize;
use sqlx::sqlite::SqliteRow;
use sqlx::{Decode, Row, Sqlite, Type};

use crate::bulk::Values;
use crate::error::Result;

/// A value that a rule concluded, or none.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Derived<T> {
    /// The value; `None` where no rule gave one.
    pub value: Option<T>,
    /// The rule, a key of `rules`.
    pub rule: Option<i64>,
    /// The facts that the rule chose, a key of `witnesses`.
    pub witness: Option<i64>,
}

impl<T> Default for Derived<T> {
    fn default() -> Self {
        Self { value: None, rule: None, witness: None }
    }
}

impl<T> Derived<T> {
    /// The value as `rule` concluded it from `witness`.
    pub fn by(rule: i64, witness: Option<i64>, value: T) -> Self {
        Self { value: Some(value), rule: Some(rule), witness }
    }

    pub(crate) fn bind_reason(&self, values: &mut Values) {
        values.integer(self.rule);
        values.integer(self.witness);
    }
}

impl<'r, T: Decode<'r, Sqlite> + Type<Sqlite>> Derived<T> {
    pub(crate) fn of(row: &'r SqliteRow, value: usize, rule: usize) -> Result<Self> {
        Ok(Self { value: row.try_get(value)?, rule: row.try_get(rule)?, witness: row.try_get(rule + 1)? })
    }
}
