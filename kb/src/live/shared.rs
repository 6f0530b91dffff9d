//! A site that several services have: how this one follows what others write, and writes itself.
//!
//! Each of them keeps a copy of the rows, and a state in memory that steps as the one of the service that wrote. Where a step does
//! not come to the same rows the state is opened from these.
//!
//! This file and the one of its folder know each other in a circle: what is here are functions of [`Live`], which holds what is
//! known of the other services.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use adit_db::Store;
use adit_db::history::Author;
use adit_db::postgres::{Entry, Failure, Place, Replica};

use super::memory::{Memory, Promptness, ROUTES};
use super::{Live, Meanwhile, Outcome, anew};
use crate::edit::Edit;
use crate::error::{Code, Error, Result};
use crate::knowledge::KnowledgeBase;
use crate::knowledge::inputs::Inputs;
use crate::site::rules::Drafts;
use crate::site::{lock, shared};
use crate::words::progress::Silent;

/// Opens the site as its files now are.
type Opening = Box<dyn Fn() -> Result<KnowledgeBase> + Send>;

/// A site in PostgreSQL, as one of its services knows it.
pub(super) struct SharedSite {
    open: Opening,
    /// When others wrote the newest state; `None`: it is this service's.
    pub(super) others: Option<Instant>,
    /// Whether the rows are newer than what is in memory.
    lost: bool,
    /// Whether files that others saved were written here, and nobody has looked yet.
    files: bool,
    _lock: File,
}

/// How long the right to write is waited for.
const PATIENCE: Duration = Duration::from_secs(20);
const PAUSE: Duration = Duration::from_millis(15);

/// How long routes that another service left stale are left to it.
const RENEWAL: Duration = Duration::from_secs(10);

/// Entries of the log that are followed one by one; of more only the last state is opened.
const STEPS: usize = 4;

/// How often an edit is made anew that others overtook.
const TRIES: usize = 3;

impl Live {
    /// As [`Live::open`], of a copy of a site that is in PostgreSQL.
    ///
    /// # Arguments
    /// `open` opens the site as its files now are; its database is the copy.
    pub fn open_shared(
        copy: Copy,
        open: impl Fn() -> Result<KnowledgeBase> + Send + 'static,
    ) -> Result<Self> {
        let site = Arc::new(open()?);
        let mut store = Store::open_copy(&copy.database, copy.replica)?;
        let inputs = site.inputs(&Silent)?;
        let mut shared = SharedSite {
            open: Box::new(open),
            others: Some(Instant::now()),
            lost: false,
            files: false,
            _lock: copy.lock,
        };
        if let Some(memory) = store.snapshot(|tx| Memory::open_due(tx, &site, &inputs))? {
            return Self::of(site, store, memory, Some(shared));
        }
        let began = Instant::now();
        loop {
            if store.lead()? {
                let entries = store.waiting(true)?;
                for entry in &entries {
                    take_rows(&mut store, &site, entry)?;
                }
                if entries.is_empty() {
                    break;
                }
            } else if began.elapsed() > PATIENCE {
                return Err(Error::from(adit_db::Error::from(Failure::Held(site.site().name.clone()))));
            }
            std::thread::sleep(PAUSE);
        }
        shared.others = None;
        let built = site.build_in(&mut store, &inputs, &Silent);
        store.cede();
        Self::of(site, store, built?.0, Some(shared))
    }

    /// Asks for the right to write, of a site that others write, too; `false` where another service has it. What others wrote
    /// before is to be [followed](Live::follow_others) then.
    pub fn try_lead(&mut self) -> Result<bool> {
        Ok(self.store.lead()?)
    }

    /// Gives the right to write up.
    pub fn cede(&mut self) {
        self.store.cede();
    }

    /// Has the right to write, and everything that others wrote before.
    pub(super) fn lead(&mut self) -> Result<()> {
        let began = Instant::now();
        while self.store.is_copy() {
            let leads = self.store.lead()?;
            self.follow_others()?;
            if leads {
                break;
            }
            if began.elapsed() > PATIENCE {
                return Err(adit_db::Error::from(Failure::Held(self.site.site().name.clone())).into());
            }
            std::thread::sleep(PAUSE);
        }
        Ok(())
    }

    /// Has the right to write at once, and nothing newer is there; else it is not waited for.
    pub(super) fn leads_now(&mut self) -> Result<bool> {
        if !self.store.lead()? {
            return Ok(false);
        }
        let waiting = self.store.waiting(false);
        let is_newest = waiting.as_ref().is_ok_and(Vec::is_empty);
        if !is_newest {
            self.store.cede();
        }
        waiting?;
        Ok(is_newest)
    }

    /// Whether routes that are stale are this service's to find anew.
    pub(super) fn renews(&self) -> bool {
        let others = self.shared.as_ref().and_then(|shared| shared.others);
        others.is_none_or(|wrote| wrote.elapsed() > RENEWAL)
    }

    /// Whether PostgreSQL could not be reached a moment ago, so that nobody knows what others wrote.
    pub fn is_cut_off(&self) -> bool {
        self.store.is_cut_off()
    }

    /// Whether files that others saved were written here since this was asked last.
    pub fn has_new_files(&mut self) -> bool {
        self.shared.as_mut().is_some_and(|shared| std::mem::take(&mut shared.files))
    }

    /// Makes an edit where others edit, too.
    pub(super) fn edit_shared(&mut self, edit: &Edit, author: &Author) -> Result<Outcome> {
        let mut tried = 0;
        loop {
            tried += 1;
            let edited = self.lead().and_then(|()| self.follow(Some((edit, author))));
            self.store.cede();
            match edited {
                Ok(Some(outcome)) => return Ok(outcome),
                // the copy holds what nobody wrote through it
                Ok(None) if tried < TRIES => drop(self.resync()?),
                Err(error) if tried < TRIES && is(&error, Code::PostgresFenced) => {}
                Err(error) => return Err(error),
                Ok(None) => {
                    let help = Some("try again".to_owned());
                    return Err(Error::said(
                        Code::LiveStale,
                        "the site's tables were edited meanwhile",
                        help,
                    ));
                }
            }
        }
    }

    /// Follows what others wrote; then the clock, where nobody else does.
    pub(super) fn catch_up_shared(&mut self) -> Result<Option<Outcome>> {
        if let Some(outcome) = self.follow_others()? {
            return Ok(Some(outcome));
        }
        if !self.memory.state.told.is_over(&self.site.clock()) || !self.leads_now()? {
            return Ok(None);
        }
        let followed = self.follow(None);
        self.store.cede();
        match followed {
            Err(error) if is(&error, Code::PostgresFenced) => Ok(None),
            Ok(None) => self.resync().map(Some),
            followed => followed,
        }
    }

    /// Takes what other services wrote into the copy and into memory; `None` where there is nothing to be said of it.
    pub fn follow_others(&mut self) -> Result<Option<Outcome>> {
        let mut outcome: Option<Outcome> = None;
        loop {
            let entries = match self.store.waiting(false) {
                Err(adit_db::Error::Postgres(Failure::TooFarBehind(_))) => return self.resync().map(Some),
                entries => entries?,
            };
            if entries.is_empty() {
                break;
            }
            let mut edits = entries.iter().filter(|entry| entry.is_edit()).count();
            for entry in &entries {
                if edits > STEPS {
                    self.lose();
                }
                match self.take(entry) {
                    Ok(Some(next)) => {
                        let rooms = outcome.as_ref().map_or(0, |before| before.rooms);
                        let doors = outcome.as_ref().map_or(0, |before| before.doors);
                        let anew = next.anew || outcome.is_some_and(|before| before.anew);
                        let (rooms, doors) = (next.rooms + rooms, next.doors + doors);
                        outcome = Some(Outcome { rooms, doors, anew, ..next });
                    }
                    Ok(None) => {}
                    Err(error) if is(&error, Code::PostgresCopy) => return self.resync().map(Some),
                    Err(error) => return Err(error),
                }
                edits -= usize::from(entry.is_edit());
            }
        }
        if self.shared.as_ref().is_some_and(|shared| shared.lost) {
            outcome = Some(self.open_from_rows()?);
        }
        let Some(mut outcome) = outcome else { return Ok(None) };
        outcome.meanwhile = self.edited()?;
        Ok(Some(outcome))
    }

    /// Takes one entry of the log. Where memory does not step with it, it is lost until it is opened from the rows.
    fn take(&mut self, entry: &Entry) -> Result<Option<Outcome>> {
        let is_lost = self.shared.as_ref().is_none_or(|shared| shared.lost);
        if !entry.is_edit() {
            self.store.take::<(), Error>(entry, |_| Ok(None))?;
            let marks = self.store.snapshot(|tx| tx.stale_marks())?;
            self.memory.routes_due = marks.iter().any(|mark| mark.table == ROUTES);
            return Ok(None);
        }
        if let Some(shared) = &mut self.shared {
            shared.others = Some(Instant::now());
        }
        if is_lost || !entry.files().is_empty() {
            // rows may be taken though a file cannot be written
            self.lose();
            take_rows(&mut self.store, &self.site, entry)?;
            if let Some(shared) = &mut self.shared {
                shared.files |= !entry.files().is_empty();
            }
            return Ok(None);
        }
        let Self { store, memory, .. } = self;
        let followed = store.take(entry, |tx| memory.follow(tx, None, Promptness::Later, &Silent).map(Some));
        match followed {
            Ok(Some(followed)) => self.accept(followed).map(Some),
            Ok(None) => {
                self.lose();
                Ok(None)
            }
            Err(error) => {
                self.lose();
                if is(&error, Code::PostgresCopy) {
                    return Err(error);
                }
                // what it cannot conclude step by step it may conclude from the rows
                take_rows(&mut self.store, &self.site, entry)?;
                Ok(None)
            }
        }
    }

    /// What is in memory is older than the rows, from now on.
    fn lose(&mut self) {
        if let Some(shared) = self.shared.as_mut().filter(|shared| !shared.lost) {
            shared.lost = true;
            self.memory.take_back().ok();
        }
    }

    /// Makes the copy's rows those of the site, and opens memory from them.
    fn resync(&mut self) -> Result<Outcome> {
        self.lose();
        let files = self.store.take_whole()?;
        let folder = &self.site.site().folder;
        let is_new = shared::write(folder, &files)?;
        if let Some(shared) = &mut self.shared {
            (shared.others, shared.files) = (Some(Instant::now()), shared.files || is_new);
        }
        let outcome = self.open_from_rows()?;
        Ok(Outcome { meanwhile: self.edited()?, ..outcome })
    }

    /// Opens memory from the rows; where they are not what follows from files and tables, all is derived anew.
    fn open_from_rows(&mut self) -> Result<Outcome> {
        let site = match &self.shared {
            Some(shared) => Arc::new((shared.open)()?),
            None => Arc::clone(&self.site),
        };
        let inputs = site.inputs(&Silent)?;
        let Some(memory) = self.store.snapshot(|tx| Memory::open_due(tx, &site, &inputs))? else {
            // who is behind by then is told so, and follows first
            if !self.leads_now()? {
                let help = Some("it is tried again".to_owned());
                let message = "what another service wrote does not follow from the site's files and tables";
                return Err(Error::said(Code::LiveStale, message, help));
            }
            let derived = self.derive(site, &inputs);
            self.store.cede();
            return derived;
        };
        (self.site, self.memory) = (site, memory);
        self.found();
        self.ready();
        let graph = self.memory.state.graph();
        Ok(Outcome {
            done: None,
            generation: self.memory.state.generation,
            rooms: graph.rooms.len(),
            doors: graph.doors.len(),
            tree_rows: 0,
            routes_due: self.memory.routes_due,
            anew: true,
            stages: Vec::new(),
            reacted: Vec::new(),
            remarks: Vec::new(),
            meanwhile: Meanwhile::Edited(Vec::new()),
        })
    }

    /// Has the next transaction keep the site's files, as they will be with these drafts of rules.
    pub(super) fn stage(&mut self, site: &KnowledgeBase, drafts: &Drafts) -> Result<()> {
        if self.store.is_copy() {
            let folder = &site.site().folder;
            let files = shared::files(folder, &site.files())?;
            self.store.stage_files(shared::drafted(files, folder, &site.rule_folder(), drafts));
        }
        Ok(())
    }

    /// The newest state is what this service wrote.
    pub(super) fn wrote(&mut self) {
        if let Some(shared) = &mut self.shared {
            shared.others = None;
        }
    }

    fn found(&mut self) {
        if let Some(shared) = &mut self.shared {
            shared.lost = false;
        }
    }

    /// Derives everything from files and tables, and keeps both.
    pub(super) fn build_shared(&mut self, site: Arc<KnowledgeBase>, inputs: &Arc<Inputs>) -> Result<Outcome> {
        let built = self.lead().and_then(|()| self.derive(site, inputs));
        // nobody keeps the right to write up whose work has failed
        self.store.cede();
        built
    }

    fn derive(&mut self, site: Arc<KnowledgeBase>, inputs: &Arc<Inputs>) -> Result<Outcome> {
        self.stage(&site, &Drafts::new())?;
        let built = site.build_in(&mut self.store, inputs, &Silent);
        self.store.cede();
        let (memory, report) = built?;
        (self.site, self.memory) = (site, memory);
        self.wrote();
        self.found();
        self.ready();
        Ok(anew(report))
    }
}

/// Takes the rows and the files of an entry, and nothing more.
fn take_rows(store: &mut Store, site: &KnowledgeBase, entry: &Entry) -> Result<()> {
    store.take::<(), Error>(entry, |_| Ok(None))?;
    shared::write_some(&site.site().folder, entry.files())
}

fn is(error: &Error, code: Code) -> bool {
    error.problems().first().and_then(crate::error::Finding::code) == Some(code)
}

/// The copy of a site for one service: its files in a folder, its rows in a database there.
pub struct Copy {
    pub replica: Replica,
    pub database: PathBuf,
    /// Has the folder to itself.
    lock: File,
}

impl Copy {
    /// Makes it.
    pub fn make(place: &Place, name: &str, folder: &Path) -> Result<Self> {
        let lock = lock::folder(folder)?;
        let database = shared::copy(folder);
        let replica = Replica::make(place, name, &owner()?, &database)?;
        shared::take(folder, name, &replica.files())?;
        Ok(Self { replica, database, lock })
    }
}

/// A name that no other service has.
fn owner() -> Result<String> {
    let mut bytes = [0; 8];
    getrandom::fill(&mut bytes).map_err(Error::of(Code::ServeThread))?;
    Ok(format!("{}-{:016x}", std::process::id(), u64::from_ne_bytes(bytes)))
}
