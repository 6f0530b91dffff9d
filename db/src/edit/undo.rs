//! Edits taken back.

use sqlx::{Row, SqliteConnection};

use super::table::Table;
use super::{Edited, add_row, dependants, insert, remove_row, set_cell};
use crate::cell::Cell;
use crate::error::{Error, Result};
use crate::history::{self, Author, Edit};

/// Takes one edit of the history back, unless its row has changed since.
pub async fn undo(connection: &mut SqliteConnection, id: i64, author: &Author) -> Result<Edited> {
    let conflict = |reason: String| Error::Conflict { id, reason };
    let edit = history::entry(connection, id).await?.ok_or_else(|| conflict("no such edit".into()))?;
    if let Some(by) = edit.undone {
        return Err(conflict(format!("edit {by} has taken it back already")));
    }
    // a value that is what the edit made it may be so again by later ones, each of which then holds on to what this one left
    if let Some(later) = history::later(connection, &edit).await? {
        let reason = format!("edit {later} changed the same later; take that one back first");
        return Err(conflict(reason));
    }
    let done = inverse(connection, &edit, author).await?;
    history::mark_undone(connection, id, done.id).await?;
    for key in dependants::keys(connection, &edit.table, &done.old).await? {
        history::mark_gone(connection, (dependants::CHANGES, &key), (id, done.id)).await?;
    }
    Ok(done)
}

async fn inverse(connection: &mut SqliteConnection, edit: &Edit, author: &Author) -> Result<Edited> {
    let table = Table::editable(connection, &edit.table).await?;
    let what = match &edit.column {
        Some(column) => table.column(column)?,
        None => table.json(),
    };
    if edit.column.is_some() || edit.old == Cell::Null {
        let conflict = |reason: String| Error::Conflict { id: edit.id, reason };
        let row = format!("{}.{}", edit.table, edit.key);
        let found = table.locate(connection, &edit.key).await.map_err(|error| match error {
            Error::UnknownKey { .. } => conflict(format!("{row} is not there any more")),
            error => error,
        })?;
        let now = table.read(connection, &what, &found).await?;
        if now != edit.new {
            return Err(conflict(match &edit.column {
                Some(column) => format!("{row}.{column} is {now} now, not {}", edit.new),
                None => format!("{row} holds something else by now"),
            }));
        }
    }
    match (&edit.column, &edit.old) {
        (Some(column), old) => set_cell(connection, (&edit.table, &edit.key, column), old, author).await,
        (None, Cell::Text(row)) => restore(connection, &table, edit.id, row, author).await,
        (None, _) => remove_row(connection, &edit.table, &edit.key, author).await,
    }
}

async fn restore(
    connection: &mut SqliteConnection,
    table: &Table<'_>,
    id: i64,
    row: &str,
    author: &Author,
) -> Result<Edited> {
    let (own, with_it): (Vec<_>, Vec<_>) =
        pairs(connection, row).await?.into_iter().partition(|(name, _)| table.column(name).is_ok());
    let done = add_row(connection, table.name, &named(&own), author).await?;
    for (name, rows) in with_it {
        let gone = Table::editable(connection, &name).await?;
        for (_, row) in pairs(connection, &rows.to_string()).await? {
            let cells = pairs(connection, &row.to_string()).await?;
            let back = insert(connection, &gone, &named(&cells)).await.map_err(|e| e.refusing(&*name));
            back.map_err(|error| match error {
                Error::Refused { .. } => Error::Conflict {
                    id,
                    reason: format!("a row of `{name}` that went with it names what is gone now: {row}"),
                },
                error => error,
            })?;
        }
    }
    Ok(done)
}

/// The keys and values of a JSON object, or the indices and entries of an array.
async fn pairs(connection: &mut SqliteConnection, json: &str) -> Result<Vec<(String, Cell)>> {
    let query = sqlx::query("SELECT CAST(key AS TEXT), value FROM json_each(?)").bind(json);
    let read = |row: &sqlx::sqlite::SqliteRow| Ok((row.try_get(0)?, Cell::of(row, 1)?));
    query.fetch_all(connection).await?.iter().map(read).collect()
}

fn named(cells: &[(String, Cell)]) -> Vec<(&str, Cell)> {
    cells.iter().map(|(name, cell)| (name.as_str(), cell.clone())).collect()
}
