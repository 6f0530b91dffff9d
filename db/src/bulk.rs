//! Writing many rows: statements of several hundred rows each, prepared once, or several small statements sent at once.

use std::collections::BTreeSet;
use std::sync::Arc;

use futures_util::future::join;
use sqlx::sqlite::SqliteArguments;
use sqlx::{Arguments, AssertSqlSafe, SqliteConnection};

use crate::cell::Cell;
use crate::error::{Error, Result};

/// Values bound in one statement. sqlx hands each statement to another thread, which costs about 20 µs;
/// SQLite takes at most 32,766 values.
const VALUES: usize = 4_000;

/// A row that a table takes.
pub(crate) trait Record {
    const TABLE: &'static str;
    const COLUMNS: &'static [&'static str];

    /// Binds one value for each column, in their order.
    fn bind(&self, values: &mut Values);
}

/// The values of one statement.
pub(crate) struct Values {
    arguments: SqliteArguments,
    bound: usize,
    nan: Option<usize>,
    failure: Option<sqlx::error::BoxDynError>,
}

impl Values {
    fn with_capacity(values: usize) -> Self {
        let mut arguments = SqliteArguments::default();
        arguments.reserve(values, 0);
        Self { arguments, bound: 0, nan: None, failure: None }
    }

    fn add<'t, T: sqlx::Encode<'t, sqlx::Sqlite> + sqlx::Type<sqlx::Sqlite> + 't>(&mut self, value: T) {
        if let Err(failure) = self.arguments.add(value) {
            self.failure.get_or_insert(failure);
        }
        self.bound += 1;
    }

    pub(crate) fn integer(&mut self, value: impl Into<Option<i64>>) {
        self.add(value.into());
    }

    pub(crate) fn truth(&mut self, value: impl Into<Option<bool>>) {
        self.add(value.into().map(i64::from));
    }

    /// SQLite would take a NaN for NULL: it is refused instead.
    pub(crate) fn real(&mut self, value: impl Into<Option<f64>>) {
        let value = value.into();
        if value.is_some_and(f64::is_nan) {
            self.nan.get_or_insert(self.bound);
        }
        self.add(value);
    }

    pub(crate) fn text<'t>(&mut self, value: impl Into<Option<&'t str>>) {
        self.add(value.into());
    }

    pub(crate) fn blob(&mut self, value: &[u8]) {
        self.add(value);
    }

    pub(crate) fn cell(&mut self, value: &Cell) {
        match value {
            Cell::Null => self.add(None::<i64>),
            Cell::Integer(value) => self.integer(*value),
            Cell::Real(value) => self.real(*value),
            Cell::Text(value) => self.text(value.as_str()),
            Cell::Blob(value) => self.blob(value),
        }
    }
}

/// Inserts all rows; how many there were.
pub(crate) async fn insert<R: Record>(
    connection: &mut SqliteConnection,
    rows: impl IntoIterator<Item = R>,
) -> Result<u64> {
    write(connection, rows, insertion::<R>).await
}

/// Sets the columns of rows that are there; how many were given. The first `KEYS` columns say which row it is.
pub(crate) async fn update<const KEYS: usize, R: Record>(
    connection: &mut SqliteConnection,
    rows: impl IntoIterator<Item = R>,
) -> Result<u64> {
    write(connection, rows, change::<KEYS, R>).await
}

/// Statements that are sent together, where each alone would be small: going to the other thread and back costs more than
/// what they do.
pub(crate) struct Batch {
    sql: String,
    values: Values,
    /// Whose values begin where.
    parts: Vec<(usize, &'static str, &'static [&'static str])>,
}

impl Batch {
    pub(crate) fn new() -> Self {
        Self { sql: String::new(), values: Values::with_capacity(0), parts: Vec::new() }
    }

    /// Inserts all rows.
    pub(crate) fn insert<R: Record>(&mut self, rows: impl IntoIterator<Item = R>) {
        self.add(rows, insertion::<R>);
    }

    /// Sets the columns of rows that are there. The first `KEYS` columns say which row it is.
    pub(crate) fn update<const KEYS: usize, R: Record>(&mut self, rows: impl IntoIterator<Item = R>) {
        self.add(rows, change::<KEYS, R>);
    }

    /// Inserts rows, or sets the columns of those that are there. The first `KEYS` columns are the key of the table.
    pub(crate) fn put<const KEYS: usize, R: Record>(&mut self, rows: impl IntoIterator<Item = R>) {
        self.add(rows, putting::<KEYS, R>);
    }

    /// A statement with these texts and numbers bound, in their order.
    pub(crate) fn run(&mut self, sql: &str, bind: impl FnOnce(&mut Values)) {
        self.parts.push((self.values.bound, "", &[]));
        bind(&mut self.values);
        self.append(sql);
    }

    fn add<R: Record>(&mut self, rows: impl IntoIterator<Item = R>, statement: fn(usize) -> Arc<str>) {
        let most = VALUES / R::COLUMNS.len();
        let mut rows = rows.into_iter();
        loop {
            let from = self.values.bound;
            let count = rows.by_ref().take(most).map(|row| row.bind(&mut self.values)).count();
            if count == 0 {
                return;
            }
            self.parts.push((from, R::TABLE, R::COLUMNS));
            self.append(&statement(count));
        }
    }

    fn append(&mut self, sql: &str) {
        self.sql.push_str(sql);
        self.sql.push_str(";\n");
    }

    /// Sends all of it. Where it fails, some of the statements may have been carried out.
    pub(crate) async fn send(self, connection: &mut SqliteConnection) -> Result<()> {
        if self.sql.is_empty() {
            return Ok(());
        }
        if let Some(at) = self.values.nan
            && let Some((from, table, columns)) = self.parts.iter().rfind(|(from, ..)| *from <= at)
            && !columns.is_empty()
        {
            return Err(Error::NotANumber { table, column: columns[(at - from) % columns.len()] });
        }
        if let Some(failure) = self.values.failure {
            return Err(sqlx::Error::Encode(failure).into());
        }
        // Another number of rows is another text: none is worth being kept ready.
        let query = sqlx::query_with(AssertSqlSafe(self.sql), self.values.arguments).persistent(false);
        let tables: BTreeSet<&str> =
            self.parts.iter().map(|(_, table, _)| *table).filter(|t| !t.is_empty()).collect();
        let refused = || Vec::from_iter(tables).join(", ");
        query.execute(connection).await.map_err(|e| Error::from(e).refusing(refused()))?;
        Ok(())
    }
}

async fn write<R: Record>(
    connection: &mut SqliteConnection,
    rows: impl IntoIterator<Item = R>,
    statement: fn(usize) -> Arc<str>,
) -> Result<u64> {
    let most = VALUES / R::COLUMNS.len();
    let full = statement(most);
    let mut rows = rows.into_iter();
    let mut bind = || {
        let mut values = Values::with_capacity(VALUES);
        let count = rows.by_ref().take(most).map(|row| row.bind(&mut values)).count();
        (count, values)
    };
    let mut written = 0;
    let (mut count, mut values) = bind();
    while count > 0 {
        let sql = if count == most { Arc::clone(&full) } else { statement(count) };
        // SQLite writes on another thread while the next rows are bound
        let (sent, next) = join(send::<R>(connection, sql, values), async { bind() }).await;
        sent?;
        written += count as u64;
        (count, values) = next;
    }
    Ok(written)
}

async fn send<R: Record>(connection: &mut SqliteConnection, sql: Arc<str>, values: Values) -> Result<()> {
    if let Some(at) = values.nan {
        return Err(Error::NotANumber { table: R::TABLE, column: R::COLUMNS[at % R::COLUMNS.len()] });
    }
    if let Some(failure) = values.failure {
        return Err(sqlx::Error::Encode(failure).into());
    }
    let query = sqlx::query_with(AssertSqlSafe(sql), values.arguments);
    query.execute(connection).await.map_err(|e| Error::from(e).refusing(R::TABLE))?;
    Ok(())
}

fn insertion<R: Record>(rows: usize) -> Arc<str> {
    format!("INSERT INTO {} ({}) {}", R::TABLE, R::COLUMNS.join(","), values::<R>(rows)).into()
}

fn change<const KEYS: usize, R: Record>(rows: usize) -> Arc<str> {
    let table = R::TABLE;
    let columns: Vec<(usize, &str)> = (1..).zip(R::COLUMNS.iter().copied()).collect();
    let (keys, rest) = columns.split_at(KEYS);
    let set: Vec<String> = rest.iter().map(|(at, name)| format!("{name} = v.column{at}")).collect();
    let found: Vec<String> = keys.iter().map(|(at, name)| format!("{table}.{name} = v.column{at}")).collect();
    let (set, found) = (set.join(", "), found.join(" AND "));
    format!("UPDATE {table} SET {set} FROM ({}) AS v WHERE {found}", values::<R>(rows)).into()
}

fn putting<const KEYS: usize, R: Record>(rows: usize) -> Arc<str> {
    let (keys, rest) = R::COLUMNS.split_at(KEYS);
    let set: Vec<String> = rest.iter().map(|name| format!("{name} = excluded.{name}")).collect();
    format!("{} ON CONFLICT ({}) DO UPDATE SET {}", insertion::<R>(rows), keys.join(","), set.join(", "))
        .into()
}

fn values<R: Record>(rows: usize) -> String {
    let row = format!("({})", vec!["?"; R::COLUMNS.len()].join(","));
    format!("VALUES {}", vec![row; rows].join(","))
}
