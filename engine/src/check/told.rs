//! Names that rules which react tell: new ones are allowed, but not those that look like a slip.

use super::kinds::Declared;
use crate::diagnostic::Diagnostic;
use crate::rule::{PropertyName, Rule};
use crate::rule_base::RuleBase;
use crate::suggest::nearest;
use crate::told::NamesTold;

/// A told class or property that nobody else has, beside one of nearly the same name that somebody has; what is near to no other
/// name is new.
pub(super) fn slips<'r>(
    base: &'r RuleBase,
    told: &NamesTold<'r>,
    known: &Declared,
) -> Vec<(&'r Rule, Diagnostic)> {
    let mut problems = vec![];
    let ranged = || base.rules.iter().flat_map(Rule::classes);
    for (class, (rule, position)) in &told.classes {
        if known.schema.has(class) || ranged().any(|other| other == *class) {
            continue;
        }
        let others: Vec<&str> = known.schema.classes().chain(ranged()).collect();
        if nearest(class, others.iter().copied()).is_some() {
            problems.push((*rule, rule.file.unknown_class(*position, class, others.into_iter())));
        }
    }
    let read = |name: &PropertyName| base.rules.iter().any(|rule| rule.reads.contains_key(name));
    for (name, (rule, position)) in &told.properties {
        let there = known.schema.kind(&name.class, &name.property).is_some();
        if there || known.concluded.contains_key(name) || read(name) {
            continue;
        }
        let concluded = known.concluded.keys().filter(|other| other.class == name.class);
        let read =
            base.rules.iter().flat_map(|rule| rule.reads.keys()).filter(|other| other.class == name.class);
        let others = known
            .schema
            .properties(&name.class)
            .chain(concluded.chain(read).map(|other| other.property.as_str()));
        let others: Vec<&str> = others.collect();
        if nearest(&name.property, others.iter().copied()).is_some() {
            problems.push((*rule, rule.file.unknown_property(*position, name, others.into_iter())));
        }
    }
    problems
}
