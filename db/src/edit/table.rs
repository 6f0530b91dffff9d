//! A table as edits see it: its key, and how to find a row by it.

use sqlx::SqliteConnection;

use crate::cell::Cell;
use crate::dynamic::{self, identifier, literal};
use crate::error::{Error, Result};
use crate::relation::{self, RelationColumn};

/// Tables of ours that people edit; the rest is derived from them. Tables of the user's own can be edited too.
const EDITABLE: &[&str] = &[
    "robots",
    "changes",
    "loads",
    "places",
    "frames",
    "told",
    "laid",
    "hours",
    "measures",
    "tuning_cells",
    "active_tunings",
];

/// A table that may be edited.
pub(super) struct Table<'t> {
    pub(super) name: &'t str,
    columns: Vec<RelationColumn>,
}

impl<'t> Table<'t> {
    /// The table `name`, unless it is derived.
    pub(super) async fn editable(connection: &mut SqliteConnection, name: &'t str) -> Result<Self> {
        let columns = relation::columns(connection, name).await?;
        if relation::OWN.contains(&name) && !EDITABLE.contains(&name) {
            return Err(Error::NotEditable(name.to_owned()));
        }
        Ok(Self { name, columns })
    }

    /// The key's columns, quoted; the row number where the table has no key.
    pub(super) fn keys(&self) -> Vec<String> {
        match relation::key_names(&self.columns).as_slice() {
            [] => vec!["rowid".to_owned()],
            names => names.iter().map(|name| identifier(name)).collect(),
        }
    }

    /// `column`, quoted.
    pub(super) fn column(&self, column: &str) -> Result<String> {
        let names = || self.columns.iter().map(|column| column.name.as_str());
        if names().any(|name| name == column) {
            return Ok(identifier(column));
        }
        let columns = names().collect::<Vec<_>>().join(", ");
        Err(Error::UnknownColumn { table: self.name.to_owned(), column: column.to_owned(), columns })
    }

    /// The condition that finds a row by its key's values.
    pub(super) fn found(&self) -> String {
        self.keys().iter().map(|key| format!("{key} IS ?")).collect::<Vec<_>>().join(" AND ")
    }

    /// The row as a JSON object. SQLite's own JSON keeps 15 digits of a number; 17 bring back each bit.
    pub(super) fn json(&self) -> String {
        let pair = |column: &RelationColumn| {
            let (name, cell) = (literal(&column.name), identifier(&column.name));
            let exact = format!("json(printf('%!.17g', {cell}))");
            format!("{name}, CASE typeof({cell}) WHEN 'real' THEN {exact} ELSE {cell} END")
        };
        format!("json_object({})", self.columns.iter().map(pair).collect::<Vec<_>>().join(", "))
    }

    /// The key's values of the one row that `key` means: all its parts, or all but the robot.
    pub(super) async fn locate(&self, connection: &mut SqliteConnection, key: &str) -> Result<Vec<Cell>> {
        let keys = self.keys();
        let all = |keys: &[String]| keys.join(" || '/' || ");
        if let Some(found) = self.locate_by_parts(connection, key).await? {
            return Ok(found);
        }
        // joined to '', a number is compared as text
        let mut condition = format!("('' || {}) = ?1", all(&keys));
        if keys.len() > 1 && keys[0] == identifier("robot") {
            condition = format!("{condition} OR ('' || {}) = ?1", all(&keys[1..]));
        }
        let names = keys.join(", ");
        let sql = format!("SELECT {names} FROM {} WHERE {condition} LIMIT 2", identifier(self.name));
        let rows = dynamic::fetch(connection, sql, &[Cell::from(key)]).await?;
        let (table, key) = (self.name.to_owned(), key.to_owned());
        match rows.as_slice() {
            [] => Err(Error::UnknownKey { table, key }),
            [row] => (0..keys.len()).map(|index| Cell::of(row, index)).collect(),
            _ => Err(Error::AmbiguousKey { table, key, columns: keys.join(", ") }),
        }
    }

    /// The key's values of the row whose parts of the key these are, reached by the index.
    async fn locate_by_parts(
        &self,
        connection: &mut SqliteConnection,
        key: &str,
    ) -> Result<Option<Vec<Cell>>> {
        let (keys, parts) = (self.keys(), key.split('/').map(Cell::from).collect::<Vec<_>>());
        if keys.len() != parts.len() {
            return Ok(None);
        }
        let each: Vec<String> = keys.iter().map(|key| format!("{key} = ?")).collect();
        let whole = format!("('' || {}) = ?", keys.join(" || '/' || "));
        let (names, each) = (keys.join(", "), each.join(" AND "));
        let sql = format!("SELECT {names} FROM {} WHERE {each} AND {whole}", identifier(self.name));
        let values: Vec<Cell> = parts.into_iter().chain([Cell::from(key)]).collect();
        let rows = dynamic::fetch(connection, sql, &values).await?;
        let Some(row) = rows.first() else { return Ok(None) };
        (0..keys.len()).map(|index| Cell::of(row, index)).collect::<Result<_>>().map(Some)
    }

    /// One expression of the row that the key's values find.
    pub(super) async fn read(
        &self,
        connection: &mut SqliteConnection,
        what: &str,
        key: &[Cell],
    ) -> Result<Cell> {
        let sql = format!("SELECT {what} FROM {} WHERE {}", identifier(self.name), self.found());
        let rows = dynamic::fetch(connection, sql, key).await?;
        rows.first().map_or(Ok(Cell::Null), |row| Cell::of(row, 0))
    }
}

/// A key's values as one text.
pub(super) fn joined(key: &[Cell]) -> String {
    key.iter().map(Cell::to_string).collect::<Vec<_>>().join("/")
}
