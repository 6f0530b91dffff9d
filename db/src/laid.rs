//! The table `laid`: areas, obstacles and places that people lay over the map while the site is in use.

use serde::Serialize;
use sqlx::sqlite::SqliteRow;
use sqlx::{Row, SqliteConnection};

use crate::error::Result;
use crate::transaction::Tx;

/// An area, an obstacle or a place.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Laid {
    pub name: String,
    /// area, obstacle or place.
    pub what: String,
    /// What an area is, where that is said.
    pub kind: Option<String>,
    /// A JSON list of corners `[[x,y],…]`, metres; of a place the one that it is.
    pub outline: String,
    /// A JSON object of what else is said of an area.
    pub properties: String,
    /// When it ends, in UTC.
    pub until: Option<String>,
    pub who: String,
    pub why: String,
    /// When it was laid, in UTC.
    pub at: String,
}

impl Laid {
    /// Whether it lies there no longer, at a moment in UTC.
    pub fn is_over(&self, now: &str) -> bool {
        self.until.as_deref().is_some_and(|until| until <= now)
    }
}

async fn laid(connection: &mut SqliteConnection) -> Result<Vec<Laid>> {
    let query = sqlx::query(
        "SELECT name, what, kind, outline, properties, until, who, why, at FROM laid ORDER BY name",
    );
    let read = |row: &SqliteRow| -> sqlx::Result<Laid> {
        Ok(Laid {
            name: row.try_get(0)?,
            what: row.try_get(1)?,
            kind: row.try_get(2)?,
            outline: row.try_get(3)?,
            properties: row.try_get(4)?,
            until: row.try_get(5)?,
            who: row.try_get(6)?,
            why: row.try_get(7)?,
            at: row.try_get(8)?,
        })
    };
    Ok(query.fetch_all(connection).await?.iter().map(read).collect::<sqlx::Result<_>>()?)
}

impl Tx<'_> {
    /// What people laid over the map, by name.
    pub fn laid(&mut self) -> Result<Vec<Laid>> {
        self.run(laid)
    }
}
