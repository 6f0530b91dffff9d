//! Plans rules and runs them for the objects that need it.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;

use super::KnowledgeBase;
use super::dirty::Dirty;
use super::memory::{Memory, Shape};
use super::network::Planned;
use crate::class::Table;
use crate::column::Column;
use crate::diagnostic::{Code, Diagnostic};
use crate::machine::Machine;
use crate::machine::candidates::Candidates;
use crate::machine::output::Output;
use crate::machine::search::{Drivers, search};
use crate::plan::uses::Uses;
use crate::plan::{Key, Kind, Kinds, Plan, plan};
use crate::rule::{PropertyName, Rule};
use crate::rule_base::RuleBase;
use crate::told::NamesTold;
use crate::value::Type;

impl KnowledgeBase {
    /// Plans a rule, if it has no plan for the types that there are now. A rule that is planned anew starts anew.
    pub(super) fn plan(&mut self, base: &RuleBase, index: usize) {
        let rule = &base.rules[index];
        let kept = self.network.nodes[index]
            .planned
            .as_ref()
            .is_some_and(|planned| planned.kinds == self.kinds(rule, &planned.plan));
        if kept {
            return;
        }
        self.drop_memory(index);
        let outcome = catch_unwind(AssertUnwindSafe(|| {
            plan(rule, &Known { base: self, rule: Some(rule), told: None }, &self.symbols)
        }));
        let outcome = outcome.unwrap_or_else(|_| Err(vec![failed_inside(rule)]));
        let (planned, problems) = match outcome {
            Ok(plan) => {
                let (uses, kinds, interprets) = (Uses::of(&plan), self.kinds(rule, &plan), plan.interprets());
                (Some(Planned { plan, uses, kinds, interprets }), vec![])
            }
            Err(problems) => (None, problems),
        };
        let node = &mut self.network.nodes[index];
        (node.planned, node.problems) = (planned, problems);
    }

    fn kinds(&self, rule: &Rule, plan: &Plan) -> Vec<Option<Type>> {
        let read = plan.columns.iter().map(|name| self.view(name, below(rule, name)).map(Column::kind));
        read.chain(rule.sets.keys().map(|name| self.told_column(name).map(Column::kind))).collect()
    }

    pub(super) fn evaluate(
        &self,
        until: Instant,
        rule: &Rule,
        plan: &Plan,
        memory: &mut Memory,
        drivers: &Dirty,
    ) -> Output {
        let outcome = catch_unwind(AssertUnwindSafe(|| self.search(until, rule, plan, memory, drivers)));
        let mut output = outcome.unwrap_or_else(|_| Output {
            problem: Some(failed_inside(rule)),
            stopped: true,
            ..Output::default()
        });
        if output.stopped {
            // What was found until then is not whole, and would hang on the order of the search.
            let problem = output.problem.take();
            *memory = Memory::new(rule, plan, memory.statuses.len());
            output = Output { problem, stopped: true, ..Output::nothing(plan, rule) };
        }
        memory.problem = output.problem.take().map(|problem| match output.problems {
            0 | 1 => problem,
            more => problem.help(format!("it failed {more} times; this is the first")),
        });
        output
    }

    fn search(
        &self,
        until: Instant,
        rule: &Rule,
        plan: &Plan,
        memory: &mut Memory,
        drivers: &Dirty,
    ) -> Output {
        let machine = self.machine(rule, plan, until);
        for number in usize::from(memory.shape != Shape::Whole)..rule.clauses.len() {
            if memory.candidates[number].is_none() {
                // A search without candidates looks at the clock, too, and is stopped.
                memory.candidates[number] = self.candidates(&machine, plan, number);
            }
        }
        let len = memory.statuses.len() as u32;
        let drivers = match (memory.shape, drivers) {
            (Shape::Whole, _) => Drivers::Whole(self.len(&rule.clauses[0].class).unwrap_or(0) as u32),
            (_, Dirty::Rows(rows)) => Drivers::Rows(rows),
            _ => Drivers::Range(0, len),
        };
        search(&machine, plan, &memory.candidates, drivers)
    }

    /// The candidates of a clause; `None` where it takes too long to find them.
    pub(super) fn candidates(&self, machine: &Machine, plan: &Plan, number: usize) -> Option<Candidates> {
        let size = self.len(&machine.rule.clauses[number].class).unwrap_or(0);
        Candidates::of(machine, plan, number, size).ok()
    }

    pub(super) fn machine<'m>(&'m self, rule: &'m Rule, plan: &Plan, until: Instant) -> Machine<'m> {
        static NONE: Column = Column::Truths(vec![]);
        let column = |name| self.view(name, below(rule, name)).unwrap_or(&NONE);
        let columns = plan.columns.iter().map(column).collect();
        Machine::new(rule, columns, &self.symbols, until.min(self.limits.end(self.limits.rule)), false)
    }
}

fn failed_inside(rule: &Rule) -> Diagnostic {
    rule.file.error(Code::Panic, rule.position, format!("rule \"{}\" failed inside the engine", rule.name))
}

/// A revision reads its own property as the level below left it; everyone reads the last level.
pub(super) fn below(rule: &Rule, name: &PropertyName) -> Option<i64> {
    rule.level().filter(|_| rule.sets.contains_key(name))
}

/// The properties that there are when a rule is planned, and those that reactions may tell some day.
pub(super) struct Known<'k> {
    pub(super) base: &'k KnowledgeBase,
    /// The rule, where it may be a revision.
    pub(super) rule: Option<&'k Rule>,
    pub(super) told: Option<&'k NamesTold<'k>>,
}

impl Known<'_> {
    fn table(&self, class: &str) -> Option<&Table> {
        self.base.held.get(class).map(|held| &held.table)
    }
}

impl Kinds for Known<'_> {
    fn kind(&self, name: &PropertyName) -> Kind {
        match self.base.view(name, self.rule.and_then(|rule| below(rule, name))) {
            Some(column) => Kind::Holds(Some(column.kind())),
            None if self.told.is_some_and(|told| told.properties.contains_key(name)) => Kind::Holds(None),
            None => Kind::Missing,
        }
    }

    fn declared(&self, name: &PropertyName) -> Option<Type> {
        self.base.told_column(name).map(Column::kind)
    }

    fn key(&self, class: &str) -> Key {
        self.table(class).map_or(Key::Unsaid, |table| {
            Key::Properties(table.key.iter().map(|&column| table.names[column].clone()).collect())
        })
    }

    fn properties(&self, class: &str) -> Vec<String> {
        self.table(class).map(|table| table.names.clone()).unwrap_or_default()
    }
}
