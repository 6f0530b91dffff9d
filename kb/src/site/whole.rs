//! What is written whole or not at all: files and folders that are made together, and a file that takes another's place.

use std::fs::{self, OpenOptions};
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

use crate::error::{Code, Error, Result};

/// What was made so far. Unless it is kept it is taken away again when this goes; what was there before stays.
#[derive(Debug, Default)]
pub struct Whole {
    made: Vec<PathBuf>,
}

impl Whole {
    /// Makes a folder, and those that it lies in; one that is there is taken as it is.
    pub fn folder(&mut self, path: &Path) -> Result<()> {
        let missing =
            path.ancestors().take_while(|folder| !folder.as_os_str().is_empty() && !folder.exists());
        let missing: Vec<PathBuf> = missing.map(Path::to_owned).collect();
        for folder in missing.into_iter().rev() {
            fs::create_dir(&folder).map_err(|error| Error::io("make", &folder, &error))?;
            self.made.push(folder);
        }
        if path.is_dir() {
            return Ok(());
        }
        let message = format!("cannot make {}: a file of this name is there", path.display());
        Err(Error::said(Code::SiteExists, message, None))
    }

    /// Makes a file. One that is there is an error.
    pub fn file(&mut self, path: &Path, content: impl AsRef<[u8]>) -> Result<()> {
        let made = OpenOptions::new().write(true).create_new(true).open(path);
        let mut file = made.map_err(|error| match error.kind() {
            ErrorKind::AlreadyExists => {
                Error::said(Code::SiteExists, format!("{} is there already", path.display()), None)
            }
            _ => Error::io("make", path, &error),
        })?;
        self.made.push(path.to_owned());
        file.write_all(content.as_ref()).map_err(|error| Error::io("write", path, &error))
    }

    /// A database that is about to be made, with what SQLite has beside it; one that is there stays.
    pub fn database(&mut self, path: &Path) {
        if path.exists() {
            return;
        }
        let beside = |end: &str| {
            let mut name = path.as_os_str().to_owned();
            name.push(end);
            PathBuf::from(name)
        };
        self.made.extend(["", "-journal", "-wal", "-shm"].map(beside));
    }

    /// All of it stays.
    pub fn keep(mut self) {
        self.made.clear();
    }
}

impl Drop for Whole {
    fn drop(&mut self) {
        for path in self.made.iter().rev() {
            // a folder in which somebody else put something stays with it
            let is_folder = fs::symlink_metadata(path).is_ok_and(|found| found.is_dir());
            if is_folder { fs::remove_dir(path) } else { fs::remove_file(path) }.ok();
        }
    }
}

/// That there is the folder for a file.
fn has_folder(path: &Path) -> Result<()> {
    let folder = folder(path);
    if folder.is_dir() {
        return Ok(());
    }
    let message = format!("cannot write {}: there is no folder {}", path.display(), folder.display());
    Err(Error::said(Code::FileUnreadable, message, None))
}

/// Writes a file. If that fails there is none, or the one that was there before.
pub fn write(path: &Path, content: &[u8]) -> Result<()> {
    has_folder(path)?;
    written(path, content).map_err(|error| Error::io("write", path, &error))
}

/// Whether a file can be written: found before long work, not after it.
pub fn is_writable(path: &Path) -> Result<()> {
    has_folder(path)?;
    let opened = if path.exists() {
        OpenOptions::new().write(true).open(path).map(drop)
    } else {
        tempfile::tempfile_in(folder(path)).map(drop)
    };
    opened.map_err(|error| Error::io("write", path, &error))
}

fn folder(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

fn written(path: &Path, content: &[u8]) -> std::io::Result<()> {
    let before = fs::symlink_metadata(path).ok();
    if before.as_ref().is_some_and(|found| !found.is_file()) {
        // a link or a device is written to, and not replaced
        return fs::write(path, content);
    }
    if before.is_some() {
        // what may not be written is not replaced either
        OpenOptions::new().write(true).open(path)?;
    }
    let mut next = tempfile::Builder::new();
    #[cfg(unix)]
    next.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut next = match next.prefix(".adit-").tempfile_in(folder(path)) {
        // a file may be open to us in a folder that is not
        Err(_) if before.is_some() => return fs::write(path, content),
        made => made?,
    };
    next.write_all(content)?;
    // or a power cut may leave the name with nothing in it
    next.as_file().sync_all()?;
    if let Some(before) = before {
        fs::set_permissions(next.path(), before.permissions())?;
    }
    next.persist(path)?;
    Ok(())
}

/// Writes a file beside another, whose place it is to take.
pub fn write_beside(next: &Path, content: &[u8]) -> std::io::Result<()> {
    let mut file = fs::File::create(next)?;
    file.write_all(content)?;
    file.sync_all()
}

/// Puts a file that was [written beside](write_beside) it in a file's place: a power cut leaves the one or the other, and the
/// new one once this has returned.
pub fn replace(path: &Path, next: &Path) -> std::io::Result<()> {
    fs::rename(next, path)?;
    sync_names(folder(path))
}

/// Has the name of a file on the disk, or that it is gone.
pub fn sync_name(path: &Path) -> std::io::Result<()> {
    sync_names(folder(path))
}

/// Takes a file away; no power cut brings it back.
pub fn remove(path: &Path) -> std::io::Result<()> {
    fs::remove_file(path)?;
    sync_names(folder(path))
}

/// Makes a folder, and those that it lies in, which no power cut takes away. One that is there is taken as it is.
pub fn lasting_folder(path: &Path) -> std::io::Result<()> {
    if path.is_dir() {
        return Ok(());
    }
    lasting_folder(folder(path))?;
    fs::create_dir(path)?;
    sync_names(folder(path))
}

/// Has the names in a folder on the disk.
#[cfg(unix)]
fn sync_names(folder: &Path) -> std::io::Result<()> {
    fs::File::open(folder)?.sync_all()
}

/// Elsewhere folders cannot be synced.
#[cfg(not(unix))]
fn sync_names(_folder: &Path) -> std::io::Result<()> {
    Ok(())
}
