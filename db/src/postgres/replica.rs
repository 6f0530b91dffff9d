//! A copy of a site that is in PostgreSQL: how it writes, and how it follows what others write.

use std::collections::{BTreeMap, HashSet};
use std::path::Path;
use std::time::Duration;

use sqlx::SqliteConnection;

use super::capture::{Capture, Known};
use super::changes::{self, Changes, File};
use super::link::Link;
use super::log::{self, Draft, Lease};
use super::place::Place;
use super::rows;
use super::tables::Template;
use super::upkeep::Upkeep;
use crate::error::{Error, Result};
use crate::failure::Failure;

/// How long the right to write lasts that nobody keeps up: so long nobody writes after a service was killed at work.
const LEASE: Duration = Duration::from_secs(5);

/// The table whose rows say of which state the database is.
const SITE: &str = "site";

/// What others wrote, to be taken into the copy.
pub struct Entry {
    entry: i64,
    changes: Changes,
}

impl Entry {
    /// Whether there is something to be concluded of it: else it holds routes that were found anew, and the like.
    pub fn is_edit(&self) -> bool {
        self.changes.tables.contains_key(SITE) || !self.changes.files.is_empty()
    }

    /// Files that are others now, or gone.
    pub fn files(&self) -> &[File] {
        &self.changes.files
    }
}

/// What a transaction is to keep, once PostgreSQL has it.
pub(crate) struct Pending {
    changes: Changes,
    known: Known,
    generation: i64,
}

/// A copy's tie to the site in PostgreSQL.
pub struct Replica {
    link: Link,
    site: String,
    owner: String,
    template: Template,
    capture: Option<Capture>,
    lease: Option<Lease>,
    lasts: Duration,
    upkeep: Upkeep,
    /// The newest entry that the copy has.
    entry: i64,
    files: BTreeMap<String, Vec<u8>>,
    /// What files are to be from the next edit on.
    staged: Option<BTreeMap<String, Vec<u8>>>,
    hints: bool,
}

impl Replica {
    /// Makes a copy of a site.
    ///
    /// # Arguments
    /// `owner` names this service among all others; `file` is where the copy is made, and must not exist.
    ///
    /// # Returns
    /// The tie, to be given to the [`Store`](crate::Store) that opens `file`.
    pub fn make(place: &Place, site: &str, owner: &str, file: &Path) -> Result<Self> {
        Self::make_lasting(place, (site, owner), file, LEASE)
    }

    /// As [`Replica::make`], with a lease of its own length.
    pub fn make_lasting(
        place: &Place,
        (site, owner): (&str, &str),
        file: &Path,
        lasts: Duration,
    ) -> Result<Self> {
        let mut link = Link::new(place)?;
        let (template, whole) = rows::snapshot(&mut link, site)?;
        whole.make(&template, file)?;
        let upkeep = Upkeep::start(place, (site, owner), lasts)?;
        let mut replica = Self {
            link,
            site: site.to_owned(),
            owner: owner.to_owned(),
            template,
            capture: None,
            lease: None,
            lasts,
            upkeep,
            entry: whole.entry,
            files: BTreeMap::new(),
            staged: None,
            hints: true,
        };
        replica.take_files(&whole.changes.files);
        Ok(replica)
    }

    /// The site's files.
    pub fn files(&self) -> Vec<File> {
        let file =
            |(path, bytes): (&String, &Vec<u8>)| File { path: path.clone(), bytes: Some(bytes.clone()) };
        self.files.iter().map(file).collect()
    }

    /// The newest entry that the copy has.
    pub fn entry(&self) -> i64 {
        self.entry
    }

    fn take_files(&mut self, files: &[File]) {
        for file in files {
            match &file.bytes {
                Some(bytes) => self.files.insert(file.path.clone(), bytes.clone()),
                None => self.files.remove(&file.path),
            };
        }
    }

    /// Has the next edit keep these files, which are all that there are. `false` where they are those that are kept.
    pub(crate) fn stage(&mut self, files: Vec<File>) -> bool {
        let files = files.into_iter().filter_map(|file| Some((file.path, file.bytes?)));
        let files: BTreeMap<String, Vec<u8>> = files.collect();
        let is_other = files != self.files;
        self.staged = is_other.then_some(files);
        is_other
    }

    /// Begins to note what the copy's connection changes.
    pub(crate) async fn begin(&mut self, connection: &mut SqliteConnection) -> Result<()> {
        self.capture = Some(Capture::begin(connection, self.template.clone()).await?);
        Ok(())
    }

    fn capture(&self) -> Result<&Capture> {
        self.capture.as_ref().ok_or_else(|| Failure::Sql("the copy is not open".to_owned()).into())
    }

    /// Asks for the right to write; `false` where another service has it.
    pub(crate) fn lead(&mut self) -> Result<bool> {
        if self.lease.is_none() {
            self.lease = log::acquire(&mut self.link, &self.site, &self.owner, self.lasts)?;
            self.upkeep.set(self.lease.map(|lease| lease.fence));
        }
        Ok(self.lease.is_some())
    }

    /// Gives the right to write up.
    pub(crate) fn cede(&mut self) {
        self.upkeep.set(None);
        self.staged = None;
        if let Some(lease) = self.lease.take() {
            // what cannot be given up ends by itself
            log::release(&mut self.link, &self.site, &self.owner, lease.fence).ok();
        }
    }

    /// Refuses to write without the right to, and where something of the log is missing.
    pub(crate) fn may_write(&self) -> Result<()> {
        match self.lease {
            Some(lease) if lease.entry <= self.entry => Ok(()),
            Some(_) => Err(Failure::Fenced(self.site.clone()).into()),
            None => Err(Failure::Held(self.site.clone()).into()),
        }
    }

    /// Whether the database was out of reach so lately that it is not asked.
    pub(crate) fn is_cut_off(&self) -> bool {
        self.link.rests()
    }

    /// What others wrote since; with `false` none is looked for shortly after the database was out of reach.
    pub(crate) fn waiting(&mut self, at_once: bool) -> Result<Vec<Entry>> {
        if !at_once && self.is_cut_off() {
            return Ok(Vec::new());
        }
        let mut entries = Vec::new();
        for written in log::after(&mut self.link, &self.site, self.entry)? {
            let follows = written.entry == self.entry + entries.len() as i64 + 1;
            let Some(text) = written.changes.filter(|_| follows) else {
                return Err(Failure::TooFarBehind(self.site.clone()).into());
            };
            let changes =
                Changes::read(&text).ok_or_else(|| self.unfit(written.entry, "it cannot be read"))?;
            entries.push(Entry { entry: written.entry, changes });
        }
        Ok(entries)
    }

    fn unfit(&self, entry: i64, reason: &str) -> Error {
        Failure::Copy { site: self.site.clone(), entry, reason: reason.to_owned() }.into()
    }

    /// What the open transaction of the copy changed; `None` where that is nothing.
    pub(crate) async fn pending(&self, connection: &mut SqliteConnection) -> Result<Option<Pending>> {
        let capture = self.capture()?;
        let (mut changes, known) = capture.changes(connection).await?;
        if let Some(staged) = &self.staged {
            let gone = self.files.keys().filter(|path| !staged.contains_key(*path));
            let gone = gone.map(|path| File { path: path.clone(), bytes: None });
            let other = staged.iter().filter(|(path, bytes)| self.files.get(*path) != Some(bytes));
            let other = other.map(|(path, bytes)| File { path: path.clone(), bytes: Some(bytes.clone()) });
            changes.files = gone.chain(other).collect();
        }
        let generation = crate::site::value(connection, "generation").await?;
        capture.forget(connection).await?;
        let generation = generation.and_then(|text| text.parse().ok()).unwrap_or(0);
        Ok((!changes.is_empty()).then_some(Pending { changes, known, generation }))
    }

    /// Keeps what a transaction changed, before the copy commits it. The right to write is given up with that.
    pub(crate) fn publish(&mut self, pending: &Pending) -> Result<()> {
        self.may_write()?;
        let Some(lease) = self.lease else { return Ok(()) };
        let draft = Draft {
            site: &self.site,
            owner: &self.owner,
            fence: lease.fence,
            entry: self.entry + 1,
            generation: pending.generation,
            changes: &pending.changes,
        };
        let kept = log::publish(&mut self.link, &self.template, &draft);
        if kept.is_ok() || matches!(kept, Err(Error::Postgres(_))) {
            self.upkeep.set(None);
            self.lease = if kept.is_ok() { None } else { self.lease };
        }
        kept?;
        if self.hints {
            self.hints = log::hint(&mut self.link, &self.site).is_ok();
        }
        Ok(())
    }

    /// What is said where what was published could not be committed.
    pub(crate) fn kept_there(&self, error: &Error) -> Error {
        Failure::KeptThere { site: self.site.clone(), reason: error.to_string() }.into()
    }

    /// The copy has committed what was published.
    pub(crate) fn accept(&mut self, pending: Pending) {
        self.entry += 1;
        if let Some(capture) = &mut self.capture {
            capture.accept(pending.known);
        }
        self.take_files(&pending.changes.files);
        self.staged = None;
    }

    /// Puts an entry into the copy, but for the rows that say of which state it is.
    pub(crate) async fn put_rows(&mut self, connection: &mut SqliteConnection, entry: &Entry) -> Result<()> {
        let put = self.capture()?.apply(connection, &entry.changes, SITE).await;
        put.map_err(|error| self.unfit(entry.entry, &error.to_string()))?;
        self.settle(connection).await
    }

    /// And these.
    pub(crate) async fn put_state(&mut self, connection: &mut SqliteConnection, entry: &Entry) -> Result<()> {
        let tables = entry.changes.tables.get(SITE).map(|rows| (SITE.to_owned(), rows.clone()));
        let changes = Changes { tables: tables.into_iter().collect(), ..Changes::default() };
        let put = self.capture()?.apply(connection, &changes, "").await;
        put.map_err(|error| self.unfit(entry.entry, &error.to_string()))?;
        self.settle(connection).await
    }

    async fn settle(&mut self, connection: &mut SqliteConnection) -> Result<()> {
        self.capture()?.forget(connection).await?;
        if let Some(capture) = &mut self.capture {
            capture.look(connection).await?;
        }
        Ok(())
    }

    /// Whether what the open transaction changed since is among what the entry changed, and is the same.
    pub(crate) async fn is_reached(&self, connection: &mut SqliteConnection, entry: &Entry) -> Result<bool> {
        let (changes, _) = self.capture()?.changes(connection).await?;
        if changes.objects.is_some() || changes.sequences.is_some() {
            return Ok(false);
        }
        for (name, ours) in &changes.tables {
            if ours.is_empty() {
                continue;
            }
            let Some(theirs) = entry.changes.tables.get(name) else { return Ok(false) };
            let text = |row: &Vec<crate::cell::Cell>| changes::line(row).to_string();
            let now: HashSet<String> = theirs.now.iter().map(text).collect();
            let gone: HashSet<String> = theirs.gone.iter().map(text).collect();
            if !ours.now.iter().all(|row| now.contains(&text(row)))
                || !ours.gone.iter().all(|key| theirs.whole || gone.contains(&text(key)))
            {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// The copy has committed this entry.
    pub(crate) fn took(&mut self, entry: &Entry) {
        self.entry = entry.entry;
        self.take_files(&entry.changes.files);
    }

    /// All rows as they now are, in the place of those that the copy has; with the files.
    pub(crate) fn whole(&mut self) -> Result<Entry> {
        let (_, whole) = rows::snapshot(&mut self.link, &self.site)?;
        Ok(Entry { entry: whole.entry, changes: whole.changes })
    }

    /// The copy has committed all rows.
    pub(crate) fn took_whole(&mut self, entry: &Entry) {
        self.files.clear();
        self.took(entry);
    }
}
