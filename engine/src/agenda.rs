//! The agenda: which rules that react may be carried out, for which objects, and in which order.
//!
//! Matches are kept and follow what changes (TREAT: Miranker 1987): a search begins at each object that is new or
//! has other values, matches that held it are dropped, and what `none`, `least` and the like decide is decided anew
//! for the matches that such an object matters to.

mod conflict_set;
mod follow;
mod matching;
mod program;
mod rebuild;
pub(crate) mod world;

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::changes::Changes;
use crate::plan::fragment::Fragment;
use crate::plan::{Effect, Kind};
use crate::rule::Rule;
pub(crate) use conflict_set::Binding;
use conflict_set::ConflictSet;
use matching::Matching;
pub(crate) use matching::{Halt, Outside};
use program::Program;
use world::{Difference, World};

#[derive(Debug, Default)]
pub(crate) struct Agenda {
    pub(crate) world: World,
    /// The rules in the order of the agenda.
    rules: Vec<Reacting>,
    /// Whether matching was left halfway.
    stale: bool,
}

#[derive(Debug)]
struct Reacting {
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

/// A state of the agenda that it can go back to.
#[derive(Debug)]
pub(crate) struct Checkpoint(Vec<Arc<Vec<u32>>>);

#[derive(Clone, Copy, Debug)]
pub(crate) struct Stopped {
    pub(crate) rule: usize,
    pub(crate) halt: Halt,
}

impl Agenda {
    pub(crate) const fn is_used(&self) -> bool {
        !self.rules.is_empty()
    }

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
        let differences = self.world.differences(outside.facts);
        if differences.iter().all(Difference::is_empty) {
            self.world.fetch(&differences, outside.facts);
            return Ok(());
        }
        let done = self.follow_each(outside, &differences);
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

    pub(crate) fn open(&self) -> impl Iterator<Item = (usize, &Binding)> {
        self.rules.iter().flat_map(|reacting| reacting.set.open().map(|binding| (reacting.rule, binding)))
    }

    pub(crate) fn fired(&self) -> impl Iterator<Item = (usize, &Binding)> {
        self.rules.iter().flat_map(|reacting| reacting.set.fired().map(|binding| (reacting.rule, binding)))
    }

    #[cfg(test)]
    pub(crate) fn all(&self, rule: usize) -> Vec<Binding> {
        let reacting = self.rules.iter().filter(|reacting| reacting.rule == rule);
        reacting.flat_map(|reacting| reacting.set.all().keys().cloned()).collect()
    }

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
    ) -> Option<(&Fragment, &[usize], Vec<f64>)> {
        let program = self.rules.iter().find(|reacting| reacting.rule == rule)?.program.as_ref()?;
        let Effect::React(Some(body)) = &program.plan.effect else { return None };
        let numbers = Matching::new(outside, &self.world, rule, program).numbers(binding).ok()?;
        Some((body, &program.columns, numbers))
    }

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
            reacting.set = ConflictSet::of_fired(reacting.set.variables(), &fired);
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

impl Agenda {
    fn others(&self, at: usize) -> usize {
        self.rules
            .iter()
            .enumerate()
            .filter(|(nth, _)| *nth != at)
            .map(|(_, reacting)| reacting.set.len())
            .sum()
    }
}
