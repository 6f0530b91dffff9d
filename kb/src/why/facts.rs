//! What a rule read of an object that it chose.

use std::collections::BTreeMap;

use adit_engine::{Support, Value, Witness};
use serde::Serialize;

use super::subject::Subject;
use crate::state::State;
use crate::words::number::number;

/// An object with the properties that rules read of it.
#[derive(Clone, Debug, PartialEq, Serialize, utoipa::ToSchema)]
pub struct Facts {
    /// Its class.
    pub class: String,
    /// Its key.
    pub key: String,
    /// What was read, by property; `null` is unknown, or a number without an end.
    #[schema(value_type = serde_json::Value)]
    pub properties: BTreeMap<String, serde_json::Value>,
}

impl Facts {
    /// What a rule read of one of its witnesses; `None` where that is nothing.
    pub(super) fn of(fork: &State, support: &Support, witness: &Witness) -> Option<Self> {
        let rule = fork.inputs.rules.rules().iter().find(|rule| rule.name() == support.rule)?;
        let knowledge = &fork.knowledge;
        let read = rule.reads().filter(|name| name.class == witness.class);
        let value = |property: &str| match knowledge.value(&witness.class, &witness.key, property) {
            Some(Value::Number(number)) => serde_json::json!(number),
            Some(Value::Text(text)) => serde_json::json!(&*text),
            Some(Value::Truth(truth)) => serde_json::json!(truth),
            None => serde_json::Value::Null,
        };
        let properties: BTreeMap<String, serde_json::Value> =
            read.map(|name| (name.property.clone(), value(&name.property))).collect();
        let (class, key) = (witness.class.clone(), witness.key.clone());
        (!properties.is_empty()).then_some(Self { class, key, properties })
    }

    /// Adds what is new of it to a list.
    pub(super) fn add(all: &mut Vec<Self>, new: Option<Self>) {
        let Some(new) = new else { return };
        match all.iter_mut().find(|known| known.class == new.class && known.key == new.key) {
            Some(known) => known.properties.extend(new.properties),
            None => all.push(new),
        }
    }

    /// What of it is unknown: `its hardness`, or of another object than is asked about `the hardness of robots SQUAT`.
    pub(super) fn unknown(self, asked: &Subject) -> Vec<String> {
        let is_asked = self.key == asked.key && self.class.eq_ignore_ascii_case(&asked.class);
        let unknown = self.properties.into_iter().filter(|(_, value)| value.is_null());
        let said = |property: String| {
            if is_asked {
                format!("its {property}")
            } else {
                format!("the {property} of {} {}", self.class.to_lowercase(), self.key)
            }
        };
        unknown.map(|(property, _)| said(property)).collect()
    }

    /// ` (hardness 4, width 0.8)`; what is unknown is left out.
    pub(super) fn in_brackets(&self) -> String {
        let word = |value: &serde_json::Value| match value {
            serde_json::Value::Number(found) => found.as_f64().map(number),
            serde_json::Value::String(text) => Some(text.clone()),
            serde_json::Value::Bool(truth) => Some(truth.to_string()),
            _ => None,
        };
        let parts: Vec<String> = self
            .properties
            .iter()
            .filter_map(|(name, value)| Some(format!("{name} {}", word(value)?)))
            .collect();
        if parts.is_empty() { String::new() } else { format!(" ({})", parts.join(", ")) }
    }
}
