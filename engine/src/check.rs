//! Names and types of a rule base against a schema.

mod kinds;
mod told;

use std::collections::{BTreeMap, BTreeSet};

use kinds::Declared;

use crate::diagnostic::Diagnostic;
use crate::order::Step;
use crate::plan::plan;
use crate::rule::{Action, Rule};
use crate::rule_base::{RuleBase, on_deep_stack};
use crate::schema::Schema;
use crate::symbols::Lexicon;
use crate::told::NamesTold;
use crate::value::Type;

impl RuleBase {
    /// Names and types against the classes that there are, and warnings; empty if all is well.
    pub fn check(&self, schema: &Schema) -> Vec<Diagnostic> {
        on_deep_stack(|| check(self, schema))
    }
}

fn check(base: &RuleBase, schema: &Schema) -> Vec<Diagnostic> {
    let symbols = Lexicon::default();
    let told = NamesTold::of(&base.rules);
    let mut known = Declared { schema, concluded: BTreeMap::new(), told: BTreeMap::new() };
    for name in base.concluded() {
        known.concluded.insert(name.clone(), None);
    }
    for name in told.properties.keys() {
        known.told.insert(name.clone(), None);
    }
    known.tell_kinds(base, &symbols);
    known.concluded.extend(base.hypotheses().into_iter().map(|name| (name, Some(Type::Truth))));
    for name in base.declared.supplied() {
        known.concluded.entry(name.clone()).or_default();
    }
    let (types, mut declared) = crate::declared::check::check(&base.declared, schema, &known);
    declared.sort_by(|a, b| (&a.file, a.span).cmp(&(&b.file, b.span)));
    for (name, kind) in types {
        known.concluded.entry(name).or_default().get_or_insert(kind);
    }
    let mut problems: Vec<(usize, Vec<Diagnostic>)> = vec![];
    for step in &base.order {
        let Step::Rule(index) = step else { continue };
        let rule = &base.rules[*index];
        if matches!(rule.action, Action::Default { .. }) {
            // It is checked with the other declarations.
            continue;
        }
        let wrong = unknown_classes(rule, base, schema, &told);
        if !wrong.is_empty()
            || !rule
                .clauses
                .iter()
                .all(|clause| schema.has(&clause.class) || told.classes.contains_key(clause.class.as_str()))
        {
            problems.push((*index, wrong));
            continue;
        }
        match plan(rule, &known, &symbols) {
            Ok(plan) => {
                for target in plan.effect.actions().flat_map(|action| &action.targets) {
                    let kind = known.concluded.entry(target.name.clone()).or_default();
                    *kind = kind.or(target.kind);
                }
            }
            Err(wrong) => problems.push((*index, wrong)),
        }
    }
    for (index, rule) in base.rules.iter().enumerate() {
        if rule.reacts() {
            let wrong = unknown_classes(rule, base, schema, &told);
            let planned = || plan(rule, &known, &symbols).err().unwrap_or_default();
            problems.push((index, if wrong.is_empty() { planned() } else { wrong }));
        }
    }
    for (rule, slip) in told::slips(base, &told, &known) {
        let index = base.rules.iter().position(|other| other.name == rule.name).unwrap_or(0);
        problems.push((index, vec![slip]));
    }
    // As the author reads: by the order of the files, not of the dependencies.
    problems.sort_by_key(|&(index, _)| index);
    let mut all: Vec<Diagnostic> =
        declared.into_iter().chain(problems.into_iter().flat_map(|(_, wrong)| wrong)).collect();
    all.extend(base.warnings.iter().cloned());
    // What is wrong with a class's condition shows in every rule over the class; it is said once.
    let mut said = BTreeSet::new();
    all.retain(|problem| said.insert((problem.file.clone(), problem.span, problem.message.clone())));
    all
}

fn unknown_classes(rule: &Rule, base: &RuleBase, schema: &Schema, told: &NamesTold) -> Vec<Diagnostic> {
    let mut named = BTreeSet::new();
    let declared = || base.declared.subclasses().map(|(name, _)| name);
    rule.clauses
        .iter()
        // What a declaration names is said there.
        .filter(|clause| clause.link.is_none() && clause.conditions.is_empty())
        .filter(|clause| !schema.has(&clause.class) && !told.classes.contains_key(clause.class.as_str()))
        .filter(|clause| named.insert(&clause.class))
        .map(|clause| {
            let others = schema.classes().chain(told.classes.keys().copied()).chain(declared());
            rule.file.unknown_class(clause.class_position, &clause.class, others)
        })
        .collect()
}
