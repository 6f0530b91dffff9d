//! Finds one witness for each binding: the least, the most, or the first that passes.

use super::evaluate::Batch;
use super::lane::{Frame, Lane, NO_ROW, Rows};
use super::search::Search;
use super::{BATCH, Stopped};
use crate::plan::clause::ClausePlan;
use crate::script::syntax::Quantifier;
use crate::value::Truth;

/// For each binding its witness, and how many candidates an unknown kept out.
pub(crate) struct Found {
    pub(crate) rows: Vec<u32>,
    pub(crate) unknown: Vec<u32>,
    values: Vec<f64>,
    /// Candidates come best first, so the first that passes is the witness.
    first_wins: bool,
    most: bool,
    open: usize,
}

impl Found {
    fn new(clause: &ClausePlan, len: usize) -> Self {
        Self {
            rows: vec![NO_ROW; len],
            unknown: vec![0; len],
            values: vec![f64::NAN; if clause.by_own { 0 } else { len }],
            first_wins: clause.by_own,
            most: clause.quantifier == Quantifier::Most,
            open: len,
        }
    }

    fn consider(&mut self, binding: usize, row: u32, truth: Truth, value: f64) {
        match truth {
            Truth::False => {}
            Truth::Unknown => self.unknown[binding] += 1,
            Truth::True if self.first_wins => {
                if self.rows[binding] == NO_ROW {
                    self.rows[binding] = row;
                    self.open -= 1;
                }
            }
            Truth::True if value.is_nan() => self.unknown[binding] += 1,
            Truth::True => {
                let best = self.values[binding];
                if best.is_nan() || (if self.most { value > best } else { value < best }) {
                    self.values[binding] = value;
                    self.rows[binding] = row;
                }
            }
        }
    }
}

impl Search<'_> {
    pub(crate) fn witnesses(
        &self,
        number: usize,
        clause: &ClausePlan,
        frame: &Frame,
    ) -> Result<Found, Stopped> {
        let mut found = Found::new(clause, frame.len);
        let candidates = self.candidates(number);
        if candidates.index.is_some() {
            self.by_index(number, clause, frame, &mut found)?;
        } else if candidates.rows.len() <= frame.len {
            self.by_candidate(number, clause, frame, &mut found)?;
        } else {
            self.by_binding(number, clause, frame, &mut found)?;
        }
        Ok(found)
    }

    fn by_index(
        &self,
        number: usize,
        clause: &ClausePlan,
        frame: &Frame,
        found: &mut Found,
    ) -> Result<(), Stopped> {
        let groups = self.groups(number, clause, frame);
        if clause.test.is_none() && clause.by_own {
            for (witness, group) in found.rows.iter_mut().zip(groups) {
                *witness = group.first().copied().unwrap_or(NO_ROW);
            }
            return Ok(());
        }
        let mut pairs: Vec<(u32, u32)> = vec![];
        for (binding, rows) in (0..).zip(groups) {
            for &row in rows {
                pairs.push((binding, row));
                if pairs.len() == BATCH {
                    self.pairs_considered(number, clause, frame, &pairs, found)?;
                    pairs.clear();
                }
            }
        }
        self.pairs_considered(number, clause, frame, &pairs, found)
    }

    fn pairs_considered(
        &self,
        number: usize,
        clause: &ClausePlan,
        frame: &Frame,
        pairs: &[(u32, u32)],
        found: &mut Found,
    ) -> Result<(), Stopped> {
        if pairs.is_empty() {
            return Ok(());
        }
        self.machine.tick()?;
        let bindings: Vec<u32> = pairs.iter().map(|&(binding, _)| binding).collect();
        let mut tried = frame.select(&bindings);
        tried.rows[number] = Rows::Each(pairs.iter().map(|&(_, row)| row).collect());
        let (truths, values) = self.tried(clause, &tried);
        for (index, &(binding, row)) in pairs.iter().enumerate() {
            found.consider(binding as usize, row, truths.at(index), values.at(index));
        }
        Ok(())
    }

    /// One candidate after the other, each for the whole batch: for classes of few objects.
    fn by_candidate(
        &self,
        number: usize,
        clause: &ClausePlan,
        frame: &Frame,
        found: &mut Found,
    ) -> Result<(), Stopped> {
        let mut tried = frame.clone();
        for &row in &self.candidates(number).rows {
            self.machine.tick()?;
            tried.rows[number] = Rows::Same(row);
            let (truths, values) = self.tried(clause, &tried);
            for index in 0..frame.len {
                found.consider(index, row, truths.at(index), values.at(index));
            }
            if found.first_wins && found.open == 0 {
                break;
            }
        }
        Ok(())
    }

    /// One binding after the other, each against batches of candidates: for classes of many objects.
    fn by_binding(
        &self,
        number: usize,
        clause: &ClausePlan,
        frame: &Frame,
        found: &mut Found,
    ) -> Result<(), Stopped> {
        let candidates = self.candidates(number);
        for binding in 0..frame.len {
            for (nth, chunk) in candidates.rows.chunks(BATCH).enumerate() {
                self.machine.tick()?;
                let mut tried = frame.repeat(binding, chunk.len());
                tried.rows[number] = if candidates.all {
                    Rows::From((nth * BATCH) as u32)
                } else {
                    Rows::Each(chunk.to_vec())
                };
                let (truths, values) = self.tried(clause, &tried);
                for (index, &row) in chunk.iter().enumerate() {
                    found.consider(binding, row, truths.at(index), values.at(index));
                }
                if found.first_wins && found.rows[binding] != NO_ROW {
                    break;
                }
            }
        }
        Ok(())
    }

    fn tried<'f>(&'f self, clause: &ClausePlan, frame: &'f Frame) -> (Lane<'f, Truth>, Lane<'f, f64>) {
        let batch = Batch { frame, slots: &[], mask: None };
        let truths = clause
            .test
            .as_ref()
            .map_or(Lane::Same(Truth::True), |test| self.machine.evaluate(test, batch).truths());
        let values = match &clause.by {
            Some(by) if !clause.by_own => self.machine.evaluate(by, batch).numbers(),
            _ => Lane::Same(f64::NAN),
        };
        (truths, values)
    }
}
