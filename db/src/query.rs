//! A user's own SQL, read-only.

use std::path::Path;
use std::time::{Duration, Instant};

use serde::Serialize;
use sqlx::sqlite::LockedSqliteHandle;
use sqlx::{ConnectOptions, Connection, SqliteConnection};

use crate::cell::Cell;
use crate::connection;
use crate::error::{Error, INTERRUPTED, NO_MEMORY, Result};
use crate::guard::{self, Failed, Statement};

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

/// SQLite looks at clock and memory after so many of its instructions, where it comes round a loop.
const INSTRUCTIONS: i32 = 50;

/// Bytes that SQLite may come to hold more while a query runs. Others that run meanwhile count, too: nobody can tell whose
/// they are.
const MEMORY: i64 = 256 << 20;

/// Answers one reading statement, on a connection of its own that can do nothing but read the file at `path`. Blocks as long as
/// that takes.
pub async fn answer(path: &Path, sql: &str, limits: &Limits) -> Result<Answer> {
    if let Some(command) = sql.split_whitespace().next().filter(|word| word.starts_with('.')) {
        let help =
            "`PRAGMA table_list` lists tables and views, `PRAGMA table_info(rooms)` the columns of one";
        return Err(Error::Query(format!(
            "`{command}` is a command of the sqlite3 shell, and no SQL: {help}"
        )));
    }
    let options = connection::options(path, limits.deadline)?.read_only(true).pragma("query_only", "1");
    let mut connection = options.pragma("cache_size", "-16384").connect().await?;
    let answer = guarded(&mut connection, path, sql, limits).await;
    connection.close().await?;
    answer
}

async fn guarded(
    connection: &mut SqliteConnection,
    path: &Path,
    sql: &str,
    limits: &Limits,
) -> Result<Answer> {
    let end = Instant::now() + limits.deadline;
    let room = guard::memory() + MEMORY;
    let mut handle = connection.lock_handle().await?;
    guard::restrict(&mut handle);
    handle.set_progress_handler(INSTRUCTIONS, move || Instant::now() < end && guard::memory() < room);
    let answer = rows(&mut handle, sql, limits);
    handle.remove_progress_handler();
    answer.map_err(|failed| match failed.code {
        INTERRUPTED if Instant::now() < end => Error::Query(TOO_MUCH.to_owned()),
        INTERRUPTED => Error::Deadline(limits.deadline),
        NO_MEMORY => Error::Query(TOO_MUCH.to_owned()),
        code => Error::of_code(code, path).unwrap_or(Error::Query(failed.message)),
    })
}

const TOO_MUCH: &str = "the query takes more memory than a query may";

fn rows(
    handle: &mut LockedSqliteHandle<'_>,
    sql: &str,
    limits: &Limits,
) -> std::result::Result<Answer, Failed> {
    let mut statement = Statement::prepare(handle, sql)?;
    let (columns, mut rows, mut bytes) = (statement.columns(), Vec::new(), 0);
    while statement.step()? {
        // a row is measured before it is copied
        bytes += statement.bytes();
        if rows.len() == limits.rows || bytes > limits.bytes {
            return Ok(Answer { columns, rows, truncated: true });
        }
        rows.push(statement.row()?);
    }
    Ok(Answer { columns, rows, truncated: false })
}
