//! Evaluates nodes for one object, with the meaning that [`Machine`](super::Machine) has for batches.

use super::evaluate::{apply, compare_cells, compute, concat};
use crate::plan::action::Step;
use crate::plan::node::Node;
use crate::symbols::{Lexicon, Symbol};
use crate::value::{Cell, Truth};

pub(crate) struct Object<'a> {
    /// For each column of a plan the property.
    pub(crate) columns: &'a [usize],
    pub(crate) cells: &'a [Cell],
    pub(crate) symbols: &'a Lexicon,
}

/// Evaluates nodes of one object; `slots` is what an action has written so far.
#[derive(Clone, Copy)]
pub(crate) struct Scalar<'b> {
    pub(crate) object: &'b Object<'b>,
    pub(crate) slots: &'b [Cell],
}

impl Scalar<'_> {
    fn property(self, column: usize) -> Cell {
        self.object.cells[self.object.columns[column]]
    }

    /// [`cell`](Self::cell), with what most nodes are looked at where it is wanted.
    #[inline]
    fn operand(self, node: &Node) -> Cell {
        match node {
            Node::Local(slot) => self.slots.get(*slot).copied().unwrap_or(Cell::Unknown),
            Node::Property { column, .. } => self.property(*column),
            other => self.cell(other),
        }
    }

    pub(crate) fn cell(self, node: &Node) -> Cell {
        match node {
            // No rule that looks at one object alone has numbers of clauses, or parts for the interpreter.
            Node::Unknown | Node::Text(Symbol::UNKNOWN) | Node::Aggregate(_) | Node::Interpret(_) => {
                Cell::Unknown
            }
            Node::Number(number) => Cell::number(*number),
            Node::Text(symbol) => Cell::Text(*symbol),
            Node::Property { column, .. } => self.property(*column),
            Node::Local(slot) => self.slots.get(*slot).copied().unwrap_or(Cell::Unknown),
            Node::Arithmetic(..) | Node::Function(..) => Cell::number(self.number(node)),
            Node::Truth(_)
            | Node::Compare(..)
            | Node::And(_)
            | Node::Or(_)
            | Node::Not(_)
            | Node::Known(_) => self.truth(node).known().map_or(Cell::Unknown, Cell::Truth),
            Node::Concat(a, b) => {
                let (a, b) = (self.cell(a), self.cell(b));
                match concat(a, b, self.object.symbols) {
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
        }
    }

    /// A number; NaN is unknown.
    pub(crate) fn number(self, node: &Node) -> f64 {
        match node {
            Node::Number(number) => *number,
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
                compare_cells(*comparison, self.operand(a), self.operand(b), self.object.symbols)
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

/// The slots of an action for one object: what they hold, and which were written.
#[derive(Clone, Debug, Default)]
pub(crate) struct Written {
    pub(crate) cells: Vec<Cell>,
    pub(crate) written: Vec<bool>,
}

impl Written {
    pub(crate) fn clear(&mut self, slots: usize) {
        self.cells.clear();
        self.cells.resize(slots, Cell::Unknown);
        self.written.clear();
        self.written.resize(slots, false);
    }

    /// Runs the steps of an action that has no interpreted step.
    pub(crate) fn act(&mut self, steps: &[Step], object: &Object) {
        for step in steps {
            let scalar = Scalar { object, slots: &self.cells };
            match step {
                Step::Put { slot, value } => self.put(*slot, scalar.operand(value)),
                Step::If { condition, then, otherwise, changes } => match scalar.truth(condition) {
                    Truth::True => self.act(then, object),
                    Truth::False => self.act(otherwise, object),
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
