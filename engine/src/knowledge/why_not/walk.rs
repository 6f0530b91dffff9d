//! Goes through the clauses of a rule for one object that it could set a property of.

use super::tests_of::{Part, TestsOfRule};
use crate::knowledge::KnowledgeBase;
use crate::machine::Machine;
use crate::machine::evaluate::Batch;
use crate::machine::lane::{Frame, Lane, NO_ROW, Rows};
use crate::plan::node::Node;
use crate::rejection::{Rejected, Rejection};
use crate::rule::Clause;
use crate::script::syntax::Quantifier;
use crate::value::{Truth, Value};

/// In a class of more objects, those that an equation keeps apart from the binding are no candidates.
const FEW_OBJECTS: usize = 50;

/// One rule, one object, and what was rejected so far.
pub(super) struct Walk<'w> {
    pub(super) knowledge: &'w KnowledgeBase,
    pub(super) machine: &'w Machine<'w>,
    pub(super) tests: &'w TestsOfRule,
    /// The clause that stands for the object, and its row.
    target: (usize, u32),
    budget: usize,
    pub(super) rejected: Vec<Rejected>,
    pub(super) truncated: bool,
}

/// The objects of a clause that pass.
struct Passing {
    rows: Vec<u32>,
    /// How many objects an unknown kept out.
    unknown: usize,
    /// How many were looked at.
    objects: usize,
}

impl<'w> Walk<'w> {
    pub(super) fn new(
        knowledge: &'w KnowledgeBase,
        machine: &'w Machine<'w>,
        tests: &'w TestsOfRule,
        target: (usize, u32),
        budget: usize,
    ) -> Self {
        Self { knowledge, machine, tests, target, budget, rejected: vec![], truncated: false }
    }

    /// Whether the rule applies to the object.
    pub(super) fn run(&mut self) -> bool {
        let frame = Frame { len: 1, rows: vec![Rows::Unbound; self.machine.rule.clauses.len()] };
        self.clause(0, &frame)
    }

    /// Whether any binding from this clause on fires.
    fn clause(&mut self, number: usize, frame: &Frame) -> bool {
        let machine = self.machine;
        let Some(clause) = machine.rule.clauses.get(number) else { return self.rows(frame) };
        if let Some(link) = &clause.link {
            return self.link(number, link.clause, frame);
        }
        let passing = self.passing(number, clause, frame);
        match clause.quantifier {
            Quantifier::Each => {
                if passing.rows.is_empty() && self.target.0 != number {
                    self.reject(clause, None, Rejection::Unmet { objects: passing.objects });
                }
                let mut applied = false;
                for &row in &passing.rows {
                    applied |= self.clause(number + 1, &bound(frame, number, Rows::Same(row)));
                }
                applied
            }
            Quantifier::Least | Quantifier::Most | Quantifier::Some => {
                let winner = self.winner(number, clause, frame, &passing);
                let Some(row) = winner else {
                    self.reject(clause, None, Rejection::Unmet { objects: passing.objects });
                    return false;
                };
                let taken = self.target.0 != number || self.target.1 == row;
                taken && self.clause(number + 1, &bound(frame, number, Rows::Same(row)))
            }
            // Goes with `link` above.
            Quantifier::Link => self.clause(number + 1, frame),
            Quantifier::None => match passing.rows.first() {
                Some(&row) => {
                    self.reject(clause, Some(row), Rejection::Found);
                    false
                }
                None => self.clause(number + 1, frame),
            },
            Quantifier::All => {
                let holds = self.all_have(number, clause, frame, &passing);
                if !holds {
                    self.reject(clause, None, Rejection::Unmet { objects: passing.objects });
                }
                holds && self.clause(number + 1, frame)
            }
            Quantifier::Count | Quantifier::Sum => {
                let total = self.total(number, clause, frame, &passing);
                self.clause(number + 1, &bound(frame, number, Rows::Numbers(Lane::Same(total))))
            }
        }
    }

    /// Goes through a link to the object that a property of clause `from` names; what is asked after that is asked of
    /// that clause's object.
    fn link(&mut self, number: usize, from: usize, frame: &Frame) -> bool {
        let rule = self.machine.rule;
        let tests = &self.tests.clauses[number];
        let objects = self.knowledge.len(&rule.clauses[number].class).unwrap_or(0) as u32;
        let named = |row: &u32| {
            let frame = bound(frame, number, Rows::Same(*row));
            tests.link.as_ref().is_some_and(|link| self.truth(link, &frame) == Truth::True)
        };
        let named = (0..objects).take_while(|_| self.machine.tick().is_ok()).find(named);
        let frame = bound(frame, number, named.map_or(Rows::Unbound, Rows::Same));
        match self.first_untrue(&tests.condition, &frame) {
            None => self.clause(number + 1, &frame),
            Some((_, reason)) => {
                self.reject(&rule.clauses[from], Some(frame.rows[from].at(0)), reason);
                false
            }
        }
    }

    /// The objects that pass `where`.
    fn passing(&mut self, number: usize, clause: &Clause, frame: &Frame) -> Passing {
        let target = self.target.0 == number;
        let (from, to) = match self.target.1 {
            row if target && clause.quantifier == Quantifier::Each => (row, row + 1),
            _ => (0, self.knowledge.len(&clause.class).unwrap_or(0) as u32),
        };
        let mut passing = Passing { rows: vec![], unknown: 0, objects: (to - from) as usize };
        // What does not pass `none`, `all`, `count` and `sum` nobody asks for.
        let noted = clause.quantifier.binds();
        let tests = self.tests;
        let few = passing.objects <= FEW_OBJECTS;
        for row in from..to {
            if self.machine.tick().is_err() {
                self.truncated = true;
                break;
            }
            let frame = bound(frame, number, Rows::Same(row));
            let Some((part, reason)) = self.first_untrue(&tests.clauses[number].condition, &frame) else {
                passing.rows.push(row);
                continue;
            };
            passing.unknown += usize::from(matches!(reason, Rejection::Unknown { .. }));
            if noted && (target || few || !part.joins) {
                self.reject(clause, Some(row), reason);
            }
        }
        passing
    }

    /// The object that is taken; the others are rejected.
    fn winner(&mut self, number: usize, clause: &Clause, frame: &Frame, passing: &Passing) -> Option<u32> {
        let tests = self.tests;
        let Some(by) = tests.clauses[number].by.as_ref().filter(|_| clause.quantifier != Quantifier::Some)
        else {
            let (&winner, others) = passing.rows.split_first()?;
            let key = self.key(clause, winner);
            for &row in others {
                self.reject(clause, Some(row), Rejection::Later { winner: key.clone() });
            }
            return Some(winner);
        };
        let number_of = |row: u32| self.number(&by.node, &bound(frame, number, Rows::Same(row)));
        let values: Vec<(u32, f64)> = passing.rows.iter().map(|&row| (row, number_of(row))).collect();
        let better = |a: f64, b: f64| if clause.quantifier == Quantifier::Most { a > b } else { a < b };
        let known = values.iter().filter(|(_, value)| !value.is_nan());
        let (winner, best) =
            known.copied().reduce(|best, next| if better(next.1, best.1) { next } else { best })?;
        let key = self.key(clause, winner);
        for (row, value) in values.into_iter().filter(|(row, _)| *row != winner) {
            let by = by.text.clone();
            let reason = if value.is_nan() {
                Rejection::Unranked { by }
            } else {
                Rejection::Lost { by, value, winner: key.clone(), winner_value: best }
            };
            self.reject(clause, Some(row), reason);
        }
        Some(winner)
    }

    /// Whether all that pass have what is asked; those that do not are rejected.
    fn all_have(&mut self, number: usize, clause: &Clause, frame: &Frame, passing: &Passing) -> bool {
        let tests = self.tests;
        let mut holds = passing.unknown == 0;
        for &row in &passing.rows {
            let frame = bound(frame, number, Rows::Same(row));
            if let Some((_, reason)) = self.first_untrue(&tests.clauses[number].have, &frame) {
                holds = false;
                self.reject(clause, Some(row), reason);
            }
        }
        holds
    }

    /// What `count` or `sum` gives; NaN where that is unknown.
    fn total(&self, number: usize, clause: &Clause, frame: &Frame, passing: &Passing) -> f64 {
        if passing.unknown > 0 {
            return f64::NAN;
        }
        match (&self.tests.clauses[number].by, clause.quantifier) {
            (Some(by), Quantifier::Sum) => {
                let amount = |row: &u32| self.number(&by.node, &bound(frame, number, Rows::Same(*row)));
                let mut amounts: Vec<f64> = passing.rows.iter().map(amount).collect();
                amounts.sort_by(f64::total_cmp);
                amounts.iter().fold(0.0, |sum, amount| sum + amount)
            }
            _ => passing.rows.len() as f64,
        }
    }

    /// The first part that is false; where there is none, the first that is unknown.
    fn first_untrue<'p>(&self, parts: &'p [Part], frame: &Frame) -> Option<(&'p Part, Rejection)> {
        let mut unknown = None;
        for part in parts {
            match self.truth(part, frame) {
                Truth::True => {}
                Truth::Unknown => unknown = unknown.or(Some(part)),
                Truth::False => {
                    let (left, right) = self.sides(part, frame);
                    return Some((part, Rejection::Failed { test: part.text.clone(), left, right }));
                }
            }
        }
        let part = unknown?;
        let (left, right) = self.sides(part, frame);
        Some((part, Rejection::Unknown { test: part.text.clone(), left, right }))
    }

    fn truth(&self, part: &Part, frame: &Frame) -> Truth {
        self.machine.evaluate(&part.node, one(frame)).truths().at(0)
    }

    fn sides(&self, part: &Part, frame: &Frame) -> (Option<Value>, Option<Value>) {
        let value = |node| self.knowledge.host_value(self.machine.evaluate(node, one(frame)).cell(0));
        part.sides.as_ref().map_or((None, None), |(left, right)| (value(left), value(right)))
    }

    fn number(&self, node: &Node, frame: &Frame) -> f64 {
        self.machine.evaluate(node, one(frame)).numbers().at(0)
    }

    fn key(&self, clause: &Clause, row: u32) -> String {
        self.knowledge.key(&clause.class, row as usize).unwrap_or_default()
    }

    fn reject(&mut self, clause: &Clause, row: Option<u32>, reason: Rejection) {
        if row.is_some() {
            if self.budget == 0 {
                self.truncated = true;
                return;
            }
            self.budget -= 1;
        }
        let key = row.filter(|&row| row != NO_ROW).map(|row| self.key(clause, row));
        let rejected = Rejected {
            variable: Some(clause.variable.clone()),
            class: Some(clause.class.clone()),
            key,
            ..super::of_rule(self.machine.rule, reason)
        };
        self.rejected.push(rejected);
    }
}

pub(super) fn one(frame: &Frame) -> Batch<'_> {
    Batch { frame, slots: &[], mask: None }
}

fn bound(frame: &Frame, number: usize, rows: Rows) -> Frame {
    let mut next = frame.clone();
    next.rows[number] = rows;
    next
}
