//! The database of a site, opened.

use std::path::Path;
use std::time::Duration;

use sqlx::SqliteConnection;

use crate::backup;
use crate::connection::{Connection, options};
use crate::doctor::{self, Health};
use crate::error::{Error, Result};
use crate::history;
use crate::migrate::{self, Kind, STEPS, VERSION};
use crate::postgres::{self, Entry, File, Leaving, Place, Replica};
use crate::query::{self, Answer, Limits};
use crate::transaction::Tx;

/// Ends SQLite's WAL mode.
const ONE_FILE: &str = "PRAGMA journal_mode = DELETE";

/// How long a locked database is waited for, unless said otherwise.
const PATIENCE: Duration = Duration::from_secs(5);

/// A site's database. Its functions block: do not call them from within an async runtime, which has the functions of
/// each table's module instead.
pub struct Store {
    connection: Connection,
    /// Whether it was opened for writing, and is one of ours.
    writes: bool,
    /// What it is a copy of.
    replica: Option<Box<Replica>>,
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

    /// As [`Store::open_or_create`], and the database keeps worlds of their own from now on.
    pub fn open_for_worlds(path: impl AsRef<Path>) -> Result<Self> {
        let path = path.as_ref();
        let mut store = Self::writable(path, true, PATIENCE)?;
        store.run(async |connection| migrate::keep_worlds(connection, path, STEPS).await)?;
        Ok(store)
    }

    /// Opens a database for reading: works in a read-only folder, and refuses every write. Only half a transaction, which a
    /// program that was killed has left, is taken back first.
    pub fn open_read_only(path: impl AsRef<Path>) -> Result<Self> {
        let path = path.as_ref();
        if !path.exists() {
            return Err(Error::Missing(path.to_owned()));
        }
        let options = options(path, PATIENCE)?.read_only(true);
        let open = || -> Result<_> {
            let mut store =
                Self { connection: Connection::open(path, &options)?, writes: false, replica: None };
            let kind = store.run(async |connection| migrate::kind(connection).await)?;
            Ok((store, kind))
        };
        let opened = match open() {
            Err(Error::ReadOnly(_)) if take_back_what_is_left(path).is_ok() => open(),
            opened => opened,
        };
        let path = path.to_owned();
        let (store, kind) = opened?;
        match kind {
            Kind::Adit(VERSION) => Ok(store),
            Kind::Adit(found) if found > VERSION => Err(Error::Newer { path, found, known: VERSION }),
            Kind::Adit(found) => Err(Error::Older { path, found, known: VERSION }),
            Kind::Empty | Kind::Other => Err(Error::NotAdit(path)),
        }
    }

    fn writable(path: &Path, create: bool, patience: Duration) -> Result<Self> {
        let options = options(path, patience)?.create_if_missing(create);
        let mut store = Self { connection: Connection::open(path, &options)?, writes: false, replica: None };
        store.run(async |connection| {
            let version: String =
                sqlx::query_scalar("SELECT sqlite_version()").fetch_one(&mut *connection).await?;
            if older_than_3_51_3(&version) {
                return Err(Error::OldSqlite(version));
            }
            if !create && migrate::kind(connection).await? == Kind::Empty {
                return Err(Error::NotAdit(path.to_owned()));
            }
            migrate::migrate(connection, path, STEPS).await
        })?;
        store.writes = true;
        Ok(store)
    }

    /// The database's file.
    pub fn path(&self) -> &Path {
        self.connection.path()
    }

    /// Does `work` in one transaction that no other writer comes between. If it fails, the database is as before.
    pub fn transaction<T, E: From<Error>>(
        &mut self,
        work: impl FnOnce(&mut Tx<'_>) -> std::result::Result<T, E>,
    ) -> std::result::Result<T, E> {
        if let Some(replica) = &self.replica {
            replica.may_write()?;
        }
        let mut tx = Tx::begin(&mut self.connection, "BEGIN IMMEDIATE")?;
        let value = work(&mut tx)?;
        tx.run(history::join)?;
        if let Some(replica) = &mut self.replica
            && let Some(pending) = tx.run(async |connection| replica.pending(connection).await)?
        {
            replica.publish(&pending)?;
            // it is made, whatever becomes of the copy: that takes it from the log as it takes those of others
            tx.commit().map_err(|error| replica.kept_there(&error))?;
            replica.accept(pending);
        } else {
            tx.commit()?;
        }
        Ok(value)
    }

    /// Opens the copy that a tie to PostgreSQL was made with: each transaction is kept there before it is committed here. Such a
    /// copy can be made anew at any time, so nothing of it is synced to the disk.
    pub fn open_copy(path: impl AsRef<Path>, replica: Replica) -> Result<Self> {
        let mut store = Self::open(path)?;
        store.connection.execute("PRAGMA synchronous = OFF")?;
        let mut replica = Box::new(replica);
        store.run(async |connection| replica.begin(connection).await)?;
        store.replica = Some(replica);
        Ok(store)
    }

    /// Puts the site into PostgreSQL: all that is in the database, and its files.
    ///
    /// # Arguments
    /// `replace`: whether one of that name is replaced; services on it go on with the new one.
    pub fn copy_in(&mut self, files: &[File], to: (&Place, &str), replace: bool) -> Result<()> {
        let leaving = self.snapshot(|tx| tx.run(Leaving::read))?;
        postgres::copy_in(leaving, files, to, replace)
    }

    /// Whether it is a copy of a site in PostgreSQL.
    pub fn is_copy(&self) -> bool {
        self.replica.is_some()
    }

    /// Whether PostgreSQL could not be reached a moment ago, so that nothing of what others wrote is seen.
    pub fn is_cut_off(&self) -> bool {
        self.replica.as_ref().is_some_and(|replica| replica.is_cut_off())
    }

    /// Asks for the right to write; `false` where another service has it. It is given up with the next transaction, or by
    /// [`Store::cede`]. Of what is no copy it is always there.
    pub fn lead(&mut self) -> Result<bool> {
        self.replica.as_mut().map_or(Ok(true), |replica| replica.lead())
    }

    /// Gives the right to write up.
    pub fn cede(&mut self) {
        if let Some(replica) = &mut self.replica {
            replica.cede();
        }
    }

    /// Has the next transaction keep the site's files, which are these; `false` where they are those that are kept.
    pub fn stage_files(&mut self, files: Vec<File>) -> bool {
        self.replica.as_mut().is_some_and(|replica| replica.stage(files))
    }

    /// What other services wrote that this copy does not have yet, in its order, or the first part of that.
    ///
    /// # Arguments
    /// `at_once`: also where the database was out of reach half a second ago.
    pub fn waiting(&mut self, at_once: bool) -> Result<Vec<Entry>> {
        self.replica.as_mut().map_or(Ok(Vec::new()), |replica| replica.waiting(at_once))
    }

    /// Takes what another service wrote into the copy.
    ///
    /// # Arguments
    /// `step` follows it, as who wrote it did: what that writes is compared with what was written.
    ///
    /// # Returns
    /// What the step gave; `None` where it did not come to the same, and all that it wrote is taken back.
    pub fn take<T, E: From<Error>>(
        &mut self,
        entry: &Entry,
        step: impl FnOnce(&mut Tx<'_>) -> std::result::Result<Option<T>, E>,
    ) -> std::result::Result<Option<T>, E> {
        let Some(replica) = &mut self.replica else { return Ok(None) };
        let mut tx = Tx::begin(&mut self.connection, "BEGIN IMMEDIATE")?;
        tx.run(async |connection| replica.put_rows(connection, entry).await)?;
        tx.execute("SAVEPOINT followed")?;
        let mut followed = step(&mut tx)?;
        if followed.is_some() {
            tx.run(crate::history::join)?;
            if !tx.run(async |connection| replica.is_reached(connection, entry).await)? {
                followed = None;
            }
        }
        if followed.is_none() {
            tx.execute("ROLLBACK TO followed")?;
        }
        tx.run(async |connection| replica.put_state(connection, entry).await)?;
        tx.commit()?;
        replica.took(entry);
        Ok(followed)
    }

    /// Makes the copy's rows those that the site now has: where its log does not reach back far enough.
    ///
    /// # Returns
    /// The site's files.
    pub fn take_whole(&mut self) -> Result<Vec<File>> {
        let Some(replica) = &mut self.replica else { return Ok(Vec::new()) };
        let entry = replica.whole()?;
        let mut tx = Tx::begin(&mut self.connection, "BEGIN IMMEDIATE")?;
        tx.run(async |connection| replica.put_rows(connection, &entry).await)?;
        tx.run(async |connection| replica.put_state(connection, &entry).await)?;
        tx.commit()?;
        replica.took_whole(&entry);
        Ok(replica.files())
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
        work(&mut Tx::begin(&mut self.connection, begin)?)
    }

    /// Lets others read while this connection writes (SQLite's WAL mode).
    pub fn share(&mut self) -> Result<()> {
        self.connection.execute("PRAGMA journal_mode = WAL")
    }

    /// Ends [`share`](Self::share): the database is one file again. Where another connection is still open, `-wal` and
    /// `-shm` stay beside it, and where the disk is full; whether the file alone holds all is said then.
    pub fn unshare(&mut self) -> Result<bool> {
        match self.connection.execute(ONE_FILE) {
            Err(error) if error.is_busy() => self.run(async |connection| {
                let checkpoint = sqlx::query_as("PRAGMA wal_checkpoint(TRUNCATE)");
                let (_, pages, moved): (i64, i64, i64) = checkpoint.fetch_one(connection).await?;
                Ok(pages == moved)
            }),
            // what was acknowledged is in the log
            Err(Error::Full(_) | Error::Disk(_) | Error::NoFileBeside(_)) => Ok(false),
            done => done.map(|()| true),
        }
    }

    /// Whether each transaction is on the disk before it is done. Without that, and in WAL mode ([`Store::share`]), a crash
    /// of the program loses nothing, and a power cut the last transactions; the database stays whole in either case.
    pub fn sync_each(&mut self, on: bool) -> Result<()> {
        self.connection.execute(if on { "PRAGMA synchronous = EXTRA" } else { "PRAGMA synchronous = NORMAL" })
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
        self.connection.beside(async |path| query::answer(path, sql, limits).await)
    }

    fn run<T>(&mut self, work: impl AsyncFnOnce(&mut SqliteConnection) -> Result<T>) -> Result<T> {
        self.connection.run(work)
    }
}

impl Drop for Store {
    /// Whoever writes last leaves one file, also where a program that shared the database was killed. With another
    /// connection open SQLite refuses that at once.
    fn drop(&mut self) {
        if self.writes {
            self.connection.execute(ONE_FILE).ok();
        }
    }
}

/// Takes half a transaction back that is left of a power cut or of a program that was killed: nobody can read before, and a
/// connection that only reads may not.
fn take_back_what_is_left(path: &Path) -> Result<()> {
    let mut writer = Connection::open(path, &options(path, PATIENCE)?)?;
    writer.run(async |connection| migrate::kind(connection).await.map(drop))
}

/// Below 3.51.3, two connections that write in WAL mode may corrupt the database (SQLite's WAL-reset bug).
fn older_than_3_51_3(version: &str) -> bool {
    let parts: Vec<u32> = version.split('.').map(|part| part.parse().unwrap_or(0)).collect();
    parts < vec![3, 51, 3]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Gives the database so many pages more than it has.
    fn give_room(store: &mut Store, pages: i64) {
        let set = store.run(async |connection| {
            let has: i64 = sqlx::query_scalar("PRAGMA page_count").fetch_one(&mut *connection).await?;
            let limit = format!("PRAGMA max_page_count = {}", has + pages);
            sqlx::raw_sql(sqlx::AssertSqlSafe(limit)).execute(connection).await?;
            Ok(())
        });
        set.unwrap();
    }

    /// SQLite ends a transaction by itself when the disk is full. It was taken for open ever after: no edit until a restart.
    #[test]
    fn a_full_disk_ends_one_transaction_and_not_all_that_follow() {
        let folder = tempfile::tempdir().unwrap();
        let mut store = Store::create(folder.path().join("site.db")).unwrap();
        let long = "long".repeat(100_000);
        for _ in 0..3 {
            give_room(&mut store, 2);
            let full = store.transaction(|tx| {
                tx.set_site_value("short", Some("before"))?;
                tx.set_site_value("long", Some(&long))
            });
            assert!(matches!(full, Err(Error::Full(_))), "{full:?}");
            let full = store.rehearse(|tx| tx.set_site_value("long", Some(&long)));
            assert!(matches!(full, Err(Error::Full(_))), "{full:?}");
            give_room(&mut store, 1_000);
            assert_eq!(store.snapshot(|tx| tx.site_value("short")).unwrap(), None);
            store.transaction(|tx| tx.set_site_value("long", Some(&long))).unwrap();
            store.transaction(|tx| tx.set_site_value("long", None)).unwrap();
            store
                .run(async |connection| Ok(sqlx::raw_sql("VACUUM").execute(connection).await.map(drop)?))
                .unwrap();
        }
    }

    #[test]
    fn a_panic_takes_a_transaction_back() {
        let folder = tempfile::tempdir().unwrap();
        let mut store = Store::create(folder.path().join("site.db")).unwrap();
        let panicked = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
            store.transaction(|tx| -> Result<()> {
                tx.set_site_value("half", Some("done"))?;
                panic!("a defect");
            })
        }));
        assert!(panicked.is_err());
        assert_eq!(store.transaction(|tx| tx.site_value("half")).unwrap(), None);
    }

    #[test]
    fn versions_are_compared_as_numbers() {
        assert!(older_than_3_51_3("3.9.0"));
        assert!(older_than_3_51_3("3.51.2"));
        assert!(!older_than_3_51_3("3.51.3"));
        assert!(!older_than_3_51_3("3.100.0"));
    }
}
