//! Why something is as it is: what the database keeps of each conclusion.

use adit_db::Tx;
use adit_db::cell::Cell;
use adit_db::conclusion::Conclusion;
use serde::Serialize;

use crate::error::{Error, Result};
use crate::generation;
use crate::knowledge::KnowledgeBase;
use crate::subject::Subject;
use crate::suggest::did_you_mean;

/// What is concluded about an object, and why.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Why {
    /// The state of the knowledge base that the answer rests on.
    pub generation: u64,
    /// The object, as `doors.7`.
    pub object: String,
    /// As people call it.
    pub name: String,
    /// Each property that rules conclude.
    pub conclusions: Vec<Reasoned>,
}

/// A concluded value.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Reasoned {
    /// The property.
    pub property: String,
    /// Its value.
    pub value: Cell,
    /// The rule.
    pub rule: Option<String>,
    /// Its version.
    pub version: Option<String>,
    /// Its file.
    pub file: Option<String>,
    /// Its line.
    pub line: Option<i64>,
    /// What the rule chose, by its variables; under `revised by` the rules that changed the value after it.
    pub witness: Option<serde_json::Value>,
    /// All of it in one sentence.
    pub why: String,
}

impl KnowledgeBase {
    /// Why an object (`door 7`, `room d`, `doors.7`), or one property of it (`doors.7.hardness`), is as it is.
    ///
    /// Where tables, `site.toml` or the map were edited since the last build, everything is derived again first.
    pub fn why(&self, what: &str) -> Result<Why> {
        self.fresh()?.snapshot(|tx| of(tx, what))
    }
}

/// Why an object, or one property of it, is as the database has it.
pub(crate) fn of(tx: &mut Tx<'_>, what: &str) -> Result<Why> {
    let subject = Subject::find(tx, what)?;
    let conclusions = conclusions(tx, &subject)?;
    let object = format!("{}.{}", subject.class, subject.key);
    Ok(Why { generation: generation::read(tx)?, object, name: subject.name, conclusions })
}

/// What is concluded about the subject; a property that is named must be among it.
pub fn conclusions(tx: &mut Tx<'_>, subject: &Subject) -> Result<Vec<Reasoned>> {
    let all = tx.conclusions(&subject.class, &subject.cell())?;
    let Some(property) = &subject.property else {
        return Ok(all.into_iter().map(|found| reasoned(subject, found)).collect());
    };
    let known: Vec<String> = all.iter().map(|found| found.property.clone()).collect();
    let found: Vec<Reasoned> = all
        .into_iter()
        .filter(|found| found.property == *property)
        .map(|found| reasoned(subject, found))
        .collect();
    if !found.is_empty() {
        return Ok(found);
    }
    let message = format!(
        "no rule concluded `{property}` of {}: it was told, is unknown, or is no property",
        subject.name
    );
    let help = did_you_mean(property, known.iter().map(String::as_str))
        .or_else(|| (!known.is_empty()).then(|| format!("concluded are {}", known.join(", "))));
    Err(Error::said("why/not-concluded", message, help))
}

fn reasoned(subject: &Subject, found: Conclusion) -> Reasoned {
    let witness: Option<serde_json::Value> =
        found.witness.as_deref().and_then(|witness| serde_json::from_str(witness).ok());
    let by = found.rule.as_ref().map_or(String::new(), |rule| {
        let version = found.version.as_deref().unwrap_or_default();
        match (&found.file, found.line) {
            (Some(file), Some(line)) => {
                format!(", by rule \"{rule}\" ({file}, line {line}, version {version})")
            }
            _ => format!(", by rule \"{rule}\""),
        }
    });
    let facts = witness.as_ref().map_or(String::new(), chosen);
    let why = format!("{} {} is {}{by}{facts}", subject.name, found.property, word(&found));
    let Conclusion { property, value, rule, version, file, line, .. } = found;
    Reasoned { property, value, rule, version, file, line, witness, why }
}

/// What a rule chose, and what changed the value after it.
fn chosen(witness: &serde_json::Value) -> String {
    let facts = witness.as_object().into_iter().flatten();
    let chosen = facts.filter_map(|(variable, object)| Some(format!("{variable} = {}", object.as_str()?)));
    let chosen: Vec<String> = chosen.collect();
    let revised = witness["revised by"].as_array().into_iter().flatten();
    let revised: Vec<String> = revised.filter_map(|rule| Some(format!("\"{}\"", rule.as_str()?))).collect();
    let part = |word: &str, of: &[String]| {
        if of.is_empty() { String::new() } else { format!("{word} {}", of.join(", ")) }
    };
    format!("{}{}", part(" with", &chosen), part("; revised by", &revised))
}

/// A value as people read it; the database holds truth values as 0 and 1.
fn word(found: &Conclusion) -> String {
    match (&found.value, found.property.as_str()) {
        (Cell::Null, _) => "unknown".to_owned(),
        (Cell::Integer(truth), "passable" | "open") => (*truth != 0).to_string(),
        (value, _) => value.to_string(),
    }
}
