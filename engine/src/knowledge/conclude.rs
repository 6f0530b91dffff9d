//! Inference: every rule whose facts are there, in the order of their dependencies, and only what has changed.

use std::collections::{BTreeMap, BTreeSet};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;

use rhai::Engine;

use super::KnowledgeBase;
use super::derived::{Done, Made};
use crate::conclusions::{Conclusions, Conflict, LeftOut, Waiting};
use crate::diagnostic::{Code, Diagnostic};
use crate::machine::Machine;
use crate::machine::output::Output;
use crate::machine::search::search;
use crate::order::Step;
use crate::plan::{Key, Kind, Kinds, plan};
use crate::rule::{PropertyName, Rule};
use crate::rule_base::{RuleBase, on_deep_stack};
use crate::script::interpreter::runner;
use crate::value::Type;

/// Which concluded properties are complete so far.
type Complete = BTreeMap<PropertyName, bool>;

impl KnowledgeBase {
    /// Evaluates every rule whose classes are asserted and whose properties are asserted or concluded, and that
    /// is new or rests on something new. What others concluded before is kept, and what rests on something
    /// that is gone is taken back.
    pub fn conclude(&mut self, rules: &RuleBase) -> Conclusions {
        on_deep_stack(|| self.infer(rules))
    }

    fn infer(&mut self, base: &RuleBase) -> Conclusions {
        let runner = runner();
        let until = Instant::now() + self.limits.inference;
        let mut report = Conclusions::default();
        let mut complete = Complete::new();
        self.forget(base);
        for step in &base.order {
            match step {
                Step::Rule(index) => self.rule(&base.rules[*index], runner, until, &complete, &mut report),
                Step::Merge(name) => {
                    let done = self.merge(base, name);
                    complete.insert(name.clone(), done);
                }
                Step::Level(name, level) => {
                    let done = self.revise(base, name, *level);
                    complete.entry(name.clone()).and_modify(|complete| *complete &= done);
                }
            }
        }
        self.report(base, &complete, &mut report);
        report
    }

    /// Drops what rested on rules that are no longer there.
    fn forget(&mut self, base: &RuleBase) {
        let versions: BTreeMap<&str, &str> =
            base.rules.iter().map(|rule| (rule.name(), rule.version())).collect();
        self.done.retain(|name, done| versions.get(name.as_str()) == Some(&done.version.as_str()));
        let concluded = base.concluded();
        self.derived.retain(|name, _| concluded.contains(name) && self.held.contains_key(&name.class));
        for (name, derived) in &mut self.derived {
            let revised = |level| {
                base.rules.iter().any(|rule| rule.level() == Some(level) && rule.sets.contains_key(name))
            };
            derived.layers.retain(|layer| revised(layer.level));
        }
    }

    fn rule(
        &mut self,
        rule: &Rule,
        runner: &Engine,
        until: Instant,
        complete: &Complete,
        report: &mut Conclusions,
    ) {
        let needs = self.needs(rule, complete);
        if !needs.is_empty() {
            self.done.remove(rule.name());
            report.waiting.push(Waiting { rule: rule.name.clone(), needs });
            return;
        }
        let made_from = self.inputs(rule);
        if self.done.get(rule.name()).is_some_and(|done| done.made_from == made_from) {
            return;
        }
        let outcome = catch_unwind(AssertUnwindSafe(|| self.evaluate(rule, runner, until)));
        let (output, problems) = outcome.unwrap_or_else(|_| {
            let place = rule.file.source.place(rule.position);
            let message = format!("rule \"{}\" failed inside the engine", rule.name);
            (Output::default(), vec![Diagnostic::error(Code::Panic, &place, message)])
        });
        let stamp = self.tick();
        let version = rule.version.clone();
        self.done.insert(rule.name.clone(), Done { version, made_from, stamp, output, problems });
        report.evaluated.push(rule.name.clone());
    }

    /// What a rule waits for.
    fn needs(&self, rule: &Rule, complete: &Complete) -> Vec<String> {
        let mut needs: BTreeSet<String> =
            rule.classes().filter(|class| !self.held.contains_key(*class)).map(str::to_owned).collect();
        let own = rule.level().and(rule.sets.keys().next());
        for name in rule.reads.keys().chain(own) {
            if needs.contains(&name.class) {
                continue;
            }
            let there = match complete.get(name) {
                Some(complete) => *complete,
                None => self.view(name, None).is_some(),
            };
            if !there {
                needs.insert(name.to_string());
            }
        }
        needs.into_iter().collect()
    }

    fn inputs(&self, rule: &Rule) -> Made {
        let classes =
            rule.classes().map(|class| (class.to_owned(), self.held.get(class).map_or(0, |held| held.stamp)));
        let own = rule.level().and(rule.sets.keys().next());
        let properties = rule.reads.keys().chain(own).map(|name| {
            let stamp = self.view(name, below(rule, name)).map_or(0, |(_, stamp)| stamp);
            (name.to_string(), stamp)
        });
        classes.chain(properties).collect()
    }

    fn evaluate(&self, rule: &Rule, runner: &Engine, until: Instant) -> (Output, Vec<Diagnostic>) {
        let plan = match plan(rule, &Known { base: self, rule }, &self.symbols) {
            Ok(plan) => plan,
            Err(problems) => return (Output::default(), problems),
        };
        let mut columns = vec![];
        for name in &plan.columns {
            match self.view(name, below(rule, name)) {
                Some((column, _)) => columns.push(column),
                None => return (Output::default(), vec![]),
            }
        }
        let sizes: Vec<usize> = rule.classes().map(|class| self.len(class).unwrap_or(0)).collect();
        let machine = Machine {
            rule,
            columns,
            symbols: &self.symbols,
            runner,
            deadline: until.min(Instant::now() + self.limits.rule),
            trouble: None.into(),
            troubles: 0.into(),
            stopped: false.into(),
        };
        let mut output = search(&machine, &plan, &sizes);
        let problem = output.problem.take().map(|problem| match output.problems {
            0 | 1 => problem,
            more => problem.help(format!("it failed {more} times; this is the first")),
        });
        (output, problem.into_iter().collect())
    }

    fn report(&self, base: &RuleBase, complete: &Complete, report: &mut Conclusions) {
        for rule in &base.rules {
            let Some(done) = self.done.get(rule.name()) else { continue };
            report.diagnostics.extend(done.problems.iter().cloned());
            for skipped in &done.output.skipped {
                let clause = &rule.clauses[skipped.clause];
                report.left_out.push(LeftOut {
                    rule: rule.name.clone(),
                    variable: clause.variable.clone(),
                    class: clause.class.clone(),
                    objects: skipped.objects,
                });
            }
        }
        for (name, derived) in &self.derived {
            report.diagnostics.extend(derived.problems.iter().cloned());
            let conflicts = self.conflicts(name, derived);
            report
                .diagnostics
                .extend(conflicts.first().and_then(|first| disagreement(base, first, conflicts.len())));
            report.conflicts.extend(conflicts);
            if complete.get(name) == Some(&true) {
                report.gaps.extend(self.gap(base, name, derived));
            }
        }
    }
}

/// One message for all conflicts about a property.
fn disagreement(base: &RuleBase, first: &Conflict, count: usize) -> Option<Diagnostic> {
    let said: Vec<String> =
        first.values.iter().map(|(rule, value)| format!("\"{rule}\" says {value}")).collect();
    let (last, _) = first.values.last()?;
    let rule = base.rules.iter().find(|rule| rule.name == *last)?;
    let place = rule.file.source.place(*rule.sets.get(&first.property)?);
    let (property, key) = (&first.property, &first.key);
    let message = format!("rules disagree about {property} of {key}: {}", said.join(", "));
    let others = if count == 1 { String::new() } else { format!(", as {} others", count - 1) };
    let help = format!(
        "{key} has no value of it now{others}; give one of the rules a `where` that keeps them apart"
    );
    Some(Diagnostic::error(Code::Conflict, &place, message).warning().help(help))
}

/// A revision reads its own property as the level below left it; everyone reads the last level.
fn below(rule: &Rule, name: &PropertyName) -> Option<i64> {
    rule.level().filter(|_| rule.sets.contains_key(name))
}

/// The properties that there are when a rule is evaluated.
struct Known<'k> {
    base: &'k KnowledgeBase,
    rule: &'k Rule,
}

impl Kinds for Known<'_> {
    fn kind(&self, name: &PropertyName) -> Kind {
        match self.base.view(name, below(self.rule, name)) {
            Some((column, _)) => Kind::Holds(Some(column.kind())),
            None => Kind::Missing,
        }
    }

    fn declared(&self, name: &PropertyName) -> Option<Type> {
        self.base.held.get(&name.class)?.table.column(&name.property).map(crate::column::Column::kind)
    }

    fn key(&self, class: &str) -> Key {
        self.base.held.get(class).map_or(Key::Unsaid, |held| {
            let table = &held.table;
            Key::Properties(table.key.iter().map(|&column| table.names[column].clone()).collect())
        })
    }

    fn properties(&self, class: &str) -> Vec<String> {
        self.base.held.get(class).map(|held| held.table.names.clone()).unwrap_or_default()
    }
}
