//! Evaluates nodes for one binding, with the meaning that [`Machine`](super::Machine) has for batches.

use std::cell::RefCell;

use super::evaluate::{apply, compare_cells, compute, concat};
use crate::plan::action::Step;
use crate::plan::fragment::Fragment;
use crate::plan::node::Node;
use crate::symbols::{Symbol, Symbols};
use crate::value::{Cell, Truth};

/// Where a node's values come from.
pub(crate) trait Binding {
    /// A property of the object that a variable is bound to.
    fn property(&self, variable: usize, column: usize) -> Cell;
    /// The number that a clause of `count` or `sum` gives.
    fn aggregate(&self, clause: usize) -> f64;
    /// What an interpreted part gives.
    fn interpret(&self, fragment: &Fragment) -> Cell;
    /// The texts.
    fn symbols(&self) -> &RefCell<Symbols>;
}

/// Evaluates nodes of one binding; `slots` is what an action has written so far.
pub(crate) struct Scalar<'b, B> {
    pub(crate) binding: &'b B,
    pub(crate) slots: &'b [Cell],
}

impl<B> Clone for Scalar<'_, B> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<B> Copy for Scalar<'_, B> {}

impl<B: Binding> Scalar<'_, B> {
    /// [`cell`](Self::cell), with what most nodes are looked at where it is wanted.
    #[inline]
    fn operand(self, node: &Node) -> Cell {
        match node {
            Node::Local(slot) => self.slots.get(*slot).copied().unwrap_or(Cell::Unknown),
            Node::Property { variable, column } => self.binding.property(*variable, *column),
            other => self.cell(other),
        }
    }

    pub(crate) fn cell(self, node: &Node) -> Cell {
        match node {
            Node::Unknown | Node::Text(Symbol::UNKNOWN) => Cell::Unknown,
            Node::Number(number) => Cell::number(*number),
            Node::Text(symbol) => Cell::Text(*symbol),
            Node::Property { variable, column } => self.binding.property(*variable, *column),
            Node::Local(slot) => self.slots.get(*slot).copied().unwrap_or(Cell::Unknown),
            Node::Aggregate(_) | Node::Arithmetic(..) | Node::Function(..) => Cell::number(self.number(node)),
            Node::Truth(_)
            | Node::Compare(..)
            | Node::And(_)
            | Node::Or(_)
            | Node::Not(_)
            | Node::Known(_) => self.truth(node).known().map_or(Cell::Unknown, Cell::Truth),
            Node::Concat(a, b) => {
                let (a, b) = (self.cell(a), self.cell(b));
                match concat(a, b, self.binding.symbols()) {
                    None | Some(Symbol::UNKNOWN) => Cell::Unknown,
                    Some(whole) => Cell::Text(whole),
                }
            }
            Node::Choose(condition, yes, no) => match self.truth(condition) {
                Truth::True => self.cell(yes),
                Truth::False => self.cell(no),
                Truth::Unknown => Cell::Unknown,
            },
            Node::Coalesce(a, b) => match self.cell(a) {
                Cell::Unknown => self.cell(b),
                known => known,
            },
            Node::Narrow(kind, a) => match self.cell(a) {
                cell if cell.kind() == Some(*kind) => cell,
                _ => Cell::Unknown,
            },
            Node::Interpret(fragment) => self.binding.interpret(fragment),
        }
    }

    /// A number; NaN is unknown.
    pub(crate) fn number(self, node: &Node) -> f64 {
        match node {
            Node::Number(number) => *number,
            Node::Aggregate(clause) => self.binding.aggregate(*clause),
            Node::Arithmetic(operator, a, b) => compute(*operator, self.number(a), self.number(b)),
            Node::Function(function, a) => apply(*function, self.number(a)),
            other => match self.cell(other) {
                Cell::Number(number) => number,
                _ => f64::NAN,
            },
        }
    }

    pub(crate) fn truth(self, node: &Node) -> Truth {
        match node {
            Node::Truth(truth) => *truth,
            Node::Compare(comparison, a, b) => {
                compare_cells(*comparison, self.operand(a), self.operand(b), self.binding.symbols())
            }
            Node::And(parts) => self.connect(parts, Truth::False),
            Node::Or(parts) => self.connect(parts, Truth::True),
            Node::Not(a) => self.truth(a).not(),
            Node::Known(a) => (self.cell(a) != Cell::Unknown).into(),
            other => match self.cell(other) {
                Cell::Truth(truth) => truth.into(),
                _ => Truth::Unknown,
            },
        }
    }

    /// "And" is decided by the first false, "or" by the first true.
    fn connect(self, parts: &[Node], decided: Truth) -> Truth {
        let mut whole = decided.not();
        for part in parts {
            match self.truth(part) {
                part if part == decided => return decided,
                Truth::Unknown => whole = Truth::Unknown,
                _ => {}
            }
        }
        whole
    }
}

/// The slots of an action for one binding: what they hold, and which were written.
#[derive(Clone, Debug, Default)]
pub(crate) struct Written {
    pub(crate) cells: Vec<Cell>,
    pub(crate) written: Vec<bool>,
}

impl Written {
    /// Empties so many slots.
    pub(crate) fn clear(&mut self, slots: usize) {
        self.cells.clear();
        self.cells.resize(slots, Cell::Unknown);
        self.written.clear();
        self.written.resize(slots, false);
    }

    /// Runs the steps of an action that has no interpreted step.
    pub(crate) fn act<B: Binding>(&mut self, steps: &[Step], binding: &B) {
        for step in steps {
            let scalar = Scalar { binding, slots: &self.cells };
            match step {
                Step::Put { slot, value } => self.put(*slot, scalar.operand(value)),
                Step::If { condition, then, otherwise, changes } => match scalar.truth(condition) {
                    Truth::True => self.act(then, binding),
                    Truth::False => self.act(otherwise, binding),
                    Truth::Unknown => changes.iter().for_each(|&slot| self.put(slot, Cell::Unknown)),
                },
                Step::Interpret(_) => {}
            }
        }
    }

    fn put(&mut self, slot: usize, cell: Cell) {
        self.cells[slot] = cell;
        self.written[slot] = true;
    }
}
