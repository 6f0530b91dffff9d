//! What all requests share: the view that they read, the way to the one who writes, and the stream of events.
//!
//! This file, [`desk`](super::desk) and [`follower`](super::follower) know each other in a circle: a job is left here for the
//! desk, and what the desk made of it is shown here. What a job may touch is the desk, so its type cannot stand apart from
//! both. A follower is one of those that requests may ask for, and looks at what is shown.

use std::collections::BTreeMap;
use std::num::NonZero;
use std::sync::mpsc::{SyncSender, TrySendError};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::thread;
use std::time::Duration;

use adit_db::{Store, Tx};
use arc_swap::ArcSwap;
use parking::Readers;
use tokio::sync::{broadcast, oneshot, watch};

use super::desk::Desk;
use super::event::{Event, Problems};
use super::fault::{Answered, Fault};
use super::follower::Followers;
use super::settings::Settings;
use super::share::{Asker, Held, Place, Places, Spent, Stock};
use super::token::Tokens;
use super::waiting::Waiting;
use super::whereabouts::Whereabouts;
use crate::error::Result;
use crate::error::problem::Problem;
use crate::live::View;
use crate::site::calm::come_after_others;
use crate::state::State;

mod parking;

/// Something that is done where edits are done, one after the other.
pub type Job = Box<dyn FnOnce(&mut Desk) + Send>;

pub struct Shared {
    pub settings: Settings,
    /// The site after the last edit.
    pub view: ArcSwap<Seen>,
    /// Who may do what; `None`: whoever reaches the service may do all.
    pub tokens: watch::Sender<Option<Tokens>>,
    /// What subscribers hear.
    pub events: broadcast::Sender<Arc<Event>>,
    /// Turns true when the service ends.
    pub ending: watch::Sender<bool>,
    /// Requests that are worked on, or wait for that.
    pub at_work: Arc<Stock>,
    /// Connections, by address.
    pub connections: Arc<Stock>,
    /// Bytes of long answers that were not read yet.
    pub unread: Arc<Stock>,
    /// Places of requests that take the processor for milliseconds.
    pub turns: Arc<Places>,
    /// Places of long bodies that are read.
    pub bodies: Arc<Places>,
    /// Places of what takes long: previews, reasons.
    long: Arc<Places>,
    /// Places of questions in SQL, which need not wait until their caller's reasons are found.
    questions: Arc<Places>,
    /// The place at the desk: callers come there one after the other.
    at_desk: Arc<Places>,
    /// Places of routes that are found anew for whoever follows them.
    renewals: Arc<Places>,
    pub followers: Followers,
    pub whereabouts: Whereabouts,
    jobs: SyncSender<Job>,
    shown: (Mutex<u64>, Condvar),
    readers: Readers,
    subscribers: Arc<Stock>,
    problems: Mutex<BTreeMap<Source, Vec<Problem>>>,
}

/// Where problems come from. Those of one source do not wipe out those of another.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Source {
    Tokens,
    /// Where the site is kept, with others who write it.
    Database,
    /// The site: its rules, map, settings.
    Site,
    /// What other programs wrote into its tables.
    Tables,
    /// The last edit, where it was the place to save it that failed.
    Saving,
}

/// The site after an edit, and when that was.
pub struct Seen {
    pub view: View,
    /// When it became so, in UTC.
    pub since: String,
    /// What the expert should know: facts that are lost, tunings that count for nothing.
    pub notes: Vec<String>,
}

/// Previews, reasons and the like that one caller has worked on at once, and no more than there are cores; of questions in SQL
/// as many besides. Each may take a core, and memory; more wait.
const LONG: usize = 4;

/// Bodies beyond [`SHORT`] that are held at once, and those of one caller; more are not read yet.
const BODIES: (usize, usize) = (64, 8);

/// Bytes of a body, or of an answer, that are not worth counting.
pub const SHORT: usize = 64 << 10;

/// Bytes of long answers that wait for their readers, and those of one caller; more are told to come back.
const UNREAD: (usize, usize) = (256 << 20, 64 << 20);

/// Connections that are open at once, and those from one address.
const CONNECTIONS: (usize, usize) = (4_096, 2_048);

/// Events that a subscriber may lag behind before it is dropped.
const BACKLOG: usize = 256;

impl Shared {
    /// Of a site that was just opened.
    pub fn new(settings: Settings, seen: Seen, tokens: Option<Tokens>, jobs: SyncSender<Job>) -> Self {
        let cores = thread::available_parallelism().map_or(1, NonZero::get);
        let places = |(all, each): (usize, usize)| Places::new(all, each);
        let stock = |(all, each): (usize, usize)| Stock::new(all, each);
        let long = || places((cores.min(LONG) + 1, cores.min(LONG)));
        // a quarter is left for others, of few nothing
        let most = |all: usize| (all, all - all / 4);
        Self {
            shown: (Mutex::new(seen.view.generation()), Condvar::new()),
            readers: Readers::new(seen.view.site().database()),
            view: ArcSwap::from_pointee(seen),
            tokens: watch::channel(tokens).0,
            problems: Mutex::default(),
            events: broadcast::channel(BACKLOG).0,
            ending: watch::channel(false).0,
            subscribers: stock(most(settings.subscribers)),
            at_work: stock(most(settings.requests)),
            connections: stock(CONNECTIONS),
            unread: stock(UNREAD),
            // one more than there are cores: whoever comes while another takes them all begins at once
            turns: places((cores + 1, cores)),
            bodies: places(BODIES),
            long: long(),
            questions: long(),
            at_desk: places((1, 1)),
            renewals: places((cores + 1, cores)),
            followers: Followers::default(),
            whereabouts: Whereabouts::default(),
            settings,
            jobs,
        }
    }

    /// Asks a copy of what is known after all edits that were asked for before, on which others may be tried. There are no more
    /// copies than places. Where whoever asked hangs up, it is given up before its next stage.
    pub async fn on_fork<T: Send + 'static>(
        self: &Arc<Self>,
        asker: &Arc<Asker>,
        work: impl FnOnce(State) -> Result<T> + Send + 'static,
    ) -> Answered<T> {
        let (place, fork, _waits) = self.fork(asker).await?;
        after_others(place, move || work(fork)).await
    }

    /// The same for a robot that waits for its answer.
    pub async fn on_errand<T: Send + 'static>(
        self: &Arc<Self>,
        asker: &Arc<Asker>,
        work: impl FnOnce(State) -> Result<T> + Send + 'static,
    ) -> Answered<T> {
        let (place, fork, _waits) = self.fork(asker).await?;
        beside(place, move || work(fork)).await
    }

    /// A place, a copy of what is known, and what is to be held for as long as somebody waits.
    async fn fork(self: &Arc<Self>, asker: &Arc<Asker>) -> Answered<(Place, State, Arc<()>)> {
        let place = self.long.take(asker).await;
        let waits = Arc::new(());
        let fork = self.edit_at_desk(asker, &Waiting::default(), |desk| Ok(desk.live.fork())).await?;
        Ok((place, fork.waited_for_by(Arc::downgrade(&waits)), waits))
    }

    /// Has something done where edits are done, after all that was asked before; not where nobody waits for it any more.
    pub async fn edit_at_desk<T: Send + 'static>(
        &self,
        asker: &Arc<Asker>,
        waiting: &Waiting,
        work: impl FnOnce(&mut Desk) -> Answered<T> + Send + 'static,
    ) -> Answered<T> {
        let place = self.at_desk.take(asker).await;
        let (answer, answered) = oneshot::channel();
        let waiting = waiting.clone();
        let job: Job = Box::new(move |desk| {
            // whoever asked may have gone: the place is free when the work is done
            let _place = place;
            if !answer.is_closed() && waiting.begin() {
                answer.send(work(desk)).ok();
            }
        });
        self.jobs.try_send(job).map_err(|error| match error {
            TrySendError::Full(_) => Fault::busy(),
            TrySendError::Disconnected(_) => Fault::ending(),
        })?;
        // a job that panicked leaves no answer, nor does one that was not begun when the service ended
        answered.await.map_err(|_| if *self.ending.borrow() { Fault::ending() } else { Fault::internal() })?
    }

    /// Has something done where edits are done, and does not wait for it; `false` where too much waits already.
    pub fn leave_at_desk(&self, work: impl FnOnce(&mut Desk) + Send + 'static) -> bool {
        self.jobs.try_send(Box::new(work)).is_ok()
    }

    /// Reads one state of the database, beside all that goes on.
    pub async fn read<T: Send + 'static>(
        self: &Arc<Self>,
        place: Option<Arc<Place>>,
        work: impl FnOnce(&mut Tx<'_>) -> Result<T> + Send + 'static,
    ) -> Answered<T> {
        let shared = Arc::clone(self);
        beside(place, move || shared.readers.with(|store| store.snapshot(work))).await
    }

    /// Answers a question of somebody's, with the whole store; few such questions are answered at once.
    pub async fn query<T: Send + 'static>(
        self: &Arc<Self>,
        asker: &Arc<Asker>,
        work: impl FnOnce(&mut Store) -> Result<T> + Send + 'static,
    ) -> Answered<T> {
        let (shared, place) = (Arc::clone(self), self.questions.take(asker).await);
        after_others(place, move || shared.readers.with(work)).await
    }

    /// Finds a route anew for whoever follows it; no more at once than there are cores, since an edit concerns all followers.
    pub async fn renew<T: Send + 'static>(
        &self,
        asker: &Arc<Asker>,
        work: impl FnOnce() -> T + Send + 'static,
    ) -> Answered<T> {
        let place = self.renewals.take(asker).await;
        beside(place, || Ok::<T, Fault>(work())).await
    }

    /// Closes all connections that read; requests must have ended.
    pub fn stop_reading(&self) {
        self.readers.close();
    }

    /// Shows the site as it now is.
    pub fn show(&self, seen: Seen) {
        let generation = seen.view.generation();
        self.view.store(Arc::new(seen));
        *self.shown.0.lock().unwrap_or_else(PoisonError::into_inner) = generation;
        self.shown.1.notify_all();
    }

    /// Waits until another state is shown than that of this number, or the time is over.
    pub fn wait_for_change(&self, generation: u64, patience: Duration) {
        let shown = self.shown.0.lock().unwrap_or_else(PoisonError::into_inner);
        drop(self.shown.1.wait_timeout_while(shown, patience, |shown| *shown == generation));
    }

    /// Does something that takes a core for long, beside all that goes on; few such things are done at once.
    pub async fn at_length<T: Send + 'static>(
        &self,
        asker: &Arc<Asker>,
        work: impl FnOnce() -> Result<T> + Send + 'static,
    ) -> Answered<T> {
        let place = self.long.take(asker).await;
        after_others(place, work).await
    }

    /// What is wrong with files that were saved, or with the place where edits are saved; the service goes on with what was
    /// before.
    pub fn problems(&self) -> Vec<Problem> {
        let problems = self.problems.lock().unwrap_or_else(PoisonError::into_inner);
        problems.values().flatten().cloned().collect()
    }

    /// What keeps edits from being saved.
    pub fn hindrances(&self) -> Vec<Problem> {
        let mut problems = self.problems();
        problems.retain(Problem::is_of_the_database);
        problems
    }

    /// Tells subscribers and the log what is wrong now with what comes from there, unless they know.
    pub fn say_problems(&self, source: Source, found: Vec<Problem>) {
        let mut problems = self.problems.lock().unwrap_or_else(PoisonError::into_inner);
        if problems.get(&source).is_some_and(|known| *known == found) {
            return;
        }
        for problem in &found {
            (self.settings.log)(&problem.to_string());
        }
        let was_wrong = problems.insert(source, found).is_some_and(|known| !known.is_empty());
        let problems: Vec<Problem> = problems.values().flatten().cloned().collect();
        if was_wrong || !problems.is_empty() {
            self.say(Event::new("problems", &Problems { problems }));
        }
    }

    /// Tells subscribers; nobody may be there.
    pub fn say(&self, event: Event) {
        self.events.send(Arc::new(event)).ok();
    }

    /// A place among the subscribers, until it is dropped.
    pub fn subscribe(&self, asker: &Arc<Asker>) -> std::result::Result<Subscription, Spent> {
        let held = self.subscribers.hold(asker, 1)?;
        Ok(Subscription { events: self.events.subscribe(), _held: held })
    }

    /// How many subscribers there are.
    pub fn subscribed(&self) -> usize {
        self.subscribers.held()
    }
}

/// Does something that takes a thread for a while. Whoever asked may hang up: the place is free when the work is done.
pub async fn beside<T: Send + 'static, E: Into<Fault> + Send + 'static>(
    place: impl Send + 'static,
    work: impl FnOnce() -> std::result::Result<T, E> + Send + 'static,
) -> Answered<T> {
    let placed = move || {
        let _place = place;
        work()
    };
    tokio::task::spawn_blocking(placed).await.map_err(|_| Fault::internal())?.map_err(Into::into)
}

/// The same for what takes long: on a thread of its own that comes after those on which robots' questions are answered.
async fn after_others<T: Send + 'static, E: Into<Fault> + Send + 'static>(
    place: Place,
    work: impl FnOnce() -> std::result::Result<T, E> + Send + 'static,
) -> Answered<T> {
    let (answer, answered) = oneshot::channel();
    let placed = move || {
        let _place = place;
        come_after_others();
        answer.send(work()).ok();
    };
    thread::Builder::new().name("long".to_owned()).spawn(placed).map_err(|_| Fault::busy())?;
    // work that panicked leaves no answer
    answered.await.map_err(|_| Fault::internal())?.map_err(Into::into)
}

pub struct Subscription {
    pub events: broadcast::Receiver<Arc<Event>>,
    _held: Held,
}
