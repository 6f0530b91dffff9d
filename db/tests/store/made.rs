//! Databases as tests begin with them. `tests/tests/store_on_postgres.rs` has another file in the place of this one.

use adit_db::Store;
use tempfile::TempDir;

pub type Folder = TempDir;

/// An empty database of a site.
pub fn site() -> (Folder, Store) {
    let folder = tempfile::tempdir().unwrap();
    let store = Store::create(folder.path().join("site.db")).unwrap();
    (folder, store)
}

/// An empty database that keeps worlds.
pub fn worlds() -> (Folder, Store) {
    let folder = tempfile::tempdir().unwrap();
    let store = Store::open_for_worlds(folder.path().join("cell.db")).unwrap();
    (folder, store)
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
