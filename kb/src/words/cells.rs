//! Cells of a row, for programs and for people.

use adit_db::Cell;
use serde_json::Value;

/// A row as a JSON object.
pub fn object<'c>(
    columns: impl IntoIterator<Item = &'c String>,
    row: impl IntoIterator<Item = &'c Cell>,
) -> Value {
    let pairs = columns.into_iter().cloned().zip(row.into_iter().map(|cell| serde_json::json!(cell)));
    Value::Object(pairs.collect())
}

/// A cell as people read it: nothing where there is no value.
pub fn text(cell: &Cell) -> String {
    match cell {
        Cell::Null => String::new(),
        cell => cell.to_string(),
    }
}
