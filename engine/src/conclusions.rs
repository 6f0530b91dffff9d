//! What an inference reports to the host.

use std::fmt;

use crate::diagnostic::Diagnostic;
use crate::rule::{Operator, PropertyName};
use crate::value::Value;

#[derive(Clone, Debug, Default)]
pub struct Conclusions {
    /// Rules that were evaluated now, in that order; the conclusions of others still held.
    pub evaluated: Vec<String>,
    pub waiting: Vec<Waiting>,
    /// Properties that rules set to different values; such a value is unknown.
    pub conflicts: Vec<Conflict>,
    /// Properties that rules conclude, for objects that they left without a value.
    pub gaps: Vec<Gap>,
    /// Objects that a rule could not consider, since what it asks of them is unknown.
    pub left_out: Vec<LeftOut>,
    /// What failed, and what the rules' author should look at.
    pub diagnostics: Vec<Diagnostic>,
}

#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Waiting {
    pub rule: String,
    /// Classes (`ROOMS`) and properties (`ROOMS.moves`) that nobody has asserted or concluded yet.
    pub needs: Vec<String>,
}

/// A property of one object that rules set to different values.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Conflict {
    pub property: PropertyName,
    pub key: String,
    /// The rules and the values that they gave, in the order of the rules.
    pub values: Vec<(String, Value)>,
}

/// A concluded property that some objects have no value of.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Gap {
    pub property: PropertyName,
    /// Rows of the objects, ascending.
    pub rows: Vec<u32>,
    /// Why, with how many objects each reason holds for.
    pub reasons: Vec<(Reason, usize)>,
}

#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Reason {
    Conflict,
    Unmet {
        rule: String,
        variable: String,
    },
    /// A `none` of the rule was not met: there is such an object.
    Found {
        rule: String,
        variable: String,
    },
    /// An `all` of the rule was not met: an object that passes lacks what it asks.
    NotAll {
        rule: String,
        variable: String,
    },
    /// A clause of the rule was not met, and for some candidates that could not be decided.
    Undecided {
        rule: String,
        variable: String,
    },
    Unknown {
        rule: String,
    },
    NoRule,
}

impl fmt::Display for Reason {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Conflict => out.write_str("rules disagree"),
            Self::Unmet { rule, variable } => write!(out, "rule \"{rule}\" found no `{variable}`"),
            Self::Found { rule, variable } => {
                write!(out, "rule \"{rule}\" found a `{variable}`, and needs that there is none")
            }
            Self::NotAll { rule, variable } => {
                write!(out, "rule \"{rule}\" found a `{variable}` that lacks what it needs of all")
            }
            Self::Undecided { rule, variable } => {
                write!(out, "rule \"{rule}\" could not decide about `{variable}`: something is unknown")
            }
            Self::Unknown { rule } => write!(out, "rule \"{rule}\" computed with something unknown"),
            Self::NoRule => out.write_str("no rule applied"),
        }
    }
}

/// Objects of a clause's class that were no candidates, since what is asked of them is unknown.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct LeftOut {
    pub rule: String,
    pub variable: String,
    pub class: String,
    pub objects: usize,
}

#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Witness {
    pub variable: String,
    pub class: String,
    pub key: String,
}

#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Support {
    pub rule: String,
    pub version: String,
    pub file: String,
    pub line: usize,
    pub witnesses: Vec<Witness>,
}

#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Origin {
    Told,
    Rule(Support),
}

#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Revision {
    pub level: i64,
    pub operator: Operator,
    /// By how much; `None` is unknown.
    pub amount: Option<f64>,
    pub support: Support,
}

#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Justification {
    pub property: PropertyName,
    pub key: String,
    /// The value; `None` is unknown.
    pub value: Option<Value>,
    pub origin: Origin,
    pub revisions: Vec<Revision>,
}

impl fmt::Display for Support {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "rule \"{}\" ({}, line {}, version {})", self.rule, self.file, self.line, self.version)?;
        for (nth, Witness { variable, class, key }) in self.witnesses.iter().enumerate() {
            let before = if nth == 0 { " with" } else { "," };
            write!(out, "{before} {variable} = {class} {key}")?;
        }
        Ok(())
    }
}

/// One sentence, as in: `PLANTS fern water is 2, by rule "thirsty" (garden.rhai, line 1, version 0f3a9c11) with
/// plant = PLANTS fern`.
impl fmt::Display for Justification {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let PropertyName { class, property } = &self.property;
        match &self.value {
            Some(value) => write!(out, "{class} {} {property} is {value}, ", self.key)?,
            None => write!(out, "{class} {} {property} is unknown, ", self.key)?,
        }
        match &self.origin {
            Origin::Told => out.write_str("as told")?,
            Origin::Rule(support) => write!(out, "by {support}")?,
        }
        for Revision { operator, amount, support, .. } in &self.revisions {
            match amount {
                Some(amount) => write!(out, "; revised {} {amount} by {support}", operator.sign())?,
                None => write!(out, "; revised {} something unknown by {support}", operator.sign())?,
            }
        }
        Ok(())
    }
}

/// What one concluded value rests on, as numbers: cheap for many rows.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Grounds {
    /// The rule's number in its rule base, from 0.
    pub rule: usize,
    /// For each variable of the rule but the first the row of its object; `None` where it is bound to none, or to the one
    /// that a property of the first one's object names.
    pub witnesses: Vec<Option<u32>>,
}

/// For each object of a class the rule behind one of its properties, as numbers: cheap for a whole column.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Justifications {
    /// Names and versions of the rules that conclude the property.
    pub rules: Vec<(String, String)>,
    /// For each row the number of its rule; `None` where the value was told or is unknown.
    pub of_row: Vec<Option<u32>>,
}
