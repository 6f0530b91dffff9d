//! Who is there to hear answers. DDS may bring a client's request before it tells the server of the client's reader, and what is
//! written before that never gets there: it is sent again once the reader is known.

use std::collections::BTreeSet;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use anyhow::Context as _;
use ros2_client::dds::rustdds::GUID;
use ros2_client::{EntityKind, GraphEvent, Node, NodeEvent, RmwRequestId};

/// A reader that was not told of in this time is taken to be there: what tells of it may get lost, or it may be called otherwise.
const PATIENCE: Duration = Duration::from_secs(1);

/// How often it is looked whether the time of an answer has come.
const TICK: Duration = Duration::from_millis(100);

/// So many readers are remembered; then it begins anew.
const KEPT: usize = 10_000;

/// So many answers wait at most.
const WAITING: usize = 1_000;

/// The readers that are known, and answers that may have to be sent again.
#[derive(Default)]
pub struct Presence {
    inner: Mutex<Inner>,
}

#[derive(Default)]
struct Inner {
    here: BTreeSet<String>,
    waiting: Vec<Waiting>,
}

struct Waiting {
    reader: String,
    since: Instant,
    send: Box<dyn FnOnce() + Send>,
}

impl Presence {
    /// Hears of readers from now on. The node must have its spinner.
    pub fn of(node: &Node) -> anyhow::Result<Arc<Self>> {
        let events = node.status_receiver().context("the node does not hear who else is there")?;
        let presence = Arc::new(Self::default());
        let (hears, looks) = (Arc::clone(&presence), Arc::clone(&presence));
        // the events of one moment are more than their channel holds, so that they are taken at once
        let hear = move || {
            while let Ok(event) = events.recv_blocking() {
                if let NodeEvent::Graph(GraphEvent::EntityDeclared(entity)) = event
                    && entity.kind == EntityKind::Subscription
                {
                    hears.has_come(&entity.node_name);
                }
            }
        };
        std::thread::Builder::new().name("presence".to_owned()).spawn(hear).context("no thread to hear")?;
        tokio::spawn(async move {
            let mut ticks = tokio::time::interval(TICK);
            loop {
                ticks.tick().await;
                looks.looks();
            }
        });
        Ok(presence)
    }

    /// An answer was sent: `again` sends it once more, where its reader was not known yet.
    pub fn sent(&self, request: &RmwRequestId, again: impl FnOnce() + Send + 'static) {
        let reader = called(request);
        let mut inner = self.inner();
        if !inner.here.contains(&reader) && inner.waiting.len() < WAITING {
            inner.waiting.push(Waiting { reader, since: Instant::now(), send: Box::new(again) });
        }
    }

    fn inner(&self) -> MutexGuard<'_, Inner> {
        self.inner.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn has_come(&self, reader: &str) {
        let mut inner = self.inner();
        if inner.here.len() >= KEPT {
            inner.here.clear();
        }
        inner.here.insert(reader.to_owned());
        let due = inner.take(|waiting| waiting.reader == reader);
        drop(inner);
        for waiting in due {
            (waiting.send)();
        }
    }

    /// Sends what waited long enough.
    fn looks(&self) {
        let mut inner = self.inner();
        let due = inner.take(|waiting| waiting.since.elapsed() >= PATIENCE);
        for waiting in &due {
            inner.here.insert(waiting.reader.clone());
        }
        drop(inner);
        for waiting in due {
            (waiting.send)();
        }
    }
}

impl Inner {
    fn take(&mut self, is: impl Fn(&Waiting) -> bool) -> Vec<Waiting> {
        let (taken, kept) = std::mem::take(&mut self.waiting).into_iter().partition(is);
        self.waiting = kept;
        taken
    }
}

/// How the library calls the reader that a request wants its answer at.
fn called(request: &RmwRequestId) -> String {
    format!("guid:{:?}", GUID::from(request.writer_gid))
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::*;

    fn counted() -> (Arc<AtomicUsize>, impl FnOnce() + Send + 'static) {
        let count = Arc::new(AtomicUsize::new(0));
        let again = Arc::clone(&count);
        (count, move || {
            again.fetch_add(1, Ordering::Relaxed);
        })
    }

    #[test]
    fn an_answer_to_a_reader_that_comes_later_is_sent_once_more_and_to_one_that_is_there_it_is_not() {
        let (presence, request) = (Presence::default(), RmwRequestId::default());
        let (count, again) = counted();
        presence.sent(&request, again);
        presence.has_come("guid:somebody else");
        assert_eq!(count.load(Ordering::Relaxed), 0);
        presence.has_come(&called(&request));
        presence.has_come(&called(&request));
        assert_eq!(count.load(Ordering::Relaxed), 1);
        let (count, again) = counted();
        presence.sent(&request, again);
        presence.has_come(&called(&request));
        assert_eq!(count.load(Ordering::Relaxed), 0);
    }

    #[test]
    fn a_reader_that_is_never_told_of_gets_its_first_answer_twice() {
        let (presence, request) = (Presence::default(), RmwRequestId::default());
        let (first, again) = counted();
        presence.sent(&request, again);
        presence.inner().waiting[0].since -= PATIENCE;
        presence.looks();
        let (second, again) = counted();
        presence.sent(&request, again);
        presence.looks();
        assert_eq!((first.load(Ordering::Relaxed), second.load(Ordering::Relaxed)), (1, 0));
    }
}
