//! What rules said at each junction of a path, and the answer that comes of it: a path, or why there is none.

use std::sync::Arc;

use adit_db::plan::{Considered, Fact as FactRow, PathStep, Plan};
use adit_engine::{Consultation, Type, Value};
use serde::Serialize;
use serde_json::json;

use super::refusal::{NoPath, Spoke};

/// A rule by name, a row of a table by its number too.
pub fn name_of(spoke: &Spoke) -> String {
    spoke.row.map_or_else(|| spoke.rule.clone(), |row| format!("{}, row {row}", spoke.rule))
}

/// What rules were told at a junction, what they concluded, and which of them spoke.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Said {
    /// Its number; 0 where it is none.
    pub junction: usize,
    /// What it is about: `junction 2`, `channel 3`.
    #[serde(skip)]
    pub place: String,
    /// The rules that were looked at, tables row by row.
    pub considered: Vec<Spoke>,
    /// Told and concluded.
    #[serde(skip)]
    pub facts: Vec<Fact>,
    /// What is done there, if rules say so.
    #[serde(skip)]
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

    /// For people: the rule that spoke, then why the others did not.
    pub fn lines(&self) -> Vec<String> {
        let (spoke, silent): (Vec<_>, Vec<_>) = self.considered.iter().partition(|rule| rule.spoke);
        let mut lines = vec![self.place.clone()];
        lines.extend(spoke.iter().map(|rule| format!("  {} spoke", rule.text())));
        lines.extend(silent.iter().map(|rule| format!("  {}", rule.text())));
        lines
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

impl<P> Answer<P> {
    /// As JSON, where a path is written so.
    pub(super) fn as_json(
        &self,
        is_explained: bool,
        path: impl FnOnce(&P) -> serde_json::Value,
    ) -> serde_json::Value {
        match &self.path {
            Ok(found) => {
                let mut answer = path(found);
                if is_explained {
                    answer["said"] =
                        json!(self.said.iter().filter(|said| said.junction > 0).collect::<Vec<_>>());
                }
                answer
            }
            Err(no_path) => json!({
                "status": "no_path",
                "junction": no_path.junction,
                "reason": no_path.reason,
                "considered": no_path.considered,
            }),
        }
    }

    /// For people, where a path is written so.
    pub(super) fn as_lines(&self, is_explained: bool, path: impl FnOnce(&P) -> Vec<String>) -> Vec<String> {
        let mut lines = match &self.path {
            Ok(found) => path(found),
            Err(no_path) => no_path.lines(),
        };
        if is_explained {
            lines.extend(self.said.iter().filter(|said| said.junction > 0).flat_map(Said::lines));
        }
        lines
    }

    /// Adds to a record what came of the plan: `path` gives length, least clearance and steps.
    pub(super) fn add_to(&self, record: &mut Plan, path: impl FnOnce(&P) -> (f64, f64, Vec<PathStep>)) {
        match &self.path {
            Ok(found) => {
                let (length, clearance, steps) = path(found);
                (record.length, record.min_clearance) = (Some(length), Some(clearance));
                record.steps = steps;
            }
            Err(no_path) => record.reason = Some(no_path.reason.clone()),
        }
        self.said.iter().filter(|said| said.junction > 0).for_each(|said| rows(said, record));
    }
}

fn rows(said: &Said, record: &mut Plan) {
    let junction = said.junction as i64;
    record.facts.extend(said.facts.iter().map(|fact| FactRow {
        junction,
        property: fact.property.to_owned(),
        value: match &fact.value {
            Value::Number(number) => adit_db::Cell::Real(*number),
            Value::Text(text) => adit_db::Cell::Text(text.to_string()),
            Value::Truth(truth) => adit_db::Cell::Integer((*truth).into()),
        },
        rule: fact.rule.clone(),
    }));
    record.considered.extend(said.considered.iter().map(|spoke| Considered {
        junction,
        rule: spoke.rule.clone(),
        row: spoke.row.map(|row| row as i64),
        file: spoke.file.clone(),
        line: spoke.line as i64,
        spoke: spoke.spoke,
        because: spoke.because.clone(),
    }));
}
