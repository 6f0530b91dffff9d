//! Which columns a plan looks at, and through which variable.

use std::collections::BTreeSet;

use super::action::Step;
use super::clause::ClausePlan;
use super::fragment::{Fragment, Source};
use super::node::Node;
use super::{Effect, Plan};

/// Columns by the number of the variable through which they are read.
#[derive(Clone, Debug, Default)]
pub(crate) struct Uses {
    pub(crate) anywhere: Vec<BTreeSet<usize>>,
    /// In the variable's own clause: what decides whether it is bound.
    pub(crate) matching: Vec<BTreeSet<usize>>,
    /// In the variable's own clause, but for what its objects are compared by.
    pub(crate) passing: Vec<BTreeSet<usize>>,
}

impl Uses {
    pub(crate) fn of_clauses(clauses: &[ClausePlan]) -> Self {
        let none = || vec![BTreeSet::new(); clauses.len()];
        let mut uses = Self { anywhere: none(), matching: none(), passing: none() };
        for (number, clause) in clauses.iter().enumerate() {
            let mut found = vec![];
            for join in &clause.joins {
                found.push((number, join.column));
                properties(&join.key, &mut found);
            }
            for node in clause.own.iter().chain(&clause.test).chain(&clause.after).chain(&clause.have) {
                properties(node, &mut found);
            }
            let own = found.iter().filter(|(variable, _)| *variable == number);
            uses.passing[number].extend(own.map(|(_, column)| *column));
            clause.by.iter().for_each(|by| properties(by, &mut found));
            let own = found.iter().filter(|(variable, _)| *variable == number);
            uses.matching[number].extend(own.map(|(_, column)| *column));
            uses.add(&found);
        }
        uses
    }

    pub(crate) fn of(plan: &Plan) -> Self {
        let mut uses = Self::of_clauses(&plan.clauses);
        let mut found = vec![];
        plan.effect.actions().for_each(|action| of_steps(&action.steps, &mut found));
        if let Effect::Revise { amount: node, .. } | Effect::Default { value: node, .. } = &plan.effect {
            properties(node, &mut found);
        }
        uses.add(&found);
        uses
    }

    fn add(&mut self, found: &[(usize, usize)]) {
        for &(variable, column) in found {
            self.anywhere[variable].insert(column);
        }
    }
}

fn of_steps(steps: &[Step], found: &mut Vec<(usize, usize)>) {
    for step in steps {
        match step {
            Step::Put { value, .. } => properties(value, found),
            Step::If { condition, then, otherwise, .. } => {
                properties(condition, found);
                of_steps(then, found);
                of_steps(otherwise, found);
            }
            Step::Interpret(fragment) => of_fragment(fragment, found),
        }
    }
}

fn of_fragment(fragment: &Fragment, found: &mut Vec<(usize, usize)>) {
    found.extend(fragment.bare.iter().map(|&(_, variable, column)| (variable, column)));
    for object in fragment.objects.values() {
        for (_, source) in &object.properties {
            if let Source::Column(column) = source {
                found.push((object.variable, *column));
            }
        }
    }
}

fn properties(node: &Node, found: &mut Vec<(usize, usize)>) {
    node.walk(&mut |node| match node {
        Node::Property { variable, column } => found.push((*variable, *column)),
        Node::Interpret(fragment) => of_fragment(fragment, found),
        _ => {}
    });
}
