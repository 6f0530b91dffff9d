//! What all requests share: the view that they read, the way to the one who writes, and the stream of events.
//!
//! This file, [`desk`](super::desk) and [`follower`](super::follower) know each other in a circle: a job is left here for the
//! desk, and what the desk made of it is shown here. What a job may touch is the desk, so its type cannot stand apart from
//! both. A follower is one of those that requests may ask for, and looks at what is shown.

use std::collections::BTreeMap;
use std::num::NonZero;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{SyncSender, TrySendError};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::thread;
use std::time::Duration;

use adit_db::{Store, Tx};
use arc_swap::ArcSwap;
use parking::Readers;
use tokio::sync::{Semaphore, broadcast, oneshot, watch};

use super::desk::Desk;
use super::event::{Event, Problems};
use super::fault::{Answered, Fault};
use super::follower::Followers;
use super::settings::Settings;
use super::token::Tokens;
use super::waiting::Waiting;
use crate::error::Result;
use crate::error::problem::Problem;
use crate::live::View;
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
    /// Places of requests that are worked on.
    pub places: Semaphore,
    /// Places of what takes long.
    long: Arc<Semaphore>,
    /// Places of questions in SQL.
    queries: Arc<Semaphore>,
    /// Places of routes that are found anew for whoever follows them.
    renewals: Arc<Semaphore>,
    pub followers: Followers,
    jobs: SyncSender<Job>,
    shown: (Mutex<u64>, Condvar),
    readers: Readers,
    subscribers: AtomicUsize,
    problems: Mutex<BTreeMap<Source, Vec<Problem>>>,
}

/// Where problems come from. Those of one source do not wipe out those of another.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Source {
    Tokens,
    /// The site: its rules, map, settings, tables.
    Site,
}

/// The site after an edit, and when that was.
pub struct Seen {
    pub view: View,
    /// When it became so, in UTC.
    pub since: String,
    /// What the expert should know: facts that are lost, tunings that count for nothing.
    pub notes: Vec<String>,
}

/// Previews and the like that are worked on at once; more wait.
const LONG: usize = 4;

/// Questions in SQL that are worked on at once; more wait. Each may take a core, and memory.
const QUERIES: usize = 4;

/// Events that a subscriber may lag behind before it is dropped.
const BACKLOG: usize = 256;

impl Shared {
    /// Of a site that was just opened.
    pub fn new(settings: Settings, seen: Seen, tokens: Option<Tokens>, jobs: SyncSender<Job>) -> Self {
        Self {
            shown: (Mutex::new(seen.view.generation()), Condvar::new()),
            readers: Readers::new(seen.view.site().database()),
            view: ArcSwap::from_pointee(seen),
            tokens: watch::channel(tokens).0,
            problems: Mutex::default(),
            events: broadcast::channel(BACKLOG).0,
            ending: watch::channel(false).0,
            subscribers: AtomicUsize::new(0),
            places: Semaphore::new(settings.requests),
            long: Arc::new(Semaphore::new(LONG)),
            queries: Arc::new(Semaphore::new(QUERIES)),
            renewals: Arc::new(Semaphore::new(thread::available_parallelism().map_or(1, NonZero::get))),
            followers: Followers::default(),
            settings,
            jobs,
        }
    }

    /// A copy of what is known after all edits that were asked for before, to try others on.
    pub async fn fork(&self) -> Answered<State> {
        self.edit_at_desk(&Waiting::default(), |desk| Ok(desk.live.fork())).await
    }

    /// Has something done where edits are done, after all that was asked before; not where nobody waits for it any more.
    pub async fn edit_at_desk<T: Send + 'static>(
        &self,
        waiting: &Waiting,
        work: impl FnOnce(&mut Desk) -> Answered<T> + Send + 'static,
    ) -> Answered<T> {
        let (answer, answered) = oneshot::channel();
        let waiting = waiting.clone();
        let job: Job = Box::new(move |desk| {
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
        work: impl FnOnce(&mut Tx<'_>) -> Result<T> + Send + 'static,
    ) -> Answered<T> {
        let shared = Arc::clone(self);
        beside(move || shared.readers.with(|store| store.snapshot(work))).await
    }

    /// Answers a question of somebody's, with the whole store; few such questions are answered at once.
    pub async fn query<T: Send + 'static>(
        self: &Arc<Self>,
        work: impl FnOnce(&mut Store) -> Result<T> + Send + 'static,
    ) -> Answered<T> {
        let shared = Arc::clone(self);
        at_a_place(&self.queries, move || shared.readers.with(work)).await
    }

    /// Finds a route anew for whoever follows it; no more at once than there are cores, since an edit concerns all followers.
    pub async fn renew<T: Send + 'static>(&self, work: impl FnOnce() -> T + Send + 'static) -> Answered<T> {
        at_a_place(&self.renewals, || Ok(work())).await
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
        self: &Arc<Self>,
        work: impl FnOnce() -> Result<T> + Send + 'static,
    ) -> Answered<T> {
        at_a_place(&self.long, work).await
    }

    /// What is wrong with files that were saved; the service goes on with those of before.
    pub fn problems(&self) -> Vec<Problem> {
        let problems = self.problems.lock().unwrap_or_else(PoisonError::into_inner);
        problems.values().flatten().cloned().collect()
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

    /// A place among the subscribers, until it is dropped; `None` where all are taken.
    pub fn subscribe(self: &Arc<Self>) -> Option<Subscription> {
        let taken = self.subscribers.fetch_add(1, Ordering::Relaxed);
        let subscription = Subscription { shared: Arc::clone(self), events: self.events.subscribe() };
        (taken < self.settings.subscribers).then_some(subscription)
    }

    /// How many subscribers there are.
    pub fn subscribed(&self) -> usize {
        self.subscribers.load(Ordering::Relaxed)
    }
}

/// Does something once there is a place for it.
async fn at_a_place<T: Send + 'static>(
    places: &Arc<Semaphore>,
    work: impl FnOnce() -> Result<T> + Send + 'static,
) -> Answered<T> {
    let place = Arc::clone(places).acquire_owned().await.map_err(|_| Fault::internal())?;
    let placed = move || {
        // whoever asked may have gone: the place is free when the work is done
        let _place = place;
        work()
    };
    beside(placed).await
}

/// Does something that takes a thread for a while.
pub async fn beside<T: Send + 'static, E: Into<Fault> + Send + 'static>(
    work: impl FnOnce() -> std::result::Result<T, E> + Send + 'static,
) -> Answered<T> {
    tokio::task::spawn_blocking(work).await.map_err(|_| Fault::internal())?.map_err(Into::into)
}

pub struct Subscription {
    shared: Arc<Shared>,
    pub events: broadcast::Receiver<Arc<Event>>,
}

impl Drop for Subscription {
    fn drop(&mut self) {
        self.shared.subscribers.fetch_sub(1, Ordering::Relaxed);
    }
}
