//! What a service has to itself while it is at work: a folder, or a database.

use std::fs::{self, File, TryLockError};
use std::path::Path;

use crate::error::{Code, Error, Result};

/// Has a folder to oneself, until what is given back goes: two services would write each other's files.
pub fn folder(folder: &Path) -> Result<File> {
    fs::create_dir_all(folder).map_err(|error| Error::io("make", folder, &error))?;
    hold(&folder.join(".adit-lock"), || {
        let message = format!("another service has its files in {}", folder.display());
        Error::said(Code::PostgresFiles, message, Some("name a folder of its own".to_owned()))
    })
}

/// Has a database to oneself among services, until what is given back goes. Commands and other programs may use it meanwhile.
pub fn database(database: &Path) -> Result<File> {
    let name = database.file_name().unwrap_or_default().to_string_lossy();
    hold(&database.with_file_name(format!(".{name}-served")), || {
        let message = format!("another service serves {} already", database.display());
        let help = "let robots and people ask that one; for several services on one site, see PostgreSQL in the manual";
        Error::said(Code::DatabaseServed, message, Some(help.to_owned()))
    })
}

/// Locks a file, which need not be there and stays behind: whoever took it away could let two in.
fn hold(path: &Path, held: impl FnOnce() -> Error) -> Result<File> {
    let file = File::create(path).map_err(|error| Error::io("write", path, &error))?;
    match file.try_lock() {
        Ok(()) => Ok(file),
        Err(TryLockError::WouldBlock) => Err(held()),
        Err(TryLockError::Error(error)) => Err(Error::io("lock", path, &error)),
    }
}
