//! Copies of the whole database.

use std::path::{Path, PathBuf};

use sqlx::SqliteConnection;

use crate::cell::Cell;
use crate::error::{Error, Result};

/// Writes a compact copy of the database to `to`, which must not exist. Works while others use the database.
pub async fn copy(connection: &mut SqliteConnection, to: &Path) -> Result<()> {
    if to.exists() {
        return Err(Error::Exists(to.to_owned()));
    }
    let name = to.to_str().ok_or_else(|| Error::CannotOpen(to.to_owned()))?;
    crate::dynamic::execute(connection, "VACUUM INTO ?".to_owned(), &[Cell::from(name)]).await?;
    Ok(())
}

/// `site.db.bak-v1`, or `site.db.bak-v1-2` where that is taken.
pub(crate) fn before_migration(path: &Path, version: i64) -> PathBuf {
    let named = |suffix: &str| {
        let mut name = path.as_os_str().to_owned();
        name.push(format!(".bak-v{version}{suffix}"));
        PathBuf::from(name)
    };
    let mut backup = named("");
    let mut copies = 1;
    while backup.exists() {
        copies += 1;
        backup = named(&format!("-{copies}"));
    }
    backup
}
