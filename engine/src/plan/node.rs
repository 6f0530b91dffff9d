//! Expressions of rules, lowered: no names, no dispatch by name, types settled.

use super::fragment::Fragment;
use crate::symbols::Symbol;
use crate::value::{Truth, Type};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Arithmetic {
    Add,
    Subtract,
    Multiply,
    Divide,
    Remainder,
    Power,
    Min,
    Max,
    Hypot,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Function {
    Negate,
    Abs,
    Sqrt,
    Floor,
    Ceil,
    Round,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Comparison {
    Equal,
    Unequal,
    Less,
    AtMost,
    Greater,
    AtLeast,
}

impl Comparison {
    pub(crate) const fn turned(self) -> Self {
        match self {
            Self::Equal => Self::Equal,
            Self::Unequal => Self::Unequal,
            Self::Less => Self::Greater,
            Self::AtMost => Self::AtLeast,
            Self::Greater => Self::Less,
            Self::AtLeast => Self::AtMost,
        }
    }
}

/// A lowered expression. Unknown goes in and comes out everywhere; "and", "or" and "not" are Kleene's.
#[derive(Clone, Debug)]
pub(crate) enum Node {
    Unknown,
    Number(f64),
    Text(Symbol),
    Truth(Truth),
    Property {
        variable: usize,
        column: usize,
    },
    /// The number that a clause of `count` or `sum` gives.
    Aggregate(usize),
    /// What a `let`, or a property set before, holds.
    Local(usize),
    Arithmetic(Arithmetic, Box<Self>, Box<Self>),
    Function(Function, Box<Self>),
    /// Both sides hold the same type.
    Compare(Comparison, Box<Self>, Box<Self>),
    And(Vec<Self>),
    Or(Vec<Self>),
    Not(Box<Self>),
    Known(Box<Self>),
    /// Texts and numbers written one after the other.
    Concat(Box<Self>, Box<Self>),
    Choose(Box<Self>, Box<Self>, Box<Self>),
    /// The first, or the second where the first is unknown.
    Coalesce(Box<Self>, Box<Self>),
    /// A value of a type that only running tells, where this type is wanted.
    Narrow(Type, Box<Self>),
    Interpret(Box<Fragment>),
}

impl Node {
    pub(crate) fn walk(&self, look: &mut dyn FnMut(&Self)) {
        look(self);
        match self {
            Self::Unknown
            | Self::Number(_)
            | Self::Text(_)
            | Self::Truth(_)
            | Self::Property { .. }
            | Self::Aggregate(_)
            | Self::Local(_)
            | Self::Interpret(_) => {}
            Self::Function(_, a) | Self::Not(a) | Self::Known(a) | Self::Narrow(_, a) => a.walk(look),
            Self::Arithmetic(_, a, b)
            | Self::Compare(_, a, b)
            | Self::Concat(a, b)
            | Self::Coalesce(a, b) => [a, b].into_iter().for_each(|part| part.walk(look)),
            Self::Choose(a, b, c) => [a, b, c].into_iter().for_each(|part| part.walk(look)),
            Self::And(parts) | Self::Or(parts) => parts.iter().for_each(|part| part.walk(look)),
        }
    }

    /// The pattern variables that it looks at, as bits.
    pub(crate) fn variables(&self) -> u64 {
        let mut bits = 0;
        self.walk(&mut |node| match node {
            Self::Property { variable, .. } | Self::Aggregate(variable) => bits |= 1 << variable,
            Self::Interpret(fragment) => bits |= fragment.variables(),
            _ => {}
        });
        bits
    }

    pub(crate) fn interprets(&self) -> bool {
        let mut found = false;
        self.walk(&mut |node| found |= matches!(node, Self::Interpret(_)));
        found
    }
}
