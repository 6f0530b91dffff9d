//! Finds bindings: depth first, clause by clause, each condition as soon as it can be tested.

use std::time::Instant;

use super::evaluate::{Bound, Evaluator};
use super::program::{Program, Step, Visit};
use crate::machine::lane::NO_ROW;
use crate::script::syntax::Quantifier;
use crate::value::Truth;

/// Why matching was stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Halt {
    /// It took too long.
    Late,
    /// There are more matches than may be kept.
    Full,
}

/// What a search does with the bindings that it finds.
pub(crate) type Sink<'s> = &'s mut dyn FnMut(&Bound) -> Result<(), Halt>;

/// A search in one rule.
pub(crate) struct Search<'s> {
    pub(crate) evaluator: Evaluator<'s>,
    pub(crate) program: &'s Program,
    pub(crate) deadline: Instant,
    pub(crate) looked_at: u32,
    /// A clause whose conditions need not be true: unknown is enough.
    pub(crate) lenient: Option<usize>,
}

impl Search<'_> {
    /// Nothing bound.
    pub(crate) fn unbound(&self) -> Bound {
        let clauses = self.program.clauses.len();
        Bound { ids: vec![NO_ROW; clauses], numbers: vec![f64::NAN; clauses] }
    }

    /// All bindings of the rule.
    pub(crate) fn all(&mut self, sink: Sink) -> Result<(), Halt> {
        let mut bound = self.unbound();
        let path = &self.program.full;
        if self.passes(&path.first, &bound) { self.run(&path.steps, &mut bound, sink) } else { Ok(()) }
    }

    /// All bindings in which a clause has this object; for a clause that is decided, all bindings of the clauses
    /// before it to which the object matters.
    pub(crate) fn with(&mut self, clause: usize, id: u32, sink: Sink) -> Result<(), Halt> {
        let mut bound = self.unbound();
        bound.ids[clause] = id;
        let path = &self.program.from[clause];
        self.lenient = self.program.clauses[clause].minds_unknowns().then_some(clause);
        let done =
            if self.passes(&path.first, &bound) { self.run(&path.steps, &mut bound, sink) } else { Ok(()) };
        self.lenient = None;
        done
    }

    /// All bindings that go on from those of the clauses before.
    pub(crate) fn after(&mut self, clause: usize, mut bound: Bound, sink: Sink) -> Result<(), Halt> {
        let steps = &self.program.full.steps[clause..];
        self.run(steps, &mut bound, sink)
    }

    fn run(&mut self, steps: &[Step], bound: &mut Bound, sink: Sink) -> Result<(), Halt> {
        let Some((step, rest)) = steps.split_first() else { return sink(bound) };
        match step.visit {
            Visit::Given => self.run(rest, bound, sink),
            Visit::Decide => {
                if self.decide(step, bound)? && self.passes(&step.tests, bound) {
                    self.run(rest, bound, sink)?;
                }
                bound.ids[step.clause] = NO_ROW;
                Ok(())
            }
            Visit::Each => {
                let (known, unknown) = self.candidates(step, bound, self.lenient.is_some());
                for &id in known.iter().chain(unknown) {
                    self.tick()?;
                    bound.ids[step.clause] = id;
                    if self.passes(&step.tests, bound) {
                        self.run(rest, bound, sink)?;
                    }
                }
                bound.ids[step.clause] = NO_ROW;
                Ok(())
            }
        }
    }

    fn tick(&mut self) -> Result<(), Halt> {
        self.looked_at = self.looked_at.wrapping_add(1);
        let late = self.looked_at.is_multiple_of(4096) && Instant::now() > self.deadline;
        if late { Err(Halt::Late) } else { Ok(()) }
    }

    fn passes(&self, tests: &[usize], bound: &Bound) -> bool {
        tests.iter().all(|&test| {
            let conjunct = &self.program.conjuncts[test];
            match self.evaluator.truth(&conjunct.node, bound) {
                Truth::True => true,
                Truth::Unknown => self.lenient == Some(conjunct.clause),
                Truth::False => false,
            }
        })
    }
}

impl<'s> Search<'s> {
    /// The candidates of a step, by index where there is one. With `unknowns` also those that may pass, as far
    /// as is known, apart from the others.
    fn candidates(&self, step: &Step, bound: &Bound, unknowns: bool) -> (&'s [u32], &'s [u32]) {
        let world = self.evaluator.world;
        let all: &[u32] = &world.classes[self.program.clauses[step.clause].class].ids;
        let Some(find) = &step.find else { return (all, &[]) };
        let keys = find.keys.iter().map(|&key| self.evaluator.cell(self.program.key(key), bound));
        let index = &world.indexes[find.index];
        match (index.find(keys), unknowns) {
            (Some(known), true) => (known, index.unknown()),
            (Some(known), false) => (known, &[]),
            (None, true) => (all, &[]),
            (None, false) => (&[], &[]),
        }
    }

    /// Whether a clause is met; binds its witness or its number.
    pub(crate) fn decide(&mut self, step: &Step, bound: &mut Bound) -> Result<bool, Halt> {
        let clause = &self.program.clauses[step.clause];
        if clause.minds_unknowns() {
            return self.tally(step, bound);
        }
        if clause.quantifier == Quantifier::Link && step.find.is_none() {
            return Ok(true);
        }
        let mut best: Option<(u32, f64)> = None;
        for &id in self.candidates(step, bound, false).0 {
            self.tick()?;
            bound.ids[step.clause] = id;
            if !self.passes(&step.own, bound) {
                continue;
            }
            let Some(by) = &clause.by else {
                best = Some((id, 0.0));
                break;
            };
            let value = self.evaluator.number(by, bound);
            let better = |least: f64| match clause.quantifier {
                Quantifier::Most => value > least,
                _ => value < least,
            };
            if !value.is_nan() && best.is_none_or(|(_, least)| better(least)) {
                best = Some((id, value));
            }
        }
        if clause.quantifier == Quantifier::None {
            bound.ids[step.clause] = NO_ROW;
            return Ok(best.is_none());
        }
        bound.ids[step.clause] = best.map_or(NO_ROW, |(id, _)| id);
        // A link that leads nowhere leaves its object unknown.
        Ok(best.is_some() || clause.quantifier == Quantifier::Link)
    }

    /// `count`, `sum` and `all`: a candidate of which it is unknown whether it counts makes the whole unknown.
    fn tally(&mut self, step: &Step, bound: &mut Bound) -> Result<bool, Halt> {
        let clause = &self.program.clauses[step.clause];
        let (known, unknown) = self.candidates(step, bound, true);
        let (mut passed, mut amounts, mut open) = (0.0, vec![], false);
        for &id in known.iter().chain(unknown) {
            self.tick()?;
            bound.ids[step.clause] = id;
            let passes =
                clause.whole.as_ref().map_or(Truth::True, |whole| self.evaluator.truth(whole, bound));
            if passes == Truth::False {
                continue;
            }
            if let Some(have) = &clause.have {
                match passes.not().max(self.evaluator.truth(have, bound)) {
                    Truth::True => {}
                    Truth::Unknown => open = true,
                    Truth::False => {
                        bound.ids[step.clause] = NO_ROW;
                        return Ok(false);
                    }
                }
                continue;
            }
            let amount = clause.by.as_ref().map_or(0.0, |by| self.evaluator.number(by, bound));
            if passes == Truth::Unknown || amount.is_nan() {
                open = true;
            } else {
                passed += 1.0;
                amounts.push(amount);
            }
        }
        bound.ids[step.clause] = NO_ROW;
        if clause.quantifier == Quantifier::All {
            return Ok(!open);
        }
        // In the order of their size, so that the order of rows does not reach the sum.
        amounts.sort_by(f64::total_cmp);
        let number = if clause.quantifier == Quantifier::Sum { amounts.iter().sum() } else { passed };
        bound.numbers[step.clause] = if open { f64::NAN } else { number };
        Ok(true)
    }
}
