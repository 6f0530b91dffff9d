//! Tables that a build takes from their files again, as an edit of somebody's.

use adit_db::history::Author;

use crate::error::{Code, Error, Result};
use crate::words::suggest::did_you_mean;

/// Tables that a build takes from their files again.
#[derive(Clone, Debug)]
pub(crate) struct Reseed {
    /// Whose edit that is.
    pub author: Author,
    /// Which; all where none is named.
    pub tables: Vec<String>,
}

impl Reseed {
    pub fn takes(&self, table: &str) -> bool {
        self.tables.is_empty() || self.tables.iter().any(|name| name.eq_ignore_ascii_case(table))
    }

    /// Refuses a table that no file fills.
    pub fn check(&self, filled: &[&str]) -> Result<()> {
        let unknown =
            self.tables.iter().find(|name| !filled.iter().any(|known| known.eq_ignore_ascii_case(name)));
        let Some(unknown) = unknown else { return Ok(()) };
        let help = did_you_mean(unknown, filled.iter().copied());
        let help = help.unwrap_or_else(|| format!("files fill {}", filled.join(", ")));
        let message = format!("no file of the site fills a table `{unknown}`");
        Err(Error::said(Code::EditUnknownTable, message, Some(help)))
    }
}
