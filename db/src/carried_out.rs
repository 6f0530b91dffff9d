//! What rules that react have carried out: the table `carried_out`.

use sqlx::{Row, SqliteConnection};

use crate::bulk::{self, Record, Values};
use crate::error::Result;
use crate::transaction::Tx;

/// A rule that was carried out for some objects.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CarriedOut {
    /// The rule's name.
    pub rule: String,
    /// Its version.
    pub version: String,
    /// The objects with what the rule read of them.
    pub because: String,
}

impl Record for &CarriedOut {
    const TABLE: &'static str = "carried_out";
    const COLUMNS: &'static [&'static str] = &["rule", "version", "because"];

    fn bind(&self, values: &mut Values) {
        values.text(&*self.rule);
        values.text(&*self.version);
        values.text(&*self.because);
    }
}

async fn read(connection: &mut SqliteConnection) -> Result<Vec<CarriedOut>> {
    let rows = sqlx::query("SELECT rule, version, because FROM carried_out ORDER BY rule, version, because");
    let rows = rows.fetch_all(connection).await?;
    let read = |row: &sqlx::sqlite::SqliteRow| -> sqlx::Result<CarriedOut> {
        Ok(CarriedOut { rule: row.try_get(0)?, version: row.try_get(1)?, because: row.try_get(2)? })
    };
    Ok(rows.iter().map(read).collect::<sqlx::Result<_>>()?)
}

async fn replace(connection: &mut SqliteConnection, by: &[CarriedOut]) -> Result<()> {
    sqlx::query("DELETE FROM carried_out").execute(&mut *connection).await?;
    bulk::insert(connection, by).await?;
    Ok(())
}

impl Tx<'_> {
    /// All that was carried out, in order.
    pub fn carried_out(&mut self) -> Result<Vec<CarriedOut>> {
        self.run(read)
    }

    /// Replaces all that was carried out.
    pub fn replace_carried_out(&mut self, by: &[CarriedOut]) -> Result<()> {
        self.run(async |connection| replace(connection, by).await)
    }
}
