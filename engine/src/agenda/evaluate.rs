//! Evaluates the nodes of a rule for one binding of the agenda.

use std::cell::RefCell;

use super::script::Scripts;
use super::world::World;
use crate::machine::scalar::{Binding, Scalar};
use crate::plan::fragment::Fragment;
use crate::plan::node::Node;
use crate::symbols::Symbols;
use crate::value::{Cell, Truth};

/// What the clauses of a rule bind: objects, and the numbers of `count` and `sum`.
#[derive(Clone, Debug)]
pub(crate) struct Bound {
    pub(crate) ids: Vec<u32>,
    pub(crate) numbers: Vec<f64>,
}

/// Evaluates the nodes of one rule.
pub(crate) struct Evaluator<'e> {
    pub(crate) world: &'e World,
    /// For each column of the rule's plan its number in the world.
    pub(crate) columns: &'e [usize],
    pub(crate) symbols: &'e RefCell<Symbols>,
    pub(crate) scripts: &'e Scripts<'e>,
}

impl Evaluator<'_> {
    pub(crate) fn cell(&self, node: &Node, bound: &Bound) -> Cell {
        Scalar { binding: &On { evaluator: self, bound }, slots: &[] }.cell(node)
    }

    /// A number; NaN is unknown.
    pub(crate) fn number(&self, node: &Node, bound: &Bound) -> f64 {
        Scalar { binding: &On { evaluator: self, bound }, slots: &[] }.number(node)
    }

    pub(crate) fn truth(&self, node: &Node, bound: &Bound) -> Truth {
        Scalar { binding: &On { evaluator: self, bound }, slots: &[] }.truth(node)
    }
}

/// A rule's evaluator on one binding.
struct On<'b> {
    evaluator: &'b Evaluator<'b>,
    bound: &'b Bound,
}

impl Binding for On<'_> {
    fn property(&self, variable: usize, column: usize) -> Cell {
        self.evaluator.world.cell(self.evaluator.columns[column], self.bound.ids[variable])
    }

    fn aggregate(&self, clause: usize) -> f64 {
        self.bound.numbers[clause]
    }

    fn interpret(&self, fragment: &Fragment) -> Cell {
        self.evaluator.scripts.value(fragment, self.evaluator, self.bound)
    }

    fn symbols(&self) -> &RefCell<Symbols> {
        self.evaluator.symbols
    }
}
