//! Values of properties, as hosts see them and as rules compute with them.

use std::fmt;
use std::sync::Arc;

use rhai::{Dynamic, ImmutableString};

use crate::symbols::{Symbol, Symbols};

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Type {
    /// A number; infinite is allowed, NaN is unknown.
    Number,
    Text,
    Truth,
}

impl Type {
    pub const fn plural(self) -> &'static str {
        match self {
            Self::Number => "numbers",
            Self::Text => "texts",
            Self::Truth => "truth values",
        }
    }
}

/// A known value. Unknown is `None` of an `Option<Value>`.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[serde(untagged)]
pub enum Value {
    Number(f64),
    Text(#[serde(serialize_with = "as_str")] Arc<str>),
    Truth(bool),
}

impl Value {
    pub(crate) const fn kind(&self) -> Type {
        match self {
            Self::Number(_) => Type::Number,
            Self::Text(_) => Type::Text,
            Self::Truth(_) => Type::Truth,
        }
    }
}

/// As scripts see it.
impl From<&Value> for Dynamic {
    fn from(value: &Value) -> Self {
        match value {
            Value::Number(number) => (*number).into(),
            Value::Text(text) => ImmutableString::from(&**text).into(),
            Value::Truth(truth) => (*truth).into(),
        }
    }
}

fn as_str<S: serde::Serializer>(text: &str, out: S) -> Result<S::Ok, S::Error> {
    out.serialize_str(text)
}

impl fmt::Display for Value {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => write!(out, "{number}"),
            Self::Text(text) => out.write_str(text),
            Self::Truth(truth) => write!(out, "{truth}"),
        }
    }
}

impl From<f64> for Value {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<&str> for Value {
    fn from(text: &str) -> Self {
        Self::Text(text.into())
    }
}

impl From<bool> for Value {
    fn from(truth: bool) -> Self {
        Self::Truth(truth)
    }
}

/// Kleene's three truth values, ordered so that "and" is the least and "or" the greatest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[repr(u8)]
pub(crate) enum Truth {
    False,
    Unknown,
    True,
}

impl Truth {
    pub(crate) const fn not(self) -> Self {
        match self {
            Self::False => Self::True,
            Self::Unknown => Self::Unknown,
            Self::True => Self::False,
        }
    }

    pub(crate) const fn known(self) -> Option<bool> {
        match self {
            Self::False => Some(false),
            Self::Unknown => None,
            Self::True => Some(true),
        }
    }
}

impl From<bool> for Truth {
    fn from(truth: bool) -> Self {
        if truth { Self::True } else { Self::False }
    }
}

/// One value inside the engine: small, copied, perhaps unknown.
///
/// With a tag as wide as what is held it is copied as two words. A tag of a byte would be copied apart from the bytes
/// behind it, and reading those as a word right after they were written in pieces stalls the processor.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(u64)]
pub(crate) enum Cell {
    Unknown,
    Number(f64),
    Text(Symbol),
    Truth(bool),
}

impl Cell {
    pub(crate) fn kind(self) -> Option<Type> {
        match self {
            Self::Unknown => None,
            Self::Number(_) => Some(Type::Number),
            Self::Text(_) => Some(Type::Text),
            Self::Truth(_) => Some(Type::Truth),
        }
    }

    /// A number; NaN is unknown.
    pub(crate) fn number(number: f64) -> Self {
        if number.is_nan() { Self::Unknown } else { Self::Number(number) }
    }

    /// The value as bits, by which those of one type are told apart; `None` if it is unknown.
    pub(crate) fn bits(self) -> Option<u64> {
        match self {
            Self::Unknown => None,
            // Minus zero equals zero.
            Self::Number(number) => Some((number + 0.0).to_bits()),
            Self::Text(symbol) => Some(u64::from(symbol.id())),
            Self::Truth(truth) => Some(u64::from(truth)),
        }
    }

    /// Equal to the bit: what a change is told by.
    pub(crate) fn same(self, other: Self) -> bool {
        match (self, other) {
            (Self::Number(a), Self::Number(b)) => a.to_bits() == b.to_bits(),
            (a, b) => a == b,
        }
    }
}

impl Symbols {
    /// A host's value as the engine keeps it.
    pub(crate) fn cell(&mut self, value: &Value) -> Cell {
        match value {
            Value::Number(number) => Cell::number(*number),
            Value::Text(text) => Cell::Text(self.intern(text)),
            Value::Truth(truth) => Cell::Truth(*truth),
        }
    }
}
