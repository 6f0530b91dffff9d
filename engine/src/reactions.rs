//! What a run of reactions reports to the host.

use std::collections::BTreeMap;

use crate::changes::Changes;
use crate::conclusions::Witness;
use crate::diagnostic::Diagnostic;
use crate::value::Value;

#[derive(Clone, Debug, Default, serde::Serialize)]
pub struct Reactions {
    pub firings: Vec<Firing>,
    /// What is different now from after the last update, told and concluded.
    pub changes: Changes,
    #[serde(skip)]
    pub diagnostics: Vec<Diagnostic>,
}

impl Reactions {
    /// All that was told, in order: what [`replay`](crate::KnowledgeBase::replay) tells again.
    pub fn log(&self) -> Vec<Told> {
        self.firings.iter().flat_map(|firing| firing.told.iter().cloned()).collect()
    }
}

/// A rule that was carried out for the objects that its clauses bound.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Firing {
    /// The number of the state that it left: one more than that before.
    pub generation: u64,
    pub rule: String,
    pub version: String,
    /// The objects, as they were called then.
    pub witnesses: Vec<Witness>,
    /// What the rule reads of them and knew then, as in `door 3: closed = true`.
    pub because: String,
    pub told: Vec<Told>,
}

/// A rule that may be carried out for the objects that its clauses bind.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Activation {
    pub rule: String,
    pub version: String,
    pub priority: i64,
    pub witnesses: Vec<Witness>,
}

/// An activation that was carried out, and that would be carried out again if its clauses were met anew, or if another value
/// stood in what the rule reads.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, serde::Serialize)]
pub struct CarriedOut {
    pub rule: String,
    pub version: String,
    /// The objects with what the rule reads of them.
    pub because: String,
}

/// Something that a rule told. Keys are those at that moment; an object of a class without a key is called by
/// its row from 1.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Told {
    Object {
        class: String,
        properties: BTreeMap<String, Value>,
    },
    /// A value of an object; `None` takes back what was told.
    Value {
        class: String,
        key: String,
        property: String,
        value: Option<Value>,
        /// For how many seconds, where the rule says so; the host takes it back then.
        #[serde(skip_serializing_if = "Option::is_none")]
        lasts: Option<f64>,
    },
    Gone {
        class: String,
        key: String,
    },
}
