//! What one transaction changed: rows by their keys, as an entry of the log says it.

use std::collections::BTreeMap;

use serde_json::{Map, Number, Value, json};

use crate::cell::Cell;

/// A file of a site: its path from the site's folder, parts joined by `/`; and what it holds, `None` where it is gone.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct File {
    pub path: String,
    pub bytes: Option<Vec<u8>>,
}

/// A table, index, view or trigger of somebody's own.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Object {
    pub kind: String,
    pub name: String,
    pub table: String,
    pub sql: String,
}

/// Rows of a table that were changed.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Rows {
    /// Whether these are all rows that the table has: it was made anew.
    pub whole: bool,
    /// Keys of rows that are gone.
    pub gone: Vec<Vec<Cell>>,
    /// Rows as they now are. Those of somebody's own table have their key before them.
    pub now: Vec<Vec<Cell>>,
    /// How many values that key has.
    pub key: usize,
}

impl Rows {
    pub(super) fn is_empty(&self) -> bool {
        !self.whole && self.gone.is_empty() && self.now.is_empty()
    }
}

/// What one transaction changed.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Changes {
    /// All objects of somebody's own, where one of them changed.
    pub objects: Option<Vec<Object>>,
    /// The last numbers that were given, where one of them changed.
    pub sequences: Option<Vec<(String, i64)>>,
    pub tables: BTreeMap<String, Rows>,
    pub files: Vec<File>,
}

impl Changes {
    pub(super) fn is_empty(&self) -> bool {
        self.objects.is_none()
            && self.sequences.is_none()
            && self.files.is_empty()
            && self.tables.values().all(Rows::is_empty)
    }

    /// As the log keeps it.
    pub(super) fn text(&self) -> String {
        let rows = |rows: &[Vec<Cell>]| Value::Array(rows.iter().map(|row| line(row)).collect());
        let mut tables = Map::new();
        for (name, changed) in self.tables.iter().filter(|(_, rows)| !rows.is_empty()) {
            let entry = json!({"whole": changed.whole, "key": changed.key, "gone": rows(&changed.gone), "now": rows(&changed.now)});
            tables.insert(name.clone(), entry);
        }
        let objects = self.objects.as_ref().map(|objects| {
            objects.iter().map(|of| json!([of.kind, of.name, of.table, of.sql])).collect::<Vec<_>>()
        });
        let files: Vec<Value> =
            self.files.iter().map(|file| json!([file.path, file.bytes.as_deref().map(hex)])).collect();
        json!({"tables": tables, "objects": objects, "sequences": self.sequences, "files": files}).to_string()
    }

    /// Reads an entry of the log; `None` where it is none.
    pub(super) fn read(text: &str) -> Option<Self> {
        let value: Value = serde_json::from_str(text).ok()?;
        let rows =
            |value: &Value| -> Option<Vec<Vec<Cell>>> { value.as_array()?.iter().map(cells).collect() };
        let mut changes = Self::default();
        for (name, entry) in value["tables"].as_object()? {
            let whole = entry["whole"].as_bool()?;
            let key = usize::try_from(entry["key"].as_u64()?).ok()?;
            let read = Rows { whole, gone: rows(&entry["gone"])?, now: rows(&entry["now"])?, key };
            changes.tables.insert(name.clone(), read);
        }
        if let Value::Array(objects) = &value["objects"] {
            let texts = |of: &Value| -> Option<Object> {
                let text = |at: usize| of[at].as_str().map(str::to_owned);
                Some(Object { kind: text(0)?, name: text(1)?, table: text(2)?, sql: text(3)? })
            };
            changes.objects = Some(objects.iter().map(texts).collect::<Option<_>>()?);
        }
        if let Value::Array(sequences) = &value["sequences"] {
            let last = |of: &Value| Some((of[0].as_str()?.to_owned(), of[1].as_i64()?));
            changes.sequences = Some(sequences.iter().map(last).collect::<Option<_>>()?);
        }
        for file in value["files"].as_array()? {
            let bytes = match &file[1] {
                Value::Null => None,
                text => Some(unhex(text.as_str()?)?),
            };
            changes.files.push(File { path: file[0].as_str()?.to_owned(), bytes });
        }
        Some(changes)
    }
}

/// A row as JSON in which each value keeps its type: 1 is no 1.0, and bytes are no text.
pub(super) fn line(row: &[Cell]) -> Value {
    Value::Array(row.iter().map(value).collect())
}

/// Reads what [`line`] made.
pub(super) fn cells(value: &Value) -> Option<Vec<Cell>> {
    value.as_array()?.iter().map(cell).collect()
}

/// A value as JSON that keeps its type.
pub(super) fn value(cell: &Cell) -> Value {
    match cell {
        Cell::Null => Value::Null,
        Cell::Integer(value) => Value::from(*value),
        Cell::Real(value) => {
            Number::from_f64(*value).map_or_else(|| json!({"real": value.to_string()}), Value::Number)
        }
        Cell::Text(text) => Value::from(text.as_str()),
        Cell::Blob(bytes) => json!({"blob": hex(bytes)}),
    }
}

/// Reads what [`value`] made.
pub(super) fn cell(value: &Value) -> Option<Cell> {
    Some(match value {
        Value::Null => Cell::Null,
        Value::Number(number) => match number.as_i64() {
            Some(whole) => Cell::Integer(whole),
            None => Cell::Real(number.as_f64()?),
        },
        Value::String(text) => Cell::Text(text.clone()),
        Value::Object(of) => match (of.get("real"), of.get("blob")) {
            (Some(real), None) => Cell::Real(real.as_str()?.parse().ok()?),
            (None, Some(bytes)) => Cell::Blob(unhex(bytes.as_str()?)?),
            _ => return None,
        },
        _ => return None,
    })
}

fn hex(bytes: &[u8]) -> String {
    use std::fmt::Write as _;
    bytes.iter().fold(String::with_capacity(2 * bytes.len()), |mut text, byte| {
        write!(text, "{byte:02x}").ok();
        text
    })
}

fn unhex(text: &str) -> Option<Vec<u8>> {
    let digits = text.as_bytes();
    if digits.len() % 2 == 1 || !text.is_ascii() {
        return None;
    }
    (0..digits.len()).step_by(2).map(|at| u8::from_str_radix(&text[at..at + 2], 16).ok()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_the_log_says_is_read_back_to_the_bit() {
        let row = vec![
            Cell::Null,
            Cell::Integer(i64::MAX),
            Cell::Integer(1),
            Cell::Real(1.0),
            Cell::Real(-0.0),
            Cell::Real(0.1 + 0.2),
            Cell::Real(1e300),
            Cell::Real(f64::INFINITY),
            Cell::Text("a\"\u{1}ß".to_owned()),
            Cell::Blob(vec![0, 255]),
        ];
        let rows = Rows { whole: true, gone: vec![vec![Cell::Text("k".to_owned())]], now: vec![row], key: 0 };
        let object = |text: &str| Object {
            kind: text.to_owned(),
            name: text.to_owned(),
            table: text.to_owned(),
            sql: text.to_owned(),
        };
        let changes = Changes {
            objects: Some(vec![object("x")]),
            sequences: Some(vec![("history".to_owned(), 7)]),
            tables: [("rooms".to_owned(), rows)].into(),
            files: vec![
                File { path: "a/b".to_owned(), bytes: Some(vec![1, 2]) },
                File { path: "c".to_owned(), bytes: None },
            ],
        };
        let read = Changes::read(&changes.text()).unwrap();
        assert_eq!(read, changes);
        let Cell::Real(zero) = read.tables["rooms"].now[0][4] else { panic!() };
        assert!(zero.is_sign_negative());
        assert_eq!(Changes::read("{}"), None);
    }
}
