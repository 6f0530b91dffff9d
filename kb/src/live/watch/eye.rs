//! An eye on the files of a site, which reads only those whose time or size changed.

use std::collections::BTreeMap;
use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use crate::error::Result;
use crate::knowledge::KnowledgeBase;

/// What files hold, as a number; `None`: it cannot be read.
pub type Files = BTreeMap<PathBuf, Option<u64>>;

/// When a file was written, and how long it is.
pub type Stamp = (SystemTime, u64);

/// An eye on the files of a site.
#[derive(Default)]
pub struct Eye {
    files: Vec<PathBuf>,
    database: PathBuf,
    read: BTreeMap<PathBuf, (Stamp, Option<u64>)>,
}

impl Eye {
    /// What the files hold now.
    pub fn look(&mut self, open: &dyn Fn() -> Result<KnowledgeBase>) -> Files {
        // a broken site.toml leaves the files to be watched that it named before
        if let Ok(knowledge) = open() {
            self.files = knowledge.files();
            knowledge.database().clone_into(&mut self.database);
        } else if let Some(file) = self.files.first() {
            self.read.remove(file);
        }
        let files = self.files.clone();
        let content = |file: PathBuf| {
            let content = self.content(&file);
            (file, content)
        };
        files.into_iter().map(content).collect()
    }

    /// The site's database.
    pub fn database(&self) -> &Path {
        &self.database
    }

    fn content(&mut self, file: &Path) -> Option<u64> {
        let stamp = stamp(file)?;
        if let Some((_, content)) = self.read.get(file).filter(|(known, _)| *known == stamp) {
            return *content;
        }
        let content = fs::read(file).ok().map(|bytes| {
            let mut hasher = DefaultHasher::new();
            bytes.hash(&mut hasher);
            hasher.finish()
        });
        self.read.insert(file.to_owned(), (stamp, content));
        content
    }
}

/// The stamp of a file; `None` where there is none.
pub fn stamp(file: &Path) -> Option<Stamp> {
    let about = fs::metadata(file).ok().filter(fs::Metadata::is_file)?;
    Some((about.modified().ok()?, about.len()))
}
