//! Counts, adds up and checks all objects that pass, for each binding.

use super::Stopped;
use super::evaluate::Batch;
use super::lane::Frame;
use super::search::{Search, pairs};
use crate::plan::clause::ClausePlan;
use crate::plan::node::Node;
use crate::script::syntax::Quantifier;
use crate::value::{Cell, Truth};

pub(crate) struct Tally {
    amounts: Vec<Vec<f64>>,
    passed: Vec<u32>,
    /// Objects that passed without having what `all` asks.
    without: Vec<u32>,
    /// Objects of which an unknown leaves open whether, or with how much, they count.
    undecided: Vec<u32>,
}

impl Tally {
    fn new(len: usize) -> Self {
        Self {
            amounts: vec![vec![]; len],
            passed: vec![0; len],
            without: vec![0; len],
            undecided: vec![0; len],
        }
    }

    /// The number for each binding, NaN where it is unknown.
    pub(crate) fn numbers(mut self, quantifier: Quantifier) -> Vec<f64> {
        let number = |binding: usize| match quantifier {
            _ if self.undecided[binding] > 0 => f64::NAN,
            Quantifier::Sum => {
                // In the order of their size, so that the order of rows does not reach the sum.
                self.amounts[binding].sort_by(f64::total_cmp);
                self.amounts[binding].iter().fold(0.0, |sum, amount| sum + amount)
            }
            _ => f64::from(self.passed[binding]),
        };
        (0..self.passed.len()).map(number).collect()
    }

    pub(super) fn holds(&self, binding: usize) -> Truth {
        match (self.without[binding], self.undecided[binding]) {
            (0, 0) => Truth::True,
            (0, _) => Truth::Unknown,
            _ => Truth::False,
        }
    }

    /// How many objects leave it open; none where others decide.
    pub(super) fn undecided(&self, binding: usize) -> u32 {
        if self.without[binding] > 0 { 0 } else { self.undecided[binding] }
    }
}

impl Search<'_> {
    /// Goes through the candidates of each binding, the undecided ones too.
    pub(crate) fn tally(&self, number: usize, clause: &ClausePlan, frame: &Frame) -> Result<Tally, Stopped> {
        let mut tally = Tally::new(frame.len);
        let candidates = self.candidates(number);
        if candidates.index.is_none() {
            let pairs = pairs(frame, |_| candidates.rows.iter());
            self.tallied(clause, clause.test.as_ref(), frame, pairs, &mut tally)?;
            let pairs = self::pairs(frame, |_| candidates.undecided.iter());
            self.tallied(clause, clause.whole.as_ref(), frame, pairs, &mut tally)?;
            return Ok(tally);
        }
        let groups = self.groups(number, clause, frame);
        let pairs = pairs(frame, |binding| groups[binding].iter());
        self.tallied(clause, clause.test.as_ref(), frame, pairs, &mut tally)?;
        let unknown_key = self.unknown_keys(clause, frame);
        let pairs = self::pairs(frame, |binding| candidates.perhaps(unknown_key[binding]));
        self.tallied(clause, clause.whole.as_ref(), frame, pairs, &mut tally)?;
        Ok(tally)
    }

    /// For each binding whether a key of the clause's joins is unknown; it may equal every value then.
    pub(super) fn unknown_keys(&self, clause: &ClausePlan, frame: &Frame) -> Vec<bool> {
        let keys = self.machine.keys(clause, frame);
        (0..frame.len).map(|binding| keys.iter().any(|key| key.cell(binding) == Cell::Unknown)).collect()
    }

    fn tallied(
        &self,
        clause: &ClausePlan,
        condition: Option<&Node>,
        frame: &Frame,
        pairs: impl Iterator<Item = (u32, u32)>,
        tally: &mut Tally,
    ) -> Result<(), Stopped> {
        self.in_batches(clause, frame, pairs, |tried, pairs| {
            let batch = Batch { frame: tried, slots: &[], mask: None };
            let truths = |node: &Node| self.machine.evaluate(node, batch).truths().into_static();
            let passes = condition.map(truths);
            // What does not pass is not asked further.
            let open: Option<Vec<bool>> = passes
                .as_ref()
                .map(|passes| (0..tried.len).map(|index| passes.at(index) != Truth::False).collect());
            let batch = Batch { mask: open.as_deref(), ..batch };
            let has = clause.have.as_ref().map(|have| self.machine.evaluate(have, batch).truths());
            let amounts = clause.by.as_ref().map(|by| self.machine.evaluate(by, batch).numbers());
            for (index, &(binding, _)) in pairs.iter().enumerate() {
                let binding = binding as usize;
                let passes = passes.as_ref().map_or(Truth::True, |passes| passes.at(index));
                if let Some(has) = &has {
                    match passes.not().max(has.at(index)) {
                        Truth::True => {}
                        Truth::Unknown => tally.undecided[binding] += 1,
                        Truth::False => tally.without[binding] += 1,
                    }
                    continue;
                }
                let amount = amounts.as_ref().map_or(0.0, |amounts| amounts.at(index));
                match passes {
                    Truth::False => {}
                    Truth::True if !amount.is_nan() => {
                        tally.passed[binding] += 1;
                        if amounts.is_some() {
                            tally.amounts[binding].push(amount);
                        }
                    }
                    _ => tally.undecided[binding] += 1,
                }
            }
        })
    }
}
