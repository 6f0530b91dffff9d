//! What robots measured on their way: the table `traversals`.

use serde::Serialize;
use sqlx::{Row, SqliteConnection};

use crate::error::Result;
use crate::transaction::Tx;

/// Metres that were driven in a state, and what was measured.
#[derive(Clone, Debug, PartialEq, Serialize, utoipa::ToSchema)]
pub struct Traversal {
    /// Its number; 0 where it is not kept yet.
    pub id: i64,
    /// The mission that it is a part of: all of its rows share what was measured.
    pub mission: Option<String>,
    /// Whose.
    pub robot: String,
    /// The state that it was driven in.
    pub state: String,
    /// Metres.
    pub distance: f64,
    /// What was measured, of the whole mission where there is one.
    pub measured: f64,
    /// What `measured` is: `seconds`, `joules`.
    pub measure: String,
    /// Who added it.
    pub who: String,
    /// When, in UTC.
    pub at: String,
}

/// All traversals, by number.
pub async fn read(connection: &mut SqliteConnection) -> Result<Vec<Traversal>> {
    let query = sqlx::query(
        "SELECT id, mission, robot, state, distance, measured, measure, who, at FROM traversals ORDER BY id",
    );
    let row = |row: &sqlx::sqlite::SqliteRow| -> sqlx::Result<Traversal> {
        Ok(Traversal {
            id: row.try_get(0)?,
            mission: row.try_get(1)?,
            robot: row.try_get(2)?,
            state: row.try_get(3)?,
            distance: row.try_get(4)?,
            measured: row.try_get(5)?,
            measure: row.try_get(6)?,
            who: row.try_get(7)?,
            at: row.try_get(8)?,
        })
    };
    Ok(query.fetch_all(connection).await?.iter().map(row).collect::<sqlx::Result<_>>()?)
}

/// Adds traversals; their numbers and times are new ones.
pub async fn add(connection: &mut SqliteConnection, new: &[Traversal]) -> Result<()> {
    for row in new {
        sqlx::query(
            "INSERT INTO traversals (mission, robot, state, distance, measured, measure, who)
             VALUES (?, ?, ?, ?, ?, ?, ?)",
        )
        .bind(row.mission.as_deref())
        .bind(&row.robot)
        .bind(&row.state)
        .bind(row.distance)
        .bind(row.measured)
        .bind(&row.measure)
        .bind(&row.who)
        .execute(&mut *connection)
        .await?;
    }
    Ok(())
}

/// Removes all traversals; how many there were.
pub async fn clear(connection: &mut SqliteConnection) -> Result<u64> {
    Ok(sqlx::query("DELETE FROM traversals").execute(connection).await?.rows_affected())
}

impl Tx<'_> {
    /// All traversals, by number.
    pub fn traversals(&mut self) -> Result<Vec<Traversal>> {
        self.run(read)
    }

    /// Adds traversals; their numbers and times are new ones.
    pub fn add_traversals(&mut self, new: &[Traversal]) -> Result<()> {
        self.run(async |connection| add(connection, new).await)
    }

    /// Removes all traversals; how many there were.
    pub fn clear_traversals(&mut self) -> Result<u64> {
        self.run(clear)
    }
}
