//! The agenda: which rules that react may be carried out, for which objects, and in which order.
//!
//! Matches are kept and follow what changes (TREAT: Miranker 1987): a search begins at each object that is new or
//! has other values, matches that held it are dropped, and what `none`, `least` and the like decide is decided anew
//! for the matches that such an object matters to.

mod conflict_set;
mod evaluate;
mod follow;
mod index;
mod program;
mod rebuild;
pub(crate) mod script;
mod search;
pub(crate) mod world;

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::time::Instant;

use rhai::Engine;

use crate::changes::Changes;
use crate::diagnostic::Diagnostic;
use crate::plan::fragment::Fragment;
use crate::plan::{Kind, Kinds};
use crate::rule::Rule;
use crate::rule_base::RuleBase;
use crate::symbols::Symbols;
pub(crate) use conflict_set::Binding;
use conflict_set::ConflictSet;
pub(crate) use evaluate::Bound;
use evaluate::Evaluator;
use program::{Program, Visit};
use script::Scripts;
pub(crate) use search::Halt;
use search::Search;
use world::{Facts, World};

/// The matches of all rules that react.
#[derive(Debug, Default)]
pub(crate) struct Agenda {
    pub(crate) world: World,
    /// The rules in the order of the agenda.
    rules: Vec<Reacting>,
    /// Whether matching was left halfway.
    stale: bool,
}

/// A rule that reacts, with its matches.
#[derive(Debug)]
struct Reacting {
    /// Its number in the rule base.
    rule: usize,
    made_for: MadeFor,
    /// `None` while it waits for a class or property, or is wrong.
    program: Option<Program>,
    set: ConflictSet,
}

/// What a program depends on but the values of properties.
#[derive(Clone, Debug, PartialEq, Eq)]
struct MadeFor {
    name: String,
    version: String,
    /// The kinds of what it reads; `None` while something is not there.
    kinds: Option<Vec<Kind>>,
}

/// What matching needs from outside.
pub(crate) struct Outside<'o> {
    pub(crate) rules: &'o RuleBase,
    pub(crate) facts: &'o dyn Facts,
    pub(crate) kinds: Box<dyn Kinds + 'o>,
    pub(crate) symbols: &'o RefCell<Symbols>,
    pub(crate) runner: &'o Engine,
    pub(crate) deadline: Instant,
    /// Most matches that are kept.
    pub(crate) matches: usize,
    /// By rule: what is wrong with it, or failed in a condition.
    pub(crate) troubles: RefCell<BTreeMap<usize, Vec<Diagnostic>>>,
}

/// A state of the agenda that it can go back to.
#[derive(Debug)]
pub(crate) struct Checkpoint(Vec<Arc<Vec<u32>>>);

/// Matching was stopped in a rule.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stopped {
    pub(crate) rule: usize,
    pub(crate) halt: Halt,
}

impl Agenda {
    /// Whether there are rules that react.
    pub(crate) const fn is_used(&self) -> bool {
        !self.rules.is_empty()
    }

    /// Notes what an inference changed.
    pub(crate) fn note(&mut self, changes: &Changes) {
        for (class, changes) in &changes.classes {
            self.world.note(class, changes);
        }
    }

    /// Makes the matches right. With `check`, also where rules or the types of properties are others than before.
    pub(crate) fn follow(&mut self, outside: &Outside, check: bool) -> Result<(), Stopped> {
        let wanted = if check { Some(wanted(outside)) } else { None };
        let as_wanted = |wanted: &Vec<(usize, MadeFor)>| {
            wanted.len() == self.rules.len()
                && wanted.iter().zip(&self.rules).all(|((rule, made_for), reacting)| {
                    *rule == reacting.rule && *made_for == reacting.made_for
                })
        };
        if self.stale || self.world.scrambled || self.world.is_sparse() || !wanted.iter().all(as_wanted) {
            return self.rebuild(outside, wanted.unwrap_or_else(|| self::wanted(outside)));
        }
        let differences = self.world.fetch(outside.facts);
        let done = self.follow_each(outside, &differences);
        self.world.settle();
        self.stale |= done.is_err();
        done
    }

    /// The first activation that waits, of a rule that is not among the skipped.
    pub(crate) fn next(&self, skipped: &BTreeSet<usize>) -> Option<(usize, Binding)> {
        self.rules
            .iter()
            .filter(|reacting| !skipped.contains(&reacting.rule))
            .find_map(|reacting| Some((reacting.rule, Arc::clone(reacting.set.open().next()?))))
    }

    /// All activations that wait, in order.
    pub(crate) fn open(&self) -> impl Iterator<Item = (usize, &Binding)> {
        self.rules.iter().flat_map(|reacting| reacting.set.open().map(|binding| (reacting.rule, binding)))
    }

    /// All matches of a rule, carried out or not.
    #[cfg(test)]
    pub(crate) fn all(&self, rule: usize) -> Vec<Binding> {
        let reacting = self.rules.iter().filter(|reacting| reacting.rule == rule);
        reacting.flat_map(|reacting| reacting.set.all().keys().cloned()).collect()
    }

    /// Marks an activation as carried out.
    pub(crate) fn carry_out(&mut self, rule: usize, binding: &Binding) {
        for reacting in self.rules.iter_mut().filter(|reacting| reacting.rule == rule) {
            reacting.set.carry_out(binding);
        }
    }

    /// The body of a rule, the columns that it names by number, and the numbers that its clauses give.
    pub(crate) fn body(
        &self,
        outside: &Outside,
        rule: usize,
        binding: &Binding,
    ) -> Option<(&Fragment, &[usize], Bound)> {
        let program = self.rules.iter().find(|reacting| reacting.rule == rule)?.program.as_ref()?;
        let scripts = scripts(outside, rule);
        let mut search = searching(outside, &self.world, program, &scripts);
        let mut bound = search.unbound();
        bound.ids.copy_from_slice(binding);
        for step in program.full.steps.iter().filter(|step| step.visit == Visit::Decide) {
            if program.clauses[step.clause].quantifier.counts() {
                search.decide(step, &mut bound).ok()?;
            }
        }
        Some((&program.body, &program.columns, bound))
    }

    /// The class that a clause of a rule ranges over, by number.
    pub(crate) fn class_of(&self, rule: usize, clause: usize) -> Option<usize> {
        let program = self.rules.iter().find(|reacting| reacting.rule == rule)?.program.as_ref()?;
        Some(program.clauses.get(clause)?.class)
    }

    /// Where [`Agenda::go_back`] can go back to.
    pub(crate) fn checkpoint(&mut self) -> Checkpoint {
        self.rules.iter_mut().for_each(|reacting| reacting.set.checkpoint());
        Checkpoint(self.world.classes.iter().map(|objects| Arc::clone(&objects.ids)).collect())
    }

    /// Forgets what was carried out since, once the objects are again those of the checkpoint.
    pub(crate) fn go_back(&mut self, checkpoint: Checkpoint) {
        for reacting in &mut self.rules {
            let fired = reacting.set.fired_before();
            reacting.set = ConflictSet::new(reacting.set.variables());
            for binding in &fired {
                reacting.set.insert(binding, true);
            }
        }
        self.world.go_back(checkpoint.0);
        self.stale = true;
    }
}

/// The rules that react in the order of the agenda, with what their programs depend on.
fn wanted(outside: &Outside) -> Vec<(usize, MadeFor)> {
    let made_for = |rule: &Rule| {
        let there = rule.classes().all(|class| outside.facts.has(class));
        let kinds: Vec<Kind> = rule.reads.keys().map(|name| outside.kinds.kind(name)).collect();
        MadeFor {
            name: rule.name.clone(),
            version: rule.version.clone(),
            kinds: (there && !kinds.contains(&Kind::Missing)).then_some(kinds),
        }
    };
    let reacting = outside.rules.rules.iter().enumerate().filter(|(_, rule)| rule.reacts());
    let mut wanted: Vec<_> = reacting.map(|(number, rule)| (number, made_for(rule))).collect();
    // Stable: equal priorities stay in the order of the files.
    wanted.sort_by_key(|&(number, _)| std::cmp::Reverse(outside.rules.rules[number].priority));
    wanted
}

fn scripts<'o>(outside: &Outside<'o>, rule: usize) -> Scripts<'o> {
    Scripts {
        rule: &outside.rules.rules[rule],
        runner: outside.runner,
        deadline: outside.deadline,
        trouble: RefCell::default(),
    }
}

fn searching<'s>(
    outside: &Outside<'s>,
    world: &'s World,
    program: &'s Program,
    scripts: &'s Scripts<'s>,
) -> Search<'s> {
    let evaluator = Evaluator { world, columns: &program.columns, symbols: outside.symbols, scripts };
    Search { evaluator, program, deadline: outside.deadline, looked_at: 0, lenient: None }
}

impl Agenda {
    /// How many matches all rules but one have.
    fn others(&self, at: usize) -> usize {
        self.rules
            .iter()
            .enumerate()
            .filter(|(nth, _)| *nth != at)
            .map(|(_, reacting)| reacting.set.len())
            .sum()
    }
}

impl Outside<'_> {
    fn trouble(&self, rule: usize, problem: Diagnostic) {
        let mut troubles = self.troubles.borrow_mut();
        let known = troubles.entry(rule).or_default();
        if known.iter().all(|other| (other.code, other.span) != (problem.code, problem.span)) {
            known.push(problem);
        }
    }
}

fn within(outside: &Outside, set: &ConflictSet, others: usize) -> Result<(), Halt> {
    if set.len() + others > outside.matches { Err(Halt::Full) } else { Ok(()) }
}
