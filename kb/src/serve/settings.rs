//! How the service is started.

use std::net::SocketAddr;
use std::path::PathBuf;
use std::time::Duration;

use adit_db::postgres::Place;
use serde::Serialize;
use utoipa::ToSchema;

use crate::error::Result;
use crate::knowledge::KnowledgeBase;
use crate::site::rules::Drafts;

/// What may stand where somebody types a rule.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, ToSchema)]
pub struct Proposal {
    /// What would be written.
    pub text: String,
    /// What it is: a class, a property, a variable, a word or a function.
    pub kind: &'static str,
    /// Its type, or its class.
    pub detail: Option<String>,
    /// What the manual says of it, as Markdown.
    pub what: Option<String>,
}

/// A class that rules may speak of.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, ToSchema)]
pub struct Known {
    pub class: Proposal,
    /// What its objects have.
    pub properties: Vec<Proposal>,
}

/// A rule file as it is written: the site, files with their texts in place of what is saved, its name, and a byte of its text.
pub type Complete = fn(&KnowledgeBase, &Drafts, &str, usize) -> Result<Vec<Proposal>>;

#[derive(Clone, Debug)]
pub struct Settings {
    pub folder: PathBuf,
    pub database: Option<PathBuf>,
    /// Where the site is in PostgreSQL, which other services may be on as well.
    pub shared: Option<Place>,
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
    /// Knows what may stand where somebody types.
    pub complete: Complete,
    /// Knows what rules may speak of.
    pub classes: fn(&KnowledgeBase) -> Result<Vec<Known>>,
}

impl Settings {
    /// The name of the site in PostgreSQL: that of the folder where the URL names none.
    pub fn shared_name(&self, place: &Place) -> String {
        let folder = std::path::absolute(&self.folder).unwrap_or_default();
        let name = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
        place.site_or(&name)
    }

    /// The site, opened as its files now are.
    pub fn open(&self) -> Result<KnowledgeBase> {
        let site = KnowledgeBase::open(&self.folder)?;
        site.needs_folder()?;
        Ok(site.with_database(self.database.as_deref()).with_rules(self.rules.as_deref()))
    }
}
