//! What can go wrong with PostgreSQL.

/// A failure that is PostgreSQL's, or on the way to it.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Failure {
    /// The URL cannot be read.
    #[error("this is no URL of a PostgreSQL database: {0}")]
    Url(String),
    /// Nobody answers, or the connection broke.
    #[error("the database {place} cannot be reached: {reason}")]
    Unreachable {
        /// Where it is.
        place: String,
        /// What was said.
        reason: String,
    },
    /// The connection cannot be made as safe as the URL asks.
    #[error("there is no safe connection to the database {place}: {reason}")]
    Tls {
        /// Where it is.
        place: String,
        /// What was said.
        reason: String,
    },
    /// The database does not let this user in.
    #[error("the database {place} lets nobody in so: {reason}")]
    LetIn {
        /// Where it is.
        place: String,
        /// What was said.
        reason: String,
    },
    /// The user may not do what is needed.
    #[error("this user of {place} has no right to do that: {reason}")]
    Rights {
        /// Where it is.
        place: String,
        /// What was said.
        reason: String,
    },
    /// No site was ever put into the database.
    #[error("{0} holds no sites")]
    NoSites(String),
    /// There is no site of that name.
    #[error("{place} has no site `{site}`; it has {sites}")]
    UnknownSite {
        /// Where it is.
        place: String,
        /// The name asked for.
        site: String,
        /// Those that there are.
        sites: String,
    },
    /// A site of that name is there already.
    #[error("{place} has a site `{site}` already")]
    SiteExists {
        /// Where it is.
        place: String,
        /// The name.
        site: String,
    },
    /// Its tables are of another version than this program's.
    #[error("the sites in {place} are of version {found}, and this program knows version {known}: {then}")]
    Version {
        /// Where it is.
        place: String,
        /// The version found.
        found: String,
        /// The one known here.
        known: String,
        /// What is to be done.
        then: &'static str,
    },
    /// What an upgrade has kept of this version is there already.
    #[error("{place} has a schema `{schema}` already, which an upgrade has kept")]
    KeptAlready {
        /// Where it is.
        place: String,
        /// The one that stands in the way.
        schema: String,
    },
    /// Some program has the tables for longer than an upgrade waits.
    #[error(
        "another program reads or writes the sites in {0} for longer than is waited for; nothing is changed"
    )]
    InUse(String),
    /// Another service writes.
    #[error("another service edits the site `{0}` just now")]
    Held(String),
    /// Another service has written, or may write by now: nothing of the edit was kept.
    #[error(
        "the right to edit the site `{0}` went to another service meanwhile; nothing of the edit was kept"
    )]
    Fenced(String),
    /// Whether an edit was kept cannot be found out.
    #[error(
        "the connection to {0} broke while an edit was kept: whether it was made shows when the database is back"
    )]
    UnknownOutcome(String),
    /// An edit was kept, and the copy of the service that made it did not take it.
    #[error(
        "the edit is made and kept in the database, but this service cannot take it into its copy of the site `{site}` yet: {reason}"
    )]
    KeptThere {
        /// The site.
        site: String,
        /// Why.
        reason: String,
    },
    /// The log does not reach back to where this copy is.
    #[error("this copy of the site `{0}` is too old to follow its log: it is made anew")]
    TooFarBehind(String),
    /// The copy's rows cannot be those of the database.
    #[error("the copy of the site `{site}` does not take entry {entry} of its log: {reason}")]
    Copy {
        /// The site.
        site: String,
        /// The entry.
        entry: i64,
        /// Why.
        reason: String,
    },
    /// Whatever else PostgreSQL says.
    #[error("PostgreSQL says: {0}")]
    Sql(String),
}

impl Failure {
    /// Whether the database could not be asked, so that nothing is known of it.
    pub fn is_out_of_reach(&self) -> bool {
        matches!(self, Self::Unreachable { .. } | Self::UnknownOutcome(_))
    }
}
