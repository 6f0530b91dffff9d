//! A connection with the runtime that drives it, in blocking form.

use std::path::{Path, PathBuf};
use std::pin::{Pin, pin};
use std::time::Duration;

use sqlx::sqlite::{SqliteConnectOptions, SqliteSynchronous};
use sqlx::{ConnectOptions, Connection as _, SqliteConnection};
use tokio::runtime::{Builder, Runtime};

use crate::error::{self, Error, Result};

/// An open connection. It is closed when this is dropped, and not some time later: SQLite tidies up behind the last one.
pub(crate) struct Connection {
    runtime: Runtime,
    inner: Option<SqliteConnection>,
    path: PathBuf,
}

impl Connection {
    pub(crate) fn open(path: &Path, options: &SqliteConnectOptions) -> Result<Self> {
        let at = || path.to_owned();
        if path.is_dir() {
            return Err(Error::CannotOpen(at()));
        }
        let runtime =
            Builder::new_current_thread().build().map_err(|source| Error::Io { path: at(), source })?;
        let connection = wait(&runtime, options.connect()).map_err(|e| match error::code(&e) {
            Some(14) => Error::CannotOpen(at()),
            _ => Error::from(e).at(path),
        })?;
        Ok(Self { runtime, inner: Some(connection), path: at() })
    }

    /// The database's file.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    pub(crate) fn run<T>(&mut self, work: impl AsyncFnOnce(&mut SqliteConnection) -> Result<T>) -> Result<T> {
        let connection = self.inner.as_mut().expect("it is taken away by drop alone");
        wait(&self.runtime, work(connection)).map_err(|e| e.at(&self.path))
    }

    /// Does what needs no connection of ours, or one of its own.
    pub(crate) fn beside<T>(&self, work: impl AsyncFnOnce(&Path) -> Result<T>) -> Result<T> {
        wait(&self.runtime, work(&self.path)).map_err(|e| e.at(&self.path))
    }

    /// Runs a statement that gives no rows.
    pub(crate) fn execute(&mut self, sql: &'static str) -> Result<()> {
        self.run(async |connection| {
            sqlx::raw_sql(sql).execute(connection).await?;
            Ok(())
        })
    }
}

impl Drop for Connection {
    fn drop(&mut self) {
        if let Some(connection) = self.inner.take() {
            wait(&self.runtime, connection.close()).ok();
        }
    }
}

/// Waits for some work. The runtime is handed all work as one type: with each type of work its loop would be compiled once more,
/// and that was a quarter of this crate.
pub(crate) fn wait<T>(runtime: &Runtime, work: impl Future<Output = T>) -> T {
    let mut done = None;
    {
        let work = pin!(async { done = Some(work.await) });
        runtime.block_on(work as Pin<&mut dyn Future<Output = ()>>);
    }
    done.expect("it was waited for")
}

/// What every connection of ours has: foreign keys, full synchronisation, and room for a build's pages. A transaction is
/// done when its journal is gone: that it is gone is synced as well, or a power cut would bring it back and undo what was
/// acknowledged.
pub(crate) fn options(path: &Path, patience: Duration) -> Result<SqliteConnectOptions> {
    // absolute, since SQLite would take a relative name like `file:x` for a URI
    let absolute = std::path::absolute(path).map_err(|source| Error::Io { path: path.to_owned(), source })?;
    Ok(SqliteConnectOptions::new()
        .filename(absolute)
        .foreign_keys(true)
        .busy_timeout(patience)
        .synchronous(SqliteSynchronous::Extra)
        .pragma("cache_size", "-65536")
        .disable_statement_logging())
}
