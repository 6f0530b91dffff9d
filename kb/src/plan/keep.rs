//! What of a plan is kept: facts, what rules said of them, and the steps of the path.

use adit_db::plan::{Considered, Fact as FactRow, Plan};
use adit_engine::{Consultation, Type, Value};

use super::said::Said;

/// A property of a step, told to the rules or concluded by one.
#[derive(Clone, Debug, PartialEq)]
pub struct Fact {
    pub property: &'static str,
    pub value: Value,
    /// The rule that concluded it, with its version; `None` where the planner told it.
    pub rule: Option<(String, String)>,
}

/// What rules were told of the last object and what they concluded, as far as it is known.
pub(crate) fn facts(
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
            facts.push(Fact { property, value, rule: None });
        }
    }
    for property in concluded {
        let Some(value) = knowledge.value_at(class, 0, property) else { continue };
        let (grounds, _) = knowledge.grounds(class, property, &[0]);
        let rule = grounds.first().and_then(|grounds| rules.rules().get(grounds.rule));
        let rule = rule.map(|rule| (rule.name().to_owned(), rule.version().to_owned()));
        facts.push(Fact { property, value, rule });
    }
    facts
}

/// The rows of one junction.
pub(crate) fn rows(said: &Said, record: &mut Plan) {
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
