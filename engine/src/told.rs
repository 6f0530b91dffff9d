//! What rules that react tell, as far as it is named in them: facts that no host has to assert.

use std::collections::BTreeMap;

use rhai::Position;

use crate::rule::{PropertyName, Rule};

/// Classes and properties that `on` rules tell, with the first rule and place that names each.
#[derive(Debug, Default)]
pub(crate) struct NamesTold<'r> {
    pub(crate) classes: BTreeMap<&'r str, (&'r Rule, Position)>,
    pub(crate) properties: BTreeMap<PropertyName, (&'r Rule, Position)>,
}

impl<'r> NamesTold<'r> {
    pub(crate) fn of(rules: &'r [Rule]) -> Self {
        let mut told = Self::default();
        for (rule, reaction) in rules.iter().filter_map(|rule| Some((rule, rule.reaction()?))) {
            for telling in reaction.tells.iter().chain(&rule.file.tells) {
                told.classes.entry(&telling.class).or_insert((rule, telling.position));
                for (property, position, _) in &telling.properties {
                    let name = PropertyName::new(&telling.class, property);
                    told.properties.entry(name).or_insert((rule, *position));
                }
            }
            for setting in &reaction.sets {
                let name = PropertyName::new(&rule.clauses[setting.variable].class, &setting.property);
                told.properties.entry(name).or_insert((rule, setting.position));
            }
        }
        told
    }
}
