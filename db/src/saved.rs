//! Queries that people keep: the table `saved_queries`.

use serde::Serialize;
use sqlx::{Row, SqliteConnection};

use crate::error::Result;
use crate::transaction::Tx;

/// A query that is kept.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, utoipa::ToSchema)]
pub struct SavedQuery {
    /// Its name.
    pub name: String,
    /// Its text.
    pub query: String,
    /// Who kept it.
    pub who: String,
    /// When, in UTC.
    pub at: String,
}

/// All of them, by name.
pub async fn all(connection: &mut SqliteConnection) -> Result<Vec<SavedQuery>> {
    let rows = sqlx::query("SELECT name, query, who, at FROM saved_queries ORDER BY name");
    let read = |row: &sqlx::sqlite::SqliteRow| -> sqlx::Result<SavedQuery> {
        Ok(SavedQuery {
            name: row.try_get(0)?,
            query: row.try_get(1)?,
            who: row.try_get(2)?,
            at: row.try_get(3)?,
        })
    };
    Ok(rows.fetch_all(connection).await?.iter().map(read).collect::<sqlx::Result<_>>()?)
}

/// Keeps a query, in place of one of the same name.
pub async fn save(connection: &mut SqliteConnection, name: &str, query: &str, who: &str) -> Result<()> {
    let insert = sqlx::query(
        "INSERT INTO saved_queries (name, query, who) VALUES (?, ?, ?) ON CONFLICT (name) DO UPDATE
         SET query = excluded.query, who = excluded.who, at = strftime('%Y-%m-%dT%H:%M:%SZ', 'now')",
    );
    let kept = insert.bind(name).bind(query).bind(who).execute(connection).await;
    kept.map_err(|error| crate::Error::from(error).refusing(format!("query {name:?}")))?;
    Ok(())
}

/// Takes a query away; whether there was one.
pub async fn remove(connection: &mut SqliteConnection, name: &str) -> Result<bool> {
    let gone = sqlx::query("DELETE FROM saved_queries WHERE name = ?").bind(name).execute(connection).await?;
    Ok(gone.rows_affected() > 0)
}

impl Tx<'_> {
    /// The queries that people keep, by name.
    pub fn saved_queries(&mut self) -> Result<Vec<SavedQuery>> {
        self.run(all)
    }

    /// Keeps a query, in place of one of the same name.
    pub fn save_query(&mut self, name: &str, query: &str, who: &str) -> Result<()> {
        self.run(async |connection| save(connection, name, query, who).await)
    }

    /// Takes a query away; whether there was one.
    pub fn remove_query(&mut self, name: &str) -> Result<bool> {
        self.run(async |connection| remove(connection, name).await)
    }
}
