//! The objects of a clause's class that may be bound, and how to find them.

use super::index::Index;
use super::lane::{Frame, Rows, Values};
use super::{BATCH, Machine, Stopped};
use crate::plan::Plan;
use crate::plan::clause::Threshold;
use crate::script::syntax::Quantifier;
use crate::value::{Cell, Truth};

/// What of a clause holds for every binding of the clauses before it.
#[derive(Clone, Debug)]
pub(crate) struct Candidates {
    /// Those that pass what is asked of them alone: the best first, where they are compared by themselves alone.
    pub(crate) rows: Vec<u32>,
    /// Whether `rows` is 0, 1, 2, ...
    pub(crate) all: bool,
    pub(crate) index: Option<Index>,
    /// Rows of which an unknown leaves open whether they may be bound, where that counts.
    pub(crate) undecided: Vec<u32>,
    /// For each threshold of the clause the value of each of `rows`, where they are few and all are numbers.
    pub(crate) thresholds: Vec<Vec<f64>>,
    /// Objects that are none, since what is asked of them is unknown.
    pub(crate) left_out: usize,
}

impl Candidates {
    pub(crate) const NONE: Self =
        Self { rows: vec![], all: false, index: None, undecided: vec![], thresholds: vec![], left_out: 0 };

    /// For objects that come and go, in the order of their rows, by so many columns.
    pub(crate) fn empty(columns: usize) -> Self {
        Self { index: (columns > 0).then(|| Index::empty(columns)), all: true, ..Self::NONE }
    }

    /// Takes in an object with these values in the columns of the index.
    pub(crate) fn insert(&mut self, row: u32, values: impl Iterator<Item = Cell>) {
        let known = self.index.as_mut().is_none_or(|index| index.insert(row, values));
        let rows = if known { &mut self.rows } else { &mut self.undecided };
        let at = rows.partition_point(|&other| other < row);
        rows.insert(at, row);
        self.all = self.rows.last().is_none_or(|&last| last as usize + 1 == self.rows.len());
    }

    /// Takes out an object that was taken in with these values.
    pub(crate) fn remove(&mut self, row: u32, values: impl Iterator<Item = Cell>) {
        if let Some(index) = &mut self.index {
            index.remove(row, values);
        }
        for rows in [&mut self.rows, &mut self.undecided] {
            if let Ok(at) = rows.binary_search(&row) {
                rows.remove(at);
            }
        }
        self.all = self.rows.last().is_none_or(|&last| last as usize + 1 == self.rows.len());
    }

    pub(crate) fn of(machine: &Machine, plan: &Plan, number: usize, size: usize) -> Result<Self, Stopped> {
        let clause = &plan.clauses[number];
        let mut rows: Vec<u32> = (0..size as u32).collect();
        let mut undecided = vec![];
        let mut left_out = 0;
        if clause.whole.is_some() {
            (rows, undecided) = decided(machine, plan, number, rows)?;
            if clause.quantifier.binds() {
                left_out += undecided.len();
            }
        } else if let Some(own) = &clause.own {
            rows = keep(machine, plan, number, &rows, |frame, keep| {
                let truths = machine.values(own, frame).truths();
                (0..frame.len).for_each(|index| {
                    let truth = truths.at(index);
                    left_out += usize::from(truth == Truth::Unknown);
                    keep.push(truth == Truth::True);
                });
            })?;
        }
        if let (Some(by), true) = (&clause.by, clause.by_own) {
            let mut values: Vec<f64> = vec![];
            let before = rows.clone();
            rows = keep(machine, plan, number, &rows, |frame, keep| {
                let numbers = machine.values(by, frame).numbers();
                for number in (0..frame.len).map(|index| numbers.at(index)) {
                    keep.push(!number.is_nan());
                    left_out += usize::from(number.is_nan());
                    values.extend(Some(number).filter(|number| !number.is_nan()));
                }
            })?;
            if plan.hypothesis.is_some() {
                let mut ranked = rows.iter().peekable();
                undecided.extend(before.iter().filter(|&row| ranked.next_if_eq(&row).is_none()));
            }
            let mut ranked: Vec<(f64, u32)> = values.into_iter().zip(rows).collect();
            // Stable: equal values stay in the order of the table. Minus zero equals zero.
            match clause.quantifier {
                Quantifier::Most => ranked.sort_by(|a, b| (b.0 + 0.0).total_cmp(&(a.0 + 0.0))),
                _ => ranked.sort_by(|a, b| (a.0 + 0.0).total_cmp(&(b.0 + 0.0))),
            }
            rows = ranked.into_iter().map(|(_, row)| row).collect();
        }
        let all = rows.iter().zip(0..).all(|(&row, nth)| row == nth);
        let index = (!clause.joins.is_empty()).then(|| {
            let columns: Vec<_> = clause.joins.iter().map(|join| machine.columns[join.column]).collect();
            Index::new(&columns, &rows)
        });
        let thresholds = thresholds(machine, plan, number, &rows);
        Ok(Self { rows, all, index, undecided, thresholds, left_out })
    }

    /// The rows batch by batch, each as a frame in which they stand beside one binding of the clauses before.
    pub(super) fn batches(
        &self,
        variable: usize,
        frame: &Frame,
        binding: usize,
    ) -> impl Iterator<Item = (&[u32], Frame)> {
        self.rows.chunks(BATCH).enumerate().map(move |(nth, chunk)| {
            let mut next = frame.repeat(binding, chunk.len());
            let first = (nth * BATCH) as u32;
            next.rows[variable] = if self.all { Rows::From(first) } else { Rows::each(chunk.to_vec()) };
            (chunk, next)
        })
    }

    /// The rows that an unknown leaves open; all of them where the key to look for is unknown.
    pub(super) fn perhaps(&self, unknown_key: bool) -> impl Iterator<Item = &u32> + Clone {
        let all = if unknown_key { self.rows.as_slice() } else { &[] };
        all.iter().chain(&self.undecided)
    }
}

/// The rows for which `test` pushes true; it sees them batch by batch, bound to one variable.
fn keep(
    machine: &Machine,
    plan: &Plan,
    variable: usize,
    rows: &[u32],
    mut test: impl FnMut(&Frame, &mut Vec<bool>),
) -> Result<Vec<u32>, Stopped> {
    let mut kept = vec![];
    let mut flags = vec![];
    for chunk in rows.chunks(BATCH) {
        machine.tick()?;
        flags.clear();
        test(&Frame::of(plan.clauses.len(), variable, chunk), &mut flags);
        kept.extend(chunk.iter().zip(&flags).filter(|(_, keep)| **keep).map(|(&row, _)| row));
    }
    Ok(kept)
}

/// Parts the rows into those that pass what is asked of the object alone, with all columns of joins known, and those
/// of which that is unknown.
fn decided(
    machine: &Machine,
    plan: &Plan,
    number: usize,
    rows: Vec<u32>,
) -> Result<(Vec<u32>, Vec<u32>), Stopped> {
    let clause = &plan.clauses[number];
    let mut truths = vec![Truth::True; rows.len()];
    if let Some(own) = &clause.own {
        truths.clear();
        keep(machine, plan, number, &rows, |frame, keep| {
            let lane = machine.values(own, frame).truths();
            truths.extend((0..frame.len).map(|index| lane.at(index)));
            keep.resize(frame.len, false);
        })?;
    }
    let columns: Vec<_> = clause.joins.iter().map(|join| machine.columns[join.column]).collect();
    let (mut passing, mut undecided) = (vec![], vec![]);
    for (row, truth) in rows.into_iter().zip(truths) {
        let known = columns.iter().all(|column| !column.is_unknown(row as usize));
        match truth {
            Truth::False => {}
            Truth::True if known => passing.push(row),
            _ => undecided.push(row),
        }
    }
    Ok((passing, undecided))
}

/// Up to so many candidates are compared one after the other, each with a whole batch.
const FEW: usize = 64;

fn thresholds(machine: &Machine, plan: &Plan, number: usize, rows: &[u32]) -> Vec<Vec<f64>> {
    let clause = &plan.clauses[number];
    if rows.len() > FEW || !clause.joins.is_empty() || !clause.by_own {
        return vec![];
    }
    let frame = Frame::of(plan.clauses.len(), number, rows);
    let numbers = |threshold: &Threshold| match machine.values(&threshold.candidate, &frame) {
        Values::Numbers(lane) => Some((0..frame.len).map(|at| lane.at(at)).collect()),
        _ => None,
    };
    clause.thresholds.iter().map(numbers).collect::<Option<_>>().unwrap_or_default()
}
