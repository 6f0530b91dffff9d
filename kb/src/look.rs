//! Looks at values that may differ after an update.

use adit_engine::{Changes, Value};

/// The rows of a property whose value or reason may differ, ascending.
pub fn rows(changes: &Changes, class: &str, property: &str) -> Vec<u32> {
    let mut rows = changes.rows(class, property).to_vec();
    rows.extend(changes.reasons(class, property));
    rows.sort_unstable();
    rows.dedup();
    rows
}

/// The number that a value is.
pub fn number(value: &Value) -> Option<f64> {
    if let Value::Number(number) = value { Some(*number) } else { None }
}

/// The text that a value is.
pub fn text(value: &Value) -> Option<String> {
    if let Value::Text(text) = value { Some(text.to_string()) } else { None }
}

/// The truth value that a value is.
pub fn truth(value: &Value) -> Option<bool> {
    if let Value::Truth(truth) = value { Some(*truth) } else { None }
}
