//! A part of a rule that stays with the interpreter.

use std::collections::BTreeMap;
use std::sync::Arc;

use rhai::{AST, Dynamic, Position};

use crate::rule::FileScope;

/// A script and what it needs to run: the properties and variables that it names.
#[derive(Clone, Debug)]
pub(crate) struct Fragment {
    pub(crate) script: AST,
    /// Where its positions are.
    pub(crate) file: Arc<FileScope>,
    pub(crate) position: Position,
    /// For each pattern variable by name: its number, and its properties with their columns.
    pub(crate) objects: BTreeMap<String, Object>,
    /// Bare properties of the variable just bound, as in `by f(hardness)`.
    pub(crate) bare: Vec<(String, usize, usize)>,
    /// Numbers that clauses of `count` and `sum` give: name, number of the clause.
    pub(crate) numbers: Vec<(String, usize)>,
    pub(crate) constants: Vec<(String, Dynamic)>,
    /// All `let` variables in scope, oldest first (the script counts them from the end): name, slot, and
    /// whether the script looks at it.
    pub(crate) locals: Vec<(String, usize, bool)>,
}

/// A pattern variable as a script sees it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Object {
    pub(crate) variable: usize,
    pub(crate) properties: Vec<(String, Source)>,
}

#[derive(Clone, Copy, Debug)]
pub(crate) enum Source {
    Column(usize),
    /// It was set earlier in the same action.
    Slot(usize),
}

impl Fragment {
    /// The pattern variables that it looks at, as bits.
    pub(crate) fn variables(&self) -> u64 {
        let objects = self.objects.values().fold(0, |bits, object| bits | 1 << object.variable);
        let objects = self.numbers.iter().fold(objects, |bits, (_, clause)| bits | 1 << clause);
        self.bare.iter().fold(objects, |bits, (_, variable, _)| bits | 1 << variable)
    }
}
