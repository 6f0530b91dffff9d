//! Finds one witness for each binding: the least, the most, or the first that passes.

use super::Stopped;
use super::lane::{Frame, Lane, NO_ROW, Rows, Values};
use super::search::{Search, pairs};
use crate::plan::clause::ClausePlan;
use crate::plan::node::Comparison;
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
        let candidates = self.candidates(number);
        if !candidates.thresholds.is_empty()
            && let Some(found) = self.by_threshold(number, clause, frame)?
        {
            return Ok(found);
        }
        let mut found = Found::new(clause, frame.len);
        if candidates.index.is_some() {
            self.by_index(number, clause, frame, &mut found)?;
        } else if candidates.rows.len() <= frame.len {
            self.by_candidate(number, clause, frame, &mut found)?;
        } else {
            self.by_binding(number, clause, frame, &mut found)?;
        }
        Ok(found)
    }

    /// For few candidates that only pass or fail comparisons of numbers: the worst first, so that the best is what
    /// stays. `None` where the bindings' side is not numbers.
    fn by_threshold(
        &self,
        number: usize,
        clause: &ClausePlan,
        frame: &Frame,
    ) -> Result<Option<Found>, Stopped> {
        let candidates = self.candidates(number);
        let mut sides = vec![];
        for threshold in &clause.thresholds {
            match self.machine.values(&threshold.binding, frame) {
                Values::Numbers(lane) => sides.push((threshold.comparison, lane)),
                _ => return Ok(None),
            }
        }
        let mut best = vec![NOWHERE; frame.len];
        let mut passes = vec![0_u64; frame.len];
        for (nth, &row) in candidates.rows.iter().enumerate().rev() {
            passes.fill(u64::MAX);
            for ((comparison, lane), values) in sides.iter().zip(&candidates.thresholds) {
                narrow(&mut passes, *comparison, values[nth], lane);
            }
            for (best, passes) in best.iter_mut().zip(&passes) {
                *best = (*best & !passes) | (u64::from(row) & passes);
            }
        }
        let mut found = Found::new(clause, frame.len);
        found.rows = best.into_iter().map(|row| row as u32).collect();
        let unknown = |index: usize| {
            let side = sides.iter().any(|(_, lane)| lane.at(index).is_nan());
            side || candidates.thresholds.iter().flatten().any(|value| value.is_nan())
        };
        let open: Vec<u32> = (0..frame.len as u32)
            .filter(|&index| found.rows[index as usize] == NO_ROW && unknown(index as usize))
            .collect();
        if !open.is_empty() {
            let mut counted = Found::new(clause, open.len());
            self.by_candidate(number, clause, &frame.select(&open), &mut counted)?;
            open.iter().zip(counted.unknown).for_each(|(&at, unknown)| found.unknown[at as usize] = unknown);
        }
        Ok(Some(found))
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
        self.in_batches(clause, frame, pairs(frame, |binding| groups[binding].iter()), |tried, pairs| {
            let (truths, values) = self.tried(clause, tried);
            for (index, &(binding, row)) in pairs.iter().enumerate() {
                found.consider(binding as usize, row, truths.at(index), values.at(index));
            }
        })
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
            tried.rows[clause.variable] = Rows::Same(row);
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
            for (chunk, tried) in candidates.batches(clause.variable, frame, binding) {
                self.machine.tick()?;
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
        let truths = clause
            .test
            .as_ref()
            .map_or(Lane::Same(Truth::True), |test| self.machine.values(test, frame).truths());
        let values = match &clause.by {
            Some(by) if !clause.by_own => self.machine.values(by, frame).numbers(),
            _ => Lane::Same(f64::NAN),
        };
        (truths, values)
    }
}

/// [`NO_ROW`] among 64 bits.
const NOWHERE: u64 = NO_ROW as u64;

/// Keeps the bits of the bindings for which the comparison with the candidate's value is true. Without a branch, so
/// that several are compared at once.
// Rules mean equality to the bit.
#[allow(clippy::float_cmp)]
fn narrow(passes: &mut [u64], comparison: Comparison, candidate: f64, bindings: &Lane<f64>) {
    fn with(passes: &mut [u64], bindings: &Lane<f64>, test: impl Fn(f64) -> bool) {
        match bindings {
            Lane::Same(value) if test(*value) => {}
            Lane::Same(_) => passes.fill(0),
            Lane::Each(values) => {
                for (passes, &value) in passes.iter_mut().zip(values.iter()) {
                    *passes &= u64::from(test(value)).wrapping_neg();
                }
            }
        }
    }
    match comparison {
        Comparison::Equal => with(passes, bindings, |value| candidate == value),
        // Nothing is unequal to the unknown.
        Comparison::Unequal => with(passes, bindings, |value: f64| {
            candidate.partial_cmp(&value).is_some_and(std::cmp::Ordering::is_ne)
        }),
        Comparison::Less => with(passes, bindings, |value| candidate < value),
        Comparison::AtMost => with(passes, bindings, |value| candidate <= value),
        Comparison::Greater => with(passes, bindings, |value| candidate > value),
        Comparison::AtLeast => with(passes, bindings, |value| candidate >= value),
    }
}
