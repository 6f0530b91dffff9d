//! What a rule says of each object of its first clause: proved, refuted, or undecided.

use super::lane::Frame;
use super::output::{Status, Verdicts};
use super::search::{Search, pairs};
use super::{BATCH, Stopped};
use crate::plan::clause::ClausePlan;
use crate::value::{Cell, Truth};

impl Search<'_> {
    /// Leaves open what rests on objects of this clause of which an unknown hides whether they pass.
    pub(super) fn doubt(&mut self, number: usize, clause: &ClausePlan, frame: &Frame) -> Result<(), Stopped> {
        if self.plan.hypothesis.is_none() || number == 0 {
            return Ok(());
        }
        let mut open: Vec<u32> = vec![];
        let candidates = self.candidates(number);
        let unknown_key = self.unknown_keys(clause, frame);
        let pairs = pairs(frame, |binding| candidates.perhaps(unknown_key[binding]));
        self.in_batches(clause, frame, pairs, |tried, pairs| {
            let truths = clause.whole.as_ref().map(|whole| self.machine.values(whole, tried).truths());
            let may_pass =
                |index: usize| truths.as_ref().is_none_or(|truths| truths.at(index) != Truth::False);
            let open_now = pairs.iter().enumerate().filter(|&(index, _)| may_pass(index));
            open.extend(open_now.map(|(_, &(binding, _))| frame.rows[0].at(binding as usize)));
        })?;
        self.verdicts.leave_open(open.into_iter());
        Ok(())
    }

    pub(super) fn prove(&mut self, frame: &Frame) {
        if self.plan.hypothesis.is_some() {
            self.verdicts.proved.extend((0..frame.len).map(|index| frame.rows[0].at(index)));
        }
    }

    /// Says of the objects that were looked at what is refuted, and what is undecided.
    pub(super) fn settle(&mut self, looked_at: impl Iterator<Item = u32>) -> Result<(), Stopped> {
        if self.plan.hypothesis.is_none() {
            return Ok(());
        }
        let Verdicts { proved, open } = std::mem::take(&mut self.verdicts);
        let others: Vec<u32> = looked_at.filter(|row| !proved.contains(row)).collect();
        for chunk in others.chunks(BATCH) {
            self.record(&Frame::of(self.plan.clauses.len(), 0, chunk), Status::SILENT)?;
            for given in &mut self.output.given {
                if Some(&given.name) == self.plan.hypothesis.as_ref() {
                    for row in chunk {
                        let refuted = !open.contains(row);
                        given.values.push(if refuted { Cell::Truth(false) } else { Cell::Unknown });
                        given.written.push(true);
                    }
                } else {
                    given.say_nothing(chunk.len());
                }
            }
        }
        Ok(())
    }
}
