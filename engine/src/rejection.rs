//! Why not: what rules rejected on the way to a value, and by which test.

use std::fmt;

use crate::rule::{PropertyName, Rule};
use crate::value::Value;

#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct WhyNot {
    pub property: PropertyName,
    pub key: String,
    /// The value that it has; `None` is unknown.
    pub value: Option<Value>,
    /// What was rejected, in the order of the rules, of their clauses, and of the objects.
    pub rejected: Vec<Rejected>,
    /// Whether there were more objects than are named for one rule, or than there was time for.
    pub truncated: bool,
}

/// An object that a clause of a rule did not take, or a clause or rule that as a whole did not hold.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Rejected {
    pub rule: String,
    pub version: String,
    pub file: String,
    pub line: usize,
    /// The clause's variable; `None`: the rule as a whole.
    pub variable: Option<String>,
    pub class: Option<String>,
    /// The object's key; `None`: the clause as a whole.
    pub key: Option<String>,
    #[serde(flatten)]
    pub reason: Rejection,
}

impl Rejected {
    pub(crate) fn of_rule(rule: &Rule, reason: Rejection) -> Self {
        Self {
            rule: rule.name.clone(),
            version: rule.version.clone(),
            file: rule.file().to_owned(),
            line: rule.line,
            variable: None,
            class: None,
            key: None,
            reason,
        }
    }
}

#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[serde(tag = "reason", rename_all = "snake_case")]
pub enum Rejection {
    Failed {
        /// The part, as the rule writes it.
        test: String,
        /// The value on its left side, or its own where it has no sides.
        left: Option<Value>,
        right: Option<Value>,
    },
    Unknown {
        /// The part, as the rule writes it.
        test: String,
        left: Option<Value>,
        right: Option<Value>,
    },
    /// Another object has the lesser (of `most`: the greater) value.
    Lost {
        /// What is compared, as the rule writes it.
        by: String,
        value: f64,
        winner: String,
        winner_value: f64,
    },
    /// What is compared is unknown of the object.
    Unranked {
        /// What is compared, as the rule writes it.
        by: String,
    },
    /// An object before it passes, too, and one is enough.
    Later {
        winner: String,
    },
    /// There must be no such object, and this is one.
    Found,
    /// No object passes, or an `all` does not hold.
    Unmet {
        objects: usize,
    },
    Row {
        /// The row, from 1.
        row: usize,
        /// The input of the first cell that fails, as the table writes it.
        input: String,
        /// What the cell asks, in words.
        cell: String,
        value: Option<Value>,
    },
    Waiting {
        needs: Vec<String>,
    },
    Overruled {
        /// The rule that counts; `None`: the value was told.
        by: Option<String>,
    },
}

impl fmt::Display for Rejected {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let class = self.class.as_deref().unwrap_or_default();
        let variable = self.variable.as_deref().unwrap_or_default();
        write!(out, "rule \"{}\" ", self.rule)?;
        if let Some(key) = &self.key {
            match &self.reason {
                Rejection::Found => write!(out, "wants no `{variable}`, and {class} {key} is one")?,
                _ => write!(out, "does not take {class} {key} as `{variable}`: ")?,
            }
        }
        match &self.reason {
            Rejection::Failed { test, left, right } => {
                sides(out, test, "false", left.as_ref(), right.as_ref())
            }
            Rejection::Unknown { test, left, right } => {
                sides(out, test, "unknown", left.as_ref(), right.as_ref())
            }
            Rejection::Lost { by, value, winner, winner_value } => {
                write!(out, "{by} {value} against {winner_value} of {class} {winner}")
            }
            Rejection::Unranked { by } => write!(out, "its {by} is unknown"),
            Rejection::Later { winner } => write!(out, "{class} {winner} comes before it"),
            Rejection::Found => Ok(()),
            Rejection::Unmet { objects: 0 } => {
                write!(out, "finds no `{variable}`: class {class} has no objects")
            }
            Rejection::Unmet { objects } => {
                let s = if *objects == 1 { "" } else { "s" };
                write!(out, "finds no `{variable}` among {objects} object{s} of {class}")
            }
            Rejection::Row { row, input, cell, value } => {
                let value = value.as_ref().map_or("unknown".to_owned(), Value::to_string);
                write!(out, "row {row} wants {input} {cell}, and it is {value}")
            }
            Rejection::Waiting { needs } => write!(out, "waits for {}", needs.join(", ")),
            Rejection::Overruled { by: Some(rule) } => {
                write!(out, "is not heard: \"{rule}\" stands against it")
            }
            Rejection::Overruled { by: None } => out.write_str("is not heard: the value was told"),
        }
    }
}

fn sides(
    out: &mut fmt::Formatter<'_>,
    test: &str,
    truth: &str,
    left: Option<&Value>,
    right: Option<&Value>,
) -> fmt::Result {
    write!(out, "{test} is {truth}")?;
    let word = |value: Option<&Value>| value.map_or("unknown".to_owned(), Value::to_string);
    match (left, right) {
        (None, None) => Ok(()),
        (left, None) if truth == "false" => write!(out, " ({})", word(left)),
        (left, right) => write!(out, " ({} against {})", word(left), word(right)),
    }
}

/// One sentence a rejection, the value first.
impl fmt::Display for WhyNot {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let PropertyName { class, property } = &self.property;
        let word = self.value.as_ref().map_or("unknown".to_owned(), Value::to_string);
        write!(out, "{class} {} {property} is {word}", self.key)?;
        if self.rejected.is_empty() {
            out.write_str("; no rule rejected anything")?;
        }
        for rejected in &self.rejected {
            write!(out, "; {rejected}")?;
        }
        if self.truncated {
            out.write_str("; and more objects than are named here")?;
        }
        Ok(())
    }
}
