//! Objects that a choice can never choose, since another stands before them wherever they would do.

use std::fmt;
use std::time::Instant;

use super::KnowledgeBase;
use crate::machine::Machine;
use crate::machine::lane::Frame;
use crate::plan::Plan;
use crate::plan::clause::ClausePlan;
use crate::plan::node::Comparison;
use crate::rule::Rule;
use crate::rule_base::{RuleBase, on_deep_stack};
use crate::script::syntax::Quantifier;
use crate::value::Cell;

/// Every object may have to be compared with every other of its class.
const MOST_OBJECTS: usize = 1_000;

/// An object that a `least` or `most` can never choose.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Dominated {
    pub rule: String,
    pub variable: String,
    pub class: String,
    pub key: String,
    /// The key of an object that passes wherever that one does, and comes before it.
    pub by: String,
}

/// One sentence, as in: `ROBOTS LIE can never be `first` in rule "weigh a door": SQUAT passes every test that it
/// passes, and comes before it`.
impl fmt::Display for Dominated {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { rule, variable, class, key, by } = self;
        write!(
            out,
            "{class} {key} can never be `{variable}` in rule \"{rule}\": {by} passes every test that it passes, and \
             comes before it"
        )
    }
}

impl KnowledgeBase {
    /// The objects that no `least` or `most` of these rules can ever choose as facts are, in the order of rules,
    /// clauses and rows: another one has a better value, or an equal one and an earlier row, and passes wherever
    /// they pass. It is looked for in clauses whose `where` compares the object with others by `<`, `<=`, `>`, `>=`
    /// and joins nothing, over classes of up to 1,000 objects. Asks of the knowledge base as the last inference left
    /// it.
    pub fn dominated(&mut self, rules: &RuleBase) -> Vec<Dominated> {
        // The interpreter may need more stack than the caller has.
        if self.network.base == Some(rules.id) { on_deep_stack(|| self.all_dominated(rules)) } else { vec![] }
    }

    fn all_dominated(&mut self, rules: &RuleBase) -> Vec<Dominated> {
        let until = self.limits.end(self.limits.inference);
        let mut found = vec![];
        for (rule, node) in rules.rules.iter().zip(&self.network.nodes) {
            let Some(planned) = node.planned.as_ref().filter(|_| node.needs.is_empty() && !rule.reacts())
            else {
                continue;
            };
            for number in 0..rule.clauses.len() {
                found.extend(self.dominated_in(rule, &planned.plan, number, until));
            }
        }
        found
    }

    fn dominated_in(&self, rule: &Rule, plan: &Plan, number: usize, until: Instant) -> Vec<Dominated> {
        let (clause, choice) = (&rule.clauses[number], &plan.clauses[number]);
        if !compares_alone(choice) || self.len(&clause.class) > Some(MOST_OBJECTS) {
            return vec![];
        }
        let machine = self.machine(rule, plan, until);
        let Some(candidates) = self.candidates(&machine, plan, number) else { return vec![] };
        let hurdles = hurdles(&machine, plan, number, &candidates.rows);
        let easier = |other: usize, one: usize| {
            hurdles.iter().all(|(comparison, cells)| at_least_as_easy(*comparison, cells[other], cells[one]))
        };
        let key = |at: usize| self.key(&clause.class, candidates.rows[at] as usize);
        let mut found: Vec<(u32, Dominated)> = vec![];
        for one in 1..candidates.rows.len() {
            // The best come first, so whoever stands in the way stands before.
            let Some(before) = (0..one).find(|&other| easier(other, one)) else { continue };
            if let (Some(key), Some(by)) = (key(one), key(before)) {
                let (rule, variable) = (rule.name.clone(), clause.variable.clone());
                let class = clause.class.clone();
                found.push((candidates.rows[one], Dominated { rule, variable, class, key, by }));
            }
        }
        found.sort_by_key(|(row, _)| *row);
        found.into_iter().map(|(_, dominated)| dominated).collect()
    }
}

/// Whether a clause chooses by the object's own value among those that pass comparisons, and nothing else.
fn compares_alone(clause: &ClausePlan) -> bool {
    matches!(clause.quantifier, Quantifier::Least | Quantifier::Most)
        && clause.by_own
        && clause.joins.is_empty()
        && !clause.thresholds.is_empty()
}

/// For each comparison the candidates' side of it.
fn hurdles(machine: &Machine, plan: &Plan, number: usize, rows: &[u32]) -> Vec<(Comparison, Vec<Cell>)> {
    let frame = Frame::of(plan.clauses.len(), number, rows);
    let cells = |candidate| {
        let lane = machine.values(candidate, &frame).cells();
        (0..frame.len).map(|at| lane.at(at)).collect()
    };
    let thresholds = plan.clauses[number].thresholds.iter();
    thresholds.map(|threshold| (threshold.comparison, cells(&threshold.candidate))).collect()
}

/// Whether whatever lets the one pass lets the other pass too. What is unknown passes nothing.
fn at_least_as_easy(comparison: Comparison, other: Cell, one: Cell) -> bool {
    match (comparison, other, one) {
        (Comparison::Less | Comparison::AtMost, Cell::Number(other), Cell::Number(one)) => other <= one,
        (Comparison::Greater | Comparison::AtLeast, Cell::Number(other), Cell::Number(one)) => other >= one,
        _ => other == one && other != Cell::Unknown,
    }
}
