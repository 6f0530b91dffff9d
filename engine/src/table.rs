//! Decision tables: rows of tests over the same inputs, each with what it gives.

mod bits;
pub(crate) mod grid;
pub(crate) mod overlap;
pub(crate) mod region;

use rhai::{Expr, Position};

use crate::class::value;
use crate::symbols::Symbols;
use crate::value::{Cell, Value};

/// Which rows of a table count where several match (DMN's hit policies).
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Hit {
    /// No two rows match one input.
    Unique,
    /// Rows that match one input give the same.
    Any,
    First,
    /// The one whose first output comes first in this list.
    Priority(Vec<Value>),
    Collect(Fold),
}

impl Hit {
    /// Whether at most one row counts, though several may match.
    pub(crate) const fn takes_one(&self) -> bool {
        matches!(self, Self::First | Self::Priority(_))
    }
}

/// How the outputs of all rows that match are brought together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fold {
    Sum,
    Min,
    Max,
    Count,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Test {
    Any,
    OneOf(Vec<Value>),
    Not(Box<Self>),
    Below(f64),
    AtMost(f64),
    Above(f64),
    AtLeast(f64),
    /// From the first up to, but not, the second.
    Between(f64, f64),
}

impl Test {
    pub(crate) fn literals(&self) -> Vec<Value> {
        match self {
            Self::Any => vec![],
            Self::OneOf(literals) => literals.clone(),
            Self::Not(test) => test.literals(),
            Self::Below(number) | Self::AtMost(number) | Self::Above(number) | Self::AtLeast(number) => {
                vec![Value::Number(*number)]
            }
            Self::Between(from, to) => vec![Value::Number(*from), Value::Number(*to)],
        }
    }

    /// Whether anything passes, the unknown too.
    pub(crate) const fn asks_nothing(&self) -> bool {
        matches!(self, Self::Any)
    }

    pub(crate) fn passes(&self, value: &Value) -> bool {
        let number = |holds: &dyn Fn(f64) -> bool| matches!(value, Value::Number(number) if holds(*number));
        match self {
            Self::Any => true,
            Self::OneOf(literals) => literals.contains(value),
            Self::Not(test) => !test.passes(value),
            Self::Below(limit) => number(&|number| number < *limit),
            Self::AtMost(limit) => number(&|number| number <= *limit),
            Self::Above(limit) => number(&|number| number > *limit),
            Self::AtLeast(limit) => number(&|number| number >= *limit),
            Self::Between(from, to) => number(&|number| *from <= number && number < *to),
        }
    }
}

impl std::fmt::Display for Test {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Any => out.write_str("any"),
            Self::OneOf(literals) => {
                let literals: Vec<String> = literals.iter().map(written).collect();
                out.write_str(&literals.join(" or "))
            }
            Self::Not(test) => write!(out, "other than {test}"),
            Self::Below(limit) => write!(out, "below {limit}"),
            Self::AtMost(limit) => write!(out, "at most {limit}"),
            Self::Above(limit) => write!(out, "above {limit}"),
            Self::AtLeast(limit) => write!(out, "at least {limit}"),
            Self::Between(from, to) => write!(out, "from {from} to below {to}"),
        }
    }
}

/// A row: a test for each input, an expression for each output.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    pub(crate) position: Position,
    pub(crate) tests: Vec<(Test, Position)>,
    pub(crate) outputs: Vec<Expr>,
}

#[derive(Clone, Debug)]
pub(crate) struct Table {
    pub(crate) hit: Hit,
    /// The inputs, each as it is written.
    pub(crate) given: Vec<(Expr, String)>,
    /// Clause, property and place of each output.
    pub(crate) set: Vec<(usize, String, Position)>,
    pub(crate) rows: Vec<Row>,
}

impl Table {
    /// For each row the first cell whose input does not pass.
    pub(crate) fn misses(&self, inputs: &[Cell], symbols: &Symbols) -> Vec<Option<usize>> {
        let known: Vec<Option<Value>> = inputs.iter().map(|&cell| value(cell, symbols)).collect();
        let passes = |(test, _): &(Test, Position), found: &Option<Value>| {
            found.as_ref().map_or(test.asks_nothing(), |found| test.passes(found))
        };
        let miss = |row: &Row| row.tests.iter().zip(&known).position(|(test, found)| !passes(test, found));
        self.rows.iter().map(miss).collect()
    }

    /// The rows in the order in which they are heard: where one has matched, later ones do not count.
    pub(crate) fn heard(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.rows.len()).collect();
        if let Hit::Priority(values) = &self.hit {
            let rank = |row: usize| {
                let first = self.rows[row].outputs.first().and_then(plain);
                values.iter().position(|value| first.as_ref() == Some(value)).unwrap_or(values.len())
            };
            order.sort_by_key(|&row| rank(row));
        }
        order
    }
}

pub(crate) fn plain(expr: &Expr) -> Option<Value> {
    Some(match expr {
        Expr::IntegerConstant(number, _) => Value::Number(*number as f64),
        Expr::FloatConstant(number, _) => Value::Number(**number),
        Expr::BoolConstant(truth, _) => Value::Truth(*truth),
        Expr::StringConstant(text, _) => Value::from(text.as_str()),
        Expr::FnCall(call, _) if call.name == "-" && call.args.len() == 1 => match plain(&call.args[0])? {
            Value::Number(number) => Value::Number(-number),
            _ => return None,
        },
        _ => return None,
    })
}

/// A value as rules write it: a text in quotes.
pub(crate) fn written(value: &Value) -> String {
    match value {
        Value::Text(text) => format!("\"{text}\""),
        other => other.to_string(),
    }
}
