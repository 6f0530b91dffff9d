//! What stands in the vehicle's row. What is on its way there counts already: a table that was asked for before says otherwise.

use std::collections::BTreeMap;

use serde_json::Value;

/// The cells of the row that are written.
pub struct Cells {
    known: BTreeMap<String, Value>,
    ours: BTreeMap<&'static str, Ours>,
}

/// What was written last into a column.
#[derive(Default)]
struct Ours {
    /// How many edits of it have no answer yet.
    open: u32,
    /// The number of its last answer.
    answer: u64,
}

impl Cells {
    pub fn new(known: BTreeMap<String, Value>) -> Self {
        Self { known, ours: BTreeMap::new() }
    }

    /// The row as a table says that was asked for after so many answers.
    pub fn read(&mut self, mut row: BTreeMap<String, Value>, answers: u64) {
        self.ours.retain(|_, ours| ours.open > 0 || answers < ours.answer);
        for column in self.ours.keys() {
            if let (Some(cell), Some(known)) = (row.get_mut(*column), self.known.get(*column)) {
                cell.clone_from(known);
            }
        }
        self.known = row;
    }

    /// Whether this has to be written: there is such a column, and something else stands in it.
    pub fn takes(&mut self, column: &'static str, value: &Value) -> bool {
        let Some(known) = self.known.get_mut(column) else { return false };
        if is_same(known, value) {
            return false;
        }
        known.clone_from(value);
        self.ours.entry(column).or_default().open += 1;
        true
    }

    /// An edit was answered, as the answer of this number.
    pub fn wrote(&mut self, column: &str, answer: u64) {
        let Some(ours) = self.ours.get_mut(column) else { return };
        ours.open = ours.open.saturating_sub(1);
        ours.answer = answer;
    }
}

/// Whether a cell says this, be it of another type: a column whose cells were all empty is one of texts, whatever is written
/// into it.
fn is_same(cell: &Value, value: &Value) -> bool {
    match (cell, value) {
        (Value::String(cell), Value::String(value)) => cell == value,
        _ => plain(cell) == plain(value),
    }
}

/// As a cell of text has it.
fn plain(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::Bool(truth) => u8::from(*truth).to_string(),
        Value::String(text) => match text.as_str() {
            "true" => "1".to_owned(),
            "false" => "0".to_owned(),
            _ => text.parse::<f64>().map_or_else(|_| text.clone(), |number| number.to_string()),
        },
        other => other.as_f64().map_or_else(|| other.to_string(), |number| number.to_string()),
    }
}
