//! Goes through the clauses of a rule for one object that it could set a property of.

use super::tests_of::{Part, TestsOf};
use crate::knowledge::KnowledgeBase;
use crate::machine::Machine;
use crate::machine::evaluate::Batch;
use crate::machine::lane::{Frame, Lane, NO_ROW, Rows};
use crate::plan::node::Node;
use crate::rejection::{Rejected, Rejection};
use crate::rule::{Clause, LinkUse, PropertyName};
use crate::script::syntax::Quantifier;
use crate::value::{Cell, Truth, Value};

/// One rule, one object, and what was rejected so far.
pub(super) struct Walk<'w> {
    knowledge: &'w KnowledgeBase,
    machine: &'w Machine<'w>,
    tests: &'w [TestsOf],
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
        tests: &'w [TestsOf],
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
        let Some(clause) = machine.rule.clauses.get(number) else { return true };
        if let Some(link) = &clause.link {
            let row = self.linked(&clause.class, link, frame);
            return self.clause(number + 1, &bound(frame, number, row.map_or(Rows::Unbound, Rows::Same)));
        }
        // What does not pass is what `none`, `all`, `count` and `sum` leave aside: nobody asks for that.
        let noted = clause.quantifier.binds();
        let passing = self.passing(number, clause, frame, noted);
        match clause.quantifier {
            Quantifier::Each | Quantifier::Link => {
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

    /// The row of the object that a property of another names.
    fn linked(&self, class: &str, link: &LinkUse, frame: &Frame) -> Option<u32> {
        let of = &self.machine.rule.clauses[link.clause].class;
        let names = self.knowledge.column(&PropertyName::new(of, &link.property))?;
        let wanted = names.cell(frame.rows[link.clause].at(0) as usize);
        let table = &self.knowledge.held.get(class)?.table;
        let key = match &link.key {
            Some(key) => self.knowledge.column(&PropertyName::new(class, key))?,
            None => &table.columns[*table.key.first()?],
        };
        (0..table.len as u32).find(|&row| wanted != Cell::Unknown && key.cell(row as usize) == wanted)
    }

    /// The objects that pass `where`.
    fn passing(&mut self, number: usize, clause: &Clause, frame: &Frame, noted: bool) -> Passing {
        let own = clause.quantifier == Quantifier::Each && self.target.0 == number;
        let (from, to) = match self.target.1 {
            row if own => (row, row + 1),
            _ => (0, self.knowledge.len(&clause.class).unwrap_or(0) as u32),
        };
        let mut passing = Passing { rows: vec![], unknown: 0, objects: (to - from) as usize };
        for row in from..to {
            if self.budget == 0 || self.machine.tick().is_err() {
                self.truncated = true;
                break;
            }
            self.budget -= 1;
            let frame = bound(frame, number, Rows::Same(row));
            match self.first_untrue(&self.tests[number].condition, &frame) {
                None => passing.rows.push(row),
                Some(reason) => {
                    passing.unknown += usize::from(matches!(reason, Rejection::Unknown { .. }));
                    if noted {
                        self.reject(clause, Some(row), reason);
                    }
                }
            }
        }
        passing
    }

    /// The object that is taken; the others are rejected.
    fn winner(&mut self, number: usize, clause: &Clause, frame: &Frame, passing: &Passing) -> Option<u32> {
        let tests = self.tests;
        let Some(by) = tests[number].by.as_ref().filter(|_| clause.quantifier != Quantifier::Some) else {
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
        let mut holds = passing.unknown == 0;
        for &row in &passing.rows {
            let frame = bound(frame, number, Rows::Same(row));
            if let Some(reason) = self.first_untrue(&self.tests[number].have, &frame) {
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
        match (&self.tests[number].by, clause.quantifier) {
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
    fn first_untrue(&self, parts: &[Part], frame: &Frame) -> Option<Rejection> {
        let truth = |part: &Part| self.machine.evaluate(&part.node, one(frame)).truths().at(0);
        let mut unknown = None;
        for part in parts {
            match truth(part) {
                Truth::True => {}
                Truth::Unknown => unknown = unknown.or(Some(part)),
                Truth::False => {
                    let (left, right) = self.sides(part, frame);
                    return Some(Rejection::Failed { test: part.text.clone(), left, right });
                }
            }
        }
        let part = unknown?;
        let (left, right) = self.sides(part, frame);
        Some(Rejection::Unknown { test: part.text.clone(), left, right })
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

fn one(frame: &Frame) -> Batch<'_> {
    Batch { frame, slots: &[], mask: None }
}

fn bound(frame: &Frame, number: usize, rows: Rows) -> Frame {
    let mut next = frame.clone();
    next.rows[number] = rows;
    next
}
