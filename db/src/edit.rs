//! Edits of single cells and rows by hand, each written to the history.

use sqlx::{Row, SqliteConnection};

use crate::cell::Cell;
use crate::dynamic::{self, identifier, literal};
use crate::error::{Error, Result};
use crate::history::{self, Author, Edit, Entry};
use crate::relation::{self, RelationColumn};
use crate::transaction::Tx;

/// Tables of ours that people edit; the rest is derived from them. Tables of the user's own can be edited too.
const EDITABLE: &[&str] = &["robots", "changes", "places", "frames"];

/// What an edit did.
#[derive(Clone, Debug, PartialEq)]
pub struct Edited {
    /// Its number in the history.
    pub id: i64,
    /// The row's whole key, its columns joined by `/`.
    pub key: String,
    /// The value before, or the row that went, as JSON.
    pub old: Cell,
    /// The value after as the table holds it, or the row that came, as JSON.
    pub new: Cell,
}

/// A table that may be edited.
struct Table<'t> {
    name: &'t str,
    columns: Vec<RelationColumn>,
}

impl<'t> Table<'t> {
    async fn editable(connection: &mut SqliteConnection, name: &'t str) -> Result<Self> {
        let columns = relation::columns(connection, name).await?;
        if relation::OWN.contains(&name) && !EDITABLE.contains(&name) {
            return Err(Error::NotEditable(name.to_owned()));
        }
        Ok(Self { name, columns })
    }

    /// The key's columns, quoted; the row number where the table has no key.
    fn keys(&self) -> Vec<String> {
        match relation::key_names(&self.columns).as_slice() {
            [] => vec!["rowid".to_owned()],
            names => names.iter().map(|name| identifier(name)).collect(),
        }
    }

    fn column(&self, column: &str) -> Result<String> {
        let names = || self.columns.iter().map(|column| column.name.as_str());
        if names().any(|name| name == column) {
            return Ok(identifier(column));
        }
        let columns = names().collect::<Vec<_>>().join(", ");
        Err(Error::UnknownColumn { table: self.name.to_owned(), column: column.to_owned(), columns })
    }

    /// The condition that finds a row by its key's values.
    fn found(&self) -> String {
        self.keys().iter().map(|key| format!("{key} IS ?")).collect::<Vec<_>>().join(" AND ")
    }

    /// The row as a JSON object. SQLite's own JSON keeps 15 digits of a number; 17 bring back each bit.
    fn json(&self) -> String {
        let pair = |column: &RelationColumn| {
            let (name, cell) = (literal(&column.name), identifier(&column.name));
            let exact = format!("json(printf('%!.17g', {cell}))");
            format!("{name}, CASE typeof({cell}) WHEN 'real' THEN {exact} ELSE {cell} END")
        };
        format!("json_object({})", self.columns.iter().map(pair).collect::<Vec<_>>().join(", "))
    }

    /// The key's values of the one row that `key` means: all its parts, or all but the robot.
    async fn locate(&self, connection: &mut SqliteConnection, key: &str) -> Result<Vec<Cell>> {
        let keys = self.keys();
        let joined = |keys: &[String]| keys.join(" || '/' || ");
        // joined to '', a number is compared as text
        let mut condition = format!("('' || {}) = ?1", joined(&keys));
        if keys.len() > 1 && keys[0] == identifier("robot") {
            condition = format!("{condition} OR ('' || {}) = ?1", joined(&keys[1..]));
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

    /// One expression of the row that the key's values find.
    async fn read(&self, connection: &mut SqliteConnection, what: &str, key: &[Cell]) -> Result<Cell> {
        let sql = format!("SELECT {what} FROM {} WHERE {}", identifier(self.name), self.found());
        let rows = dynamic::fetch(connection, sql, key).await?;
        rows.first().map_or(Ok(Cell::Null), |row| Cell::of(row, 0))
    }
}

fn joined(key: &[Cell]) -> String {
    key.iter().map(Cell::to_string).collect::<Vec<_>>().join("/")
}

/// Sets one cell. `key` is the row's key, its columns joined by `/`; the robot may be left out where that leaves one
/// row. The table's types and ranges decide what is taken.
pub async fn set_cell(
    connection: &mut SqliteConnection,
    (table, key, column): (&str, &str, &str),
    value: &Cell,
    author: &Author,
) -> Result<Edited> {
    let what = format!("{table}.{key}.{column}");
    if matches!(value, Cell::Real(number) if number.is_nan()) {
        return Err(Error::Refused { what, reason: "not a number".to_owned() });
    }
    let table = Table::editable(connection, table).await?;
    let quoted = table.column(column)?;
    let mut found = table.locate(connection, key).await?;
    let old = table.read(connection, &quoted, &found).await?;
    let sql = format!("UPDATE {} SET {quoted} = ? WHERE {}", identifier(table.name), table.found());
    let mut values = vec![value.clone()];
    values.extend(found.iter().cloned());
    dynamic::execute(connection, sql, &values).await.map_err(|e| e.refusing(what))?;
    // the history names the row by the key that it now has
    if let Some(part) = table.keys().iter().position(|name| *name == quoted) {
        found[part] = value.clone();
    }
    let new = table.read(connection, &quoted, &found).await?;
    let key = joined(&found);
    let entry = Entry { table: table.name, key: &key, column: Some(column), old: &old, new: &new };
    let id = history::record(connection, author, &entry).await?;
    Ok(Edited { id, key, old, new })
}

/// Adds a row; columns not named take their defaults.
pub async fn add_row(
    connection: &mut SqliteConnection,
    table: &str,
    row: &[(&str, Cell)],
    author: &Author,
) -> Result<Edited> {
    let table = Table::editable(connection, table).await?;
    let mut names = Vec::new();
    for (column, _) in row {
        names.push(table.column(column)?);
    }
    let values: Vec<Cell> = row.iter().map(|(_, value)| value.clone()).collect();
    let holes = vec!["?"; names.len()].join(", ");
    let sql = format!(
        "INSERT INTO {} ({}) VALUES ({holes}) RETURNING {}, {}",
        identifier(table.name),
        names.join(", "),
        table.json(),
        table.keys().join(", ")
    );
    let rows = dynamic::fetch(connection, sql, &values).await.map_err(|e| e.refusing(table.name))?;
    let row = rows.first().ok_or(sqlx::Error::RowNotFound)?;
    let new = Cell::of(row, 0)?;
    let key: Vec<Cell> = (1..row.len()).map(|index| Cell::of(row, index)).collect::<Result<_>>()?;
    let key = joined(&key);
    let entry = Entry { table: table.name, key: &key, column: None, old: &Cell::Null, new: &new };
    let id = history::record(connection, author, &entry).await?;
    Ok(Edited { id, key, old: Cell::Null, new })
}

/// Removes a row.
pub async fn remove_row(
    connection: &mut SqliteConnection,
    table: &str,
    key: &str,
    author: &Author,
) -> Result<Edited> {
    let table = Table::editable(connection, table).await?;
    let found = table.locate(connection, key).await?;
    let old = table.read(connection, &table.json(), &found).await?;
    let sql = format!("DELETE FROM {} WHERE {}", identifier(table.name), table.found());
    dynamic::execute(connection, sql, &found).await.map_err(|e| e.refusing(table.name))?;
    let key = joined(&found);
    let entry = Entry { table: table.name, key: &key, column: None, old: &old, new: &Cell::Null };
    let id = history::record(connection, author, &entry).await?;
    Ok(Edited { id, key, old, new: Cell::Null })
}

/// Takes one edit of the history back, unless its row has changed since.
pub async fn undo(connection: &mut SqliteConnection, id: i64, author: &Author) -> Result<Edited> {
    let conflict = |reason: String| Error::Conflict { id, reason };
    let edits = history::read(connection, u32::MAX).await?;
    let edit = edits.into_iter().find(|edit| edit.id == id).ok_or_else(|| conflict("no such edit".into()))?;
    if let Some(by) = edit.undone {
        return Err(conflict(format!("edit {by} did so already")));
    }
    let done = inverse(connection, &edit, author).await?;
    let mark = sqlx::query("UPDATE history SET undone = ? WHERE id = ?").bind(done.id).bind(id);
    mark.execute(connection).await?;
    Ok(done)
}

async fn inverse(connection: &mut SqliteConnection, edit: &Edit, author: &Author) -> Result<Edited> {
    let table = Table::editable(connection, &edit.table).await?;
    let what = match &edit.column {
        Some(column) => table.column(column)?,
        None => table.json(),
    };
    if edit.column.is_some() || edit.old == Cell::Null {
        let found = table.locate(connection, &edit.key).await?;
        let now = table.read(connection, &what, &found).await?;
        if now != edit.new {
            let column = edit.column.as_ref().map_or(String::new(), |column| format!(".{column}"));
            let reason = format!("{}.{}{column} is {now} now, not {}", edit.table, edit.key, edit.new);
            return Err(Error::Conflict { id: edit.id, reason });
        }
    }
    match (&edit.column, &edit.old) {
        (Some(column), old) => set_cell(connection, (&edit.table, &edit.key, column), old, author).await,
        (None, Cell::Text(row)) => restore(connection, &table, row, author).await,
        (None, _) => remove_row(connection, &edit.table, &edit.key, author).await,
    }
}

async fn restore(
    connection: &mut SqliteConnection,
    table: &Table<'_>,
    row: &str,
    author: &Author,
) -> Result<Edited> {
    let query = sqlx::query("SELECT key, value FROM json_each(?)").bind(row);
    let mut cells: Vec<(String, Cell)> = Vec::new();
    for row in query.fetch_all(&mut *connection).await? {
        cells.push((row.try_get(0)?, Cell::of(&row, 1)?));
    }
    let named: Vec<(&str, Cell)> = cells.iter().map(|(name, cell)| (name.as_str(), cell.clone())).collect();
    add_row(connection, table.name, &named, author).await
}

impl Tx<'_> {
    /// Sets one cell. `key` is the row's key, its columns joined by `/`; the robot may be left out where that leaves
    /// one row. The table's types and ranges decide what is taken. The routes are stale until the next build.
    pub fn set_cell(&mut self, cell: (&str, &str, &str), value: &Cell, author: &Author) -> Result<Edited> {
        self.run(async |connection| set_cell(connection, cell, value, author).await)
    }

    /// Adds a row; columns not named take their defaults.
    pub fn add_row(&mut self, table: &str, row: &[(&str, Cell)], author: &Author) -> Result<Edited> {
        self.run(async |connection| add_row(connection, table, row, author).await)
    }

    /// Removes a row; `key` as in [`Tx::set_cell`].
    pub fn remove_row(&mut self, table: &str, key: &str, author: &Author) -> Result<Edited> {
        self.run(async |connection| remove_row(connection, table, key, author).await)
    }

    /// Takes one edit of the history back, unless its row has changed since.
    pub fn undo(&mut self, id: i64, author: &Author) -> Result<Edited> {
        self.run(async |connection| undo(connection, id, author).await)
    }
}
