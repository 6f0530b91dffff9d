//! One transaction, and the blocking form of what the tables' modules do.

use std::path::Path;

use sqlx::{Sqlite, SqliteConnection, Transaction};
use tokio::runtime::Runtime;

use crate::error::{Error, Result};

/// A transaction of a [`Store`](crate::Store). Each table's module adds the functions that read and write it. After a
/// failed write let the error end the transaction, so that no half of it is kept.
pub struct Tx<'s> {
    runtime: &'s Runtime,
    transaction: Transaction<'s, Sqlite>,
    path: &'s Path,
}

impl<'s> Tx<'s> {
    pub(crate) fn new(runtime: &'s Runtime, transaction: Transaction<'s, Sqlite>, path: &'s Path) -> Self {
        Self { runtime, transaction, path }
    }

    pub(crate) fn run<T>(&mut self, work: impl AsyncFnOnce(&mut SqliteConnection) -> Result<T>) -> Result<T> {
        self.runtime.block_on(work(&mut self.transaction)).map_err(|e| e.at(self.path))
    }

    pub(crate) fn commit(self) -> Result<()> {
        self.runtime.block_on(self.transaction.commit()).map_err(|e| Error::from(e).at(self.path))
    }

    pub(crate) fn roll_back(self) -> Result<()> {
        self.runtime.block_on(self.transaction.rollback()).map_err(|e| Error::from(e).at(self.path))
    }
}
