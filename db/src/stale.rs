//! Marks of edits that no build has followed up yet: the table `stale_marks` and the triggers that fill it.

use serde::Serialize;
use sqlx::{Row, SqliteConnection};

use crate::dynamic::{self, identifier, literal};
use crate::error::{Error, Result};
use crate::relation::{self, Form};
use crate::transaction::Tx;

/// An edit that makes the routes stale.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Mark {
    /// The table edited.
    pub table: String,
    /// The row's key, its columns joined by `/`; empty where more than single rows changed.
    pub key: String,
}

/// All marks, by table and key.
pub async fn marks(connection: &mut SqliteConnection) -> Result<Vec<Mark>> {
    let query = sqlx::query("SELECT table_name, key FROM stale_marks ORDER BY table_name, key");
    let rows = query.fetch_all(connection).await?;
    let read = |row: &sqlx::sqlite::SqliteRow| -> sqlx::Result<Mark> {
        Ok(Mark { table: row.try_get(0)?, key: row.try_get(1)? })
    };
    Ok(rows.iter().map(read).collect::<sqlx::Result<_>>()?)
}

/// Whether what is stored does not hold any more: by an edit, or by the clock.
pub async fn is_stale(connection: &mut SqliteConnection) -> Result<bool> {
    Ok(sqlx::query_scalar("SELECT stale FROM staleness").fetch_one(connection).await?)
}

/// Takes all marks away: what is stored now follows from the tables as they are.
pub async fn mark_fresh(connection: &mut SqliteConnection) -> Result<()> {
    sqlx::query("DELETE FROM stale_marks").execute(connection).await?;
    Ok(())
}

/// Marks a table as edited by someone who follows it up later.
pub async fn mark_stale(connection: &mut SqliteConnection, table: &str) -> Result<()> {
    let mark = sqlx::query("INSERT OR IGNORE INTO stale_marks VALUES (?, '')").bind(table);
    mark.execute(connection).await?;
    Ok(())
}

/// Writes in bulk: one mark for the whole table instead of one a row.
pub(crate) async fn in_bulk<T>(
    connection: &mut SqliteConnection,
    table: &'static str,
    write: impl AsyncFnOnce(&mut SqliteConnection) -> Result<T>,
) -> Result<T> {
    let result = quietly(connection, write).await;
    mark_stale(connection, table).await?;
    result
}

/// Writes what triggers would mark, or refuse from others.
pub(crate) async fn quietly<T>(
    connection: &mut SqliteConnection,
    write: impl AsyncFnOnce(&mut SqliteConnection) -> Result<T>,
) -> Result<T> {
    sqlx::query("UPDATE writer SET quiet = 1").execute(&mut *connection).await?;
    let result = write(connection).await;
    sqlx::query("UPDATE writer SET quiet = 0").execute(&mut *connection).await?;
    result
}

const PREFIX: &str = "adit_watch_";

/// Watches the user's own tables, and no others from now on: any edit of one leaves a mark. A view cannot be watched;
/// where one is named, every table of the user is.
pub async fn watch(connection: &mut SqliteConnection, names: &[&str]) -> Result<()> {
    unwatch(connection).await?;
    let own = relation::user_tables(connection).await?;
    let mut view = false;
    for name in names {
        let known = own.iter().find(|table| table.name == *name);
        view |= known.ok_or_else(|| Error::UnknownTable((*name).to_owned()))?.form == Form::View;
    }
    for table in own.iter().filter(|table| table.form == Form::Table) {
        if view || names.contains(&table.name.as_str()) {
            watch_table(connection, &table.name).await?;
        }
    }
    Ok(())
}

async fn watch_table(connection: &mut SqliteConnection, table: &str) -> Result<()> {
    for event in ["INSERT", "UPDATE", "DELETE"] {
        let trigger = identifier(&format!("{PREFIX}{}_{table}", event.to_lowercase()));
        let sql = format!(
            "CREATE TRIGGER {trigger} AFTER {event} ON {} WHEN (SELECT NOT quiet FROM writer) \
             BEGIN INSERT OR IGNORE INTO stale_marks VALUES ({}, ''); END",
            identifier(table),
            literal(table)
        );
        dynamic::execute(connection, sql, &[]).await?;
    }
    Ok(())
}

async fn unwatch(connection: &mut SqliteConnection) -> Result<()> {
    let query = sqlx::query_scalar(
        "SELECT name FROM sqlite_schema WHERE type = 'trigger' AND substr(name, 1, length(?1)) = ?1",
    );
    let triggers: Vec<String> = query.bind(PREFIX).fetch_all(&mut *connection).await?;
    for trigger in triggers {
        dynamic::execute(connection, format!("DROP TRIGGER {}", identifier(&trigger)), &[]).await?;
    }
    Ok(())
}

impl Tx<'_> {
    /// The edits that no build has followed up yet, by table and key.
    pub fn stale_marks(&mut self) -> Result<Vec<Mark>> {
        self.run(marks)
    }

    /// Whether what is stored does not hold any more: by an edit, or by the clock.
    pub fn is_stale(&mut self) -> Result<bool> {
        self.run(is_stale)
    }

    /// Says that a table was edited and will be followed up later.
    pub fn mark_stale(&mut self, table: &str) -> Result<()> {
        self.run(async |connection| mark_stale(connection, table).await)
    }

    /// Says that what is stored now follows from the tables as they are: the last step of a build.
    pub fn mark_fresh(&mut self) -> Result<()> {
        self.run(mark_fresh)
    }

    /// Watches the user's own tables, and no others from now on: any edit of one makes the routes stale. A view
    /// cannot be watched; where one is named, every table of the user is.
    pub fn watch_tables(&mut self, names: &[&str]) -> Result<()> {
        self.run(async |connection| watch(connection, names).await)
    }
}
