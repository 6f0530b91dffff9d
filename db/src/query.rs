//! A user's own SQL, read-only.

use std::path::Path;
use std::time::{Duration, Instant};

use futures_util::TryStreamExt;
use serde::Serialize;
use sqlx::sqlite::SqliteRow;
use sqlx::{
    AssertSqlSafe, Column, ConnectOptions, Connection, Executor, Row, SqlSafeStr, SqliteConnection, Statement,
};

use crate::cell::Cell;
use crate::error::{Error, INTERRUPTED, Result, code};
use crate::{guard, store};

/// How much one query may take.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// Time; the query is stopped then.
    pub deadline: Duration,
    /// Rows; the rest is left out, and said to be.
    pub rows: usize,
    /// Bytes of all texts together, with eight for each number; the rest is left out likewise.
    pub bytes: usize,
}

impl Default for Limits {
    fn default() -> Self {
        Self { deadline: Duration::from_secs(10), rows: 100_000, bytes: 64 << 20 }
    }
}

/// The answer to a query.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Answer {
    /// The columns' names.
    pub columns: Vec<String>,
    /// A value for each column.
    pub rows: Vec<Vec<Cell>>,
    /// Whether there were more rows than the limit.
    pub truncated: bool,
}

/// SQLite looks at the clock after so many of its instructions.
const INSTRUCTIONS: i32 = 1_000;

/// Answers one reading statement, on a connection of its own that can do nothing but read the file at `path`.
pub async fn answer(path: &Path, sql: &str, limits: &Limits) -> Result<Answer> {
    let options = store::options(path, limits.deadline)?.read_only(true).pragma("query_only", "1");
    let mut connection = options.connect().await?;
    let answer = guarded(&mut connection, sql, limits).await;
    connection.close().await?;
    answer.map_err(|error| match error {
        Error::Sql(error) if code(&error) == Some(INTERRUPTED) => Error::Deadline(limits.deadline),
        Error::Sql(error) => said(error),
        other => other,
    })
}

/// What SQLite says about the user's text, without sqlx's words around it. Failures of the file stay as they are.
fn said(error: sqlx::Error) -> Error {
    const SQL_ERROR: i32 = 1;
    match (code(&error), error.as_database_error()) {
        (Some(SQL_ERROR), Some(said)) => Error::Query(said.message().to_owned()),
        _ => Error::Sql(error),
    }
}

async fn guarded(connection: &mut SqliteConnection, sql: &str, limits: &Limits) -> Result<Answer> {
    let end = Instant::now() + limits.deadline;
    {
        let mut handle = connection.lock_handle().await?;
        guard::restrict(&mut handle);
        guard::one_reading_statement(&mut handle, sql).map_err(Error::Query)?;
        handle.set_progress_handler(INSTRUCTIONS, move || Instant::now() < end);
    }
    let text = || AssertSqlSafe(sql.to_owned());
    let statement = (&mut *connection).prepare(text().into_sql_str()).await?;
    let columns: Vec<String> = statement.columns().iter().map(|column| column.name().to_owned()).collect();
    let (mut rows, mut bytes) = (Vec::new(), 0);
    let mut stream = sqlx::query(text()).fetch(connection);
    while let Some(row) = stream.try_next().await? {
        let row = cells(&row)?;
        bytes += row.iter().map(Cell::bytes).sum::<usize>();
        if rows.len() == limits.rows || bytes > limits.bytes {
            return Ok(Answer { columns, rows, truncated: true });
        }
        rows.push(row);
    }
    Ok(Answer { columns, rows, truncated: false })
}

fn cells(row: &SqliteRow) -> Result<Vec<Cell>> {
    (0..row.len()).map(|index| Cell::of(row, index)).collect()
}
