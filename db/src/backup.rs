//! Copies of the whole database.

use std::path::{Path, PathBuf};

use sqlx::SqliteConnection;

use crate::cell::Cell;
use crate::error::{Error, Result};

/// Writes a compact copy of the database to `to`, which must not exist. Works while others use the database.
pub async fn copy(connection: &mut SqliteConnection, to: &Path) -> Result<()> {
    // an empty file may be written to, and says at once where none can be made
    std::fs::File::create_new(to).map_err(|source| match source.kind() {
        std::io::ErrorKind::AlreadyExists => Error::Exists(to.to_owned()),
        _ => Error::Io { path: to.to_owned(), source },
    })?;
    let name = to.to_str().ok_or_else(|| Error::CannotOpen(to.to_owned()))?;
    let copied = crate::dynamic::execute(connection, "VACUUM INTO ?".to_owned(), &[Cell::from(name)]).await;
    if copied.is_err() {
        // half a copy is none, and stands in the way of a whole one
        std::fs::remove_file(to).ok();
    }
    copied.map(drop)
}

/// Copies the database beside itself before it is migrated. Under the copy's name there is a whole one, whenever the power goes.
pub(crate) async fn before_migration(
    connection: &mut SqliteConnection,
    path: &Path,
    version: i64,
) -> Result<()> {
    let backup = free_name(path, version);
    let half = beside(path, ".bak-half");
    // of a copy that was broken off
    std::fs::remove_file(&half).ok();
    copy(connection, &half).await?;
    std::fs::rename(&half, &backup).map_err(|source| Error::Io { path: backup, source })
}

fn beside(path: &Path, suffix: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(suffix);
    PathBuf::from(name)
}

/// `site.db.bak-v1`, or `site.db.bak-v1-2` where that is taken.
fn free_name(path: &Path, version: i64) -> PathBuf {
    let mut backup = beside(path, &format!(".bak-v{version}"));
    let mut copies = 1;
    while backup.exists() {
        copies += 1;
        backup = beside(path, &format!(".bak-v{version}-{copies}"));
    }
    backup
}
