//! What values of a property must be, and which properties of a class anybody knows.

use adit_engine::{RuleBase, Schema, Type};

use super::closing::lists_robots;
use super::{Fact, Told};
use crate::words::suggest::did_you_mean;

/// What values of these properties must be, whatever rules say.
const KINDS: [(&str, &str, Type); 12] = [
    ("ROBOTS", "berth", Type::Number),
    ("ROBOTS", "berth_cost", Type::Number),
    ("SPACES", "closed", Type::Truth),
    ("DOORWAYS", "closed", Type::Truth),
    ("DOORWAYS", "closed_from", Type::Text),
    ("PRIME_AREAS", "open", Type::Truth),
    ("ROOMS", "hardness", Type::Number),
    ("ROOMS", "action", Type::Text),
    ("ROOMS", "passable", Type::Truth),
    ("DOORS", "hardness", Type::Number),
    ("DOORS", "action", Type::Text),
    ("DOORS", "passable", Type::Truth),
];

/// What values of the property must be, whatever rules say; `None` where it is theirs to say.
pub fn fixed(class: &str, property: &str) -> Option<Type> {
    if lists_robots(class, property) {
        return Some(Type::Text);
    }
    let found = KINDS.iter().find(|(of, name, _)| *of == class && *name == property);
    found.map(|(_, _, kind)| *kind)
}

/// That no rule reads the property and nothing gives it, with what may be meant; `None` where somebody knows it.
pub fn unread(
    class: &str,
    property: &str,
    schema: &Schema,
    rules: &RuleBase,
) -> Option<(String, Option<String>)> {
    let mut known: Vec<&str> = schema.properties(class).collect();
    for rule in rules.rules() {
        let named = rule.reads().chain(rule.sets()).filter(|name| name.class == class);
        known.extend(named.map(|name| name.property.as_str()));
    }
    known.extend(KINDS.iter().filter(|(of, _, _)| *of == class).map(|(_, name, _)| *name));
    if known.contains(&property) || lists_robots(class, property) {
        return None;
    }
    let message = format!("no rule reads {class}.{property}, and nothing gives it");
    Some((message, did_you_mean(property, known.iter().copied())))
}

/// A fact whose value its property cannot hold, and what it holds. Only another program can write such a one.
#[derive(Clone, Debug, PartialEq)]
pub struct Unfit {
    pub fact: Fact,
    pub holds: Type,
}

impl Unfit {
    /// That it counts for nothing, and why.
    pub fn said(&self) -> String {
        let Fact { class, property, .. } = &self.fact;
        let (holds, is) = (self.holds.plural(), self.fact.kind().plural());
        format!(
            "{} counts for nothing: {class}.{property} holds {holds}, and its value is one of {is}",
            self.fact.name()
        )
    }
}

impl Told {
    /// Sets aside facts with values that their properties cannot hold, as far as `schema` says.
    pub fn set_unfit_aside(&mut self, schema: &Schema) {
        let holds = |fact: &Fact| {
            fixed(&fact.class, &fact.property).or_else(|| schema.kind(&fact.class, &fact.property))
        };
        let facts = std::mem::take(&mut self.facts);
        for fact in facts {
            match holds(&fact).filter(|kind| *kind != fact.kind()) {
                Some(holds) => self.unfit.push(Unfit { fact, holds }),
                None => self.facts.push(fact),
            }
        }
    }
}
