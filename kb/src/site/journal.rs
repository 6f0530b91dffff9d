//! Rule files that change with rows of the database: whole or not at all, whatever fails and whenever the power goes.
//!
//! What takes a file's place is written beside it, and a journal beside the database names the entries of the history that say
//! so, before these are committed; the commit decides. Then each takes its place, and the journal goes. Whoever finds one that
//! was left goes on from there.

use std::fs;
use std::path::{Path, PathBuf};

use adit_db::{Cell, Store, Tx};
use serde::{Deserialize, Serialize};

use crate::error::{Code, Error, Result};
use crate::site::rules::{text, version};
use crate::site::whole;

/// What the history calls rule files and their tests, in place of a table.
pub const FILES: &str = "rule files";

/// A file of the user's own rules, as the history says that it is from now on.
#[derive(Debug, Serialize, Deserialize)]
struct Written {
    /// The entry of the history.
    entry: i64,
    /// Relative to the folder of the database, where it lies below that.
    path: PathBuf,
    /// Names the text of before, and that of now; none where there is no file.
    old: Option<String>,
    new: Option<String>,
}

/// Files that wait for a commit. What was written is taken away again unless it [takes its place](Journal::finish).
#[derive(Debug)]
pub struct Journal {
    path: PathBuf,
    written: Vec<Written>,
    /// Folders that were made for them, the outermost first.
    made: Vec<PathBuf>,
    is_committed: bool,
}

fn beside(database: &Path) -> PathBuf {
    let mut name = database.as_os_str().to_owned();
    name.push("-files");
    name.into()
}

impl Journal {
    /// Prepares what these entries of the history say of files in a folder of rules: the last thing in their transaction. `None`
    /// where they are about no file.
    pub fn begin(tx: &mut Tx<'_>, database: &Path, folder: &Path, since: i64) -> Result<Option<Self>> {
        let entries: Vec<_> =
            tx.history_of(FILES, None)?.into_iter().take_while(|entry| entry.id > since).collect();
        if entries.is_empty() {
            return Ok(None);
        }
        let mut journal =
            Self { path: beside(database), written: Vec::new(), made: Vec::new(), is_committed: false };
        for entry in entries.into_iter().rev() {
            let path = folder.join(&entry.key);
            let failed = |error: std::io::Error| Error::io("write", &path, &error);
            let [old, new] = [&entry.old, &entry.new].map(|text| match text {
                Cell::Text(text) => Some(text.as_str()),
                _ => None,
            });
            if let (Some(text), Some(folder)) = (new, path.parent()) {
                let missing = folder.ancestors().take_while(|folder| !folder.exists());
                let missing: Vec<PathBuf> = missing.map(Path::to_owned).collect();
                journal.made.extend(missing.into_iter().rev());
                whole::lasting_folder(folder).map_err(failed)?;
                // named first, so that half of it is taken away, too
                journal.note(database, entry.id, &path, [old, new]);
                whole::write_beside(&path.with_extension("new"), text.as_bytes()).map_err(failed)?;
            } else {
                journal.note(database, entry.id, &path, [old, new]);
            }
        }
        let failed = |error: std::io::Error| Error::io("write", &journal.path, &error);
        let text = serde_json::to_string(&journal.written).map_err(|error| failed(error.into()))?;
        whole::write_beside(&journal.path, text.as_bytes())
            .and_then(|()| whole::sync_name(&journal.path))
            .map_err(failed)?;
        for written in &journal.written {
            let path = journal.at(written);
            if path.parent().is_some_and(Path::exists) {
                whole::sync_name(&path).map_err(failed)?;
            }
        }
        Ok(Some(journal))
    }

    fn note(&mut self, database: &Path, entry: i64, path: &Path, [old, new]: [Option<&str>; 2]) {
        let home = database.parent().unwrap_or(Path::new(""));
        let path = path.strip_prefix(home).unwrap_or(path).to_owned();
        let [old, new] = [old, new].map(|text| text.map(version));
        self.written.push(Written { entry, path, old, new });
    }

    fn at(&self, written: &Written) -> PathBuf {
        self.path.parent().unwrap_or(Path::new("")).join(&written.path)
    }

    /// Has the files take their places, once the entries are committed. What the disk does not take now it takes when somebody
    /// [recovers](recover) next: it is edited by then.
    pub fn finish(journal: Option<Self>) {
        journal.map(Self::put_all).transpose().ok();
    }

    fn put_all(mut self) -> Result<()> {
        self.is_committed = true;
        for written in &self.written {
            let path = self.at(written);
            Self::put(written, &path).map_err(|error| Error::io("write", &path, &error))?;
        }
        // one that stays is found to be done
        whole::remove(&self.path).ok();
        Ok(())
    }

    fn put(written: &Written, path: &Path) -> std::io::Result<()> {
        let next = path.with_extension("new");
        if written.new.is_some() {
            // what another program has put there by now stays there
            return if next.exists() { whole::replace(path, &next) } else { Ok(()) };
        }
        let is_old = text(path).ok().flatten().as_deref().map(version) == written.old;
        if is_old && path.exists() { whole::remove(path) } else { Ok(()) }
    }

    /// Whether the database has the entries.
    fn is_kept(&self, tx: &mut Tx<'_>) -> Result<bool> {
        for written in &self.written {
            let is_it = tx.entry(written.entry)?.is_some_and(|entry| {
                let now = match &entry.new {
                    Cell::Text(text) => Some(version(text)),
                    _ => None,
                };
                entry.table == FILES && written.path.ends_with(&entry.key) && now == written.new
            });
            if !is_it {
                return Ok(false);
            }
        }
        Ok(true)
    }
}

impl Drop for Journal {
    fn drop(&mut self) {
        if self.is_committed {
            return;
        }
        for written in self.written.iter().filter(|written| written.new.is_some()) {
            fs::remove_file(self.at(written).with_extension("new")).ok();
        }
        fs::remove_file(&self.path).ok();
        for folder in self.made.iter().rev() {
            // one in which somebody else put something stays
            fs::remove_dir(folder).ok();
        }
    }
}

/// Goes on where files and rows were left by half: as the database says.
pub fn recover(database: &Path) -> Result<()> {
    let path = beside(database);
    if !path.exists() || !database.exists() {
        return Ok(());
    }
    let kept = Store::open(database)?.transaction(|tx| -> Result<Option<Journal>> {
        // whoever writes files holds the database until they are decided: what is there now is nobody's
        let Ok(text) = fs::read_to_string(&path) else { return Ok(None) };
        // one that is not whole was never decided
        let written = serde_json::from_str(&text).unwrap_or_default();
        let journal = Journal { path: path.clone(), written, made: Vec::new(), is_committed: false };
        let is_kept = !journal.written.is_empty() && journal.is_kept(tx)?;
        Ok(is_kept.then_some(journal))
    })?;
    kept.map_or(Ok(()), |journal| {
        let failed = |error: Error| {
            let message = format!("rule files that were saved are not in their places: {error}");
            Error::said(
                Code::FileUnreadable,
                message,
                Some("make room on the disk, then try again".to_owned()),
            )
        };
        journal.put_all().map_err(failed)
    })
}
