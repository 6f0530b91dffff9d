//! Goes through a rule's clauses, from batch to batch, and fires.

use super::action::Slots;
use super::evaluate::Batch;
use super::hypothesis::Verdicts;
use super::index::Index;
use super::lane::{Frame, Lane, NO_ROW, Rows};
use super::output::{Failure, Output, Skipped};
use super::{BATCH, Machine, Stopped};
use crate::diagnostic::{Code, Diagnostic};
use crate::plan::action::ActionPlan;
use crate::plan::clause::ClausePlan;
use crate::plan::{Effect, Plan};
use crate::script::syntax::Quantifier;
use crate::value::{Truth, Type};

/// Most firings of one rule.
pub(crate) const MAX_FIRINGS: u32 = 20_000_000;

/// The objects of a clause's class that may be bound, and how to find them.
pub(crate) struct Candidates {
    pub(crate) rows: Vec<u32>,
    /// Rows of which it is not known whether they may be bound, where that counts.
    pub(crate) undecided: Vec<u32>,
    /// Whether `rows` is 0, 1, 2, ...
    pub(crate) all: bool,
    pub(crate) index: Option<Index>,
}

impl Candidates {
    /// The rows that an unknown leaves open; all of them where the key to look for is unknown.
    pub(super) fn perhaps(&self, unknown_key: bool) -> impl Iterator<Item = &u32> + Clone {
        let all = if unknown_key { self.rows.as_slice() } else { &[] };
        all.iter().chain(&self.undecided)
    }
}

/// The evaluation of one rule.
pub(crate) struct Search<'s> {
    pub(crate) machine: &'s Machine<'s>,
    pub(crate) plan: &'s Plan,
    pub(crate) candidates: Vec<Candidates>,
    pub(super) verdicts: Verdicts,
    pub(super) output: Output,
}

/// Evaluates a rule; `sizes` are the numbers of objects of its clauses' classes.
pub(crate) fn search(machine: &Machine, plan: &Plan, sizes: &[usize]) -> Output {
    let mut search = Search {
        machine,
        plan,
        candidates: vec![],
        verdicts: Verdicts::default(),
        output: Output::default(),
    };
    search.output.witnesses = vec![vec![]; plan.clauses.len()];
    search.expect();
    let stopped = search.prepare(sizes).and_then(|()| {
        let rows = plan.clauses.iter().map(|_| Rows::Unbound).collect();
        search.advance(0, Frame { len: 1, rows })?;
        search.settle()
    });
    let mut output = search.output;
    output.problem = machine.trouble.take();
    output.problems = machine.troubles.get();
    if stopped.is_err() || machine.stopped.get() {
        let place = machine.rule.file.source.place(machine.rule.position);
        let message = format!(
            "rule \"{}\" was stopped: it did more, or took longer, than a rule may",
            machine.rule.name
        );
        let stopped = Diagnostic::error(Code::Deadline, &place, message);
        return Output {
            problem: output.problem.or(Some(stopped)),
            problems: output.problems.max(1),
            ..Output::default()
        };
    }
    output
}

impl<'s> Search<'s> {
    /// Makes room for what may be concluded, so that a type is known even where nothing is.
    fn expect(&mut self) {
        match &self.plan.effect {
            Effect::Conclude { then, otherwise } => {
                for target in then.targets.iter().chain(otherwise.iter().flat_map(|action| &action.targets)) {
                    let given = self.output.given(&target.name);
                    given.kind = given.kind.or(target.kind);
                }
                if let Some(name) = &self.plan.hypothesis {
                    self.output.given(name).kind = Some(Type::Truth);
                }
            }
            Effect::Default { name, kind, .. } => self.output.given(name).kind = *kind,
            Effect::Revise { .. } => {
                for name in self.machine.rule.sets.keys() {
                    self.output.given(name).kind = Some(Type::Number);
                }
            }
        }
    }

    fn prepare(&mut self, sizes: &[usize]) -> Result<(), Stopped> {
        for (number, (clause, &size)) in self.plan.clauses.iter().zip(sizes).enumerate() {
            let mut rows: Vec<u32> = (0..size as u32).collect();
            let mut unknown = 0;
            let mut undecided = vec![];
            if clause.whole.is_some() {
                (rows, undecided) = self.decided(number, clause, rows)?;
                if clause.quantifier.binds() {
                    unknown += undecided.len();
                }
            } else if let Some(own) = &clause.own {
                rows = self.keep(number, &rows, |machine, batch, keep| {
                    let truths = machine.evaluate(own, batch).truths();
                    (0..batch.frame.len).for_each(|index| {
                        let truth = truths.at(index);
                        unknown += usize::from(truth == Truth::Unknown);
                        keep.push(truth == Truth::True);
                    });
                })?;
            }
            if let (Some(by), true) = (&clause.by, clause.by_own) {
                let mut values: Vec<f64> = vec![];
                let before = rows.clone();
                rows = self.keep(number, &rows, |machine, batch, keep| {
                    let numbers = machine.evaluate(by, batch).numbers();
                    for number in (0..batch.frame.len).map(|index| numbers.at(index)) {
                        keep.push(!number.is_nan());
                        unknown += usize::from(number.is_nan());
                        values.extend(Some(number).filter(|number| !number.is_nan()));
                    }
                })?;
                if self.plan.hypothesis.is_some() {
                    let mut ranked = rows.iter().peekable();
                    undecided.extend(before.iter().filter(|&row| ranked.next_if_eq(&row).is_none()));
                }
                let mut ranked: Vec<(f64, u32)> = values.into_iter().zip(rows).collect();
                // Stable: equal values stay in the order of the table.
                match clause.quantifier {
                    Quantifier::Most => ranked.sort_by(|a, b| b.0.total_cmp(&a.0)),
                    _ => ranked.sort_by(|a, b| (a.0 + 0.0).total_cmp(&(b.0 + 0.0))),
                }
                rows = ranked.into_iter().map(|(_, row)| row).collect();
            }
            if unknown > 0 {
                self.output.skipped.push(Skipped { clause: number, objects: unknown });
            }
            if number == 0 && self.plan.hypothesis.is_some() {
                self.verdicts.start(size, &undecided);
            }
            let all = rows.iter().zip(0..).all(|(&row, nth)| row == nth);
            let index = (!clause.joins.is_empty()).then(|| {
                let columns: Vec<_> =
                    clause.joins.iter().map(|join| self.machine.columns[join.column]).collect();
                Index::new(&columns, rows.iter().copied())
            });
            self.candidates.push(Candidates { rows, undecided, all, index });
        }
        Ok(())
    }

    /// The rows for which `test` pushes true; it sees them batch by batch, bound to one variable.
    pub(super) fn keep(
        &self,
        variable: usize,
        rows: &[u32],
        mut test: impl FnMut(&Machine, Batch, &mut Vec<bool>),
    ) -> Result<Vec<u32>, Stopped> {
        let mut kept = vec![];
        let mut flags = vec![];
        for chunk in rows.chunks(BATCH) {
            self.machine.tick()?;
            let mut bound = vec![Rows::Unbound; self.plan.clauses.len()];
            bound[variable] = Rows::Each(chunk.to_vec());
            let frame = Frame { len: chunk.len(), rows: bound };
            flags.clear();
            test(self.machine, Batch { frame: &frame, slots: &[], mask: None }, &mut flags);
            kept.extend(chunk.iter().zip(&flags).filter(|(_, keep)| **keep).map(|(&row, _)| row));
        }
        Ok(kept)
    }

    fn advance(&mut self, number: usize, frame: Frame) -> Result<(), Stopped> {
        self.machine.tick()?;
        let plan = self.plan;
        let Some(clause) = plan.clauses.get(number) else { return self.fire(&frame) };
        if clause.quantifier == Quantifier::Each {
            self.each(number, clause, &frame)?;
            return self.doubt(number, clause, &frame);
        }
        if clause.quantifier.counts() {
            let numbers = self.tally(number, clause, &frame)?.numbers(clause.quantifier);
            let mut next = frame;
            next.rows[number] = Rows::Numbers(Lane::Each(numbers.into()));
            return self.advance(number + 1, next);
        }
        if clause.quantifier == Quantifier::Link {
            let rows = match self.candidates[number].index {
                Some(_) => self.groups(number, clause, &frame),
                None => vec![&[][..]; frame.len],
            };
            let first = rows.into_iter().map(|rows| rows.first().copied().unwrap_or(NO_ROW)).collect();
            let mut next = frame;
            next.rows[number] = Rows::Each(first);
            return self.filtered(number, clause, next);
        }
        if clause.quantifier == Quantifier::All {
            return self.all(number, clause, frame);
        }
        let found = self.witnesses(number, clause, &frame)?;
        let wanted = clause.quantifier != Quantifier::None;
        let met = |index: &u32| (found.rows[*index as usize] != NO_ROW) == wanted;
        let (passing, failing): (Vec<u32>, Vec<u32>) = (0..frame.len as u32).partition(met);
        if !failing.is_empty() {
            let failed = frame.select(&failing);
            if wanted {
                self.doubt(number, clause, &failed)?;
            }
            self.fail(number, &failed, failing.iter().map(|&index| found.unknown[index as usize]))?;
        }
        if passing.is_empty() {
            return Ok(());
        }
        let mut next = if failing.is_empty() { frame } else { frame.select(&passing) };
        next.rows[number] = if wanted {
            Rows::Each(passing.iter().map(|&index| found.rows[index as usize]).collect())
        } else {
            Rows::Unbound
        };
        self.advance(number + 1, next)
    }

    /// Goes on with the bindings of which it is known that all objects have what is asked.
    fn all(&mut self, number: usize, clause: &'s ClausePlan, frame: Frame) -> Result<(), Stopped> {
        let tally = self.tally(number, clause, &frame)?;
        let met = |index: &u32| tally.holds(*index as usize) == Truth::True;
        let (passing, failing): (Vec<u32>, Vec<u32>) = (0..frame.len as u32).partition(met);
        if !failing.is_empty() {
            let undecided = failing.iter().map(|&index| tally.undecided(index as usize));
            self.fail(number, &frame.select(&failing), undecided)?;
        }
        match passing.len() {
            0 => Ok(()),
            all if all == frame.len => self.advance(number + 1, frame),
            _ => self.advance(number + 1, frame.select(&passing)),
        }
    }

    /// Every candidate that passes, for every binding.
    fn each(&mut self, number: usize, clause: &'s ClausePlan, frame: &Frame) -> Result<(), Stopped> {
        if self.candidates[number].index.is_some() {
            let groups: Vec<Vec<u32>> =
                self.groups(number, clause, frame).into_iter().map(<[u32]>::to_vec).collect();
            let mut pairs: Vec<(u32, u32)> = vec![];
            for (binding, rows) in (0..).zip(groups) {
                for row in rows {
                    pairs.push((binding, row));
                    if pairs.len() == BATCH {
                        self.pairs(number, clause, frame, &std::mem::take(&mut pairs))?;
                    }
                }
            }
            return self.pairs(number, clause, frame, &pairs);
        }
        for binding in 0..frame.len {
            let mut from = 0;
            while from < self.candidates[number].rows.len() {
                let candidates = &self.candidates[number];
                let to = (from + BATCH).min(candidates.rows.len());
                let mut next = frame.repeat(binding, to - from);
                next.rows[number] = if candidates.all {
                    Rows::From(from as u32)
                } else {
                    Rows::Each(candidates.rows[from..to].to_vec())
                };
                self.filtered(number, clause, next)?;
                from = to;
            }
        }
        Ok(())
    }

    fn pairs(
        &mut self,
        number: usize,
        clause: &'s ClausePlan,
        frame: &Frame,
        pairs: &[(u32, u32)],
    ) -> Result<(), Stopped> {
        if pairs.is_empty() {
            return Ok(());
        }
        let bindings: Vec<u32> = pairs.iter().map(|&(binding, _)| binding).collect();
        let mut next = frame.select(&bindings);
        next.rows[number] = Rows::Each(pairs.iter().map(|&(_, row)| row).collect());
        self.filtered(number, clause, next)
    }

    fn filtered(&mut self, number: usize, clause: &'s ClausePlan, frame: Frame) -> Result<(), Stopped> {
        let Some(test) = &clause.test else { return self.advance(number + 1, frame) };
        let truths = self.machine.evaluate(test, Batch { frame: &frame, slots: &[], mask: None }).truths();
        if self.plan.hypothesis.is_some() {
            let unknown = (0..frame.len).filter(|&index| truths.at(index) == Truth::Unknown);
            self.verdicts.leave_open(unknown.map(|index| frame.rows[0].at(index)));
        }
        let passing: Vec<u32> =
            (0..frame.len as u32).filter(|&index| truths.at(index as usize) == Truth::True).collect();
        if passing.is_empty() {
            return Ok(());
        }
        let next = if passing.len() == frame.len { frame.clone() } else { frame.select(&passing) };
        self.advance(number + 1, next)
    }

    /// For each binding the rows that the index gives.
    pub(crate) fn groups(&self, number: usize, clause: &ClausePlan, frame: &Frame) -> Vec<&[u32]> {
        let Some(index) = &self.candidates[number].index else { return vec![] };
        let batch = Batch { frame, slots: &[], mask: None };
        let keys: Vec<_> = clause.joins.iter().map(|join| self.machine.evaluate(&join.key, batch)).collect();
        (0..frame.len).map(|binding| index.rows(keys.iter().map(|key| key.cell(binding)))).collect()
    }

    fn fail(
        &mut self,
        number: usize,
        frame: &Frame,
        unknown: impl Iterator<Item = u32>,
    ) -> Result<(), Stopped> {
        let plan = self.plan;
        let unknown: Vec<u32> = unknown.collect();
        let open = unknown.iter().enumerate().filter(|(_, unknown)| **unknown > 0);
        self.verdicts.leave_open(open.map(|(index, _)| frame.rows[0].at(index)));
        if let Effect::Conclude { otherwise: Some(action), .. } = &plan.effect {
            return self.conclude(action, frame);
        }
        for (index, unknown) in unknown.into_iter().enumerate() {
            let row = frame.rows[0].at(index);
            self.output.failures.push(Failure { row, clause: number as u32, unknown });
        }
        Ok(())
    }

    fn fire(&mut self, frame: &Frame) -> Result<(), Stopped> {
        let plan = self.plan;
        match &plan.effect {
            Effect::Conclude { then, .. } => {
                self.prove(frame);
                self.conclude(then, frame)
            }
            Effect::Default { name, value, .. } => {
                let first = self.record(frame)?;
                let values = self.machine.evaluate(value, Batch { frame, slots: &[], mask: None });
                let given = self.output.given(name);
                for index in 0..frame.len {
                    given.rows.push(frame.rows[0].at(index));
                    given.firings.push(first + index as u32);
                    given.cells.push(values.cell(index));
                }
                Ok(())
            }
            Effect::Revise { variable, amount, .. } => {
                let first = self.record(frame)?;
                let amounts = self.machine.evaluate(amount, Batch { frame, slots: &[], mask: None });
                let rows = &frame.rows[*variable];
                let Some(name) = self.machine.rule.sets.keys().next() else { return Ok(()) };
                let given = self.output.given(name);
                for index in 0..frame.len {
                    given.rows.push(rows.at(index));
                    given.firings.push(first + index as u32);
                    given.cells.push(amounts.cell(index));
                }
                Ok(())
            }
        }
    }

    fn conclude(&mut self, action: &ActionPlan, frame: &Frame) -> Result<(), Stopped> {
        let first = self.record(frame)?;
        let Slots { values, written } = self.machine.act(action, frame);
        for target in &action.targets {
            let rows = &frame.rows[target.variable];
            let given = self.output.given(&target.name);
            for index in 0..frame.len {
                let row = rows.at(index);
                if row != NO_ROW && written[target.slot].at(index) {
                    given.rows.push(row);
                    given.firings.push(first + index as u32);
                    given.cells.push(values[target.slot].cell(index));
                }
            }
        }
        Ok(())
    }

    /// Keeps what the bindings rest on; gives the number of the first firing.
    pub(super) fn record(&mut self, frame: &Frame) -> Result<u32, Stopped> {
        let first = self.output.firings;
        if first > MAX_FIRINGS {
            return Err(Stopped);
        }
        for (column, rows) in self.output.witnesses.iter_mut().zip(&frame.rows) {
            column.extend((0..frame.len).map(|index| rows.at(index)));
        }
        self.output.firings += frame.len as u32;
        Ok(first)
    }
}
