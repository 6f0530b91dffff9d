//! What values of a property must be, and which properties of a class anybody knows.

use adit_engine::{RuleBase, Schema, Type};

use super::closing::lists_robots;
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
