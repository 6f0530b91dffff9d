//! Connections that read, kept open between requests.

use std::path::{Path, PathBuf};
use std::sync::Mutex;

use adit_db::Store;

use crate::error::Result;
use crate::site::calm::apart;

/// Connections that nobody reads by at the moment.
pub struct Readers {
    database: PathBuf,
    free: Mutex<Vec<Store>>,
}

/// So many are kept open.
const KEPT: usize = 8;

impl Readers {
    pub fn new(database: &Path) -> Self {
        Self { database: database.to_owned(), free: Mutex::default() }
    }

    /// Does something with a connection; after a failure it is closed.
    pub fn with<T>(&self, work: impl FnOnce(&mut Store) -> Result<T>) -> Result<T> {
        let free = self.free().pop();
        let mut store = match free {
            Some(store) => store,
            // a connection has a thread of its own, which is begun with it
            None => apart(|| Store::open_read_only(&self.database))?,
        };
        let done = work(&mut store)?;
        let mut free = self.free();
        if free.len() < KEPT {
            free.push(store);
        }
        Ok(done)
    }

    /// Closes them: whoever writes can leave the database as one file only when nobody else has it open.
    pub fn close(&self) {
        self.free().clear();
    }

    fn free(&self) -> std::sync::MutexGuard<'_, Vec<Store>> {
        // whoever panicked held no connection: it was taken out before
        self.free.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
    }
}
