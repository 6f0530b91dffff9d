//! What robots carry: the table `loads`.

use serde::{Deserialize, Serialize};
use sqlx::{Row, SqliteConnection};

use crate::bulk::{self, Record, Values};
use crate::error::Result;
use crate::transaction::Tx;

/// Something that a robot can carry.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Load {
    /// The robot's name.
    pub robot: String,
    /// The load's name.
    pub load: String,
    /// Metres that it stands above the robot.
    pub height: f64,
    /// How wide it is, metres.
    pub width: f64,
    /// Whether the robot carries it now.
    pub carried: bool,
}

impl Record for &Load {
    const TABLE: &'static str = "loads";
    const COLUMNS: &'static [&'static str] = &["robot", "load", "height", "width", "carried"];

    fn bind(&self, values: &mut Values) {
        values.text(&*self.robot);
        values.text(&*self.load);
        values.real(self.height);
        values.real(self.width);
        values.truth(self.carried);
    }
}

/// All loads, by key.
pub async fn read(connection: &mut SqliteConnection) -> Result<Vec<Load>> {
    let rows = sqlx::query("SELECT robot, load, height, width, carried FROM loads ORDER BY robot, load");
    let rows = rows.fetch_all(connection).await?;
    let read = |row: &sqlx::sqlite::SqliteRow| -> sqlx::Result<Load> {
        Ok(Load {
            robot: row.try_get(0)?,
            load: row.try_get(1)?,
            height: row.try_get(2)?,
            width: row.try_get(3)?,
            carried: row.try_get(4)?,
        })
    };
    Ok(rows.iter().map(read).collect::<sqlx::Result<_>>()?)
}

/// Replaces all loads by these, as seeding does.
pub async fn replace(connection: &mut SqliteConnection, loads: &[Load]) -> Result<()> {
    sqlx::query("DELETE FROM loads").execute(&mut *connection).await?;
    bulk::insert(connection, loads).await?;
    Ok(())
}

impl Tx<'_> {
    /// All loads, by key.
    pub fn loads(&mut self) -> Result<Vec<Load>> {
        self.run(read)
    }

    /// Replaces all loads by these, as seeding does.
    pub fn replace_loads(&mut self, by: &[Load]) -> Result<()> {
        self.run(async |connection| replace(connection, by).await)
    }
}
