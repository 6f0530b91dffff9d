//! Goes through the clauses of a rule for one object that it could set a property of: the machine says who is bound, and
//! the parts of each `where` say why the others are not.

use std::ops::Range;

use rhai::Expr;

use crate::knowledge::KnowledgeBase;
use crate::machine::candidates::Candidates;
use crate::machine::evaluate::Batch;
use crate::machine::lane::{Frame, NO_ROW, Rows};
use crate::machine::search::{Drivers, Search};
use crate::machine::{BATCH, Machine};
use crate::plan::clause::parts;
use crate::plan::node::{Comparison, Node};
use crate::plan::{Effect, Plan};
use crate::rejection::{Rejected, Rejection};
use crate::rule::{Action, Clause};
use crate::script::syntax::Quantifier;
use crate::script::wording::wording;
use crate::value::{Cell, Truth};

/// In a class of more objects, those that an equation keeps apart from the binding are no candidates.
const FEW_OBJECTS: usize = 50;

/// One rule, one object, and what was rejected so far.
pub(super) struct Walk<'w> {
    pub(super) knowledge: &'w KnowledgeBase,
    pub(super) machine: &'w Machine<'w>,
    pub(super) plan: &'w Plan,
    pub(super) candidates: &'w [Option<&'w Candidates>],
    /// The clause that stands for the object, and its row.
    pub(super) target: (usize, u32),
    pub(super) budget: usize,
    pub(super) rejected: Vec<Rejected>,
    pub(super) truncated: bool,
}

/// The first part that an object does not pass, and whether that is false or unknown.
type Untrue = Option<(usize, Truth)>;

impl Walk<'_> {
    pub(super) fn run(&mut self) -> bool {
        let frame = Frame { len: 1, rows: vec![Rows::Unbound; self.plan.clauses.len()] };
        self.clause(0, &frame)
    }

    /// Whether any binding from this clause on fires.
    fn clause(&mut self, number: usize, frame: &Frame) -> bool {
        let Some(clause) = self.machine.rule.clauses.get(number) else { return self.rows(frame) };
        if let Some(link) = &clause.link {
            return self.link(number, link.clause, frame);
        }
        let target = Some(self.target.1).filter(|_| self.target.0 == number);
        let size = self.knowledge.len(&clause.class).unwrap_or(0) as u32;
        let objects = match target {
            Some(row) if clause.quantifier == Quantifier::Each => row..row + 1,
            _ => 0..size,
        };
        let unmet = Rejection::Unmet { objects: objects.len() };
        let next = self.next(number, frame, &objects);
        // What does not pass `none`, `all`, `count` and `sum` nobody asks for.
        let asked = clause.quantifier.binds() || next.is_empty();
        let passing = if asked { self.passing(number, frame, objects) } else { vec![] };
        match (clause.quantifier, next.first()) {
            (Quantifier::Each, _) => {
                if passing.is_empty() && target.is_none() {
                    self.reject(clause, None, unmet);
                }
                let mut applied = false;
                for next in &next {
                    applied |= self.clause(number + 1, next);
                }
                applied
            }
            (_, Some(next)) => {
                let winner = next.rows[number].at(0);
                if winner != NO_ROW {
                    self.losers(number, frame, &passing, winner);
                }
                (winner == NO_ROW || target.is_none_or(|row| row == winner)) && self.clause(number + 1, next)
            }
            (Quantifier::None, None) => {
                if let Some(&row) = passing.first() {
                    self.reject(clause, Some(row), Rejection::Found);
                }
                false
            }
            (_, None) => {
                self.without(number, frame, &passing);
                self.reject(clause, None, unmet);
                false
            }
        }
    }

    /// The bindings that go on from this one, each by itself.
    fn next(&mut self, number: usize, frame: &Frame, objects: &Range<u32>) -> Vec<Frame> {
        let search =
            Search::new(self.machine, self.plan, &self.plan.clauses[..=number], self.candidates.to_vec());
        let each = self.plan.clauses[number].quantifier == Quantifier::Each;
        let drivers = match number {
            0 if each => Drivers::Range(objects.start, objects.end),
            _ => Drivers::Bound(number, frame.clone()),
        };
        let Ok(found) = search.bindings(drivers, usize::MAX) else {
            self.truncated = true;
            return vec![];
        };
        let single = found.iter().flat_map(|found| (0..found.len).map(|index| found.repeat(index, 1)));
        single.filter(|frame| !each || objects.contains(&frame.rows[number].at(0))).collect()
    }

    /// Goes through a link to the object that a property of clause `from` names; what is asked after that is asked of
    /// that clause's object.
    fn link(&mut self, number: usize, from: usize, frame: &Frame) -> bool {
        let search =
            Search::new(self.machine, self.plan, &self.plan.clauses[..=number], self.candidates.to_vec());
        let named = search.groups(number, &self.plan.clauses[number], frame);
        let named = named.first().and_then(|rows| rows.first());
        let frame = bound(frame, number, named.map_or(Rows::Unbound, |&row| Rows::Same(row)));
        let parts = &self.plan.clauses[number].parts;
        let Some((at, truth)) = self.untrue(parts, &frame)[0] else { return self.clause(number + 1, &frame) };
        let rule = self.machine.rule;
        let reason = self.reason(parts, &texts(&rule.clauses[number]), (at, truth), &frame);
        self.reject(&rule.clauses[from], Some(frame.rows[from].at(0)), reason);
        false
    }

    /// The objects that pass `where`; the others are rejected where the clause binds one.
    fn passing(&mut self, number: usize, frame: &Frame, objects: Range<u32>) -> Vec<u32> {
        let clause = &self.machine.rule.clauses[number];
        let (parts, texts) = (&self.plan.clauses[number].parts, texts(clause));
        let named = self.target.0 == number || objects.len() <= FEW_OBJECTS;
        let mut passing = vec![];
        for chunk in objects.collect::<Vec<u32>>().chunks(BATCH) {
            if self.machine.tick().is_err() {
                self.truncated = true;
                break;
            }
            let tried = of_objects(frame, number, chunk);
            for (&row, untrue) in chunk.iter().zip(self.untrue(parts, &tried)) {
                match untrue {
                    None => passing.push(row),
                    Some((at, _)) if !clause.quantifier.binds() || !named && joins(&parts[at]) => {}
                    Some(untrue) => {
                        let reason =
                            self.reason(parts, &texts, untrue, &bound(frame, number, Rows::Same(row)));
                        self.reject(clause, Some(row), reason);
                    }
                }
            }
        }
        passing
    }

    fn losers(&mut self, number: usize, frame: &Frame, passing: &[u32], winner: u32) {
        let clause = &self.machine.rule.clauses[number];
        let key = self.key(clause, winner);
        let ranked = self.plan.clauses[number].by.as_ref().zip(clause.by.as_ref());
        let values = ranked.map(|(by, _)| {
            let tried = of_objects(frame, number, passing);
            let values = self.machine.values(by, &tried).numbers();
            (0..tried.len).map(|index| values.at(index)).collect::<Vec<f64>>()
        });
        let best = passing.iter().position(|&row| row == winner);
        for (at, &row) in passing.iter().enumerate().filter(|(_, row)| **row != winner) {
            let winner = key.clone();
            let reason = match (ranked, &values, best) {
                (Some((_, by)), Some(values), _) if values[at].is_nan() => {
                    Rejection::Unranked { by: wording(by) }
                }
                (Some((_, by)), Some(values), Some(best)) => {
                    Rejection::Lost { by: wording(by), value: values[at], winner, winner_value: values[best] }
                }
                _ => Rejection::Later { winner },
            };
            self.reject(clause, Some(row), reason);
        }
    }

    fn without(&mut self, number: usize, frame: &Frame, passing: &[u32]) {
        let clause = &self.machine.rule.clauses[number];
        let (Some(have), Some(asked)) = (self.plan.clauses[number].have.clone(), &clause.have) else {
            return;
        };
        let (have, texts) = (parts(have), in_parts(asked));
        let tried = of_objects(frame, number, passing);
        for (&row, untrue) in passing.iter().zip(self.untrue(&have, &tried)) {
            if let Some(untrue) = untrue {
                let reason = self.reason(&have, &texts, untrue, &bound(frame, number, Rows::Same(row)));
                self.reject(clause, Some(row), reason);
            }
        }
    }

    /// Whether the rule goes on to conclude: always, but for a table, of which a row must match.
    fn rows(&mut self, frame: &Frame) -> bool {
        let (Action::Table(table), Effect::Conclude { then, .. }) =
            (&self.machine.rule.action, &self.plan.effect)
        else {
            return true;
        };
        // The first steps of a table look at its inputs, one each.
        let inputs = then.steps.iter().take(table.given.len());
        let inputs: Vec<Cell> = inputs.map(|step| self.machine.values(step.value(), frame).cell(0)).collect();
        let misses = table.misses(&inputs, &self.knowledge.symbols.read());
        for (row, column) in misses.iter().enumerate().filter_map(|(row, column)| Some((row, (*column)?))) {
            let reason = Rejection::Row {
                row: row + 1,
                input: table.given[column].1.clone(),
                cell: table.rows[row].tests[column].0.to_string(),
                value: self.knowledge.host_value(inputs[column]),
            };
            self.rejected.push(Rejected::of_rule(self.machine.rule, reason));
        }
        misses.contains(&None)
    }

    /// For each binding the first part that is false; where there is none, the first that is unknown.
    fn untrue(&self, parts: &[Node], frame: &Frame) -> Vec<Untrue> {
        let mut found: Vec<Untrue> = vec![None; frame.len];
        for (at, part) in parts.iter().enumerate() {
            let open: Vec<bool> =
                found.iter().map(|found| !matches!(found, Some((_, Truth::False)))).collect();
            let truths = self.machine.evaluate(part, Batch { frame, slots: &[], mask: Some(&open) }).truths();
            for (index, found) in found.iter_mut().enumerate().filter(|(index, _)| open[*index]) {
                match truths.at(index) {
                    Truth::True => {}
                    Truth::False => *found = Some((at, Truth::False)),
                    Truth::Unknown => *found = found.or(Some((at, Truth::Unknown))),
                }
            }
        }
        found
    }

    fn reason(
        &self,
        parts: &[Node],
        texts: &[String],
        (at, truth): (usize, Truth),
        frame: &Frame,
    ) -> Rejection {
        let value = |node| self.knowledge.host_value(self.machine.values(node, frame).cell(0));
        let (left, right) = match &parts[at] {
            Node::Compare(_, left, right) => (value(left), value(right)),
            _ => (None, None),
        };
        let test = texts.get(at).cloned().unwrap_or_default();
        match truth {
            Truth::False => Rejection::Failed { test, left, right },
            _ => Rejection::Unknown { test, left, right },
        }
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
            ..Rejected::of_rule(self.machine.rule, reason)
        };
        self.rejected.push(rejected);
    }
}

fn bound(frame: &Frame, number: usize, rows: Rows) -> Frame {
    let mut next = frame.clone();
    next.rows[number] = rows;
    next
}

fn of_objects(frame: &Frame, number: usize, rows: &[u32]) -> Frame {
    bound(&frame.repeat(0, rows.len()), number, Rows::Each(rows.to_vec()))
}

/// Whether a part is an equation between the clause's object and what was bound before.
fn joins(part: &Node) -> bool {
    let Node::Compare(Comparison::Equal, a, b) = part else { return false };
    let (a, b) = (a.variables(), b.variables());
    a & b == 0 && a != 0 && b != 0
}

/// The parts of `where`, as the rule writes them.
fn texts(clause: &Clause) -> Vec<String> {
    let of_class = clause.conditions.iter().map(|condition| &condition.expr);
    of_class.chain(&clause.condition).flat_map(in_parts).collect()
}

fn in_parts(expr: &Expr) -> Vec<String> {
    match expr {
        Expr::And(parts, _) => parts.iter().flat_map(in_parts).collect(),
        part => vec![wording(part)],
    }
}
