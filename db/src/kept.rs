//! Reading back what was kept: starts and trees, and tables that planners fill.

use sqlx::sqlite::SqliteRow;
use sqlx::{Row, SqliteConnection};

use crate::cell::Cell;
use crate::dynamic::{self, identifier};
use crate::error::Result;
use crate::transaction::Tx;
use crate::tree::{Start, TreeRow};

/// All starts, in the order of their trees.
pub async fn starts(connection: &mut SqliteConnection) -> Result<Vec<Start>> {
    let query = sqlx::query("SELECT name, robot, tree FROM starts ORDER BY tree, name");
    let rows = query.fetch_all(connection).await?;
    let read = |row: &SqliteRow| -> sqlx::Result<Start> {
        Ok(Start { name: row.try_get(0)?, robot: row.try_get(1)?, tree: row.try_get(2)? })
    };
    Ok(rows.iter().map(read).collect::<sqlx::Result<_>>()?)
}

/// The rows of one tree, by node.
pub async fn tree_rows(connection: &mut SqliteConnection, tree: i64) -> Result<Vec<TreeRow>> {
    let query = sqlx::query(
        "SELECT node, prev, from_room, door, hops, reach, leg, x, y, heading, distance, clearance, bend,
           walked
         FROM tree_rows WHERE tree = ? ORDER BY node",
    );
    let rows = query.bind(tree).fetch_all(connection).await?;
    let read = |row: &SqliteRow| -> sqlx::Result<TreeRow> {
        let at: (Option<f64>, Option<f64>) = (row.try_get(7)?, row.try_get(8)?);
        let heading: Option<i64> = row.try_get(9)?;
        Ok(TreeRow {
            node: row.try_get(0)?,
            prev: row.try_get(1)?,
            from_room: row.try_get(2)?,
            door: row.try_get(3)?,
            hops: row.try_get(4)?,
            reach: row.try_get(5)?,
            leg: row.try_get(6)?,
            at: at.0.zip(at.1).map(|(x, y)| [x, y]),
            heading: heading.map(|hundredths| hundredths as f64 / 100.0),
            distance: row.try_get(10)?,
            clearance: row.try_get(11)?,
            bend: row.try_get(12)?,
            walked: row.try_get(13)?,
        })
    };
    Ok(rows.iter().map(read).collect::<sqlx::Result<_>>()?)
}

/// The edges of the strips along x and along y, metres, ascending.
pub async fn strip_edges(connection: &mut SqliteConnection) -> Result<[Vec<f64>; 2]> {
    let mut edges = [Vec::new(), Vec::new()];
    for (axis, edges) in ["x", "y"].into_iter().zip(&mut edges) {
        let query = sqlx::query("SELECT low, high FROM strips WHERE axis = ? ORDER BY strip").bind(axis);
        for row in query.fetch_all(&mut *connection).await? {
            if edges.is_empty() {
                edges.push(row.try_get(0)?);
            }
            edges.push(row.try_get(1)?);
        }
    }
    Ok(edges)
}

/// Replaces a table that is no table of ours, columns and all. A column is a name and a declared type; `key` names those
/// of its primary key, and may be empty.
pub async fn replace_user_table(
    connection: &mut SqliteConnection,
    name: &str,
    columns: &[(&str, &str)],
    key: &[&str],
    rows: impl IntoIterator<Item = Vec<Cell>>,
) -> Result<()> {
    let table = identifier(name);
    let mut declared: Vec<String> =
        columns.iter().map(|(column, kind)| format!("{} {kind}", identifier(column))).collect();
    if !key.is_empty() {
        let key: Vec<String> = key.iter().map(|column| identifier(column)).collect();
        declared.push(format!("PRIMARY KEY ({})", key.join(", ")));
    }
    dynamic::execute(connection, format!("DROP TABLE IF EXISTS {table}"), &[]).await?;
    dynamic::execute(connection, format!("CREATE TABLE {table} ({})", declared.join(", ")), &[]).await?;
    let holes = vec!["?"; columns.len()].join(", ");
    for row in rows {
        dynamic::execute(connection, format!("INSERT INTO {table} VALUES ({holes})"), &row).await?;
    }
    Ok(())
}

/// Adds a column to a table that is no table of ours.
async fn add_column(connection: &mut SqliteConnection, table: &str, column: &str, kind: &str) -> Result<()> {
    let sql = format!("ALTER TABLE {} ADD COLUMN {} {kind}", identifier(table), identifier(column));
    dynamic::execute(connection, sql, &[]).await?;
    Ok(())
}

impl Tx<'_> {
    /// All starts, in the order of their trees.
    pub fn starts(&mut self) -> Result<Vec<Start>> {
        self.run(starts)
    }

    /// The rows of one tree, by node.
    pub fn tree_rows(&mut self, tree: i64) -> Result<Vec<TreeRow>> {
        self.run(async |connection| tree_rows(connection, tree).await)
    }

    /// The edges of the strips along x and along y, metres, ascending.
    pub fn strip_edges(&mut self) -> Result<[Vec<f64>; 2]> {
        self.run(strip_edges)
    }

    /// Replaces a table that is no table of ours, columns and all. A column is a name and a declared type; `key` names
    /// those of its primary key, and may be empty.
    pub fn replace_user_table(
        &mut self,
        name: &str,
        columns: &[(&str, &str)],
        key: &[&str],
        rows: impl IntoIterator<Item = Vec<Cell>>,
    ) -> Result<()> {
        self.run(async |connection| replace_user_table(connection, name, columns, key, rows).await)
    }

    /// Adds a column to a table that is no table of ours, with the type that it is declared with.
    pub fn add_column(&mut self, table: &str, column: &str, kind: &str) -> Result<()> {
        self.run(async |connection| add_column(connection, table, column, kind).await)
    }
}
