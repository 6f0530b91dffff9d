//! Has the right to write last for as long as an edit takes, on a thread of its own.

use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use super::link::Link;
use super::log;
use super::place::Place;
use crate::error::{Error, Result};

#[derive(Default)]
struct State {
    fence: Option<i64>,
    ends: bool,
}

#[derive(Default)]
struct Shared {
    state: Mutex<State>,
    changed: Condvar,
}

impl Shared {
    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

pub(super) struct Upkeep {
    shared: Arc<Shared>,
    thread: Option<JoinHandle<()>>,
}

impl Upkeep {
    pub(super) fn start(place: &Place, (site, owner): (&str, &str), lasts: Duration) -> Result<Self> {
        let shared = Arc::new(Shared::default());
        let mut link = Link::new(place)?;
        let (site, owner, seen) = (site.to_owned(), owner.to_owned(), Arc::clone(&shared));
        let work = move || {
            let mut state = seen.state();
            while !state.ends {
                let Some(fence) = state.fence else {
                    state = seen.changed.wait(state).unwrap_or_else(PoisonError::into_inner);
                    continue;
                };
                let same = |state: &mut State| !state.ends && state.fence == Some(fence);
                let waited = seen.changed.wait_timeout_while(state, lasts / 3, same);
                let (after, waited) = waited.unwrap_or_else(PoisonError::into_inner);
                state = after;
                if waited.timed_out() {
                    drop(state);
                    // whoever lost it hears so when the edit is kept
                    log::extend(&mut link, &site, &owner, (fence, lasts)).ok();
                    state = seen.state();
                }
            }
        };
        let thread = std::thread::Builder::new().name("lease".to_owned()).spawn(work);
        let thread = thread.map_err(|source| Error::Io { path: "a thread".into(), source })?;
        Ok(Self { shared, thread: Some(thread) })
    }

    /// Keeps the right of this number up from now on, or none.
    pub(super) fn set(&self, fence: Option<i64>) {
        self.shared.state().fence = fence;
        self.shared.changed.notify_all();
    }
}

impl Drop for Upkeep {
    fn drop(&mut self) {
        self.shared.state().ends = true;
        self.shared.changed.notify_all();
        if let Some(thread) = self.thread.take() {
            thread.join().ok();
        }
    }
}
