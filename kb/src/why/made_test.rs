//! A test of rules made of what is there: of a room, a door or another object, with what its conclusions may follow from.

use std::collections::BTreeSet;
use std::fmt::Write;

use adit_db::Cell;
use adit_engine::{RuleTests, SourceFile};
use adit_planners::facts::Column;
use serde::Serialize;

use super::subject::Subject;
use crate::error::problem::Problem;
use crate::error::{Code, Error, Result};
use crate::knowledge::{classes, tables};
use crate::state::State;

/// Of a table that is told whole, so many rows stand in a test.
const ROWS: usize = 200;

/// A test of rules, as it stands in a file of tests.
#[derive(Clone, Debug, PartialEq, Serialize, utoipa::ToSchema)]
pub struct MadeTest {
    /// What it is about, as people call it.
    pub name: String,
    /// The test: what is given, and what rules conclude of it now.
    pub text: String,
    /// What fails where the test stands alone, since more decides than stands in it; none where it holds.
    pub failures: Vec<Problem>,
}

impl State {
    /// A test that holds as long as rules say of an object (`room d`, `door 7`) what they say of it now.
    pub fn made_test(&self, what: &str) -> Result<MadeTest> {
        let subject = Subject::find(self, what)?;
        let class = subject.class.to_uppercase();
        let concluded = self.inputs.rules.concluded().into_iter().filter(|of| of.class.as_str() == class);
        let concluded: Vec<&str> = concluded.map(|of| of.property.as_str()).collect();
        let row = self.knowledge.row(&class, &subject.key);
        let (Some(row), false) = (row, concluded.is_empty()) else {
            let message = format!("rules conclude nothing of {}, so there is nothing to test", subject.name);
            return Err(Error::said(Code::WhyUnknown, message, None));
        };
        let mut text = format!("[[test]]\nname = {}\n[test.given]\n", quoted(&subject.name));
        for (name, rows) in self.given_with(&class, row) {
            self.write_rows(&name, &rows, &mut text);
        }
        writeln!(text, "[test.conclude]").ok();
        for property in concluded {
            let value = self.value(&class, property, row).unwrap_or_else(|| "{ unknown = true }".to_owned());
            writeln!(text, "{class}.{}.{property} = {value}", quoted(&subject.key)).ok();
        }
        let file = SourceFile::new("tests/made.toml", text.as_str());
        let tests = RuleTests::read(&[file]).map_err(|problems| Error::all(problems.0))?;
        let outcomes = self.site.trial(&self.inputs.rules, &tests, &self.told)?;
        let failures = outcomes.into_iter().flat_map(|outcome| outcome.failures);
        let failures = failures.map(|failure| Problem::of(&failure.diagnostic.into())).collect();
        Ok(MadeTest { name: subject.name, text, failures })
    }

    /// The rows that a test of one object is given, by class: tables whole, and of what planners gave what belongs to it.
    fn given_with(&self, class: &str, row: usize) -> Vec<(String, Vec<usize>)> {
        let knowledge = &self.knowledge;
        let rules = self.inputs.rules.rules();
        let mut named: BTreeSet<String> =
            rules.iter().flat_map(|rule| rule.classes()).map(str::to_owned).collect();
        named.insert(class.to_owned());
        let number = |property: &str| match classes::column(knowledge, class, property) {
            Some(Column::Number(values)) => values[row],
            _ => None,
        };
        let rooms: Vec<f64> = ["room", "room1", "room2"].into_iter().filter_map(number).collect();
        let mut names: BTreeSet<String> = BTreeSet::new();
        let (mut given, mut later) = (Vec::new(), Vec::new());
        for name in named {
            let Some(len) = knowledge.len(&name) else { continue };
            if name == class {
                given.push((name, vec![row]));
            } else if self.told.classes.contains_key(&name) {
                given.push((name, (0..len.min(ROWS)).collect()));
            } else if let Some(Column::Number(of)) = classes::column(knowledge, &name, "room") {
                let rows: Vec<usize> =
                    (0..len).filter(|&row| of[row].is_some_and(|room| rooms.contains(&room))).collect();
                for &row in &rows {
                    names.extend(
                        knowledge.key(&name, row).iter().flat_map(|key| key.split('/')).map(str::to_owned),
                    );
                }
                given.push((name, rows));
            } else {
                later.push((name, len));
            }
        }
        for (name, len) in later {
            let is_named = |row: &usize| knowledge.key(&name, *row).is_some_and(|key| names.contains(&key));
            let rows: Vec<usize> = (0..len).filter(is_named).collect();
            given.push((name, rows));
        }
        given.retain(|(_, rows)| !rows.is_empty());
        given.sort();
        given
    }

    fn write_rows(&self, class: &str, rows: &[usize], text: &mut String) {
        let schema = self.site.schema(&self.told);
        let rules = &self.inputs.rules;
        let properties: Vec<&str> =
            schema.properties(class).filter(|property| !rules.gives(class, property)).collect();
        writeln!(text, "{class} = [").ok();
        for &row in rows {
            let cells = properties.iter().filter_map(|property| {
                self.value(class, property, row).map(|value| format!("{property} = {value}"))
            });
            writeln!(text, "    {{ {} }},", cells.collect::<Vec<_>>().join(", ")).ok();
        }
        writeln!(text, "]").ok();
    }

    /// A value as tests have it; `None` where it is not known.
    fn value(&self, class: &str, property: &str, row: usize) -> Option<String> {
        let column = classes::column(&self.knowledge, class, property)?;
        let is_truth = matches!(column, Column::Truth(_));
        match tables::cell(&column, row) {
            Cell::Integer(truth) if is_truth => Some((truth == 1).to_string()),
            Cell::Integer(number) => Some(number.to_string()),
            Cell::Real(number) if number.is_finite() => Some(number.to_string()),
            Cell::Null | Cell::Blob(_) | Cell::Real(_) => None,
            Cell::Text(text) => Some(quoted(&text)),
        }
    }
}

/// A text as TOML has it, whose escapes are those of JSON.
fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}
