//! Opening hours, as people edit them and as `site.toml` says: the tables `hours` and `site_hours`.

use serde::Serialize;
use sqlx::{Row, SqliteConnection};

use crate::bulk::{self, Record, Values};
use crate::error::Result;
use crate::transaction::Tx;

/// When something is open.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Hours {
    /// The name of the area or door.
    pub name: String,
    /// Days: `mon-fri`, `sat,sun`.
    pub days: String,
    /// From when: `08:00`.
    pub opens: String,
    /// Up to when: `18:30`, at most `24:00`.
    pub closes: String,
}

impl Record for &Hours {
    const TABLE: &'static str = "site_hours";
    const COLUMNS: &'static [&'static str] = &["name", "days", "opens", "closes"];

    fn bind(&self, values: &mut Values) {
        values.text(&*self.name);
        values.text(&*self.days);
        values.text(&*self.opens);
        values.text(&*self.closes);
    }
}

/// The hours that people edit, by name, days and opening.
pub async fn hours(connection: &mut SqliteConnection) -> Result<Vec<Hours>> {
    let query = sqlx::query("SELECT name, days, opens, closes FROM hours ORDER BY 1, 2, 3");
    let read = |row: &sqlx::sqlite::SqliteRow| -> sqlx::Result<Hours> {
        Ok(Hours {
            name: row.try_get(0)?,
            days: row.try_get(1)?,
            opens: row.try_get(2)?,
            closes: row.try_get(3)?,
        })
    };
    Ok(query.fetch_all(connection).await?.iter().map(read).collect::<sqlx::Result<_>>()?)
}

/// Replaces the hours that `site.toml` says.
pub async fn replace_site_hours(connection: &mut SqliteConnection, by: &[Hours]) -> Result<()> {
    sqlx::query("DELETE FROM site_hours").execute(&mut *connection).await?;
    bulk::insert(connection, by).await?;
    Ok(())
}

impl Tx<'_> {
    /// The hours that people edit, by name, days and opening.
    pub fn hours(&mut self) -> Result<Vec<Hours>> {
        self.run(hours)
    }

    /// Replaces the hours that `site.toml` says.
    pub fn replace_site_hours(&mut self, by: &[Hours]) -> Result<()> {
        self.run(async |connection| replace_site_hours(connection, by).await)
    }
}
