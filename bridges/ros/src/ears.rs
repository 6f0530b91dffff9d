//! One thread that hears all topics and requests; what follows of them runs elsewhere.

use std::time::Duration;

use adit_site::say;
use anyhow::Context;
use ros2_client::dds::rustdds::mio1::{Events, Interest, Poll, Token, event::Source};
use ros2_client::{Message, Server, Subscription};

/// How long a wake-up that got lost may delay anything.
const AGAIN: Duration = Duration::from_millis(500);

/// How many messages that cannot be read are skipped at one go.
const SKIPPED: usize = 1000;

/// Takes what came, until nothing is left.
pub type Hear = Box<dyn FnMut() + Send>;

/// Whatever is heard, each with what to do.
pub struct Ears {
    poll: Poll,
    hears: Vec<Hear>,
}

impl Ears {
    pub fn new() -> anyhow::Result<Self> {
        Ok(Self {
            poll: Poll::new().context("the system has no way to wait for messages")?,
            hears: Vec::new(),
        })
    }

    /// Wakes up for this source from now on.
    pub fn wake_for(&mut self, source: &mut impl Source) -> anyhow::Result<()> {
        let token = Token(self.hears.len());
        self.poll.registry().register(source, token, Interest::READABLE).context("a topic cannot be heard")
    }

    /// What to do when one of the sources has something that were named since the last call.
    pub fn then(&mut self, hear: Hear) {
        self.hears.push(hear);
    }

    /// Hears a topic.
    pub fn topic<M: Message + Send + 'static>(
        &mut self,
        mut topic: Subscription<M>,
        name: String,
        mut on: impl FnMut(M) + Send + 'static,
    ) -> anyhow::Result<()> {
        self.wake_for(&mut topic)?;
        self.then(Box::new(move || {
            drain(&name, || Ok(topic.take().map_err(words)?.map(|(message, _)| message)), &mut on);
        }));
        Ok(())
    }

    /// Hears requests of a service.
    pub fn service<Q: Message + 'static, A: Message + 'static>(
        &mut self,
        service: Server<Q, A>,
        name: String,
        mut on: impl FnMut(&std::sync::Arc<Server<Q, A>>, ros2_client::RmwRequestId, Q) + Send + 'static,
    ) -> anyhow::Result<()>
    where
        Server<Q, A>: Send + Sync,
    {
        let mut service = service;
        self.wake_for(&mut service)?;
        let service = std::sync::Arc::new(service);
        self.then(Box::new(move || {
            drain(&name, || service.receive_request().map_err(words), &mut |(id, request)| {
                on(&service, id, request);
            });
        }));
        Ok(())
    }

    /// Hears until the program ends.
    pub fn listen(mut self) {
        let mut events = Events::with_capacity(256);
        loop {
            if let Err(error) = self.poll.poll(&mut events, Some(AGAIN))
                && error.kind() != std::io::ErrorKind::Interrupted
            {
                say(&format!("nothing is heard any more: {error}"));
                return;
            }
            let woken: Vec<usize> = events.iter().map(|event| event.token().0).collect();
            for (index, hear) in self.hears.iter_mut().enumerate() {
                if woken.is_empty() || woken.contains(&index) {
                    hear();
                }
            }
        }
    }
}

/// A library's error in words.
pub fn words(error: impl std::fmt::Debug) -> String {
    format!("{error:?}")
}

/// Takes all that is there. What cannot be read is said and skipped.
pub fn drain<T>(name: &str, mut take: impl FnMut() -> Result<Option<T>, String>, on: &mut impl FnMut(T)) {
    for _ in 0..SKIPPED {
        match take() {
            Ok(Some(message)) => on(message),
            Ok(None) => return,
            Err(error) => say(&format!("a message on {name} cannot be read and is skipped: {error}")),
        }
    }
}
