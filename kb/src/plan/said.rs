//! What rules said at each junction of a path, and the answer that comes of it: a path, or why there is none.

use std::sync::Arc;

use adit_engine::{Consultation, Type, Value};

use super::refusal::{NoPath, Spoke};

/// A rule by name, a row of a table by its number too.
pub fn name_of(spoke: &Spoke) -> String {
    spoke.row.map_or_else(|| spoke.rule.clone(), |row| format!("{}, row {row}", spoke.rule))
}

/// What rules were told at a junction, what they concluded, and which of them spoke.
#[derive(Clone, Debug, PartialEq)]
pub struct Said {
    /// Its number; 0 where it is none.
    pub junction: usize,
    /// What it is about: `junction 2`, `channel 3`.
    pub place: String,
    /// The rules that were looked at, tables row by row.
    pub considered: Vec<Spoke>,
    /// Told and concluded.
    pub facts: Vec<Fact>,
    /// What is done there, if rules say so.
    pub action: Option<Arc<str>>,
}

impl Said {
    /// The rule by which a property is concluded, with the rows of tables and with those that revised it.
    pub fn rule_of(&self, property: &str) -> Option<String> {
        let fact = self.facts.iter().find(|fact| fact.property == property)?;
        let (rule, _) = fact.rule.as_ref()?;
        let spoke = self.considered.iter().find(|spoke| spoke.spoke && spoke.rule == *rule);
        let name = spoke.map_or_else(|| rule.clone(), name_of);
        Some(
            std::iter::once(name)
                .chain(fact.revised.iter().cloned())
                .collect::<Vec<_>>()
                .join("; revised by "),
        )
    }
}

/// A property of a step, told to the rules or concluded by one.
#[derive(Clone, Debug, PartialEq)]
pub struct Fact {
    pub property: &'static str,
    pub value: Value,
    /// The rule that concluded it, with its version; `None` where the planner told it.
    pub rule: Option<(String, String)>,
    /// The rules that changed it after that.
    pub revised: Vec<String>,
}

/// What rules were told of the last object and what they concluded, as far as it is known.
pub fn facts(
    consultation: &mut Consultation,
    class: &str,
    told: &[(&'static str, Type)],
    concluded: &[&'static str],
) -> Vec<Fact> {
    let rules = consultation.rules();
    let knowledge = consultation.knowledge();
    let mut facts = Vec::new();
    for (property, _) in told {
        if let Some(value) = knowledge.value_at(class, 0, property) {
            facts.push(Fact { property, value, rule: None, revised: Vec::new() });
        }
    }
    for property in concluded {
        let Some(value) = knowledge.value_at(class, 0, property) else { continue };
        let (grounds, _) = knowledge.grounds(class, property, &[0]);
        let rule = grounds.first().and_then(|grounds| rules.rules().get(grounds.rule));
        let rule = rule.map(|rule| (rule.name().to_owned(), rule.version().to_owned()));
        let revised = knowledge.revised(&rules, class, property);
        let revised = revised.into_iter().filter(|(_, rows)| !rows.is_empty());
        let revised = revised.map(|(rule, _)| rule.name().to_owned()).collect();
        facts.push(Fact { property, value, rule, revised });
    }
    facts
}

/// A path or why there is none, and what rules said on the way.
#[derive(Clone, Debug)]
pub struct Answer<P> {
    pub path: Result<P, NoPath>,
    /// Junction by junction, as far as rules were asked.
    pub said: Vec<Said>,
}
