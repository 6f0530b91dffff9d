//! Edits of single cells and rows by hand, each written to the history.

use sqlx::{Row, SqliteConnection};

use crate::cell::Cell;
use crate::dynamic::{self, identifier};
use crate::error::{Error, Result};
use crate::history::{self, Author, Entry};
use crate::transaction::Tx;

mod dependants;
mod table;
mod undo;

use table::{Table, joined};
pub use undo::undo;

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

/// What a cell holds.
pub async fn cell(connection: &mut SqliteConnection, table: &str, key: &str, column: &str) -> Result<Cell> {
    let table = Table::editable(connection, table).await?;
    let quoted = table.column(column)?;
    let found = table.locate(connection, key).await?;
    table.read(connection, &quoted, &found).await
}

/// What a cell would hold after [`set_cell`], and the row's whole key; nothing is changed. A part of the key is refused,
/// since with it a row would be another one.
pub async fn try_cell(
    connection: &mut SqliteConnection,
    (table, key, column): (&str, &str, &str),
    value: &Cell,
) -> Result<(String, Cell)> {
    let what = format!("{table}.{key}.{column}");
    let table = Table::editable(connection, table).await?;
    let quoted = table.column(column)?;
    if table.keys().contains(&quoted) {
        return Err(Error::Refused { what, reason: "it is a part of the key".to_owned() });
    }
    let found = table.locate(connection, key).await?;
    let old = table.read(connection, &quoted, &found).await?;
    let sql = format!("UPDATE {} SET {quoted} = ? WHERE {}", identifier(table.name), table.found());
    let mut values = vec![value.clone()];
    values.extend(found.iter().cloned());
    dynamic::execute(connection, sql.clone(), &values).await.map_err(|e| e.refusing(what))?;
    let new = table.read(connection, &quoted, &found).await?;
    values[0] = old;
    dynamic::execute(connection, sql, &values).await?;
    Ok((joined(&found), new))
}

/// Adds a row; columns not named take their defaults.
pub async fn add_row(
    connection: &mut SqliteConnection,
    table: &str,
    row: &[(&str, Cell)],
    author: &Author,
) -> Result<Edited> {
    let table = Table::editable(connection, table).await?;
    let (key, new) = insert(connection, &table, row).await?;
    let entry = Entry { table: table.name, key: &key, column: None, old: &Cell::Null, new: &new };
    let id = history::record(connection, author, &entry).await?;
    Ok(Edited { id, key, old: Cell::Null, new })
}

/// Adds a row without a word in the history; its key, and the row as JSON.
async fn insert(
    connection: &mut SqliteConnection,
    table: &Table<'_>,
    row: &[(&str, Cell)],
) -> Result<(String, Cell)> {
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
    Ok((joined(&key), new))
}

/// Removes a row, and with a state the changes of shape from it and to it; the history keeps all of them.
pub async fn remove_row(
    connection: &mut SqliteConnection,
    table: &str,
    key: &str,
    author: &Author,
) -> Result<Edited> {
    let table = Table::editable(connection, table).await?;
    let found = table.locate(connection, key).await?;
    let old = table.read(connection, &table.json(), &found).await?;
    let old = dependants::with(connection, table.name, &found, old).await?;
    let sql = format!("DELETE FROM {} WHERE {}", identifier(table.name), table.found());
    dynamic::execute(connection, sql, &found).await.map_err(|e| e.refusing(table.name))?;
    let key = joined(&found);
    let entry = Entry { table: table.name, key: &key, column: None, old: &old, new: &Cell::Null };
    let id = history::record(connection, author, &entry).await?;
    Ok(Edited { id, key, old, new: Cell::Null })
}

impl Tx<'_> {
    /// What a cell holds.
    pub fn cell(&mut self, table: &str, key: &str, column: &str) -> Result<Cell> {
        self.run(async |connection| cell(connection, table, key, column).await)
    }

    /// Sets one cell. `key` is the row's key, its columns joined by `/`; the robot may be left out where that leaves
    /// one row. The table's types and ranges decide what is taken. The routes are stale until the next build.
    pub fn set_cell(&mut self, cell: (&str, &str, &str), value: &Cell, author: &Author) -> Result<Edited> {
        self.run(async |connection| set_cell(connection, cell, value, author).await)
    }

    /// What a cell would hold after [`Tx::set_cell`], and the row's whole key; nothing is changed. A part of the key is
    /// refused, since with it a row would be another one.
    pub fn try_cell(&mut self, cell: (&str, &str, &str), value: &Cell) -> Result<(String, Cell)> {
        self.run(async |connection| try_cell(connection, cell, value).await)
    }

    /// Adds a row; columns not named take their defaults.
    pub fn add_row(&mut self, table: &str, row: &[(&str, Cell)], author: &Author) -> Result<Edited> {
        self.run(async |connection| add_row(connection, table, row, author).await)
    }

    /// Removes a row; `key` as in [`Tx::set_cell`].
    pub fn remove_row(&mut self, table: &str, key: &str, author: &Author) -> Result<Edited> {
        self.run(async |connection| remove_row(connection, table, key, author).await)
    }

    /// The rows of a table as the history keeps them, in the order in which [`Tx::read_table`] reads them where it has a key.
    pub fn rows_as_kept(&mut self, table: &str) -> Result<Vec<Cell>> {
        self.run(async |connection| {
            let table = Table::editable(connection, table).await?;
            let (name, keys) = (identifier(table.name), table.keys().join(", "));
            let sql = format!("SELECT {} FROM {name} ORDER BY {keys}", table.json());
            let rows = dynamic::fetch(connection, sql, &[]).await?;
            rows.iter().map(|row| Cell::of(row, 0)).collect()
        })
    }

    /// Takes one edit of the history back, unless its row has changed since.
    pub fn undo(&mut self, id: i64, author: &Author) -> Result<Edited> {
        self.run(async |connection| undo(connection, id, author).await)
    }
}
