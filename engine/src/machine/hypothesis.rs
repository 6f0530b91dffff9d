//! What a rule says of each object of its first clause: proved, refuted, or undecided.

use super::evaluate::Batch;
use super::lane::{Frame, Rows};
use super::search::Search;
use super::tally::pairs;
use super::{BATCH, Stopped};
use crate::plan::clause::ClausePlan;
use crate::value::{Cell, Truth};

/// For each object of the first clause; empty where the rule has no hypothesis.
#[derive(Debug, Default)]
pub(super) struct Verdicts(Vec<Truth>);

impl Verdicts {
    /// Refuted until something else comes up; `open` are the rows of which the first clause is undecided.
    pub(super) fn start(&mut self, objects: usize, open: &[u32]) {
        self.0 = vec![Truth::False; objects];
        self.leave_open(open.iter().copied());
    }

    pub(super) fn leave_open(&mut self, rows: impl Iterator<Item = u32>) {
        self.raise(rows, Truth::Unknown);
    }

    fn raise(&mut self, rows: impl Iterator<Item = u32>, truth: Truth) {
        for row in rows {
            if let Some(verdict) = self.0.get_mut(row as usize) {
                *verdict = truth.max(*verdict);
            }
        }
    }
}

impl Search<'_> {
    /// Leaves open what rests on objects of this clause of which an unknown hides whether they pass.
    pub(super) fn doubt(&mut self, number: usize, clause: &ClausePlan, frame: &Frame) -> Result<(), Stopped> {
        if self.plan.hypothesis.is_none() || number == 0 {
            return Ok(());
        }
        let mut open: Vec<u32> = vec![];
        let candidates = &self.candidates[number];
        let unknown_key = self.unknown_keys(clause, frame);
        let mut pairs = pairs(frame, |binding| candidates.perhaps(unknown_key[binding]));
        loop {
            let (bindings, rows): (Vec<u32>, Vec<u32>) = pairs.by_ref().take(BATCH).unzip();
            if bindings.is_empty() {
                break;
            }
            self.machine.tick()?;
            let mut tried = frame.select(&bindings);
            tried.rows[number] = Rows::Each(rows);
            let batch = Batch { frame: &tried, slots: &[], mask: None };
            let truths = clause.whole.as_ref().map(|whole| self.machine.evaluate(whole, batch).truths());
            let may_pass =
                |index: usize| truths.as_ref().is_none_or(|truths| truths.at(index) != Truth::False);
            open.extend(
                bindings
                    .iter()
                    .enumerate()
                    .filter(|&(index, _)| may_pass(index))
                    .map(|(_, &binding)| frame.rows[0].at(binding as usize)),
            );
        }
        drop(pairs);
        self.verdicts.leave_open(open.into_iter());
        Ok(())
    }

    /// The bindings met all clauses; their firing is the next.
    pub(super) fn prove(&mut self, frame: &Frame) {
        let Some(name) = &self.plan.hypothesis else { return };
        let first = self.output.firings;
        let rows = &frame.rows[0];
        let given = self.output.given(name);
        for index in 0..frame.len {
            given.rows.push(rows.at(index));
            given.firings.push(first + index as u32);
            given.cells.push(Cell::Truth(true));
        }
        self.verdicts.raise((0..frame.len).map(|index| rows.at(index)), Truth::True);
    }

    /// Says what is refuted, and what is undecided.
    pub(super) fn settle(&mut self) -> Result<(), Stopped> {
        let Some(name) = &self.plan.hypothesis else { return Ok(()) };
        let verdicts = std::mem::take(&mut self.verdicts).0;
        let open: Vec<u32> =
            (0..verdicts.len() as u32).filter(|&row| verdicts[row as usize] != Truth::True).collect();
        for chunk in open.chunks(BATCH) {
            let mut rows = vec![Rows::Unbound; self.plan.clauses.len()];
            rows[0] = Rows::Each(chunk.to_vec());
            let first = self.record(&Frame { len: chunk.len(), rows })?;
            let given = self.output.given(name);
            for (firing, &row) in (first..).zip(chunk) {
                let refuted = verdicts[row as usize] == Truth::False;
                given.rows.push(row);
                given.firings.push(firing);
                given.cells.push(if refuted { Cell::Truth(false) } else { Cell::Unknown });
            }
        }
        Ok(())
    }
}
