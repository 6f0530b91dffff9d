//! What rules say of rooms and doors, checked before it is kept: a hardness is a number that a sum can take.

use adit_db::door::Door;
use adit_db::room::Room;
use adit_engine::{Changes, KnowledgeBase as Inference, Value};
use adit_planners::facts::Column;

use crate::error::{Code, Error, Result};
use crate::knowledge::classes;
use crate::words::number::number;

/// The largest hardness that the tables take.
const LARGEST: f64 = 1e300;

/// Checks the hardness of a class's objects.
///
/// # Arguments
/// `name` is how messages call the object in a row.
fn check_hardness(knowledge: &Inference, class: &str, name: impl Fn(usize) -> String) -> Result<()> {
    let values = match classes::column(knowledge, class, "hardness") {
        Some(Column::Number(values)) => values,
        Some(other) => {
            let kind = if matches!(other, Column::Text(_)) { "texts" } else { "truth values" };
            let rules = rules(knowledge, class);
            let message = format!("{class}.hardness must hold numbers, and {rules} gives it {kind}");
            return Err(Error::said(Code::RuleHardness, message, None));
        }
        None => return Ok(()),
    };
    let wrong = |value: &Option<f64>| value.is_some_and(|value| !(0.0..=LARGEST).contains(&value));
    let Some(row) = values.iter().position(wrong) else { return Ok(()) };
    Err(refusal(knowledge, class, (row, values[row]), name))
}

/// Checks the hardness of rooms and doors: of those that an update changed, or of all.
pub fn check(
    knowledge: &Inference,
    (rooms, doors): (&[Room], &[Door]),
    changes: Option<&Changes>,
) -> Result<()> {
    let room = |row: usize| format!("room {}", rooms[row].name);
    let door = |row: usize| format!("door {}", doors[row].door);
    let Some(changes) = changes else {
        check_hardness(knowledge, "ROOMS", room)?;
        return check_hardness(knowledge, "DOORS", door);
    };
    check_rows(knowledge, "ROOMS", changes.rows("ROOMS", "hardness"), room)?;
    check_rows(knowledge, "DOORS", changes.rows("DOORS", "hardness"), door)
}

/// Checks the hardness of the objects in these rows, of a class that was checked before.
fn check_rows(
    knowledge: &Inference,
    class: &str,
    rows: &[u32],
    name: impl Fn(usize) -> String,
) -> Result<()> {
    for &row in rows {
        let row = row as usize;
        if let Some(Value::Number(value)) = knowledge.value_at(class, row, "hardness")
            && !(0.0..=LARGEST).contains(&value)
        {
            return Err(refusal(knowledge, class, (row, Some(value)), name));
        }
    }
    Ok(())
}

fn refusal(
    knowledge: &Inference,
    class: &str,
    (row, value): (usize, Option<f64>),
    name: impl Fn(usize) -> String,
) -> Error {
    let by = knowledge.justifications(class, "hardness").and_then(|found| {
        let rule = found.of_row.get(row).copied().flatten()?;
        found.rules.get(rule as usize).map(|(rule, _)| format!("rule \"{rule}\""))
    });
    let by = by.unwrap_or_else(|| rules(knowledge, class));
    let found = value.map_or_else(String::new, number);
    let message = format!("{by} gives {} the hardness {found}", name(row));
    let help = "a hardness is finite and not negative; revisions count, too".to_owned();
    Error::said(Code::RuleHardness, message, Some(help))
}

/// The rules that give a class its hardness.
fn rules(knowledge: &Inference, class: &str) -> String {
    let found = knowledge.justifications(class, "hardness");
    let names: Vec<String> =
        found.into_iter().flat_map(|found| found.rules).map(|(rule, _)| format!("rule \"{rule}\"")).collect();
    if names.is_empty() { "a planner".to_owned() } else { names.join(" or ") }
}
