//! The health of a database.

use serde::Serialize;
use sqlx::{Row, SqliteConnection};

use crate::dynamic::{self, identifier};
use crate::error::Result;
use crate::relation::{self, Form};
use crate::stale::{self, Mark};

/// What an examination found.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Health {
    /// Damages of the file; empty is sound.
    pub damages: Vec<String>,
    /// Rows that refer to rows that are not there; empty is sound.
    pub dangling: Vec<String>,
    /// Version of the SQLite that this program holds.
    pub sqlite: String,
    /// Version of the database's schema.
    pub schema: i64,
    /// How transactions are kept: delete, or wal while a service runs.
    pub journal: String,
    /// Rows of each table, ours and the user's, by name.
    pub rows: Vec<(String, i64)>,
    /// Edits that no build has followed up yet.
    pub stale: Vec<Mark>,
}

impl Health {
    /// Whether nothing is damaged.
    pub fn is_sound(&self) -> bool {
        self.damages.is_empty() && self.dangling.is_empty()
    }
}

/// Examines the whole database; takes as long as reading it.
pub async fn examine(connection: &mut SqliteConnection) -> Result<Health> {
    let report: Vec<String> =
        sqlx::query_scalar("PRAGMA integrity_check").fetch_all(&mut *connection).await?;
    let mut dangling = Vec::new();
    for row in sqlx::query("PRAGMA foreign_key_check").fetch_all(&mut *connection).await? {
        let (table, parent): (String, String) = (row.try_get(0)?, row.try_get(2)?);
        dangling.push(format!("a row of {table} refers to a row of {parent} that is not there"));
    }
    let there: Vec<String> =
        sqlx::query_scalar("SELECT name FROM sqlite_schema").fetch_all(&mut *connection).await?;
    let missing = relation::OWN.iter().filter(|name| !there.iter().any(|known| known == *name));
    let mut damages: Vec<String> = missing.map(|name| format!("table or view {name} is missing")).collect();
    let lost_marks = damages.iter().any(|damage| damage.contains("stale_marks"));
    damages.extend(report.into_iter().filter(|line| line != "ok"));
    Ok(Health {
        damages,
        dangling,
        sqlite: sqlx::query_scalar("SELECT sqlite_version()").fetch_one(&mut *connection).await?,
        schema: sqlx::query_scalar("PRAGMA user_version").fetch_one(&mut *connection).await?,
        journal: sqlx::query_scalar("PRAGMA journal_mode").fetch_one(&mut *connection).await?,
        rows: rows(connection).await?,
        stale: if lost_marks { Vec::new() } else { stale::marks(connection).await? },
    })
}

async fn rows(connection: &mut SqliteConnection) -> Result<Vec<(String, i64)>> {
    let own = sqlx::query_scalar(
        "SELECT name FROM sqlite_schema WHERE type = 'table' AND name NOT IN ('writer', 'step_parts')",
    );
    let own: Vec<String> = own.fetch_all(&mut *connection).await?;
    let mut tables: Vec<String> =
        own.into_iter().filter(|name| relation::OWN.contains(&name.as_str())).collect();
    let users = relation::user_tables(connection).await?;
    tables.extend(users.into_iter().filter(|table| table.form == Form::Table).map(|table| table.name));
    tables.sort();
    let mut counts = Vec::new();
    for table in tables {
        let sql = format!("SELECT count(*) FROM {}", identifier(&table));
        let count = dynamic::fetch(connection, sql, &[]).await?;
        counts.push((table, count.first().map_or(Ok(0), |row| row.try_get(0))?));
    }
    Ok(counts)
}
