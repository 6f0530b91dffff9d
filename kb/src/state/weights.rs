//! What rules say of rooms and doors, checked before it is kept: a hardness is a number that a sum can take.

use adit_db::door::Door;
use adit_db::room::Room;
use adit_engine::{Changes, KnowledgeBase as Inference, Origin, Revision, RuleBase, Value};
use adit_planners::facts::Column;

use crate::error::{Code, Error, Result};
use crate::knowledge::classes;
use crate::state::weighed::measures;
use crate::words::number::number;

/// The largest hardness that the tables take.
const LARGEST: f64 = 1e300;

/// Checks what weighs or adds up of a class's objects.
///
/// # Arguments
/// `name` is how messages call the object in a row.
fn check_all(
    (knowledge, rules): (&Inference, &RuleBase),
    (class, property): (&str, &str),
    name: impl Fn(usize) -> String,
) -> Result<()> {
    let values = match classes::column(knowledge, class, property) {
        Some(Column::Number(values)) => values,
        Some(other) => {
            let kind = if matches!(other, Column::Text(_)) { "texts" } else { "truth values" };
            let by = givers(knowledge, (class, property));
            let message = format!("{class}.{property} must hold numbers, and {by} gives it {kind}");
            return Err(Error::said(Code::RuleHardness, message, None));
        }
        None => return Ok(()),
    };
    let wrong = |value: &Option<f64>| value.is_some_and(|value| !(0.0..=LARGEST).contains(&value));
    let Some(row) = values.iter().position(wrong) else { return Ok(()) };
    Err(refusal((knowledge, rules), (class, property), (row, values[row]), name))
}

/// Checks the hardness of rooms and doors and what of them adds up: of those that an update changed, or of all.
pub fn check(
    (knowledge, rules): (&Inference, &RuleBase),
    (rooms, doors): (&[Room], &[Door]),
    changes: Option<&Changes>,
) -> Result<()> {
    let room = |row: usize| format!("room {}", rooms[row].name);
    let door = |row: usize| format!("door {}", doors[row].door);
    let names: [(&str, &dyn Fn(usize) -> String); 2] = [("ROOMS", &room), ("DOORS", &door)];
    for (class, name) in names {
        let measures = measures(knowledge, class);
        for property in ["hardness"].into_iter().chain(measures.iter().map(String::as_str)) {
            // one that is declared just now was never looked at
            match changes.filter(|changes| !changes.classes.contains_key("MEASURES")) {
                None => check_all((knowledge, rules), (class, property), name)?,
                Some(changes) => {
                    let rows = changes.rows(class, property);
                    check_rows((knowledge, rules), (class, property), rows, name)?;
                }
            }
        }
    }
    Ok(())
}

/// Checks the objects in these rows, of a class that was checked before.
fn check_rows(
    (knowledge, rules): (&Inference, &RuleBase),
    (class, property): (&str, &str),
    rows: &[u32],
    name: impl Fn(usize) -> String,
) -> Result<()> {
    for &row in rows {
        let row = row as usize;
        if let Some(Value::Number(value)) = knowledge.value_at(class, row, property)
            && !(0.0..=LARGEST).contains(&value)
        {
            return Err(refusal((knowledge, rules), (class, property), (row, Some(value)), name));
        }
    }
    Ok(())
}

fn refusal(
    (knowledge, rules): (&Inference, &RuleBase),
    (class, property): (&str, &str),
    (row, value): (usize, Option<f64>),
    name: impl Fn(usize) -> String,
) -> Error {
    let found = value.map_or_else(String::new, number);
    let key = knowledge.key(class, row);
    let why = key.and_then(|key| knowledge.why(rules, class, &key, property));
    if let Some(why) = why.filter(|why| !why.revisions.is_empty()) {
        let giver = match &why.origin {
            Origin::Told => "a fact or a table".to_owned(),
            Origin::Rule(support) => format!("rule \"{}\"", support.rule),
        };
        let revised: Vec<String> = why.revisions.iter().map(revision).collect();
        let message = format!(
            "{} has the {property} {found}, by {giver}, then by {}",
            name(row),
            revised.join(", then by ")
        );
        let help = format!("{property} must be finite and not negative");
        return Error::said(Code::RuleHardness, message, Some(help));
    }
    let by = knowledge.justifications(class, property).and_then(|found| {
        let rule = found.of_row.get(row).copied().flatten()?;
        found.rules.get(rule as usize).map(|(rule, _)| format!("rule \"{rule}\""))
    });
    let by = by.unwrap_or_else(|| givers(knowledge, (class, property)));
    let message = format!("{by} gives {} the {property} {found}", name(row));
    let help = format!("{property} must be finite and not negative");
    Error::said(Code::RuleHardness, message, Some(help))
}

/// A revision: what it does, the rule, and what made that rule speak.
fn revision(Revision { operator, amount, support, .. }: &Revision) -> String {
    // what comes first is what is revised, what comes last why
    let about = support.witnesses.iter().skip(1).next_back();
    let about = about.map_or_else(String::new, |of| format!(" for {} {}", of.class, of.key));
    let amount = amount.map_or_else(|| "unknown".to_owned(), number);
    let (operator, rule) = (operator.sign(), &support.rule);
    format!("`{operator} {amount}` of rule \"{rule}\" ({}, line {}){about}", support.file, support.line)
}

/// The rules that give a class a property.
fn givers(knowledge: &Inference, (class, property): (&str, &str)) -> String {
    let found = knowledge.justifications(class, property);
    let names: Vec<String> =
        found.into_iter().flat_map(|found| found.rules).map(|(rule, _)| format!("rule \"{rule}\"")).collect();
    if names.is_empty() { "a planner".to_owned() } else { names.join(" or ") }
}
