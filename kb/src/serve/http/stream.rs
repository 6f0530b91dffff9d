//! Live events.

use std::convert::Infallible;
use std::sync::Arc;
use std::time::Duration;

use axum::http::HeaderMap;
use axum::response::sse::{self, KeepAlive, Sse};
use futures_util::Stream;
use futures_util::stream;
use tokio::sync::watch;

use super::extract::Site;
use crate::serve::event::{Event, Hello};
use crate::serve::fault::{Answered, Fault};
use crate::serve::gate;
use crate::serve::shared::Subscription;
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
    let subscription = site.subscribe().ok_or_else(Fault::busy)?;
    // subscribed before the state is read, so that no change falls between both
    let view = site.view.load().view.clone();
    let hello = Hello { generation: view.generation(), layout: view.layout().to_owned() };
    let first = Some(Arc::new(Event::new("hello", &hello)));
    let (ending, tokens) = (site.ending.subscribe(), site.tokens.subscribe());
    // and before the caller is looked at, so that no token is taken away between both
    gate::caller(&site, &headers)?;
    let events = stream::unfold((first, subscription, ending, tokens), next);
    Ok(Sse::new(events).keep_alive(KeepAlive::new().interval(ALIVE)))
}

type Place = (Option<Arc<Event>>, Subscription, watch::Receiver<bool>, watch::Receiver<Option<Tokens>>);

async fn next(
    (first, mut subscription, mut ending, mut tokens): Place,
) -> Option<(Result<sse::Event, Infallible>, Place)> {
    let event = if let Some(first) = first {
        first
    } else {
        tokio::select! {
            // who missed events begins anew, and learns where things stand
            event = subscription.events.recv() => event.ok()?,
            _ = ending.wait_for(|ends| *ends) => return None,
            // whoever still holds a token comes again with it
            _ = tokens.changed() => return None,
        }
    };
    let said = sse::Event::default().event(event.name).data(&event.data);
    Some((Ok(said), (None, subscription, ending, tokens)))
}
