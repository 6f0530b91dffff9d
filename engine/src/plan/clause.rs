//! Clauses made ready: what an index answers, what is tested once for the class, what for each binding.

use std::sync::Arc;

use super::link::{self, Join};
use super::lower::Lowering;
use super::node::{Comparison, Node};
use crate::script::syntax::Quantifier;
use crate::value::Type;

/// A comparison that has the candidate on its left side alone, and the variables before it on its right.
#[derive(Clone, Debug)]
pub(crate) struct Threshold {
    pub(crate) comparison: Comparison,
    pub(crate) candidate: Node,
    pub(crate) binding: Node,
}

#[derive(Clone, Debug)]
pub(crate) struct ClausePlan {
    /// Its number among the clauses of the rule, which is that of its variable too.
    pub(crate) variable: usize,
    pub(crate) quantifier: Quantifier,
    /// The parts of `where`, as the rule writes them.
    pub(crate) parts: Vec<Node>,
    pub(crate) joins: Vec<Join>,
    /// The part of `where` that looks at this clause's object alone.
    pub(crate) own: Option<Node>,
    pub(crate) test: Option<Node>,
    /// What must be true once an object is bound, whichever was chosen.
    pub(crate) after: Option<Node>,
    /// Whether an `each` also takes objects that the joins may find as far as is known.
    pub(crate) perhaps: bool,
    pub(crate) by: Option<Node>,
    /// Whether `by` looks at this clause's object alone. Never of `sum`, where `by` does not rank.
    pub(crate) by_own: bool,
    /// All of `where`, for clauses that must know which objects are undecided.
    pub(crate) whole: Option<Node>,
    /// What must be true of each object that passes `all`.
    pub(crate) have: Option<Node>,
    /// `test`, where it is such comparisons and nothing else.
    pub(crate) thresholds: Vec<Threshold>,
}

impl ClausePlan {
    /// Whether an object counts of which it is unknown whether it passes.
    pub(crate) fn minds_unknowns(&self) -> bool {
        self.quantifier.counts() || self.quantifier == Quantifier::All
    }
}

pub(crate) fn clauses(lowering: &mut Lowering) -> Vec<ClausePlan> {
    let rule = lowering.rule;
    let mut plans = vec![];
    for (index, clause) in rule.clauses.iter().enumerate() {
        lowering.enter(Some(index));
        let of_class = of_class(lowering, index);
        let by = clause.by.as_ref().map(|by| {
            lowering.own = Some(index);
            let node = lowering.wanted(by, Type::Number);
            lowering.own = None;
            node
        });
        let condition = clause.condition.as_ref().map(|condition| lowering.wanted(condition, Type::Truth));
        let parts: Vec<Node> = of_class.into_iter().chain(condition).flat_map(parts).collect();
        let have = clause.have.as_ref().map(|have| lowering.wanted(have, Type::Truth));
        let undecided_counts =
            clause.quantifier.counts() || clause.quantifier == Quantifier::All || rule.hypothesis.is_some();
        let mut plan = ClausePlan {
            variable: index,
            quantifier: clause.quantifier,
            joins: vec![],
            own: None,
            test: None,
            after: None,
            perhaps: false,
            by_own: clause.quantifier != Quantifier::Sum
                && by.as_ref().is_none_or(|by| by.variables() & !(1 << index) == 0),
            by,
            whole: if undecided_counts { all(parts.clone()) } else { None },
            have,
            thresholds: vec![],
            parts,
        };
        if let Some(link) = &clause.link {
            // A link's condition looks at the object before, which is bound; it is tested after the link.
            plan.joins.extend(link::join(lowering, index, link));
            plan.after = all(plan.parts.clone());
        } else {
            split(index, &mut plan);
        }
        plan.thresholds = plan.test.as_ref().and_then(|test| thresholds(test, index)).unwrap_or_default();
        plans.push(plan);
    }
    plans
}

/// What makes the clause's object one of the class that the rule names.
fn of_class(lowering: &mut Lowering, index: usize) -> Vec<Node> {
    let rule = lowering.rule;
    let own_file = Arc::clone(&lowering.file);
    lowering.own = Some(index);
    let conditions = rule.clauses[index].conditions.iter();
    let nodes = conditions
        .map(|condition| {
            lowering.file = Arc::clone(&condition.file);
            lowering.wanted(&condition.expr, Type::Truth)
        })
        .collect();
    lowering.own = None;
    lowering.file = own_file;
    nodes
}

pub(crate) fn parts(condition: Node) -> Vec<Node> {
    match condition {
        Node::And(parts) => parts,
        other => vec![other],
    }
}

fn split(index: usize, plan: &mut ClausePlan) {
    let (mut own, mut test) = (vec![], vec![]);
    for part in plan.parts.clone() {
        match part {
            part if part.variables() & !(1 << index) == 0 => own.push(part),
            Node::Compare(Comparison::Equal, a, b) => match join(*a, *b, index) {
                Ok(join) => plan.joins.push(join),
                Err((a, b)) => test.push(Node::Compare(Comparison::Equal, Box::new(a), Box::new(b))),
            },
            part => test.push(part),
        }
    }
    plan.own = all(own);
    plan.test = all(test);
}

/// The equation as a join, if one of its sides is a property of the clause's object and the other does without it.
pub(super) fn join(a: Node, b: Node, index: usize) -> Result<Join, (Node, Node)> {
    let free = |node: &Node| node.variables() & (1 << index) == 0 && !node.interprets();
    match (a, b) {
        (Node::Property { variable, column }, key) if variable == index && free(&key) => {
            Ok(Join { column, key })
        }
        (key, Node::Property { variable, column }) if variable == index && free(&key) => {
            Ok(Join { column, key })
        }
        other => Err(other),
    }
}

pub(super) fn all(mut parts: Vec<Node>) -> Option<Node> {
    if parts.len() > 1 { Some(Node::And(parts)) } else { parts.pop() }
}

fn thresholds(test: &Node, index: usize) -> Option<Vec<Threshold>> {
    let parts = if let Node::And(parts) = test { parts.as_slice() } else { std::slice::from_ref(test) };
    parts.iter().map(|part| threshold(part, index)).collect()
}

fn threshold(part: &Node, index: usize) -> Option<Threshold> {
    let Node::Compare(comparison, a, b) = part else { return None };
    let alone = |node: &Node| node.variables() == 1 << index && !node.interprets();
    let apart = |node: &Node| node.variables() & (1 << index) == 0 && !node.interprets();
    let (comparison, candidate, binding) = if alone(a) && apart(b) {
        (*comparison, a, b)
    } else if alone(b) && apart(a) {
        (comparison.turned(), b, a)
    } else {
        return None;
    };
    Some(Threshold { comparison, candidate: (**candidate).clone(), binding: (**binding).clone() })
}
