//! What can go wrong with the store.

use std::path::{Path, PathBuf};

/// A failure of the store, with the file, table or value that it is about.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// No file there.
    #[error("there is no database {0}")]
    Missing(PathBuf),
    /// `create` found something there already.
    #[error("{0} exists already")]
    Exists(PathBuf),
    /// The file is not SQLite's, or is damaged.
    #[error("{0} is not a SQLite database, or is damaged")]
    NotADatabase(PathBuf),
    /// A SQLite database, but of another program.
    #[error("{0} is a SQLite database, but not one of Adit")]
    NotAdit(PathBuf),
    /// Written by a newer Adit.
    #[error("{path} has schema version {found}; this program knows versions up to {known}: use a newer one")]
    Newer {
        /// The database.
        path: PathBuf,
        /// Its schema version.
        found: i64,
        /// The newest version known here.
        known: i64,
    },
    /// Written by an older Adit, and opened for reading only.
    #[error("{path} has schema version {found}, not yet {known}: open it for writing once (`adit build`)")]
    Older {
        /// The database.
        path: PathBuf,
        /// Its schema version.
        found: i64,
        /// The version wanted.
        known: i64,
    },
    /// A table of somebody's own has the name of one that a migration, or keeping worlds, makes.
    #[error("{path} has a table `{table}` of its own, and one of that name is to be made: rename it")]
    Taken {
        /// The database.
        path: PathBuf,
        /// The table.
        table: String,
    },
    /// Another program held the database for longer than we waited.
    #[error("{0} is locked by another program")]
    Locked(PathBuf),
    /// The file, its folder or this way of opening does not allow writing.
    #[error("{0} cannot be written: the file, its folder or this connection is read-only")]
    ReadOnly(PathBuf),
    /// A journal that cannot be made beside the database.
    #[error(
        "{0} cannot be used: no file can be made beside it, since its folder is read-only or the disk is full"
    )]
    NoFileBeside(PathBuf),
    /// The disk is full.
    #[error("the disk is full while writing {0}")]
    Full(PathBuf),
    /// The disk does not do what it is told.
    #[error("the disk failed while reading or writing {0}")]
    Disk(PathBuf),
    /// The operating system would not open the file.
    #[error("{0} cannot be opened")]
    CannotOpen(PathBuf),
    /// SQLite below 3.51.3 may corrupt a database that two connections write in WAL mode.
    #[error("SQLite {0} is too old to write safely: 3.51.3 or newer is needed")]
    OldSqlite(String),
    /// No such table or view in the database.
    #[error("there is no table `{0}`")]
    UnknownTable(String),
    /// The table has no such column.
    #[error("table `{table}` has no column `{column}`; it has {columns}")]
    UnknownColumn {
        /// The table.
        table: String,
        /// The column asked for.
        column: String,
        /// The columns that there are.
        columns: String,
    },
    /// A value that is no text of UTF-8.
    #[error("column {column} of `{table}` cannot be read in row {row}: {reason}")]
    Unreadable {
        /// The table.
        table: String,
        /// The column.
        column: String,
        /// The row in the order of the key, from 1.
        row: usize,
        /// What the decoder says.
        reason: String,
    },
    /// The table has no such row.
    #[error("table `{table}` has no row `{key}`")]
    UnknownKey {
        /// The table.
        table: String,
        /// The key asked for.
        key: String,
    },
    /// The key fits several rows.
    #[error("`{key}` fits several rows of `{table}`: give the whole key ({columns}), joined by `/`")]
    AmbiguousKey {
        /// The table.
        table: String,
        /// The key asked for.
        key: String,
        /// The columns of the whole key.
        columns: String,
    },
    /// The table is written by builds, not by hand.
    #[error("`{0}` is derived and would be overwritten by the next build: edit what it comes from")]
    NotEditable(String),
    /// A constraint of the schema refuses the value.
    #[error("{what}: {reason}")]
    Refused {
        /// Table and column, or table.
        what: String,
        /// The constraint, as a sentence.
        reason: String,
    },
    /// Not a number; SQL would silently store NULL.
    #[error("column {column} of `{table}` got a NaN")]
    NotANumber {
        /// The table.
        table: &'static str,
        /// The column's name.
        column: &'static str,
    },
    /// An undo whose row has changed since.
    #[error("edit {id} cannot be taken back: {reason}")]
    Conflict {
        /// The entry of `history`.
        id: i64,
        /// Why not.
        reason: String,
    },
    /// A query of the user that is empty, several statements, or no reading one.
    #[error("{0}")]
    Query(String),
    /// A query of the user that took too long.
    #[error("the query was stopped after {0:?}")]
    Deadline(std::time::Duration),
    /// A site in PostgreSQL.
    #[error(transparent)]
    Postgres(#[from] crate::failure::Failure),
    /// Whatever else SQLite says.
    #[error("{0}")]
    Sql(#[from] sqlx::Error),
    /// The file system, while preparing the work.
    #[error("{path}: {source}")]
    Io {
        /// What was read or written.
        path: PathBuf,
        /// The cause.
        source: std::io::Error,
    },
}

/// The result of the store's work.
pub type Result<T> = std::result::Result<T, Error>;

/// SQLite's primary result code, see <https://www.sqlite.org/rescode.html>.
pub(crate) fn code(error: &sqlx::Error) -> Option<i32> {
    let extended: i32 = error.as_database_error()?.code()?.parse().ok()?;
    Some(extended & 0xff)
}

const BUSY: i32 = 5;
const TABLE_LOCKED: i32 = 6;
const READ_ONLY: i32 = 8;
pub(crate) const NO_MEMORY: i32 = 7;
pub(crate) const INTERRUPTED: i32 = 9;
const DISK: i32 = 10;
const CORRUPT: i32 = 11;
const FULL: i32 = 13;
const CANNOT_OPEN: i32 = 14;
const CONSTRAINT: i32 = 19;
const NOT_A_DATABASE: i32 = 26;

impl Error {
    /// The same failure, naming the database.
    pub(crate) fn at(self, path: &Path) -> Self {
        let Self::Sql(error) = self else { return self };
        let of_file = code(&error).and_then(|code| Self::of_code(code, path));
        of_file.unwrap_or(Self::Sql(error))
    }

    /// What a primary result code of SQLite says of the file, if it speaks of that.
    pub(crate) fn of_code(code: i32, path: &Path) -> Option<Self> {
        let path = path.to_owned();
        Some(match code {
            BUSY | TABLE_LOCKED => Self::Locked(path),
            READ_ONLY => Self::ReadOnly(path),
            CANNOT_OPEN => Self::NoFileBeside(path),
            DISK => Self::Disk(path),
            CORRUPT | NOT_A_DATABASE => Self::NotADatabase(path),
            FULL => Self::Full(path),
            _ => return None,
        })
    }

    /// Whether another program holds the database.
    pub fn is_busy(&self) -> bool {
        matches!(self, Self::Locked(_))
    }

    /// The same failure, as a refusal of `what` where a constraint refused it.
    pub(crate) fn refusing(self, what: impl Into<String>) -> Self {
        let Self::Sql(error) = self else { return self };
        if code(&error) != Some(CONSTRAINT) {
            return Self::Sql(error);
        }
        let message = error.as_database_error().map_or("", |e| e.message());
        let reason = message.strip_prefix("CHECK constraint failed: ").unwrap_or(message).to_owned();
        Self::Refused { what: what.into(), reason }
    }
}
