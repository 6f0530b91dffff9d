//! Live events.

use std::convert::Infallible;
use std::sync::Arc;
use std::time::Duration;

use axum::http::HeaderMap;
use axum::response::sse::{self, KeepAlive, KeepAliveStream, Sse};
use futures_util::stream;
use futures_util::{Stream, StreamExt};
use tokio::sync::watch;

use super::extract::Site;
use crate::serve::event::{Event, Hello};
use crate::serve::fault::Answered;
use crate::serve::gate;
use crate::serve::shared::{Shared, Subscription};
use crate::serve::token::Tokens;

/// How often a stream on which nothing happens shows that it lives.
const ALIVE: Duration = Duration::from_secs(15);

/// Live events: `hello` first, then `changed` after each change, `routes` with the routes between places that cost more
/// or less, and `problems` when a file is saved that cannot be used. A reader that lags far behind is cut off.
#[utoipa::path(get, path = "/api/events", tag = "service",
    responses((status = 200, content_type = "text/event-stream", body = String)))]
pub async fn events(
    site: Site,
    headers: HeaderMap,
) -> Answered<Sse<impl Stream<Item = Result<sse::Event, Infallible>>>> {
    let subscription = site.subscribe(site.asker())?;
    // subscribed before the state is read, so that no change falls between both
    let view = site.view.load().view.clone();
    let hello = Hello { generation: view.generation(), layout: view.layout().to_owned() };
    let first = Some(Arc::new(Event::new("hello", &hello)));
    let over = Over::of(&site);
    // and before the caller is looked at, so that no token is taken away between both
    gate::caller(&site, &headers)?;
    Ok(sent(stream::unfold((first, subscription, over), next)))
}

/// Events as they go out, with signs of life where nothing happens.
pub fn sent(
    events: impl Stream<Item = Arc<Event>> + Send + 'static,
) -> Sse<KeepAliveStream<impl Stream<Item = Result<sse::Event, Infallible>>>> {
    let events = events.map(|event| Ok(sse::Event::default().event(event.name).data(&event.data)));
    Sse::new(events).keep_alive(KeepAlive::new().interval(ALIVE))
}

/// What ends a stream: the service ends, or tokens are others. Whoever still holds one comes again with it.
pub struct Over {
    ending: watch::Receiver<bool>,
    tokens: watch::Receiver<Option<Tokens>>,
}

impl Over {
    pub fn of(shared: &Shared) -> Self {
        Self { ending: shared.ending.subscribe(), tokens: shared.tokens.subscribe() }
    }

    /// Waits until it is so.
    pub async fn come(&mut self) {
        tokio::select! {
            _ = self.ending.wait_for(|ends| *ends) => {}
            _ = self.tokens.changed() => {}
        }
    }
}

type Place = (Option<Arc<Event>>, Subscription, Over);

async fn next((first, mut subscription, mut over): Place) -> Option<(Arc<Event>, Place)> {
    let event = if let Some(first) = first {
        first
    } else {
        tokio::select! {
            // who missed events begins anew, and learns where things stand
            event = subscription.events.recv() => event.ok()?,
            () = over.come() => return None,
        }
    };
    Some((event, (None, subscription, over)))
}
