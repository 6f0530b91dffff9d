//! What a rule gave, firing by firing, and how that is replaced for some of its objects.

use std::collections::BTreeMap;

use super::dirty::Dirty;
use crate::diagnostic::Diagnostic;
use crate::machine::candidates::Candidates;
use crate::machine::lane::NO_ROW;
use crate::machine::output::{Given, Output, Status};
use crate::plan::Plan;
use crate::rule::Rule;
use crate::script::syntax::Quantifier;
use crate::value::Cell;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Shape {
    /// At most one for each object of the first clause: the firing has that object's row as number.
    Single,
    /// Any number for each object of the first clause, kept in the order of those.
    Many,
    /// The first clause binds one object at most; evaluated as a whole.
    Whole,
}

impl Shape {
    pub(crate) fn of(plan: &Plan) -> Self {
        let each = |quantifier| quantifier == Quantifier::Each;
        match plan.clauses.split_first() {
            Some((first, rest)) if each(first.quantifier) => {
                if rest.iter().any(|clause| each(clause.quantifier)) { Self::Many } else { Self::Single }
            }
            _ => Self::Whole,
        }
    }
}

#[derive(Clone, Debug)]
pub(crate) struct Memory {
    pub(crate) shape: Shape,
    /// For each object of the first clause what came of it.
    pub(crate) statuses: Vec<Status>,
    /// How many of them nobody asked for yet.
    pub(crate) unasked: usize,
    /// Objects of the first clause for which unknown candidates kept a clause from being met.
    pub(crate) undecided: BTreeMap<u32, u32>,
    /// By firing, but for [`Shape::Single`], where `statuses` has it.
    ways: Vec<Status>,
    /// For each clause the row that each firing (or failure) rests on. Empty for the first of [`Shape::Single`].
    pub(crate) witnesses: Vec<Vec<u32>>,
    pub(crate) given: Vec<Given>,
    /// For each of `given` the firings by the row that they set, where that is not their own number.
    inverse: Vec<Option<Inverse>>,
    pub(crate) candidates: Vec<Option<Candidates>>,
    /// Objects of the first clause whose witness was removed.
    pub(crate) lost: Vec<u32>,
    pub(crate) problem: Option<Diagnostic>,
}

#[derive(Clone, Debug)]
struct Inverse {
    starts: Vec<u32>,
    firings: Vec<u32>,
}

impl Memory {
    pub(crate) fn new(rule: &Rule, plan: &Plan, drivers: usize) -> Self {
        let shape = Shape::of(plan);
        let drivers = if shape == Shape::Whole { 1 } else { drivers };
        let given = Given::expected(plan, rule);
        Self {
            shape,
            statuses: vec![Status::UNASKED; drivers],
            unasked: drivers,
            undecided: BTreeMap::new(),
            ways: vec![],
            witnesses: vec![vec![]; plan.clauses.len()],
            inverse: given.iter().map(|_| None).collect(),
            given,
            candidates: plan.clauses.iter().map(|_| None).collect(),
            lost: vec![],
            problem: None,
        }
    }

    pub(crate) fn firings(&self) -> usize {
        if self.shape == Shape::Single { self.statuses.len() } else { self.ways.len() }
    }

    pub(crate) fn witness(&self, clause: usize, firing: usize) -> u32 {
        if clause == 0 && self.shape == Shape::Single {
            return firing as u32;
        }
        self.witnesses[clause].get(firing).copied().unwrap_or(NO_ROW)
    }

    pub(crate) fn claim(&self, given: usize, firing: usize) -> Option<Cell> {
        let given = &self.given[given];
        given.is_written(firing).then(|| given.values.cell(firing))
    }

    pub(crate) fn sets_own(&self, given: &Given) -> bool {
        self.shape == Shape::Single && given.variable == 0
    }

    /// Whether what [`firings_of`](Self::firings_of) looks up is there.
    pub(crate) fn is_prepared(&self, given: usize) -> bool {
        self.sets_own(&self.given[given]) || self.inverse[given].is_some()
    }

    /// Makes what [`firings_of`](Self::firings_of) looks up.
    pub(crate) fn prepare(&mut self, given: usize, rows: usize) {
        let of = &self.given[given];
        let set: Vec<(u32, u32)> = (0..self.firings())
            .filter(|&firing| of.is_written(firing))
            .map(|firing| (self.witness(of.variable, firing), firing as u32))
            .filter(|&(row, _)| (row as usize) < rows)
            .collect();
        let mut starts = vec![0_u32; rows + 1];
        for &(row, _) in &set {
            starts[row as usize + 1] += 1;
        }
        for row in 0..rows {
            starts[row + 1] += starts[row];
        }
        let mut next = starts.clone();
        let mut firings = vec![0; set.len()];
        for (row, firing) in set {
            let at = &mut next[row as usize];
            firings[*at as usize] = firing;
            *at += 1;
        }
        self.inverse[given] = Some(Inverse { starts, firings });
    }

    /// The firings that set this row, ascending, where each object is not set by the firing of its own number.
    pub(crate) fn firings_of(&self, given: usize, row: u32) -> &[u32] {
        match &self.inverse[given] {
            Some(Inverse { starts, firings }) if (row as usize) + 1 < starts.len() => {
                &firings[starts[row as usize] as usize..starts[row as usize + 1] as usize]
            }
            _ => &[],
        }
    }

    /// Takes over what an evaluation gave for some objects of the first clause; tells for each of `given` which
    /// rows may have another value now.
    pub(crate) fn replace(&mut self, drivers: &Dirty, output: Output) -> Vec<Dirty> {
        self.note(drivers, &output);
        let touched = match (self.shape, drivers) {
            (Shape::Single, Dirty::All) => {
                self.replace_all(output);
                vec![Dirty::All; self.given.len()]
            }
            (Shape::Single, drivers) => self.replace_some(&drivers.rows(self.statuses.len()), &output),
            (Shape::Many, Dirty::Rows(rows)) => self.splice(rows, output),
            _ => {
                self.ways = output.statuses;
                self.witnesses = output.witnesses;
                self.given = output.given;
                if self.shape == Shape::Many {
                    self.sort();
                }
                vec![Dirty::All; self.given.len()]
            }
        };
        for (at, touched) in touched.iter().enumerate() {
            if !touched.is_none() {
                self.inverse[at] = None;
            }
        }
        touched
    }

    fn note(&mut self, drivers: &Dirty, output: &Output) {
        let set = |statuses: &mut Vec<Status>, row: u32, status: Status| {
            if let Some(place) = statuses.get_mut(row as usize) {
                *place = status;
            }
        };
        match drivers {
            Dirty::Rows(rows) if self.shape != Shape::Whole => {
                for row in rows {
                    let unasked = self.statuses[*row as usize] == Status::UNASKED;
                    self.unasked -= usize::from(unasked);
                    set(&mut self.statuses, *row, Status::SILENT);
                    self.undecided.remove(row);
                }
            }
            _ => {
                self.statuses.fill(Status::SILENT);
                self.unasked = 0;
                self.undecided.clear();
            }
        }
        if self.shape != Shape::Whole {
            for (&row, &status) in output.witnesses[0].iter().zip(&output.statuses) {
                set(&mut self.statuses, row, status);
            }
            for failure in &output.failures {
                // Of several bindings, the first that failed; one that fired counts more.
                if self.statuses.get(failure.row as usize) == Some(&Status::SILENT) {
                    set(&mut self.statuses, failure.row, Status::failed(failure.clause as usize));
                }
            }
            output.left_out.iter().for_each(|&row| set(&mut self.statuses, row, Status::LEFT_OUT));
        }
        for &(row, unknown) in &output.undecided {
            *self.undecided.entry(row).or_default() += unknown;
        }
    }

    /// Makes room for a firing of each object of the first clause.
    fn make_room(&mut self) {
        let len = self.statuses.len();
        self.witnesses.iter_mut().skip(1).for_each(|column| column.resize(len, NO_ROW));
        for given in &mut self.given {
            given.values.resize(len);
            given.written.resize(len, false);
        }
    }

    fn replace_all(&mut self, output: Output) {
        let len = self.statuses.len();
        let straight =
            output.firings == len && output.witnesses[0].iter().zip(0..).all(|(&row, at)| row == at);
        if straight {
            self.witnesses = output.witnesses;
            self.witnesses[0] = vec![];
            self.given = output.given;
            return;
        }
        self.make_room();
        self.witnesses.iter_mut().skip(1).for_each(|column| column.fill(NO_ROW));
        for given in &mut self.given {
            given.written.fill(false);
            // A firing that sets nothing leaves nothing of before.
            given.values.resize(0);
            given.values.resize(len);
        }
        self.write(&output);
    }

    /// Writes what was found to the rows of the first clause's objects, which hold nothing.
    fn write(&mut self, output: &Output) {
        let Output { witnesses, given, failures, failed, .. } = output;
        let drivers = &witnesses[0];
        for (to, from) in self.witnesses.iter_mut().zip(witnesses).skip(1) {
            drivers.iter().zip(from).for_each(|(&row, &witness)| to[row as usize] = witness);
        }
        for (to, from) in self.witnesses.iter_mut().zip(failed).skip(1) {
            failures.iter().zip(from).for_each(|(failure, &witness)| to[failure.row as usize] = witness);
        }
        for (to, from) in self.given.iter_mut().zip(given) {
            for (firing, &row) in drivers.iter().enumerate() {
                to.written[row as usize] = from.written[firing];
                to.values.set(row as usize, from.values.cell(firing));
            }
        }
    }

    fn replace_some(&mut self, rows: &[u32], output: &Output) -> Vec<Dirty> {
        self.make_room();
        let variables: Vec<usize> = self.given.iter().map(|given| given.variable).collect();
        let state = |memory: &Self, at: usize, row: u32| {
            let set = memory.claim(at, row as usize);
            set.map(|cell| (memory.witness(variables[at], row as usize), cell))
        };
        let before: Vec<Vec<Option<(u32, Cell)>>> =
            (0..variables.len()).map(|at| rows.iter().map(|&row| state(self, at, row)).collect()).collect();
        for &row in rows {
            self.witnesses.iter_mut().skip(1).for_each(|column| column[row as usize] = NO_ROW);
            for given in &mut self.given {
                given.written[row as usize] = false;
                given.values.set(row as usize, Cell::Unknown);
            }
        }
        self.write(output);
        let mut touched = vec![];
        for (at, before) in before.into_iter().enumerate() {
            let mut dirty = Dirty::None;
            for (&row, old) in rows.iter().zip(before) {
                let new = state(self, at, row);
                let same = match (old, new) {
                    (Some(old), Some(new)) => old.0 == new.0 && old.1.same(new.1),
                    (old, new) => old.is_none() && new.is_none(),
                };
                if !same {
                    dirty.extend(old.into_iter().chain(new).map(|(row, _)| row));
                }
            }
            touched.push(dirty);
        }
        touched
    }

    /// Replaces the firings of some objects of the first clause among many.
    fn splice(&mut self, rows: &[u32], output: Output) -> Vec<Dirty> {
        let stale = |row: u32| rows.binary_search(&row).is_ok();
        let touched: Vec<Dirty> = (0..self.given.len())
            .map(|at| {
                let variable = self.given[at].variable;
                let mut dirty = Dirty::None;
                let old = (0..self.ways.len()).filter(|&firing| stale(self.witnesses[0][firing]));
                dirty.extend(old.map(|firing| self.witnesses[variable][firing]));
                dirty.extend(output.witnesses[variable].iter().copied());
                dirty
            })
            .collect();
        let kept: Vec<usize> =
            (0..self.ways.len()).filter(|&firing| !stale(self.witnesses[0][firing])).collect();
        self.select(&kept);
        self.ways.extend(output.statuses);
        for (column, more) in self.witnesses.iter_mut().zip(&output.witnesses) {
            column.extend(more);
        }
        for (given, more) in self.given.iter_mut().zip(&output.given) {
            given.written.extend(&more.written);
            given.values.append(&more.values);
        }
        self.sort();
        touched
    }

    fn select(&mut self, firings: &[usize]) {
        self.ways = firings.iter().map(|&firing| self.ways[firing]).collect();
        for column in &mut self.witnesses {
            *column = firings.iter().map(|&firing| column[firing]).collect();
        }
        for given in &mut self.given {
            *given = given.select(firings);
        }
    }

    /// Firings in the order of the objects of the first clause, however they were found.
    fn sort(&mut self) {
        if self.witnesses[0].is_sorted() {
            return;
        }
        let mut order: Vec<usize> = (0..self.ways.len()).collect();
        order.sort_by_key(|&firing| self.witnesses[0][firing]);
        self.select(&order);
    }

    /// Objects of the first clause's class moved; new ones wait to be asked for. Of [`Shape::Single`] only.
    pub(crate) fn move_drivers(&mut self, moved: Option<&[Option<u32>]>, len: usize) {
        self.make_room();
        let to = |row: usize| moved.map_or(Some(row as u32), |moved| moved.get(row).copied().flatten());
        self.statuses = moved_to(&self.statuses, to, vec![Status::UNASKED; len]);
        self.unasked = self.statuses.iter().filter(|&&status| status == Status::UNASKED).count();
        let undecided = std::mem::take(&mut self.undecided);
        self.undecided =
            undecided.into_iter().filter_map(|(row, count)| Some((to(row as usize)?, count))).collect();
        self.lost = self.lost.iter().filter_map(|&row| to(row as usize)).collect();
        for column in self.witnesses.iter_mut().skip(1) {
            *column = moved_to(column, to, vec![NO_ROW; len]);
        }
        for given in &mut self.given {
            let mut values = given.values.empty();
            values.resize(len);
            for (from, row) in (0..given.written.len()).filter_map(|from| Some((from, to(from)?))) {
                values.set(row as usize, given.values.cell(from));
            }
            given.values = values;
            given.written = moved_to(&given.written, to, vec![false; len]);
        }
        self.inverse.iter_mut().for_each(|inverse| *inverse = None);
    }

    /// Objects of a later clause's class moved; who rests on one that is gone is lost. Of [`Shape::Single`] only.
    pub(crate) fn move_witnesses(&mut self, clause: usize, moved: &[Option<u32>]) {
        self.make_room();
        for (driver, witness) in
            self.witnesses[clause].iter_mut().enumerate().filter(|(_, row)| **row != NO_ROW)
        {
            let row = moved.get(*witness as usize).copied().flatten();
            if row.is_none() {
                self.lost.push(driver as u32);
            }
            *witness = row.unwrap_or(NO_ROW);
        }
        self.inverse.iter_mut().for_each(|inverse| *inverse = None);
    }

    /// Whether it can follow when objects of a class come, go or move. Ties hang on the order of rows, and numbers
    /// on objects that no firing names.
    pub(crate) fn follows(&self, rule: &Rule, class: &str, keeps_order: bool) -> bool {
        let of_class = || rule.clauses.iter().skip(1).filter(|clause| clause.class == class);
        let named = of_class().all(|clause| clause.quantifier.names() && rule.hypothesis.is_none());
        self.shape == Shape::Single && named && (keeps_order || of_class().next().is_none())
    }

    /// The objects of the first clause that nobody asked for yet.
    pub(crate) fn waiting(&self) -> Vec<u32> {
        let rows = self.statuses.iter().zip(0..);
        rows.filter(|(status, _)| **status == Status::UNASKED).map(|(_, row)| row).collect()
    }
}

/// Rows where they went, among those of `none`.
fn moved_to<T: Copy>(rows: &[T], to: impl Fn(usize) -> Option<u32>, none: Vec<T>) -> Vec<T> {
    let mut out = none;
    for (from, &value) in rows.iter().enumerate() {
        if let Some(row) = to(from) {
            out[row as usize] = value;
        }
    }
    out
}
