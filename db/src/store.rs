//! The database of a site, opened.

use std::path::{Path, PathBuf};
use std::time::Duration;

use sqlx::sqlite::SqliteConnectOptions;
use sqlx::{ConnectOptions, Connection, SqliteConnection};
use tokio::runtime::{Builder, Runtime};

use crate::backup;
use crate::doctor::{self, Health};
use crate::error::{self, Error, Result};
use crate::migrate::{self, Kind, STEPS, VERSION};
use crate::query::{self, Answer, Limits};
use crate::transaction::Tx;

/// How long a locked database is waited for, unless said otherwise.
const PATIENCE: Duration = Duration::from_secs(5);

/// A site's database. Its functions block: do not call them from within an async runtime, which has the functions of
/// each table's module instead.
pub struct Store {
    runtime: Runtime,
    connection: SqliteConnection,
    path: PathBuf,
}

impl Store {
    /// Makes a new database; there must be none.
    pub fn create(path: impl AsRef<Path>) -> Result<Self> {
        let path = path.as_ref();
        if path.metadata().is_ok_and(|file| file.len() > 0) {
            return Err(Error::Exists(path.to_owned()));
        }
        Self::writable(path, true, PATIENCE)
    }

    /// Opens a database for reading and writing. One of an older version is copied to `FILE.bak-vN` and migrated.
    pub fn open(path: impl AsRef<Path>) -> Result<Self> {
        Self::open_waiting(path, PATIENCE)
    }

    /// As [`Store::open`]; a lock of another program is waited for so long, then and at each later write.
    pub fn open_waiting(path: impl AsRef<Path>, patience: Duration) -> Result<Self> {
        let path = path.as_ref();
        if !path.exists() {
            return Err(Error::Missing(path.to_owned()));
        }
        Self::writable(path, false, patience)
    }

    /// Opens the database, or makes it where there is none.
    pub fn open_or_create(path: impl AsRef<Path>) -> Result<Self> {
        Self::writable(path.as_ref(), true, PATIENCE)
    }

    /// Opens a database for reading: works in a read-only folder, and refuses every write.
    pub fn open_read_only(path: impl AsRef<Path>) -> Result<Self> {
        let path = path.as_ref();
        if !path.exists() {
            return Err(Error::Missing(path.to_owned()));
        }
        let mut store = Self::connect(path, &options(path, PATIENCE)?.read_only(true))?;
        match store.run(async |connection| migrate::kind(connection).await)? {
            Kind::Adit(VERSION) => Ok(store),
            Kind::Adit(found) if found > VERSION => {
                Err(Error::Newer { path: store.path, found, known: VERSION })
            }
            Kind::Adit(found) => Err(Error::Older { path: store.path, found, known: VERSION }),
            Kind::Empty | Kind::Other => Err(Error::NotAdit(store.path)),
        }
    }

    fn writable(path: &Path, create: bool, patience: Duration) -> Result<Self> {
        let mut store = Self::connect(path, &options(path, patience)?.create_if_missing(create))?;
        let at = store.path.clone();
        store.run(async |connection| {
            let version: String =
                sqlx::query_scalar("SELECT sqlite_version()").fetch_one(&mut *connection).await?;
            if older_than_3_51_3(&version) {
                return Err(Error::OldSqlite(version));
            }
            if !create && migrate::kind(connection).await? == Kind::Empty {
                return Err(Error::NotAdit(at.clone()));
            }
            migrate::migrate(connection, &at, STEPS).await
        })?;
        Ok(store)
    }

    fn connect(path: &Path, options: &SqliteConnectOptions) -> Result<Self> {
        let at = || path.to_owned();
        if path.is_dir() {
            return Err(Error::CannotOpen(at()));
        }
        let runtime =
            Builder::new_current_thread().build().map_err(|source| Error::Io { path: at(), source })?;
        let connection = runtime.block_on(options.connect()).map_err(|e| match error::code(&e) {
            Some(14) => Error::CannotOpen(at()),
            _ => Error::from(e).at(path),
        })?;
        Ok(Self { runtime, connection, path: at() })
    }

    /// The database's file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Does `work` in one transaction that no other writer comes between. If it fails, the database is as before.
    pub fn transaction<T, E: From<Error>>(
        &mut self,
        work: impl FnOnce(&mut Tx<'_>) -> std::result::Result<T, E>,
    ) -> std::result::Result<T, E> {
        let mut tx = self.begin("BEGIN IMMEDIATE")?;
        let result = work(&mut tx);
        match result {
            Ok(value) => match tx.commit() {
                Ok(()) => Ok(value),
                Err(error) => {
                    // the rollback is only on its way: whoever reads the file next must not find it locked still
                    self.runtime.block_on(self.connection.ping()).ok();
                    Err(E::from(error))
                }
            },
            Err(error) => {
                // on a full disk SQLite has rolled back already, and says so; what went wrong first is what counts
                tx.roll_back().ok();
                Err(error)
            }
        }
    }

    /// Does `work` as [`Store::transaction`] would, and takes everything back.
    pub fn rehearse<T, E: From<Error>>(
        &mut self,
        work: impl FnOnce(&mut Tx<'_>) -> std::result::Result<T, E>,
    ) -> std::result::Result<T, E> {
        self.undone("BEGIN IMMEDIATE", work)
    }

    /// Reads one state of the database, whatever others write meanwhile.
    pub fn snapshot<T, E: From<Error>>(
        &mut self,
        work: impl FnOnce(&mut Tx<'_>) -> std::result::Result<T, E>,
    ) -> std::result::Result<T, E> {
        self.undone("BEGIN", work)
    }

    fn undone<T, E: From<Error>>(
        &mut self,
        begin: &'static str,
        work: impl FnOnce(&mut Tx<'_>) -> std::result::Result<T, E>,
    ) -> std::result::Result<T, E> {
        let mut tx = self.begin(begin)?;
        let result = work(&mut tx);
        let rolled_back = tx.roll_back();
        let value = result?;
        rolled_back.map_err(E::from)?;
        Ok(value)
    }

    fn begin(&mut self, begin: &'static str) -> Result<Tx<'_>> {
        let transaction = self
            .runtime
            .block_on(self.connection.begin_with(begin))
            .map_err(|e| Error::from(e).at(&self.path))?;
        Ok(Tx::new(&self.runtime, transaction, &self.path))
    }

    /// Lets others read while this connection writes (SQLite's WAL mode), or not any more: then the database is one file
    /// again, unless another connection is open.
    pub fn share(&mut self, on: bool) -> Result<()> {
        let sql = if on { "PRAGMA journal_mode = WAL" } else { "PRAGMA journal_mode = DELETE" };
        self.run(async |connection| {
            sqlx::query(sql).execute(connection).await?;
            Ok(())
        })
    }

    /// Whether each transaction is on the disk before it is done. Without that, and in WAL mode ([`Store::share`]), a crash
    /// of the program loses nothing, and a power cut the last transactions; the database stays whole in either case.
    pub fn sync_each(&mut self, on: bool) -> Result<()> {
        let sql = if on { "PRAGMA synchronous = FULL" } else { "PRAGMA synchronous = NORMAL" };
        self.run(async |connection| {
            sqlx::query(sql).execute(connection).await?;
            Ok(())
        })
    }

    /// Writes a compact copy of the database to `to`, which must not exist.
    pub fn backup(&mut self, to: impl AsRef<Path>) -> Result<()> {
        self.run(async |connection| backup::copy(connection, to.as_ref()).await)
    }

    /// Checks the database's integrity, and counts what is in it.
    pub fn doctor(&mut self) -> Result<Health> {
        self.run(doctor::examine)
    }

    /// Answers one reading SQL statement of a user, on a connection that can do nothing but read this file.
    pub fn query(&self, sql: &str, limits: &Limits) -> Result<Answer> {
        self.runtime.block_on(query::answer(&self.path, sql, limits)).map_err(|e| e.at(&self.path))
    }

    fn run<T>(&mut self, work: impl AsyncFnOnce(&mut SqliteConnection) -> Result<T>) -> Result<T> {
        self.runtime.block_on(work(&mut self.connection)).map_err(|e| e.at(&self.path))
    }
}

/// What every connection of ours has: foreign keys, full synchronisation, and room for a build's pages.
pub(crate) fn options(path: &Path, patience: Duration) -> Result<SqliteConnectOptions> {
    // absolute, since SQLite would take a relative name like `file:x` for a URI
    let absolute = std::path::absolute(path).map_err(|source| Error::Io { path: path.to_owned(), source })?;
    Ok(SqliteConnectOptions::new()
        .filename(absolute)
        .foreign_keys(true)
        .busy_timeout(patience)
        .pragma("cache_size", "-65536")
        .disable_statement_logging())
}

/// Below 3.51.3, two connections that write in WAL mode may corrupt the database (SQLite's WAL-reset bug).
fn older_than_3_51_3(version: &str) -> bool {
    let parts: Vec<u32> = version.split('.').map(|part| part.parse().unwrap_or(0)).collect();
    parts < vec![3, 51, 3]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn versions_are_compared_as_numbers() {
        assert!(older_than_3_51_3("3.9.0"));
        assert!(older_than_3_51_3("3.51.2"));
        assert!(!older_than_3_51_3("3.51.3"));
        assert!(!older_than_3_51_3("3.100.0"));
    }
}
