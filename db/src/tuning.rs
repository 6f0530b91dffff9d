//! Named sets of edits: the tables `tuning_cells` and `active_tunings`.

use serde::Serialize;
use sqlx::{Row, SqliteConnection};

use crate::cell::Cell;
use crate::error::Result;
use crate::transaction::Tx;

/// A cell of a named tuning.
#[derive(Clone, Debug, PartialEq, Serialize, utoipa::ToSchema)]
pub struct TuningCell {
    /// The tuning.
    pub tuning: String,
    /// The table.
    pub table: String,
    /// The row's whole key, its columns joined by `/`.
    pub key: String,
    /// The column.
    pub column: String,
    /// The value that counts while the tuning is on.
    #[schema(value_type = Value)]
    pub value: Cell,
}

/// All cells of all tunings, by tuning, table, key and column.
pub async fn cells(connection: &mut SqliteConnection) -> Result<Vec<TuningCell>> {
    let query = sqlx::query(
        "SELECT tuning, table_name, key, column_name, value FROM tuning_cells ORDER BY 1, 2, 3, 4",
    );
    let mut cells = Vec::new();
    for row in query.fetch_all(connection).await? {
        cells.push(TuningCell {
            tuning: row.try_get(0)?,
            table: row.try_get(1)?,
            key: row.try_get(2)?,
            column: row.try_get(3)?,
            value: Cell::of(&row, 4)?,
        });
    }
    Ok(cells)
}

/// The tunings that are on, by name.
pub async fn active(connection: &mut SqliteConnection) -> Result<Vec<String>> {
    let query = sqlx::query_scalar("SELECT tuning FROM active_tunings ORDER BY tuning");
    Ok(query.fetch_all(connection).await?)
}

impl Tx<'_> {
    /// All cells of all tunings, by tuning, table, key and column.
    pub fn tuning_cells(&mut self) -> Result<Vec<TuningCell>> {
        self.run(cells)
    }

    /// The tunings that are on, by name.
    pub fn active_tunings(&mut self) -> Result<Vec<String>> {
        self.run(active)
    }
}
