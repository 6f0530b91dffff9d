//! Evaluates nodes over a batch.

use std::borrow::Cow;
use std::cmp::Ordering;

use super::Machine;
use super::lane::{Frame, Lane, Rows, Values};
use crate::column::Column;
use crate::plan::clause::ClausePlan;
use crate::plan::node::{Arithmetic, Comparison, Function, Node};
use crate::symbols::{Lexicon, Symbol};
use crate::value::{Cell, Truth, Type};
use crate::zero::{negated, product, written};

/// Which bindings of a batch count; `None` is all. Only interpreted parts look at it.
pub(crate) type Mask<'m> = Option<&'m [bool]>;

/// What a batch is evaluated with: its bindings, and the slots of the action.
#[derive(Clone, Copy)]
pub(crate) struct Batch<'b> {
    pub(crate) frame: &'b Frame,
    pub(crate) slots: &'b [Values<'static>],
    pub(crate) mask: Mask<'b>,
}

impl Machine<'_> {
    pub(crate) fn values<'b>(&'b self, node: &Node, frame: &'b Frame) -> Values<'b> {
        self.evaluate(node, Batch { frame, slots: &[], mask: None })
    }

    pub(crate) fn keys<'b>(&'b self, clause: &ClausePlan, frame: &'b Frame) -> Vec<Values<'b>> {
        clause.joins.iter().map(|join| self.values(&join.key, frame)).collect()
    }

    pub(crate) fn evaluate<'b>(&'b self, node: &Node, batch: Batch<'b>) -> Values<'b> {
        match node {
            Node::Unknown => Values::UNKNOWN,
            Node::Number(number) => Values::Numbers(Lane::Same(*number)),
            Node::Text(symbol) => Values::Texts(Lane::Same(*symbol)),
            Node::Truth(truth) => Values::Truths(Lane::Same(*truth)),
            Node::Property { variable, column } => {
                gather(self.columns[*column], &batch.frame.rows[*variable], batch.frame.len)
            }
            Node::Aggregate(clause) => match &batch.frame.rows[*clause] {
                Rows::Numbers(numbers) => Values::Numbers(numbers.clone()),
                _ => Values::UNKNOWN.narrow(Type::Number),
            },
            Node::Local(slot) => batch.slots[*slot].clone(),
            Node::Arithmetic(operator, a, b) => {
                let (a, b) = (self.evaluate(a, batch).numbers(), self.evaluate(b, batch).numbers());
                Values::Numbers(arithmetic(*operator, &a, &b))
            }
            Node::Function(function, a) => {
                Values::Numbers(self.evaluate(a, batch).numbers().map(|a| apply(*function, a)))
            }
            Node::Compare(comparison, a, b) => {
                Values::Truths(self.compare(*comparison, self.evaluate(a, batch), self.evaluate(b, batch)))
            }
            Node::And(parts) => Values::Truths(self.connect(parts, batch, true)),
            Node::Or(parts) => Values::Truths(self.connect(parts, batch, false)),
            Node::Not(a) => Values::Truths(self.evaluate(a, batch).truths().map(Truth::not)),
            Node::Known(a) => Values::Truths(self.evaluate(a, batch).known()),
            Node::Concat(a, b) => {
                let (a, b) = (self.evaluate(a, batch).cells(), self.evaluate(b, batch).cells());
                Values::Texts(a.zip(&b, |a, b| concat(a, b, self.symbols).unwrap_or(Symbol::UNKNOWN)))
            }
            Node::Choose(condition, yes, no) => self.choose(condition, yes, no, batch),
            Node::Coalesce(a, b) => self.coalesce(a, b, batch),
            Node::Narrow(kind, a) => self.evaluate(a, batch).narrow(*kind),
            Node::Interpret(fragment) => Values::Cells(Lane::Each(self.interpret(fragment, batch).into())),
        }
    }

    /// "And" and "or". As in the interpreter, a later part does not run where an earlier one decides.
    fn connect<'b>(&'b self, parts: &[Node], batch: Batch<'b>, all: bool) -> Lane<'b, Truth> {
        let decided = if all { Truth::False } else { Truth::True };
        let mut lane = Lane::Same(decided.not());
        for part in parts {
            let open: Option<Vec<bool>> = part.interprets().then(|| {
                let active = |index| batch.mask.is_none_or(|mask| mask[index]);
                (0..batch.frame.len).map(|index| active(index) && lane.at(index) != decided).collect()
            });
            let mask = open.as_deref().or(batch.mask);
            let next = self.evaluate(part, Batch { mask, ..batch }).into_static().truths();
            lane = if all { lane.zip(&next, Truth::min) } else { lane.zip(&next, Truth::max) };
        }
        lane
    }

    fn choose<'b>(&'b self, condition: &Node, yes: &Node, no: &Node, batch: Batch<'b>) -> Values<'b> {
        let condition = self.evaluate(condition, batch).truths();
        match condition {
            Lane::Same(Truth::True) => return self.evaluate(yes, batch),
            Lane::Same(Truth::False) => return self.evaluate(no, batch),
            Lane::Same(Truth::Unknown) | Lane::Each(_) => {}
        }
        let len = batch.frame.len;
        let when = |wanted: Truth| -> Vec<bool> {
            let active = |index| batch.mask.is_none_or(|mask| mask[index]);
            (0..len).map(|index| active(index) && condition.at(index) == wanted).collect()
        };
        let (on_yes, on_no) = (when(Truth::True), when(Truth::False));
        let yes = self.evaluate(yes, Batch { mask: Some(&on_yes), ..batch }).into_static();
        let no = self.evaluate(no, Batch { mask: Some(&on_no), ..batch }).into_static();
        let chosen = no.blend(yes, len, |index| condition.at(index) == Truth::True);
        chosen.blend(Values::UNKNOWN, len, |index| condition.at(index) == Truth::Unknown)
    }

    fn coalesce<'b>(&'b self, a: &Node, b: &Node, batch: Batch<'b>) -> Values<'b> {
        let a = self.evaluate(a, batch);
        let known = a.known();
        let len = batch.frame.len;
        let active = |index| batch.mask.is_none_or(|mask| mask[index]);
        let missing: Vec<bool> =
            (0..len).map(|index| active(index) && known.at(index) == Truth::False).collect();
        let b = self.evaluate(b, Batch { mask: Some(&missing), ..batch }).into_static();
        a.into_static().blend(b, len, |index| known.at(index) == Truth::False)
    }

    fn compare(&self, comparison: Comparison, a: Values, b: Values) -> Lane<'static, Truth> {
        match (a.kind(), b.kind()) {
            (Some(Type::Number), _) => numbers(comparison, &a.numbers(), &b.numbers()),
            (Some(Type::Text), _) => self.texts(comparison, &a.texts(), &b.texts()),
            (Some(Type::Truth), _) => a.truths().zip(&b.truths(), |a, b| match (a.known(), b.known()) {
                (Some(a), Some(b)) => holds(comparison, a.cmp(&b)).into(),
                _ => Truth::Unknown,
            }),
            (None, _) => a.cells().zip(&b.cells(), |a, b| compare_cells(comparison, a, b, self.symbols)),
        }
    }

    fn texts(&self, comparison: Comparison, a: &Lane<Symbol>, b: &Lane<Symbol>) -> Lane<'static, Truth> {
        let unknown = |a, b| a == Symbol::UNKNOWN || b == Symbol::UNKNOWN;
        let known = |a, b, truth: bool| if unknown(a, b) { Truth::Unknown } else { truth.into() };
        match comparison {
            Comparison::Equal => a.zip(b, |a, b| known(a, b, a == b)),
            Comparison::Unequal => a.zip(b, |a, b| known(a, b, a != b)),
            _ => {
                let symbols = self.symbols.read();
                a.zip(b, |a, b| known(a, b, holds(comparison, symbols.text(a).cmp(&symbols.text(b)))))
            }
        }
    }
}

/// Compares two values; those of different types, and the unknown, compare to nothing.
pub(crate) fn compare_cells(comparison: Comparison, a: Cell, b: Cell, symbols: &Lexicon) -> Truth {
    match (a, b) {
        (Cell::Number(a), Cell::Number(b)) => {
            a.partial_cmp(&b).map_or(Truth::Unknown, |order| holds(comparison, order).into())
        }
        (Cell::Text(a), Cell::Text(b)) => match comparison {
            Comparison::Equal => (a == b).into(),
            Comparison::Unequal => (a != b).into(),
            _ => {
                let symbols = symbols.read();
                holds(comparison, symbols.text(a).cmp(&symbols.text(b))).into()
            }
        },
        (Cell::Truth(a), Cell::Truth(b)) => holds(comparison, a.cmp(&b)).into(),
        _ => Truth::Unknown,
    }
}

/// Texts and numbers one after the other; `None` where one is unknown, or the whole is too long.
pub(crate) fn concat(a: Cell, b: Cell, symbols: &Lexicon) -> Option<Symbol> {
    let mut symbols = symbols.write();
    let mut whole = String::new();
    for cell in [a, b] {
        match cell {
            Cell::Text(symbol) => whole.push_str(symbols.text(symbol).map_or("", |text| text)),
            Cell::Number(number) => whole.push_str(&written(number)),
            Cell::Truth(_) | Cell::Unknown => return None,
        }
    }
    (whole.len() <= crate::script::limits::MAX_TEXT).then(|| symbols.intern(&whole))
}

fn gather<'b>(column: &'b Column, rows: &Rows, len: usize) -> Values<'b> {
    match column {
        Column::Numbers(values) => Values::Numbers(gather_lane(values, rows, len, f64::NAN)),
        Column::Texts(values) => Values::Texts(gather_lane(values, rows, len, Symbol::UNKNOWN)),
        Column::Truths(values) => Values::Truths(gather_lane(values, rows, len, Truth::Unknown)),
    }
}

fn gather_lane<'b, T: Copy>(values: &'b [T], rows: &Rows, len: usize, unknown: T) -> Lane<'b, T> {
    match rows {
        Rows::Unbound | Rows::Numbers(_) => Lane::Same(unknown),
        Rows::Same(row) => Lane::Same(values.get(*row as usize).copied().unwrap_or(unknown)),
        Rows::From(first) => {
            let from = values.get(*first as usize..).unwrap_or_default();
            // Objects may have been added that no rule has seen yet.
            let missing = || from.iter().copied().chain(std::iter::repeat(unknown)).take(len).collect();
            Lane::Each(from.get(..len).map_or_else(missing, Cow::Borrowed))
        }
        Rows::Each(rows) => {
            Lane::Each(rows.iter().map(|&row| values.get(row as usize).copied().unwrap_or(unknown)).collect())
        }
    }
}

fn arithmetic(operator: Arithmetic, a: &Lane<f64>, b: &Lane<f64>) -> Lane<'static, f64> {
    /// One loop for each operator: it is a constant in each.
    macro_rules! loops {
        ($($operator:ident)*) => {
            match operator {
                $(Arithmetic::$operator => a.zip(b, |a, b| compute(Arithmetic::$operator, a, b)),)*
            }
        };
    }
    loops!(Add Subtract Multiply Divide Remainder Power Min Max Hypot)
}

/// Two numbers to one; what is unknown stays unknown.
#[inline]
pub(crate) fn compute(operator: Arithmetic, a: f64, b: f64) -> f64 {
    let known = |value: f64| if a.is_nan() || b.is_nan() { f64::NAN } else { value };
    match operator {
        Arithmetic::Add => a + b,
        Arithmetic::Subtract => a - b,
        Arithmetic::Multiply => product(a, b),
        Arithmetic::Divide => a / b,
        Arithmetic::Remainder => a % b,
        // An unknown exponent stays unknown, though 1 to the power of anything is 1.
        Arithmetic::Power => known(a.powf(b)),
        Arithmetic::Min => known(a.min(b)),
        Arithmetic::Max => known(a.max(b)),
        Arithmetic::Hypot => known(a.hypot(b)),
    }
}

#[inline]
pub(crate) fn apply(function: Function, a: f64) -> f64 {
    match function {
        Function::Negate => negated(a),
        Function::Abs => a.abs(),
        Function::Sqrt => a.sqrt(),
        Function::Floor => a.floor(),
        Function::Ceil => a.ceil(),
        Function::Round => a.round(),
    }
}

// Rules mean equality to the bit.
#[allow(clippy::float_cmp)]
fn numbers(comparison: Comparison, a: &Lane<f64>, b: &Lane<f64>) -> Lane<'static, Truth> {
    fn with(a: &Lane<f64>, b: &Lane<f64>, test: impl Fn(f64, f64) -> bool) -> Lane<'static, Truth> {
        a.zip(b, |a, b| {
            // Without a branch: 2 for true, 0 for false, 1 where either is NaN.
            match (u8::from(test(a, b)) << 1) | u8::from(a.is_nan() | b.is_nan()) {
                0 => Truth::False,
                2 => Truth::True,
                _ => Truth::Unknown,
            }
        })
    }
    match comparison {
        Comparison::Equal => with(a, b, |a, b| a == b),
        Comparison::Unequal => with(a, b, |a, b| a != b),
        Comparison::Less => with(a, b, |a, b| a < b),
        Comparison::AtMost => with(a, b, |a, b| a <= b),
        Comparison::Greater => with(a, b, |a, b| a > b),
        Comparison::AtLeast => with(a, b, |a, b| a >= b),
    }
}

/// Whether an order is the one that a comparison asks for.
pub(crate) fn holds(comparison: Comparison, order: Ordering) -> bool {
    match comparison {
        Comparison::Equal => order.is_eq(),
        Comparison::Unequal => order.is_ne(),
        Comparison::Less => order.is_lt(),
        Comparison::AtMost => order.is_le(),
        Comparison::Greater => order.is_gt(),
        Comparison::AtLeast => order.is_ge(),
    }
}
