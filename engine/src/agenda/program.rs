//! A rule that reacts, made ready for matching: for each clause at which a search may begin, the steps that follow.

use super::world::{Facts, World};
use crate::plan::clause::ClausePlan;
use crate::plan::fragment::Fragment;
use crate::plan::node::{Comparison, Node};
use crate::plan::reaction::ReactionPlan;
use crate::plan::uses::Uses;
use crate::rule::{PropertyName, Reaction, Rule};
use crate::script::syntax::Quantifier;

/// One part of a condition: all of them must be true.
#[derive(Debug)]
pub(crate) struct Conjunct {
    pub(crate) node: Node,
    variables: u64,
    pub(crate) clause: usize,
    /// It looks at a link's object, bound or not, and does not decide the link.
    after_link: bool,
}

/// A clause of the rule.
#[derive(Debug)]
pub(crate) struct Clause {
    pub(crate) quantifier: Quantifier,
    /// Its class by number.
    pub(crate) class: usize,
    pub(crate) by: Option<Node>,
    pub(crate) have: Option<Node>,
    /// All of `where`, for clauses to which unknowns matter.
    pub(crate) whole: Option<Node>,
    /// For its variable the columns that the rule reads.
    pub(crate) reads: Vec<usize>,
}

/// What a step does with its clause.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Visit {
    /// The search began here.
    Given,
    /// Every candidate.
    Each,
    /// Ask whether the clause is met, and by what.
    Decide,
}

/// Candidates by index: its number, and for each column the conjunct with the side that gives the key.
#[derive(Debug)]
pub(crate) struct Find {
    pub(crate) index: usize,
    pub(crate) keys: Vec<(usize, Side)>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    Left,
    Right,
}

/// One clause's turn.
#[derive(Debug)]
pub(crate) struct Step {
    pub(crate) clause: usize,
    pub(crate) visit: Visit,
    pub(crate) find: Option<Find>,
    /// What a candidate must pass to meet a clause that is decided.
    pub(crate) own: Vec<usize>,
    /// The conjuncts to test as soon as the clause is bound.
    pub(crate) tests: Vec<usize>,
}

/// A search from its first step to its last.
#[derive(Debug)]
pub(crate) struct Path {
    /// What can be tested with the first object alone.
    pub(crate) first: Vec<usize>,
    pub(crate) steps: Vec<Step>,
}

/// A rule ready for matching.
#[derive(Debug)]
pub(crate) struct Program {
    pub(crate) clauses: Vec<Clause>,
    pub(crate) conjuncts: Vec<Conjunct>,
    /// For each column of the plan its number in the world.
    pub(crate) columns: Vec<usize>,
    /// All clauses in their order.
    pub(crate) full: Path,
    /// For each clause: of an `each`, a search for all bindings with an object of it; of the others, a search for
    /// the bindings of the clauses before that an object matters to.
    pub(crate) from: Vec<Path>,
    pub(crate) body: Fragment,
}

impl Clause {
    /// Whether a candidate of which it is unknown whether it passes matters.
    pub(crate) fn minds_unknowns(&self) -> bool {
        self.quantifier.counts() || self.quantifier == Quantifier::All
    }

    /// Whether the rule reads one of these columns of its object.
    pub(crate) fn reads_any(&self, columns: &[usize]) -> bool {
        columns.iter().any(|column| self.reads.contains(column))
    }
}

impl Program {
    pub(crate) fn new(
        rule: &Rule,
        reaction: &Reaction,
        plan: ReactionPlan,
        world: &mut World,
        facts: &dyn Facts,
    ) -> Self {
        let columns: Vec<usize> = plan.columns.iter().map(|name| world.column(name, facts)).collect();
        let uses = Uses::of_clauses(&plan.clauses);
        let (mut clauses, mut conjuncts) = (vec![], vec![]);
        for (number, plan) in plan.clauses.into_iter().enumerate() {
            let name = &rule.clauses[number].class;
            let class = world.class(name, facts);
            let read = reaction.reads.iter().filter(|(variable, _)| *variable == number);
            let mut reads: Vec<usize> =
                read.map(|(_, property)| world.column(&PropertyName::new(name, property), facts)).collect();
            reads.extend(uses.anywhere[number].iter().map(|&column| columns[column]));
            let (by, have, whole) = (plan.by.clone(), plan.have.clone(), plan.whole.clone());
            clauses.push(Clause { quantifier: plan.quantifier, class, by, have, whole, reads });
            world.classes[class].watched |= plan.quantifier != Quantifier::Each;
            conjuncts.extend(parts(plan, number));
        }
        let full = Path { first: vec![], steps: vec![] };
        let mut program = Self { clauses, conjuncts, columns, full, from: vec![], body: plan.body };
        program.full = program.path(None, program.clauses.len(), world);
        program.from = (0..program.clauses.len())
            .map(|clause| {
                let each = program.clauses[clause].quantifier == Quantifier::Each;
                let end = if each { program.clauses.len() } else { clause };
                program.path(Some(clause), end, world)
            })
            .collect();
        program
    }

    /// The steps for the clauses up to `end`, where the object of clause `from` is known already.
    fn path(&self, from: Option<usize>, end: usize, world: &mut World) -> Path {
        // Conditions of a clause that is decided are tested there, unless the search is for what it decides.
        let tested = |conjunct: &Conjunct| {
            if from == Some(conjunct.clause) {
                return !conjunct.after_link;
            }
            conjunct.after_link || self.clauses[conjunct.clause].quantifier == Quantifier::Each
        };
        let mut bound = from.map_or(0, |clause| 1 << clause);
        let due = |before: u64, now: u64| -> Vec<usize> {
            let due = |conjunct: &Conjunct| {
                let fresh = conjunct.variables & !before != 0 || (before == 0 && now == bit(from));
                tested(conjunct) && conjunct.variables & !now == 0 && fresh
            };
            (0..self.conjuncts.len()).filter(|&nth| due(&self.conjuncts[nth])).collect()
        };
        let first = due(0, bound);
        let mut steps = vec![];
        for clause in 0..end {
            let each = self.clauses[clause].quantifier == Quantifier::Each;
            let visit = match (from == Some(clause), each) {
                (true, _) => Visit::Given,
                (false, true) => Visit::Each,
                (false, false) => Visit::Decide,
            };
            let own = |conjunct: &Conjunct| conjunct.clause == clause && !conjunct.after_link;
            let usable = |conjunct: &Conjunct| if each { tested(conjunct) } else { own(conjunct) };
            let find = if visit == Visit::Given { None } else { self.find(clause, bound, &usable, world) };
            let now = bound | 1 << clause;
            let owns = |nth: &usize| visit == Visit::Decide && own(&self.conjuncts[*nth]);
            let own = (0..self.conjuncts.len()).filter(owns).collect();
            let tests = if visit == Visit::Given { vec![] } else { due(bound, now) };
            steps.push(Step { clause, visit, find, own, tests });
            bound = now;
        }
        Path { first, steps }
    }

    /// The equations that an index answers for a clause, given what is bound before.
    fn find(
        &self,
        clause: usize,
        bound: u64,
        usable: &dyn Fn(&Conjunct) -> bool,
        world: &mut World,
    ) -> Option<Find> {
        let mut keys: Vec<(usize, usize, Side)> = vec![];
        for (nth, conjunct) in self.conjuncts.iter().enumerate().filter(|(_, conjunct)| usable(conjunct)) {
            let Node::Compare(Comparison::Equal, a, b) = &conjunct.node else { continue };
            for (side, own, key) in [(Side::Right, a, b), (Side::Left, b, a)] {
                if let Node::Property { variable, column } = **own
                    && variable == clause
                    && key.variables() & !bound == 0
                    && !key.interprets()
                {
                    keys.push((self.columns[column], nth, side));
                    break;
                }
            }
        }
        keys.sort_by_key(|&(column, nth, _)| (column, nth));
        keys.dedup_by_key(|(column, ..)| *column);
        if keys.is_empty() {
            return None;
        }
        let columns: Vec<usize> = keys.iter().map(|&(column, ..)| column).collect();
        let index = world.index(self.clauses[clause].class, &columns);
        Some(Find { index, keys: keys.into_iter().map(|(_, nth, side)| (nth, side)).collect() })
    }

    /// The side of an equation.
    pub(crate) fn key(&self, (conjunct, side): (usize, Side)) -> &Node {
        match (&self.conjuncts[conjunct].node, side) {
            (Node::Compare(_, key, _), Side::Left) | (Node::Compare(_, _, key), Side::Right) => key,
            _ => &Node::Unknown,
        }
    }
}

fn bit(clause: Option<usize>) -> u64 {
    clause.map_or(0, |clause| 1 << clause)
}

/// All parts of a clause's `where`.
fn parts(plan: ClausePlan, clause: usize) -> Vec<Conjunct> {
    let equation = |join: crate::plan::clause::Join| {
        let own = Node::Property { variable: clause, column: join.column };
        Node::Compare(Comparison::Equal, Box::new(own), Box::new(join.key))
    };
    let link = plan.quantifier == Quantifier::Link;
    let mut nodes: Vec<(Node, bool)> = plan.joins.into_iter().map(|join| (equation(join), false)).collect();
    for condition in plan.own.into_iter().chain(plan.test) {
        match condition {
            Node::And(parts) => nodes.extend(parts.into_iter().map(|part| (part, link))),
            other => nodes.push((other, link)),
        }
    }
    let conjunct = |(node, after_link): (Node, bool)| {
        let variables = node.variables();
        Conjunct { node, variables, clause, after_link }
    };
    nodes.into_iter().map(conjunct).collect()
}
