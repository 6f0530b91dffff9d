//! Databases as tests of the store begin with them: copies of new sites in PostgreSQL.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::atomic::{AtomicUsize, Ordering};

use adit_db::postgres::{self, Place, Replica};
use adit_db::{Error, Store};
use adit_tests::database::cluster;
use tempfile::TempDir;

/// An empty database of a site.
pub fn site() -> (Folder, Store) {
    Folder::holding(|file| Store::create(file))
}

/// An empty database that keeps worlds.
pub fn worlds() -> (Folder, Store) {
    Folder::holding(|file| Store::open_for_worlds(file))
}

/// A store that has the right to write.
pub trait Led {
    fn led(&mut self) -> &mut Self;
}

impl Led for Store {
    fn led(&mut self) -> &mut Self {
        assert!(self.lead().unwrap());
        self
    }
}

/// The folder of a copy. When it goes, the site in PostgreSQL and a follower's copy are to have the rows that the copy has.
pub struct Folder {
    at: TempDir,
    site: String,
    follower: Store,
}

impl Folder {
    fn holding(make: impl FnOnce(&Path) -> Result<Store, Error>) -> (Self, Store) {
        static NUMBER: AtomicUsize = AtomicUsize::new(0);
        let site = format!("site {}", NUMBER.fetch_add(1, Ordering::Relaxed));
        let folder = tempfile::tempdir().unwrap();
        let file = |name: &str| folder.path().join(name);
        make(&file("new.db")).unwrap().copy_in(&[], (&place(), &site), false).unwrap();
        let copy = |name: &str| {
            let replica = Replica::make(&place(), &site, name, &file(name)).unwrap();
            Store::open_copy(file(name), replica).unwrap()
        };
        let (store, follower) = (copy("site.db"), copy("follower.db"));
        (Self { at: folder, site, follower }, store)
    }

    fn file(&self, name: &str) -> PathBuf {
        self.at.path().join(name)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        if std::thread::panicking() {
            return;
        }
        loop {
            let entries = self.follower.waiting(true).unwrap();
            for entry in &entries {
                self.follower.take::<(), Error>(entry, |_| Ok(None)).unwrap();
            }
            if entries.is_empty() {
                break;
            }
        }
        postgres::copy_out(&place(), &self.site, &self.file("there.db")).unwrap();
        let written = rows(&self.file("site.db"));
        assert!(!written.is_empty());
        for copy in ["there.db", "follower.db"] {
            let kept = rows(&self.file(copy));
            let differs = written.iter().zip(&kept).find(|(one, other)| one != other);
            assert!(written == kept, "{copy} is not what was written: {differs:?}");
        }
    }
}

fn place() -> Place {
    Place::parse(&cluster().url("any")).unwrap()
}

/// All rows of a database, but for what is the same rows once more.
fn rows(database: &Path) -> Vec<String> {
    let dump = Command::new("sqlite3").arg(database).arg(".dump").output().unwrap();
    let text = String::from_utf8(dump.stdout).unwrap();
    let mut lines: Vec<String> =
        text.lines().filter(|line| !line.starts_with("INSERT INTO blocks")).map(str::to_owned).collect();
    lines.sort();
    lines
}
