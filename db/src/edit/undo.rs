//! Edits taken back.

use sqlx::{Row, SqliteConnection};

use super::table::Table;
use super::{Edited, add_row, remove_row, set_cell};
use crate::cell::Cell;
use crate::error::{Error, Result};
use crate::history::{self, Author, Edit};

/// Takes one edit of the history back, unless its row has changed since.
pub async fn undo(connection: &mut SqliteConnection, id: i64, author: &Author) -> Result<Edited> {
    let conflict = |reason: String| Error::Conflict { id, reason };
    let edit = history::entry(connection, id).await?.ok_or_else(|| conflict("no such edit".into()))?;
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
