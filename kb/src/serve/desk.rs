//! Where all edits are made, one after the other, on a thread of its own: the only one that writes.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::Arc;
use std::sync::mpsc::Receiver;
use std::thread;
use std::time::{Duration, Instant};

use adit_db::history::{Author, Edit as Entry};
use adit_db::tree::TreeRow;
use adit_planners::planner::Planner;
use axum::http::StatusCode;
use jiff::Timestamp;

use super::event::{Changed, Event};
use super::shared::{Job, Seen, Shared, Source};
use crate::edit::{Edit, entry};
use crate::error::problem::Problem;
use crate::error::{Code, Error, Result};
use crate::live::watch::{Eye, Files};
use crate::live::{Live, Meanwhile, Outcome, Renewal};
use crate::site::calm::side_by_side;
use crate::site::clock::stored;
use crate::site::journal;

/// Rules run here: their deepest nesting needs more than the usual stack.
const STACK: usize = 16 << 20;

/// After so long whoever opened the page of a service that was just begun sees it.
const FIRST_PAGE: Duration = Duration::from_secs(3);

/// How long nobody asks before files, clock and other programs are looked after; then twice a file must look the same.
const TICK: Duration = Duration::from_millis(200);

pub struct Desk {
    pub live: Live,
    /// What requests see.
    pub shared: Arc<Shared>,
    eye: Eye,
    /// Which file the database is.
    database: Option<u64>,
    /// When there was last no saving an edit.
    unsaved: Option<Instant>,
    /// Files as they were when they were looked at last, and as they were when they were last taken or refused.
    looked: Option<Files>,
    taken: Option<Files>,
    /// The planners that were asked ahead.
    asked: Vec<Arc<dyn Planner>>,
}

/// After so long an edit that could not be saved says no more of whether the next one can: who sends none to a service that is
/// not ready would never hear that it is.
const REMEMBERED: Duration = Duration::from_secs(30);

/// How long the right to edit is waited for, where other services have it.
const LEADING: Duration = Duration::from_secs(10);

/// What is said of edits of others that the history does not tell.
const EDITED: &str = "tables were edited";

/// Who did something, why, and what, in a few words.
pub struct Cause {
    pub who: String,
    pub why: String,
    pub what: String,
}

impl Cause {
    /// Something that nobody asked for.
    fn itself(who: &str, what: &str) -> Self {
        Self { who: who.to_owned(), why: String::new(), what: what.to_owned() }
    }

    /// What happened without the service.
    fn of(outcome: &Outcome) -> Self {
        match &outcome.meanwhile {
            Meanwhile::Ended(ended) if ended.is_empty() => {
                Self::itself("clock", "the time of a fact or of opening hours is over")
            }
            Meanwhile::Ended(ended) => Self::itself("clock", &ended.join("; ")),
            Meanwhile::Edited(edits) if edits.is_empty() => Self::itself("another program", EDITED),
            Meanwhile::Edited(edits) => {
                let all = |of: fn(&Entry) -> String, between: &str| {
                    let mut all: Vec<String> = edits.iter().map(of).filter(|text| !text.is_empty()).collect();
                    all.dedup();
                    all.join(between)
                };
                let who = all(|edit| edit.who.clone(), ", ");
                Self { who, why: all(|edit| edit.why.clone(), "; "), what: all(entry, "; ") }
            }
        }
    }
}

/// Which file a path names, so that another one in its place is told apart.
#[cfg(unix)]
fn identity(path: &Path) -> Option<u64> {
    use std::os::unix::fs::MetadataExt;
    std::fs::metadata(path).ok().map(|file| file.ino())
}

#[cfg(not(unix))]
fn identity(path: &Path) -> Option<u64> {
    path.exists().then_some(0)
}

/// What requests see of a site.
pub fn seen(live: &Live) -> Seen {
    Seen { view: live.view(), since: stored(Timestamp::now()), notes: live.notes() }
}

/// Works until the service ends; gives the site back.
pub fn start(live: Live, shared: Arc<Shared>, jobs: Receiver<Job>) -> Result<thread::JoinHandle<Live>> {
    let work = move || {
        let database = identity(live.site().database());
        let mut desk = Desk {
            database,
            live,
            shared,
            eye: Eye::default(),
            unsaved: None,
            looked: None,
            taken: None,
            asked: Vec::new(),
        };
        desk.taken = Some(desk.look());
        desk.ask_ahead();
        desk.work(&jobs);
        desk.live
    };
    let builder = thread::Builder::new().name("desk".to_owned()).stack_size(STACK);
    builder.spawn(work).map_err(Error::of(Code::ServeThread))
}

impl Desk {
    fn work(&mut self, jobs: &Receiver<Job>) {
        let mut looked = Instant::now();
        while !*self.shared.ending.borrow() {
            let next = jobs.recv_timeout(TICK.saturating_sub(looked.elapsed()));
            let is_time = looked.elapsed() >= TICK;
            let done = catch_unwind(AssertUnwindSafe(|| {
                if let Ok(job) = next {
                    job(self);
                }
                if is_time {
                    self.look_around();
                }
            }));
            if is_time {
                looked = Instant::now();
            }
            if done.is_err() {
                // what was in memory may be half-done; what is in the database is not
                let outcome = self.live.reopen().map(Some);
                self.report(outcome, &Cause::itself("service", "taken up again after a failure"));
            }
        }
    }

    /// Makes an edit, and tells everyone; where there is no saving it, the log and whoever watches the service, too.
    pub fn edit(&mut self, edit: &Edit, author: &Author) -> Result<Outcome> {
        let edited = self.save(edit, author);
        let problems = edited.as_ref().err().map_or_else(Vec::new, |error| Problem::all(error.problems()));
        // who is in the way for a moment is no fault of the place, and PostgreSQL is looked after by itself
        let is_fault = |of: &Problem| {
            let is_lasting = |code: Code| code.http() == StatusCode::INTERNAL_SERVER_ERROR;
            of.is_of_the_database() && of.code.is_some_and(is_lasting)
        };
        let problems: Vec<Problem> = problems.into_iter().filter(is_fault).collect();
        self.unsaved = (!problems.is_empty()).then(Instant::now);
        self.shared.say_problems(Source::Saving, problems);
        edited
    }

    fn save(&mut self, edit: &Edit, author: &Author) -> Result<Outcome> {
        self.check_database()?;
        // what others did before has its own cause
        self.catch_up();
        self.lead()?;
        let edited = self.make(edit, author);
        self.live.cede();
        if edited.is_err() && self.live.view().generation() != self.shared.view.load().view.generation() {
            let outcome = self.live.reopen().map(Some);
            self.report(outcome, &Cause::itself("another program", EDITED));
        }
        let (outcome, has_files) = edited?;
        let (who, why) = (author.who.clone(), author.why.clone());
        let what = outcome.done.as_ref().map_or_else(String::new, |done| edit.words(done));
        self.publish(&outcome, &Cause { who, why, what });
        if has_files {
            self.files_are_taken();
        }
        Ok(outcome)
    }

    /// Makes an edit; with it, whether it has files.
    fn make(&mut self, edit: &Edit, author: &Author) -> Result<(Outcome, bool)> {
        let has_files = !self.live.files_of(edit)?.is_empty();
        let outcome = if has_files {
            // the site as its files are: somebody may have saved another one a moment ago
            let site = self.shared.settings.open()?;
            self.live.edit_with_files(&site, edit, author)?
        } else {
            self.live.edit(edit, author)?
        };
        Ok((outcome, has_files))
    }

    /// Shows the site as it now is, and says what changed.
    pub fn publish(&mut self, outcome: &Outcome, cause: &Cause) {
        let seen = seen(&self.live);
        let what: Vec<&str> = std::iter::once(&cause.what)
            .chain(&outcome.reacted)
            .map(String::as_str)
            .filter(|what| !what.is_empty())
            .collect();
        let changed = Changed {
            generation: outcome.generation,
            layout: seen.view.layout().to_owned(),
            who: cause.who.clone(),
            why: cause.why.clone(),
            what: what.join("; "),
            rooms: outcome.rooms,
            doors: outcome.doors,
            anew: outcome.anew,
            ways: !self.shared.view.load().view.ways().are_those_of(&seen.view),
            at: seen.since.clone(),
        };
        self.shared.show(seen);
        self.shared.say(Event::changed(&changed));
        if outcome.anew {
            self.ask_ahead();
        }
    }

    /// Asks planners that the site has now for what they keep, while nobody waits: those of a site that was opened as it was built
    /// were asked nothing.
    fn ask_ahead(&mut self) {
        let ahead = self.live.to_make_ahead();
        let planners = ahead.planners();
        let are_asked = planners.iter().all(|one| self.asked.iter().any(|other| Arc::ptr_eq(one, other)));
        if are_asked {
            return;
        }
        self.asked = planners;
        let work = move || {
            // whoever opens the page of a service that has just begun comes first
            thread::sleep(FIRST_PAGE);
            side_by_side(|| ahead.make());
        };
        // where there is no thread to be had, whoever needs it waits for it
        thread::Builder::new().name("ahead".to_owned()).spawn(work).ok();
    }

    /// Keeps routes that were found anew; `false` where a change has overtaken them.
    pub fn keep(&mut self, renewal: &Renewal, trees: Vec<(i64, Vec<TreeRow>)>, last: bool) -> bool {
        match self.live.keep(renewal, trees, last) {
            Ok(true) => {
                let since = self.shared.view.load().since.clone();
                self.shared.show(Seen { since, ..seen(&self.live) });
                true
            }
            Ok(false) => false,
            Err(error) => {
                self.say_problems(Problem::all(error.problems()));
                false
            }
        }
    }

    /// Looks after what happened without us: files that were saved, edits of other programs, the clock.
    fn look_around(&mut self) {
        // said by whoever reads the rules next
        journal::recover(self.live.site().database()).ok();
        let now = self.look();
        // what still changes is being written: it is read when two looks agree
        if self.looked.as_ref() == Some(&now) && self.taken.as_ref() != Some(&now) {
            self.taken = Some(now.clone());
            self.take_files();
        }
        self.looked = Some(now);
        if self.unsaved.is_some_and(|failed| failed.elapsed() > REMEMBERED) {
            self.unsaved = None;
            self.shared.say_problems(Source::Saving, Vec::new());
        }
        if let Err(error) = self.check_database() {
            return self.say_problems(Problem::all(error.problems()));
        }
        self.catch_up();
    }

    /// Follows the clock and what other programs edited.
    fn catch_up(&mut self) {
        let outcome = self.live.catch_up();
        self.caught_up(outcome);
    }

    fn caught_up(&mut self, outcome: Result<Option<Outcome>>) {
        if self.live.has_new_files() {
            self.files_are_taken();
        }
        let source = if self.shared.settings.shared.is_some() { Source::Database } else { Source::Tables };
        match outcome {
            Ok(Some(outcome)) => self.publish(&outcome, &Cause::of(&outcome)),
            Ok(None) => self.show_routes(),
            Err(error) => return self.shared.say_problems(source, Problem::all(error.problems())),
        }
        if !self.live.is_cut_off() {
            self.shared.say_problems(source, Vec::new());
        }
    }

    /// Shows that kept routes are stale, or no longer, where nothing else changed.
    fn show_routes(&mut self) {
        let shown = self.shared.view.load();
        if self.live.view().routes_due() != shown.view.routes_due() {
            let since = shown.since.clone();
            self.shared.show(Seen { since, ..seen(&self.live) });
        }
    }

    /// Another service says that it wrote something.
    pub fn hear(&mut self) {
        self.catch_up();
    }

    /// Waits for the right to edit, of a site that other services edit, too; what they write meanwhile is followed.
    fn lead(&mut self) -> Result<()> {
        if self.shared.settings.shared.is_none() {
            return Ok(());
        }
        let began = Instant::now();
        loop {
            let leads = self.live.try_lead()?;
            let followed = self.live.follow_others();
            self.caught_up(followed);
            if leads || began.elapsed() > LEADING {
                // whoever does not have it by now is told so by the edit
                return Ok(());
            }
            thread::sleep(Duration::from_millis(15));
        }
    }

    /// Refuses to go on where the database is not the file any more that was opened: what is written is nowhere then.
    fn check_database(&self) -> Result<()> {
        if identity(self.live.site().database()) == self.database {
            return Ok(());
        }
        let message = "the site's database was removed or replaced while it was served: nothing can be saved";
        Err(Error::said(Code::DatabaseReplaced, message, Some("start the service again".to_owned())))
    }

    fn look(&mut self) -> Files {
        let settings = &self.shared.settings;
        self.eye.look(&|| settings.open())
    }

    /// Takes files as they now are. Those that cannot be used are said, and all stays as it was.
    fn take_files(&mut self) {
        let settings = &self.shared.settings;
        let outcome = settings.open().and_then(|site| self.live.open_again(site));
        if outcome.is_ok() {
            self.say_problems(Vec::new());
        }
        let before = self.shared.view.load().view.generation();
        let outcome = outcome.map(|outcome| Some(outcome).filter(|outcome| outcome.generation != before));
        self.report(outcome, &Cause::itself("files", "rules, map or settings were saved"));
    }

    /// Remembers that the files as they now are have been taken.
    fn files_are_taken(&mut self) {
        self.taken = Some(self.look());
        self.say_problems(Vec::new());
    }

    fn report(&mut self, outcome: Result<Option<Outcome>>, cause: &Cause) {
        match outcome {
            Ok(Some(outcome)) => self.publish(&outcome, cause),
            Ok(None) => {}
            Err(error) => self.say_problems(Problem::all(error.problems())),
        }
    }

    fn say_problems(&mut self, problems: Vec<Problem>) {
        self.shared.say_problems(Source::Site, problems);
    }
}
