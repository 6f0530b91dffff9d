//! The objects of a clause's class that may be bound, and how to find them.

use super::evaluate::Batch;
use super::index::Index;
use super::lane::{Frame, Rows, Values};
use super::{BATCH, Machine, Stopped};
use crate::plan::Plan;
use crate::plan::clause::Threshold;
use crate::script::syntax::Quantifier;
use crate::value::Truth;

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
    /// The candidates of a clause whose class has `size` objects.
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
            rows = keep(machine, plan, number, &rows, |batch, keep| {
                let truths = machine.evaluate(own, batch).truths();
                (0..batch.frame.len).for_each(|index| {
                    let truth = truths.at(index);
                    left_out += usize::from(truth == Truth::Unknown);
                    keep.push(truth == Truth::True);
                });
            })?;
        }
        if let (Some(by), true) = (&clause.by, clause.by_own) {
            let mut values: Vec<f64> = vec![];
            let before = rows.clone();
            rows = keep(machine, plan, number, &rows, |batch, keep| {
                let numbers = machine.evaluate(by, batch).numbers();
                for number in (0..batch.frame.len).map(|index| numbers.at(index)) {
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
    mut test: impl FnMut(Batch, &mut Vec<bool>),
) -> Result<Vec<u32>, Stopped> {
    let mut kept = vec![];
    let mut flags = vec![];
    for chunk in rows.chunks(BATCH) {
        machine.tick()?;
        let mut bound = vec![Rows::Unbound; plan.clauses.len()];
        bound[variable] = Rows::Each(chunk.to_vec());
        let frame = Frame { len: chunk.len(), rows: bound };
        flags.clear();
        test(Batch { frame: &frame, slots: &[], mask: None }, &mut flags);
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
        keep(machine, plan, number, &rows, |batch, keep| {
            let lane = machine.evaluate(own, batch).truths();
            truths.extend((0..batch.frame.len).map(|index| lane.at(index)));
            keep.resize(batch.frame.len, false);
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
    let mut bound = vec![Rows::Unbound; plan.clauses.len()];
    bound[number] = Rows::Each(rows.to_vec());
    let frame = Frame { len: rows.len(), rows: bound };
    let numbers = |threshold: &Threshold| {
        let batch = Batch { frame: &frame, slots: &[], mask: None };
        match machine.evaluate(&threshold.candidate, batch) {
            Values::Numbers(lane) => Some((0..frame.len).map(|at| lane.at(at)).collect()),
            _ => None,
        }
    };
    clause.thresholds.iter().map(numbers).collect::<Option<_>>().unwrap_or_default()
}
