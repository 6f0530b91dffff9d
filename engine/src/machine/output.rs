//! What the evaluation of one rule gives.

use std::collections::HashSet;

use super::lane::Values;
use crate::column::Column;
use crate::diagnostic::Diagnostic;
use crate::plan::Plan;
use crate::rule::{PropertyName, Rule};
use crate::value::{Cell, Type};

/// Values side by side, of one type where it is known before running.
#[derive(Clone, Debug)]
pub(crate) enum Buffer {
    Typed(Column),
    Cells(Vec<Cell>),
}

impl Buffer {
    pub(crate) fn new(kind: Option<Type>) -> Self {
        kind.map_or(Self::Cells(vec![]), |kind| Self::Typed(Column::unknown(kind, 0)))
    }

    pub(crate) fn empty(&self) -> Self {
        match self {
            Self::Typed(column) => Self::Typed(Column::unknown(column.kind(), 0)),
            Self::Cells(_) => Self::Cells(vec![]),
        }
    }

    pub(crate) fn len(&self) -> usize {
        match self {
            Self::Typed(column) => column.len(),
            Self::Cells(cells) => cells.len(),
        }
    }

    pub(crate) fn cell(&self, at: usize) -> Cell {
        match self {
            Self::Typed(column) => column.cell(at),
            Self::Cells(cells) => cells.get(at).copied().unwrap_or(Cell::Unknown),
        }
    }

    pub(crate) fn set(&mut self, at: usize, cell: Cell) {
        match self {
            Self::Typed(column) => {
                column.set(at, cell);
            }
            Self::Cells(cells) => cells[at] = cell,
        }
    }

    pub(crate) fn push(&mut self, cell: Cell) {
        match self {
            Self::Typed(column) => column.push(cell),
            Self::Cells(cells) => cells.push(cell),
        }
    }

    /// Makes it this long; new places are unknown.
    pub(crate) fn resize(&mut self, len: usize) {
        match self {
            Self::Typed(column) => column.resize(len),
            Self::Cells(cells) => cells.resize(len, Cell::Unknown),
        }
    }

    pub(crate) fn extend(&mut self, values: &Values, len: usize) {
        match (self, values) {
            (Self::Typed(Column::Numbers(out)), Values::Numbers(lane)) => lane.extend(out, len),
            (Self::Typed(Column::Texts(out)), Values::Texts(lane)) => lane.extend(out, len),
            (Self::Typed(Column::Truths(out)), Values::Truths(lane)) => lane.extend(out, len),
            (out, values) => (0..len).for_each(|index| out.push(values.cell(index))),
        }
    }

    pub(crate) fn append(&mut self, other: &Self) {
        match (self, other) {
            (Self::Typed(Column::Numbers(out)), Self::Typed(Column::Numbers(more))) => out.extend(more),
            (Self::Typed(Column::Texts(out)), Self::Typed(Column::Texts(more))) => out.extend(more),
            (Self::Typed(Column::Truths(out)), Self::Typed(Column::Truths(more))) => out.extend(more),
            (out, more) => (0..more.len()).for_each(|at| out.push(more.cell(at))),
        }
    }
}

/// What a rule gives to one property of one of its variables: a value for each firing that gives one.
#[derive(Clone, Debug)]
pub(crate) struct Given {
    pub(crate) name: PropertyName,
    pub(crate) variable: usize,
    pub(crate) values: Buffer,
    pub(crate) written: Vec<bool>,
}

impl Given {
    pub(crate) fn expected(plan: &Plan, rule: &Rule) -> Vec<Self> {
        let given = |(name, variable, kind): (&PropertyName, usize, _)| Self {
            name: name.clone(),
            variable,
            values: Buffer::new(kind),
            written: vec![],
        };
        plan.targets(rule).into_iter().map(given).collect()
    }

    /// One value more for each of so many firings.
    pub(crate) fn say(&mut self, values: &Values, firings: usize) {
        self.values.extend(values, firings);
        self.written.resize(self.values.len(), true);
    }

    pub(crate) fn say_nothing(&mut self, firings: usize) {
        self.values.resize(self.values.len() + firings);
        self.written.resize(self.values.len(), false);
    }

    pub(crate) fn is_written(&self, firing: usize) -> bool {
        self.written.get(firing) == Some(&true)
    }

    pub(crate) fn select(&self, firings: &[usize]) -> Self {
        let mut values = self.values.empty();
        for &firing in firings {
            values.push(self.values.cell(firing));
        }
        let written = firings.iter().map(|&firing| self.written[firing]).collect();
        Self { name: self.name.clone(), variable: self.variable, values, written }
    }
}

/// A binding of the clauses before, for which a clause was not met.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Failure {
    pub(crate) row: u32,
    pub(crate) clause: u32,
}

/// What came of an object of the first clause, or how a firing came about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Status(u8);

impl Status {
    /// Nobody asked for it yet.
    pub(crate) const UNASKED: Self = Self(255);
    /// The rule says nothing of it.
    pub(crate) const SILENT: Self = Self(0);
    /// All clauses were met.
    pub(crate) const THEN: Self = Self(1);
    /// What the first clause asks of it is unknown.
    pub(crate) const LEFT_OUT: Self = Self(2);

    /// This clause was not met, and there is no `else`.
    pub(crate) const fn failed(clause: usize) -> Self {
        Self(64 + clause as u8)
    }

    /// This clause was not met, and `else` was carried out.
    pub(crate) const fn otherwise(clause: usize) -> Self {
        Self(128 + clause as u8)
    }

    pub(crate) const fn unmet(self) -> Option<usize> {
        match self.0 {
            64..=127 => Some(self.0 as usize - 64),
            128..=191 => Some(self.0 as usize - 128),
            _ => None,
        }
    }

    /// Whether the search came as far as this clause.
    pub(crate) const fn reached(self, clause: usize) -> bool {
        match self.unmet() {
            Some(unmet) => clause <= unmet,
            None => self.0 == 1,
        }
    }
}

/// All conclusions of one rule from some of its first clause's objects, with what each rests on.
#[derive(Clone, Debug, Default)]
pub(crate) struct Output {
    /// For each clause the row bound in each firing, [`NO_ROW`](super::lane::NO_ROW) where there is none.
    pub(crate) witnesses: Vec<Vec<u32>>,
    pub(crate) statuses: Vec<Status>,
    /// Rows of the first clause for which a clause was not met, and how many candidates an unknown kept out.
    pub(crate) undecided: Vec<(u32, u32)>,
    pub(crate) firings: usize,
    pub(crate) given: Vec<Given>,
    pub(crate) failures: Vec<Failure>,
    /// For each clause the row bound in each failure, that of the clause itself being what a `none` found.
    pub(crate) failed: Vec<Vec<u32>>,
    /// Objects of the first clause that were not considered, since what is asked of them is unknown.
    pub(crate) left_out: Vec<u32>,
    pub(crate) problem: Option<Diagnostic>,
    pub(crate) problems: usize,
    /// Whether a limit ended it; what it gave is not whole then.
    pub(crate) stopped: bool,
}

impl Output {
    /// Nothing found yet, with room for all that the rule sets: a type is known even where nothing is given.
    pub(crate) fn nothing(plan: &Plan, rule: &Rule) -> Self {
        let none = || vec![vec![]; plan.clauses.len()];
        Self { witnesses: none(), failed: none(), given: Given::expected(plan, rule), ..Self::default() }
    }
}

/// Which objects of the first clause a hypothesis was proved of, and of which it is open.
#[derive(Debug, Default)]
pub(super) struct Verdicts {
    pub(super) proved: HashSet<u32>,
    pub(super) open: HashSet<u32>,
}

impl Verdicts {
    pub(super) fn leave_open(&mut self, rows: impl Iterator<Item = u32>) {
        self.open.extend(rows);
    }
}
