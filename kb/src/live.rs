//! A site's knowledge held in memory between edits: an edit costs what depends on it, not what there is.

mod by_hand;
mod courses;
mod memory;
mod once;
mod renewal;
pub(crate) mod report;
mod reseeded;
mod routes;
mod shared;
mod trees;
mod view;
pub mod watch;

use std::sync::Arc;

use adit_db::history::{Author, Edit as Entry};
use adit_db::{Store, Tx};

use crate::answer::Answer;
use crate::edit::Tell;
use crate::edit::react::make_tables;
use crate::edit::{Done, Edit};
use crate::error::{Code, Error, Result};
use crate::knowledge::KnowledgeBase;
use crate::live::report::Report;
use crate::plan::course::Asked;
use crate::site::journal::Journal;
use crate::site::rules::Drafts;
use crate::state::{Ahead, State};
use crate::words::progress::{Silent, Stage};
pub(crate) use memory::Memory;
use memory::{Accepted, Followed, Promptness};
pub use renewal::Renewal;
pub use shared::Copy;
use shared::SharedSite;
pub use view::{View, Ways};

/// A built site, ready for many edits. What it writes is what [`KnowledgeBase::edit`] would write.
///
/// Rules and map are those of the files when it was opened. Edits of other programs are seen: before the next edit
/// all is derived anew.
pub struct Live {
    site: Arc<KnowledgeBase>,
    store: Store,
    memory: Memory,
    /// Whether ways between any two rooms are kept ready.
    is_prepared: bool,
    /// The newest entry of the history that is known.
    newest: i64,
    /// Where the site is in PostgreSQL.
    shared: Option<SharedSite>,
}

/// What an edit did.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// The edit; `None` where only time has passed.
    pub done: Option<Done>,
    /// Number of the knowledge base's state.
    pub generation: u64,
    /// Rooms whose row was written.
    pub rooms: usize,
    /// Doors whose row was written.
    pub doors: usize,
    /// Rows of routes that were written.
    pub tree_rows: usize,
    /// Whether the kept routes are stale until [`Live::renew_routes`]; [`Live::route`] is right at once.
    pub routes_due: bool,
    /// Whether the whole site was derived anew, since what planners need changed.
    pub anew: bool,
    /// What was done, and how long it took.
    pub stages: Vec<Stage>,
    /// What rules that react told, in sentences.
    pub reacted: Vec<String>,
    /// What the edit leaves as people may not expect it, in sentences.
    pub remarks: Vec<String>,
    pub meanwhile: Meanwhile,
}

/// What happened without this program.
#[derive(Clone, Debug, PartialEq)]
pub enum Meanwhile {
    /// What ended or began by itself, in sentences.
    Ended(Vec<String>),
    /// What others edited, the newest last; what they wrote past the history is not among it.
    Edited(Vec<Entry>),
}

/// Entries of the history that are looked at after edits of others.
const ENTRIES: u32 = 50;

impl Live {
    /// Takes a site's knowledge into memory; builds the site where it is not built, or its tables were edited since.
    pub fn open(site: KnowledgeBase) -> Result<Self> {
        if !site.database().exists() {
            site.build(&Silent)?;
        }
        let site = Arc::new(site);
        let mut store = Store::open(site.database())?;
        let inputs = site.inputs(&Silent)?;
        let memory = match store.snapshot(|tx| Memory::open(tx, &site, &inputs))? {
            Some(memory) => memory,
            None => site.build_in(&mut store, &inputs, &Silent)?.0,
        };
        Self::of(site, store, memory, None)
    }

    fn of(
        site: Arc<KnowledgeBase>,
        mut store: Store,
        memory: Memory,
        shared: Option<SharedSite>,
    ) -> Result<Self> {
        let newest = store.snapshot(|tx| tx.history(1))?.first().map_or(0, |entry| entry.id);
        let mut live = Self { site, store, memory, is_prepared: false, newest, shared };
        live.ready();
        Ok(live)
    }

    /// What makes edits and answers quick from now on.
    fn ready(&mut self) {
        let Memory { state, routes, .. } = &mut self.memory;
        routes.follow_at_once(state.graph());
        if self.is_prepared {
            state.prepare();
        }
    }

    /// The site as it is after the last edit.
    pub fn view(&self) -> View {
        View::of(&self.memory)
    }

    /// The site.
    pub fn site(&self) -> &KnowledgeBase {
        &self.site
    }

    /// What the expert should know: facts that are lost, tunings that count for nothing, what no rule reads.
    pub fn notes(&self) -> Vec<String> {
        let State { inputs, told, attached, .. } = &self.memory.state;
        inputs.notes.iter().chain(&told.notes).cloned().chain(told.lost(attached)).collect()
    }

    /// Keeps ways between any two rooms ready, from now on: an answer then takes microseconds where all hardness lies on the
    /// doors, and each edit a little longer.
    pub fn prepare(&mut self) {
        self.is_prepared = true;
        self.memory.state.prepare();
    }

    /// Lets others read the database while edits are written.
    pub fn share(&mut self) -> Result<()> {
        Ok(self.store.share()?)
    }

    /// Leaves the database as one file. Where others still read it, two files stay beside it; `false` where the file lacks
    /// then what is in those.
    pub fn unshare(mut self) -> Result<bool> {
        Ok(self.store.unshare()?)
    }

    /// Keeps a query of somebody's under a name, or takes it away; whether there is, or was, one.
    pub fn keep_query(&mut self, name: &str, query: Option<(&str, &str)>) -> Result<bool> {
        self.write(|tx| match query {
            Some((query, who)) => Ok(tx.save_query(name, query, who).map(|()| true)?),
            None => Ok(tx.remove_query(name)?),
        })
    }

    /// Writes what nothing follows from, in one transaction.
    pub fn write<T>(&mut self, work: impl FnOnce(&mut Tx<'_>) -> Result<T>) -> Result<T> {
        let written = self.lead().and_then(|()| self.store.transaction(work));
        self.store.cede();
        written
    }

    /// Forgets what is in memory, and derives it from files and tables.
    pub fn reopen(&mut self) -> Result<Outcome> {
        self.build_anew(Arc::clone(&self.site))
    }

    /// Edits a table and writes all that follows, in one transaction. If anything fails, database and memory are as
    /// before.
    pub fn edit(&mut self, edit: &Edit, author: &Author) -> Result<Outcome> {
        self.site.needs_folder()?;
        if !self.files_of(edit)?.is_empty() {
            let site = self.lead().map(|()| KnowledgeBase::clone(&self.site));
            let edited = site.and_then(|site| self.edit_with_files(&site, edit, author));
            self.store.cede();
            return edited;
        }
        if self.store.is_copy() {
            return self.edit_shared(edit, author);
        }
        if let Some(outcome) = self.follow(Some((edit, author)))? {
            return Ok(outcome);
        }
        if self.reopen().is_err() {
            // what keeps the site from being opened may be what the edit mends
            let site = KnowledgeBase::clone(&self.site);
            return self.edit_with_files(&site, edit, author);
        }
        let outcome = self.follow(Some((edit, author)))?.ok_or_else(|| {
            let help = Some("try again".to_owned());
            Error::said(Code::LiveStale, "the site's tables were edited meanwhile", help)
        })?;
        Ok(Outcome { anew: true, ..outcome })
    }

    /// The rule files that an edit would have others, by name.
    pub fn files_of(&mut self, edit: &Edit) -> Result<Drafts> {
        self.store.snapshot(|tx| edit.files(tx))
    }

    /// An edit of rule files, and of whatever else belongs to it, of the site as its files now are: files, rows and all that
    /// follows, whole or not at all.
    pub fn edit_with_files(&mut self, site: &KnowledgeBase, edit: &Edit, author: &Author) -> Result<Outcome> {
        let drafts = self.files_of(edit)?;
        self.stage(site, &drafts)?;
        let drafted = Arc::new(site.drafting(drafts));
        let inputs = drafted.inputs(&Silent)?;
        let written = self.store.transaction(|tx| -> Result<_> {
            let since = tx.history(1)?.first().map_or(0, |entry| entry.id);
            make_tables(tx, &inputs.rules)?;
            let done = edit.apply(tx, &drafted, &inputs.rules, author)?;
            let (memory, report) = Memory::build(tx, &drafted, &inputs, &Silent)?;
            let remarks = edit.remarks(tx, &drafted, &done)?;
            let journal = Journal::begin(tx, drafted.database(), &drafted.rule_folder(), since)?;
            Ok((done, memory, (report, remarks), journal))
        });
        self.store.cede();
        let (done, mut memory, (report, remarks), journal) = written?;
        Journal::finish(journal);
        self.wrote();
        self.site = Arc::new(drafted.with_drafts_saved());
        memory.state.site = Arc::clone(&self.site);
        self.memory = memory;
        self.newest = self.store.snapshot(|tx| tx.history(1))?.first().map_or(self.newest, |entry| entry.id);
        self.ready();
        Ok(Outcome { done: Some(done), remarks, ..anew(report) })
    }

    /// Derives all anew, since others edited the tables; with what they did.
    fn take_up(&mut self) -> Result<Outcome> {
        let outcome = self.reopen()?;
        Ok(Outcome { meanwhile: self.edited()?, ..outcome })
    }

    /// What others edited since.
    fn edited(&mut self) -> Result<Meanwhile> {
        let mut edits = self.store.snapshot(|tx| tx.history(ENTRIES))?;
        edits.retain(|entry| entry.id > self.newest);
        edits.reverse();
        self.newest = edits.last().map_or(self.newest, |entry| entry.id);
        Ok(Meanwhile::Edited(edits))
    }

    /// Writes what follows from an edit, or from the clock alone, in one transaction; `None` where somebody else edited the
    /// tables meanwhile.
    fn follow(&mut self, edit: Option<(&Edit, &Author)>) -> Result<Option<Outcome>> {
        let Self { site, store, memory, .. } = self;
        let followed = store.transaction(|tx| -> Result<_> {
            if !memory.is_of(tx)? {
                return Ok(None);
            }
            let rules = &memory.state.inputs.rules;
            let done = edit.map(|(edit, author)| edit.apply(tx, site, rules, author)).transpose()?;
            let followed = memory.follow(tx, done.clone(), Promptness::Later, &Silent)?;
            let remarks =
                edit.zip(done).map(|((edit, _), done)| edit.remarks(tx, site, &done)).transpose()?;
            Ok(Some((followed, remarks.unwrap_or_default())))
        });
        match followed {
            Ok(None) => Ok(None),
            Ok(Some((followed, remarks))) => {
                let outcome = self.accept(followed)?;
                self.wrote();
                Ok(Some(Outcome { remarks, ..outcome }))
            }
            Err(error) => {
                memory.take_back()?;
                Err(error)
            }
        }
    }

    /// Makes part of what is known what is committed.
    fn accept(&mut self, followed: Followed) -> Result<Outcome> {
        let Self { site, memory, .. } = self;
        let over = memory.state.told.is_over(&site.clock()).then(|| memory.state.told.clone());
        let accepted = memory.accept(followed);
        let ended = over.map(|before| memory.state.told.ended_since(&before));
        let meanwhile = Meanwhile::Ended(ended.unwrap_or_default());
        self.newest = accepted.done.as_ref().map_or(self.newest, |done| done.id);
        if !accepted.reacted.is_empty() {
            let last = self.store.snapshot(|tx| tx.history(1))?;
            self.newest = last.first().map_or(self.newest, |entry| entry.id);
        }
        if accepted.anew {
            self.ready();
        }
        Ok(Outcome { meanwhile, ..self.outcome(accepted) })
    }

    /// Follows what happened without this program: edits of other programs, facts that ended, hours that began or
    /// ended. `None` where nothing did.
    pub fn catch_up(&mut self) -> Result<Option<Outcome>> {
        if self.store.is_copy() {
            return self.catch_up_shared();
        }
        let memory = &self.memory;
        if !self.store.snapshot(|tx| memory.is_of(tx))? {
            return self.take_up().map(Some);
        }
        if !memory.state.told.is_over(&self.site.clock()) {
            return Ok(None);
        }
        match self.follow(None)? {
            Some(outcome) => Ok(Some(outcome)),
            None => self.take_up().map(Some),
        }
    }

    /// Takes the site as its files now are. Where they cannot be used, all stays as it was.
    pub fn open_again(&mut self, site: KnowledgeBase) -> Result<Outcome> {
        self.build_anew(Arc::new(site))
    }

    /// Tells a fact about one object, as [`Live::edit`] does.
    pub fn tell(&mut self, fact: Tell, author: &Author) -> Result<Outcome> {
        self.edit(&Edit::Tell(fact), author)
    }

    /// Takes a fact back, by its number.
    pub fn retract(&mut self, fact: i64, author: &Author) -> Result<Outcome> {
        self.edit(&Edit::Retract(fact), author)
    }

    /// The route of least hardness to the one of several goals that costs least, with everything that was edited so far.
    /// Nothing is read but memory.
    pub fn route(&self, start: &str, goals: &[String], robot: Option<&str>) -> Result<Answer> {
        self.view().route(start, goals, robot)
    }

    /// The rules, to be asked about one object at a time, with all that is known now.
    pub fn asked(&self) -> Asked<'_> {
        self.memory.state.asked()
    }

    /// What planners keep and may not have made yet.
    pub(crate) fn to_make_ahead(&self) -> Ahead {
        self.memory.state.to_make_ahead()
    }

    pub(crate) fn generation(&self) -> u64 {
        self.memory.state.generation
    }

    /// A copy of what is known, in memory only, to try edits on.
    pub fn fork(&self) -> State {
        self.memory.state.fork()
    }

    /// Derives everything from files and tables, writes it, and takes it into memory.
    fn build_anew(&mut self, site: Arc<KnowledgeBase>) -> Result<Outcome> {
        let inputs = site.inputs(&Silent)?;
        if self.store.is_copy() {
            return self.build_shared(site, &inputs);
        }
        let (memory, report) = site.build_in(&mut self.store, &inputs, &Silent)?;
        (self.site, self.memory) = (site, memory);
        self.ready();
        Ok(anew(report))
    }

    fn outcome(&self, accepted: Accepted) -> Outcome {
        let Accepted { done, weighed, tree_rows, anew, stages, reacted, .. } = accepted;
        let graph = self.memory.state.graph();
        let all = (graph.rooms.len(), graph.doors.len());
        let (rooms, doors) = weighed.map_or(all, |weighed| (weighed.rooms.len(), weighed.doors.len()));
        Outcome {
            done,
            generation: self.memory.state.generation,
            rooms,
            doors,
            tree_rows,
            routes_due: self.memory.routes_due,
            anew,
            stages,
            reacted,
            remarks: Vec::new(),
            meanwhile: Meanwhile::Ended(Vec::new()),
        }
    }
}

/// What came of deriving everything anew.
fn anew(report: Report) -> Outcome {
    Outcome {
        done: None,
        generation: report.generation,
        rooms: report.rooms.changed,
        doors: report.doors.changed,
        tree_rows: report.routes.rows as usize,
        routes_due: false,
        anew: true,
        stages: report.stages,
        reacted: report.reacted,
        remarks: Vec::new(),
        meanwhile: Meanwhile::Ended(Vec::new()),
    }
}
