//! How the service is started.

use std::net::SocketAddr;
use std::path::PathBuf;
use std::time::Duration;

use crate::error::Result;
use crate::knowledge::KnowledgeBase;

#[derive(Clone, Debug)]
pub struct Settings {
    pub folder: PathBuf,
    pub database: Option<PathBuf>,
    pub rules: Option<PathBuf>,
    pub listen: SocketAddr,
    /// Names besides those of this machine under which browsers may call the service.
    pub hosts: Vec<String>,
    pub sql_deadline: Duration,
    pub sql_rows: usize,
    /// Time that an answer may take.
    pub patience: Duration,
    /// Requests that are worked on at once.
    pub requests: usize,
    /// Streams of events that are open at once.
    pub subscribers: usize,
    /// Hears what whoever runs the service should know.
    pub log: fn(&str),
}

impl Settings {
    /// The site, opened as its files now are.
    pub fn open(&self) -> Result<KnowledgeBase> {
        let site = KnowledgeBase::open(&self.folder)?;
        site.needs_folder()?;
        Ok(site.with_database(self.database.as_deref()).with_rules(self.rules.as_deref()))
    }
}
