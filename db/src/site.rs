//! The site's own values: name, mode, generation, fingerprints of inputs. The table `site`.

use sqlx::SqliteConnection;

use crate::error::Result;
use crate::transaction::Tx;

/// The value of `key`.
pub async fn value(connection: &mut SqliteConnection, key: &str) -> Result<Option<String>> {
    let query = sqlx::query_scalar("SELECT value FROM site WHERE key = ?").bind(key);
    Ok(query.fetch_optional(connection).await?)
}

/// All values whose key begins with `prefix`, by key.
pub async fn values(connection: &mut SqliteConnection, prefix: &str) -> Result<Vec<(String, String)>> {
    let query =
        sqlx::query_as("SELECT key, value FROM site WHERE substr(key, 1, length(?1)) = ?1 ORDER BY key");
    Ok(query.bind(prefix).fetch_all(connection).await?)
}

/// Sets `key`, or takes it away.
pub async fn set(connection: &mut SqliteConnection, key: &str, value: Option<&str>) -> Result<()> {
    match value {
        Some(value) => sqlx::query("INSERT OR REPLACE INTO site VALUES (?, ?)").bind(key).bind(value),
        None => sqlx::query("DELETE FROM site WHERE key = ?").bind(key),
    }
    .execute(connection)
    .await?;
    Ok(())
}

impl Tx<'_> {
    /// The site's value of `key`.
    pub fn site_value(&mut self, key: &str) -> Result<Option<String>> {
        self.run(async |connection| value(connection, key).await)
    }

    /// All the site's values whose key begins with `prefix`, by key.
    pub fn site_values(&mut self, prefix: &str) -> Result<Vec<(String, String)>> {
        self.run(async |connection| values(connection, prefix).await)
    }

    /// Sets the site's value of `key`, or takes it away.
    pub fn set_site_value(&mut self, key: &str, to: Option<&str>) -> Result<()> {
        self.run(async |connection| set(connection, key, to).await)
    }
}
