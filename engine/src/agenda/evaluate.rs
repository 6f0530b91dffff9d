//! Evaluates nodes for one binding, with the meaning that [`Machine`](crate::machine::Machine) has for batches.

use std::cell::RefCell;
use std::cmp::Ordering;

use super::script::Scripts;
use super::world::World;
use crate::machine::evaluate::holds;
use crate::plan::node::{Arithmetic, Comparison, Function, Node};
use crate::script::interpreter::MAX_TEXT;
use crate::symbols::{Symbol, Symbols};
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
        match node {
            Node::Unknown | Node::Local(_) => Cell::Unknown,
            Node::Number(number) => Cell::number(*number),
            Node::Text(symbol) => text(*symbol),
            Node::Property { variable, column } => {
                self.world.cell(self.columns[*column], bound.ids[*variable])
            }
            Node::Aggregate(clause) => Cell::number(bound.numbers[*clause]),
            Node::Arithmetic(..) | Node::Function(..) => Cell::number(self.number(node, bound)),
            Node::Truth(_)
            | Node::Compare(..)
            | Node::And(_)
            | Node::Or(_)
            | Node::Not(_)
            | Node::Known(_) => self.truth(node, bound).known().map_or(Cell::Unknown, Cell::Truth),
            Node::Concat(a, b) => self.concat(self.cell(a, bound), self.cell(b, bound)),
            Node::Choose(condition, yes, no) => match self.truth(condition, bound) {
                Truth::True => self.cell(yes, bound),
                Truth::False => self.cell(no, bound),
                Truth::Unknown => Cell::Unknown,
            },
            Node::Coalesce(a, b) => match self.cell(a, bound) {
                Cell::Unknown => self.cell(b, bound),
                known => known,
            },
            Node::Narrow(kind, a) => {
                let cell = self.cell(a, bound);
                if cell.kind() == Some(*kind) { cell } else { Cell::Unknown }
            }
            Node::Interpret(fragment) => self.scripts.value(fragment, self, bound),
        }
    }

    /// A number; NaN is unknown.
    pub(crate) fn number(&self, node: &Node, bound: &Bound) -> f64 {
        match node {
            Node::Number(number) => *number,
            Node::Aggregate(clause) => bound.numbers[*clause],
            Node::Arithmetic(operator, a, b) => {
                arithmetic(*operator, self.number(a, bound), self.number(b, bound))
            }
            Node::Function(function, a) => {
                let a = self.number(a, bound);
                match function {
                    Function::Negate => -a,
                    Function::Abs => a.abs(),
                    Function::Sqrt => a.sqrt(),
                    Function::Floor => a.floor(),
                    Function::Ceil => a.ceil(),
                    Function::Round => a.round(),
                }
            }
            other => match self.cell(other, bound) {
                Cell::Number(number) => number,
                _ => f64::NAN,
            },
        }
    }

    pub(crate) fn truth(&self, node: &Node, bound: &Bound) -> Truth {
        match node {
            Node::Truth(truth) => *truth,
            Node::Compare(comparison, a, b) => {
                self.compare(*comparison, self.cell(a, bound), self.cell(b, bound))
            }
            Node::And(parts) => self.connect(parts, bound, true),
            Node::Or(parts) => self.connect(parts, bound, false),
            Node::Not(a) => self.truth(a, bound).not(),
            Node::Known(a) => (self.cell(a, bound) != Cell::Unknown).into(),
            other => match self.cell(other, bound) {
                Cell::Truth(truth) => truth.into(),
                _ => Truth::Unknown,
            },
        }
    }

    fn connect(&self, parts: &[Node], bound: &Bound, all: bool) -> Truth {
        let decided = if all { Truth::False } else { Truth::True };
        let mut whole = decided.not();
        for part in parts {
            let part = self.truth(part, bound);
            whole = if all { whole.min(part) } else { whole.max(part) };
            if whole == decided {
                break;
            }
        }
        whole
    }

    fn compare(&self, comparison: Comparison, a: Cell, b: Cell) -> Truth {
        let order = match (a, b) {
            (Cell::Number(a), Cell::Number(b)) => match a.partial_cmp(&b) {
                Some(order) => order,
                None => return Truth::Unknown,
            },
            (Cell::Text(a), Cell::Text(b)) if a == b => Ordering::Equal,
            (Cell::Text(_), Cell::Text(_)) if comparison == Comparison::Equal => return Truth::False,
            (Cell::Text(a), Cell::Text(b)) => {
                let symbols = self.symbols.borrow();
                symbols.text(a).cmp(&symbols.text(b))
            }
            (Cell::Truth(a), Cell::Truth(b)) => a.cmp(&b),
            _ => return Truth::Unknown,
        };
        holds(comparison, order).into()
    }

    fn concat(&self, a: Cell, b: Cell) -> Cell {
        let mut symbols = self.symbols.borrow_mut();
        let mut whole = String::new();
        for cell in [a, b] {
            match cell {
                Cell::Text(symbol) => whole.push_str(symbols.text(symbol).map_or("", |text| text)),
                Cell::Number(number) => whole.push_str(&number.to_string()),
                Cell::Truth(_) | Cell::Unknown => return Cell::Unknown,
            }
        }
        if whole.len() > MAX_TEXT { Cell::Unknown } else { text(symbols.intern(&whole)) }
    }
}

fn text(symbol: Symbol) -> Cell {
    if symbol == Symbol::UNKNOWN { Cell::Unknown } else { Cell::Text(symbol) }
}

fn arithmetic(operator: Arithmetic, a: f64, b: f64) -> f64 {
    // Some functions give a number for NaN; what is unknown stays so.
    if a.is_nan() || b.is_nan() {
        return f64::NAN;
    }
    match operator {
        Arithmetic::Add => a + b,
        Arithmetic::Subtract => a - b,
        Arithmetic::Multiply => a * b,
        Arithmetic::Divide => a / b,
        Arithmetic::Remainder => a % b,
        Arithmetic::Power => a.powf(b),
        Arithmetic::Min => a.min(b),
        Arithmetic::Max => a.max(b),
        Arithmetic::Hypot => a.hypot(b),
    }
}
