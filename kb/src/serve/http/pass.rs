//! What every request passes: its caller's share, the gate, a time in which it is answered, its body, and its turn.

use std::net::IpAddr;
use std::pin::pin;
use std::sync::Arc;
use std::time::Duration;

use axum::body::{Body, HttpBody};
use axum::extract::{Request, State};
use axum::http::header;
use axum::middleware::Next;
use axum::response::Response;
use futures_util::StreamExt;
use tokio::time::{sleep, timeout};

use super::extract::{BODY, too_large};
use super::portions::Portions;
use crate::error::Code;
use crate::serve::fault::{Answered, Fault};
use crate::serve::gate;
use crate::serve::role::Caller;
use crate::serve::share::{Asker, Turn};
use crate::serve::shared::{SHORT, Shared};
use crate::serve::waiting::Waiting;

/// How long whoever asks for more than the share waits for the refusal: who asks again at once costs next to nothing.
const PAUSE: Duration = Duration::from_secs(1);

/// From where a request comes.
#[derive(Clone, Copy)]
pub struct Peer(pub IpAddr);

/// Lets a request pass, or refuses it.
pub async fn pass(State(shared): State<Arc<Shared>>, request: Request, next: Next) -> Answered<Response> {
    let caller = gate::look(&shared, &request);
    let asker = Arc::new(asker(&request, caller.as_ref().ok()));
    let _at_work = match shared.at_work.hold(&asker, 1) {
        Ok(held) => held,
        Err(spent) => {
            sleep(PAUSE).await;
            return Err(spent.into());
        }
    };
    let waiting = Waiting::default();
    let mut answer = pin!(answer(&shared, request, next, caller, &asker, &waiting));
    let response = match timeout(shared.settings.patience, &mut answer).await {
        Ok(answer) => answer,
        Err(_) if waiting.give_up() => Err(Fault::late()),
        // an edit that the desk has begun is waited for: it will be made, and its caller must not hear otherwise
        Err(_) => answer.await,
    }?;
    portioned(&shared, &asker, response)
}

/// Who is meant by one caller: whoever holds a token, or else an address.
fn asker(request: &Request, caller: Option<&Caller>) -> Asker {
    let is_holder = request.headers().contains_key(header::AUTHORIZATION);
    match caller.filter(|caller| is_holder && !caller.roles.is_empty()) {
        Some(caller) => Asker::Holder(caller.name.clone()),
        None => request.extensions().get::<Peer>().map_or_else(Asker::unknown, |peer| Asker::at(peer.0)),
    }
}

async fn answer(
    shared: &Arc<Shared>,
    mut request: Request,
    next: Next,
    caller: Answered<Caller>,
    asker: &Arc<Asker>,
    waiting: &Waiting,
) -> Answered<Response> {
    let turn = Arc::new(Turn::new(&shared.turns, asker));
    let caller = match caller {
        Ok(caller) => caller,
        Err(fault) => {
            turn.take().await;
            return Err(fault);
        }
    };
    // the whole body is there before the turn comes: who sends slowly keeps nobody waiting
    let size = request.body().size_hint().upper();
    let _place = match size {
        Some(size) if size <= SHORT as u64 => None,
        _ => Some(shared.bodies.take(asker).await),
    };
    if !request.body().is_end_stream() {
        request = whole(request).await?;
    }
    turn.take().await;
    let extensions = request.extensions_mut();
    extensions.insert(caller);
    extensions.insert(waiting.clone());
    extensions.insert(turn);
    Ok(next.run(request).await)
}

async fn whole(request: Request) -> Answered<Request> {
    let (head, body) = request.into_parts();
    let mut bytes = Vec::new();
    let mut body = body.into_data_stream();
    while let Some(part) = body.next().await {
        let part =
            part.map_err(|error| Fault::new(Code::ServiceRefused, format!("the body breaks off: {error}")))?;
        if bytes.len() + part.len() > BODY {
            return Err(too_large());
        }
        bytes.extend_from_slice(&part);
    }
    Ok(Request::from_parts(head, Body::from(bytes)))
}

/// A long answer is counted until its reader has it, and goes out in portions.
fn portioned(shared: &Shared, asker: &Arc<Asker>, response: Response) -> Answered<Response> {
    match response.body().size_hint().exact() {
        Some(size) if size > SHORT as u64 => {
            let held = shared.unread.hold(asker, size as usize)?;
            Ok(response.map(|body| Body::new(Portions::new(body, held))))
        }
        _ => Ok(response),
    }
}
