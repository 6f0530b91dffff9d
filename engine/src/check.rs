//! Names and types of a rule base against a schema.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};

use crate::diagnostic::{Code, Diagnostic};
use crate::order::Step;
use crate::plan::{Effect, Kind, Kinds, plan};
use crate::rule::{PropertyName, Rule};
use crate::rule_base::RuleBase;
use crate::schema::Schema;
use crate::suggest::nearest;
use crate::symbols::Symbols;
use crate::value::Type;

pub(crate) fn check(base: &RuleBase, schema: &Schema) -> Vec<Diagnostic> {
    let symbols = RefCell::new(Symbols::default());
    let mut known = Declared { schema, concluded: BTreeMap::new() };
    for name in base.concluded() {
        known.concluded.insert(name.clone(), None);
    }
    known.concluded.extend(base.hypotheses().into_iter().map(|name| (name, Some(Type::Truth))));
    let mut problems: Vec<(usize, Vec<Diagnostic>)> = vec![];
    for step in &base.order {
        let Step::Rule(index) = step else { continue };
        let rule = &base.rules[*index];
        let wrong = unknown_classes(rule, schema);
        if !wrong.is_empty() {
            problems.push((*index, wrong));
            continue;
        }
        match plan(rule, &known, &symbols) {
            Ok(plan) => {
                if let Effect::Conclude { then, otherwise } = &plan.effect {
                    for target in
                        then.targets.iter().chain(otherwise.iter().flat_map(|action| &action.targets))
                    {
                        let kind = known.concluded.entry(target.name.clone()).or_default();
                        *kind = kind.or(target.kind);
                    }
                }
            }
            Err(wrong) => problems.push((*index, wrong)),
        }
    }
    // As the author reads: by the order of the files, not of the dependencies.
    problems.sort_by_key(|&(index, _)| index);
    problems.into_iter().flat_map(|(_, wrong)| wrong).collect()
}

fn unknown_classes(rule: &Rule, schema: &Schema) -> Vec<Diagnostic> {
    let mut named = BTreeSet::new();
    rule.clauses
        .iter()
        .filter(|clause| !schema.has(&clause.class) && named.insert(&clause.class))
        .map(|clause| {
            let place = rule.file.source.place(clause.class_position);
            Diagnostic::error(Code::UnknownClass, &place, format!("there is no class {}", clause.class))
                .did_you_mean(nearest(&clause.class, schema.classes()))
        })
        .collect()
}

/// The properties of a schema, and those that rules conclude.
struct Declared<'s> {
    schema: &'s Schema,
    concluded: BTreeMap<PropertyName, Option<Type>>,
}

impl Kinds for Declared<'_> {
    fn kind(&self, name: &PropertyName) -> Kind {
        match (self.schema.kind(&name.class, &name.property), self.concluded.get(name)) {
            (Some(kind), _) => Kind::Holds(Some(kind)),
            (None, Some(kind)) => Kind::Holds(*kind),
            (None, None) => Kind::Missing,
        }
    }

    /// What an earlier rule gives, a later one has to give too.
    fn declared(&self, name: &PropertyName) -> Option<Type> {
        self.schema.kind(&name.class, &name.property).or_else(|| self.concluded.get(name).copied().flatten())
    }

    fn properties(&self, class: &str) -> Vec<String> {
        let concluded =
            self.concluded.keys().filter(|name| name.class == class).map(|name| name.property.clone());
        self.schema.properties(class).map(str::to_owned).chain(concluded).collect()
    }
}
