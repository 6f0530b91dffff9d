//! A rule that reacts, made ready for matching.

use super::world::{Facts, World};
use crate::plan::Plan;
use crate::plan::clause::ClausePlan;
use crate::plan::seeded::seeded;
use crate::plan::uses::Uses;
use crate::rule::{PropertyName, Reaction, Rule};
use crate::script::syntax::Quantifier;

#[derive(Debug)]
pub(crate) struct Clause {
    pub(crate) quantifier: Quantifier,
    pub(crate) class: usize,
    /// For its variable the columns that the rule reads.
    reads: Vec<usize>,
}

/// A search, and for each of its clauses the number of its candidates in the world.
#[derive(Debug)]
pub(crate) struct Path {
    pub(crate) clauses: Vec<ClausePlan>,
    pub(crate) candidates: Vec<usize>,
}

#[derive(Debug)]
pub(crate) struct Program {
    pub(crate) clauses: Vec<Clause>,
    pub(crate) plan: Plan,
    /// For each column of the plan its number in the world.
    pub(crate) columns: Vec<usize>,
    pub(crate) full: Path,
    /// For each clause the search that begins at an object of it.
    pub(crate) from: Vec<Path>,
}

impl Clause {
    pub(crate) fn reads_any(&self, columns: &[usize]) -> bool {
        columns.iter().any(|column| self.reads.contains(column))
    }
}

impl Program {
    pub(crate) fn new(
        rule: &Rule,
        reaction: &Reaction,
        plan: Plan,
        world: &mut World,
        facts: &dyn Facts,
    ) -> Self {
        let columns: Vec<usize> = plan.columns.iter().map(|name| world.column(name, facts)).collect();
        let uses = Uses::of_clauses(&plan.clauses);
        let mut clauses = vec![];
        for (number, plan) in plan.clauses.iter().enumerate() {
            let name = &rule.clauses[number].class;
            let class = world.class(name, facts);
            let read = reaction.reads.iter().filter(|(variable, _)| *variable == number);
            let mut reads: Vec<usize> =
                read.map(|(_, property)| world.column(&PropertyName::new(name, property), facts)).collect();
            reads.extend(uses.anywhere[number].iter().map(|&column| columns[column]));
            clauses.push(Clause { quantifier: plan.quantifier, class, reads });
        }
        let classes: Vec<usize> = clauses.iter().map(|clause: &Clause| clause.class).collect();
        let mut path = |seed| {
            let clauses = seeded(&plan.clauses, seed);
            let candidates = |clause: &ClausePlan| {
                let joins = clause.joins.iter().map(|join| columns[join.column]).collect();
                world.candidates(classes[clause.variable], joins)
            };
            Path { candidates: clauses.iter().map(candidates).collect(), clauses }
        };
        let full = path(None);
        let from = (0..plan.clauses.len()).map(|clause| path(Some(clause))).collect();
        Self { clauses, plan, columns, full, from }
    }
}
