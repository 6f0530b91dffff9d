//! One transaction, and the blocking form of what the tables' modules do.

use sqlx::SqliteConnection;

use crate::connection::Connection;
use crate::error::Result;

/// A transaction of a [`Store`](crate::Store). Each table's module adds the functions that read and write it. After a
/// failed write let the error end the transaction, so that no half of it is kept.
///
/// It is no transaction of sqlx's, which counts those that are open: SQLite ends one by itself where the disk is full or
/// fails, and whoever counts takes that for open ever after.
pub struct Tx<'s> {
    connection: &'s mut Connection,
    is_committed: bool,
}

impl<'s> Tx<'s> {
    pub(crate) fn begin(connection: &'s mut Connection, begin: &'static str) -> Result<Self> {
        connection.execute(begin)?;
        Ok(Self { connection, is_committed: false })
    }

    pub(crate) fn run<T>(&mut self, work: impl AsyncFnOnce(&mut SqliteConnection) -> Result<T>) -> Result<T> {
        self.connection.run(work)
    }

    pub(crate) fn execute(&mut self, sql: &'static str) -> Result<()> {
        self.connection.execute(sql)
    }

    pub(crate) fn commit(mut self) -> Result<()> {
        self.connection.execute("COMMIT")?;
        self.is_committed = true;
        Ok(())
    }
}

impl Drop for Tx<'_> {
    /// What was not committed is taken back, after a panic too. It fails only where SQLite has ended the transaction already.
    fn drop(&mut self) {
        if !self.is_committed {
            self.connection.execute("ROLLBACK").ok();
        }
    }
}
