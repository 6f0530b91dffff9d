//! What the evaluation of one rule gives.

use crate::diagnostic::Diagnostic;
use crate::rule::PropertyName;
use crate::value::{Cell, Type};

/// Values that a rule gives to a property: row, firing and value side by side.
#[derive(Clone, Debug)]
pub(crate) struct Given {
    pub(crate) name: PropertyName,
    /// The type, if it is known before running.
    pub(crate) kind: Option<Type>,
    pub(crate) rows: Vec<u32>,
    pub(crate) firings: Vec<u32>,
    pub(crate) cells: Vec<Cell>,
}

/// A binding of the clauses before, for which a clause was not met.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Failure {
    /// Row of the first clause's object.
    pub(crate) row: u32,
    pub(crate) clause: u32,
    /// Candidates whose test, or whose value to compare, was unknown.
    pub(crate) unknown: u32,
}

/// Objects of a clause's class that were never candidates, since what is asked of them is unknown.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Skipped {
    pub(crate) clause: usize,
    pub(crate) objects: usize,
}

/// All conclusions of one rule, with what each rests on.
#[derive(Clone, Debug, Default)]
pub(crate) struct Output {
    /// For each clause the row bound in each firing, [`NO_ROW`](super::lane::NO_ROW) where there is none.
    pub(crate) witnesses: Vec<Vec<u32>>,
    pub(crate) firings: u32,
    pub(crate) given: Vec<Given>,
    pub(crate) failures: Vec<Failure>,
    pub(crate) skipped: Vec<Skipped>,
    pub(crate) problem: Option<Diagnostic>,
    pub(crate) problems: usize,
}

impl Output {
    pub(crate) fn given(&mut self, name: &PropertyName) -> &mut Given {
        let at = self.given.iter().position(|given| given.name == *name).unwrap_or_else(|| {
            self.given.push(Given {
                name: name.clone(),
                kind: None,
                rows: vec![],
                firings: vec![],
                cells: vec![],
            });
            self.given.len() - 1
        });
        &mut self.given[at]
    }
}
