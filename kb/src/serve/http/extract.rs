//! What requests bring, taken apart; what cannot be is a failure in the one shape.

use std::convert::Infallible;
use std::ops::Deref;
use std::sync::Arc;

use adit_db::{Store, Tx};
use axum::extract::rejection::JsonRejection;
use axum::extract::{FromRequest, FromRequestParts, Json, Query, Request};
use axum::http::StatusCode;
use axum::http::request::Parts;
use serde::de::DeserializeOwned;

use crate::error::Code;
use crate::error::Result as Done;
use crate::serve::desk::Desk;
use crate::serve::fault::{Answered, Fault};
use crate::serve::role::Caller;
use crate::serve::share::{Asker, Turn};
use crate::serve::shared::{Shared, beside};
use crate::serve::waiting::Waiting;
use crate::state::State;

/// The longest body that is read, bytes.
pub const BODY: usize = 2 << 20;

/// What every handler is given: what all requests share, whether this one is still waited for, and its turn.
pub struct Site {
    pub shared: Arc<Shared>,
    pub waiting: Waiting,
    turn: Arc<Turn>,
}

impl Site {
    /// Whose request this is.
    pub fn asker(&self) -> &Arc<Asker> {
        &self.turn.asker
    }

    /// Has an edit made, if its turn comes while its caller waits.
    pub async fn edit_at_desk<T: Send + 'static>(
        &self,
        work: impl FnOnce(&mut Desk) -> Answered<T> + Send + 'static,
    ) -> Answered<T> {
        self.turn.aside(self.shared.edit_at_desk(self.asker(), &self.waiting, work)).await
    }

    /// Does something that takes milliseconds, beside all that goes on.
    pub async fn beside<T: Send + 'static, E: Into<Fault> + Send + 'static>(
        &self,
        work: impl FnOnce() -> Result<T, E> + Send + 'static,
    ) -> Answered<T> {
        beside(self.turn.place(), work).await
    }

    /// Reads one state of the database, beside all that goes on.
    pub async fn read<T: Send + 'static>(
        &self,
        work: impl FnOnce(&mut Tx<'_>) -> Done<T> + Send + 'static,
    ) -> Answered<T> {
        self.shared.read(self.turn.place(), work).await
    }

    /// Answers a question of somebody's, with the whole store; few such questions are answered at once.
    pub async fn query<T: Send + 'static>(
        &self,
        work: impl FnOnce(&mut Store) -> Done<T> + Send + 'static,
    ) -> Answered<T> {
        self.turn.aside(self.shared.query(self.asker(), work)).await
    }

    /// Does something that takes a core for long, beside all that goes on; few such things are done at once.
    pub async fn at_length<T: Send + 'static>(
        &self,
        work: impl FnOnce() -> Done<T> + Send + 'static,
    ) -> Answered<T> {
        self.turn.aside(self.shared.at_length(self.asker(), work)).await
    }

    /// The same on a copy of what is known after all edits that were asked for before.
    pub async fn on_fork<T: Send + 'static>(
        &self,
        work: impl FnOnce(State) -> Done<T> + Send + 'static,
    ) -> Answered<T> {
        self.turn.aside(self.shared.on_fork(self.asker(), work)).await
    }

    /// The same for a robot that waits for its answer.
    pub async fn on_errand<T: Send + 'static>(
        &self,
        work: impl FnOnce(State) -> Done<T> + Send + 'static,
    ) -> Answered<T> {
        self.turn.aside(self.shared.on_errand(self.asker(), work)).await
    }
}

impl Deref for Site {
    type Target = Arc<Shared>;

    fn deref(&self) -> &Arc<Shared> {
        &self.shared
    }
}

impl FromRequestParts<Arc<Shared>> for Site {
    type Rejection = Infallible;

    async fn from_request_parts(parts: &mut Parts, shared: &Arc<Shared>) -> Result<Self, Infallible> {
        let waiting = parts.extensions.get().cloned().unwrap_or_default();
        let turn = parts.extensions.get().cloned();
        let turn = turn.unwrap_or_else(|| Arc::new(Turn::new(&shared.turns, &Arc::new(Asker::unknown()))));
        Ok(Self { shared: Arc::clone(shared), waiting, turn })
    }
}

pub struct Body<T>(pub T);

impl<T: DeserializeOwned, S: Send + Sync> FromRequest<S> for Body<T> {
    type Rejection = Fault;

    async fn from_request(request: Request, state: &S) -> Result<Self, Fault> {
        match Json::<T>::from_request(request, state).await {
            Ok(Json(value)) => Ok(Self(value)),
            Err(rejection) => Err(body_fault(&rejection)),
        }
    }
}

fn body_fault(rejection: &JsonRejection) -> Fault {
    let fault = |code| Fault::new(code, rejection.body_text());
    match rejection {
        JsonRejection::JsonDataError(_) => fault(Code::ServiceBody),
        JsonRejection::MissingJsonContentType(_) => {
            fault(Code::ServiceContentType).helped("send `Content-Type: application/json`")
        }
        _ if rejection.status() == StatusCode::PAYLOAD_TOO_LARGE => fault(Code::ServiceTooLarge),
        _ => fault(Code::ServiceSyntax),
    }
}

/// What stands behind the question mark.
pub struct Asked<T>(pub T);

impl<T: DeserializeOwned, S: Send + Sync> FromRequestParts<S> for Asked<T> {
    type Rejection = Fault;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Fault> {
        match Query::<T>::from_request_parts(parts, state).await {
            Ok(Query(value)) => Ok(Self(value)),
            Err(rejection) => Err(Fault::new(Code::ServiceQuestion, rejection.body_text())),
        }
    }
}

/// A part of the path.
pub struct Named<T>(pub T);

impl<T: DeserializeOwned + Send, S: Send + Sync> FromRequestParts<S> for Named<T> {
    type Rejection = Fault;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Fault> {
        match axum::extract::Path::<T>::from_request_parts(parts, state).await {
            Ok(axum::extract::Path(value)) => Ok(Self(value)),
            Err(rejection) => Err(Fault::new(Code::ServicePath, rejection.body_text())),
        }
    }
}

impl<S: Send + Sync> FromRequestParts<S> for Caller {
    type Rejection = Fault;

    async fn from_request_parts(parts: &mut Parts, _: &S) -> Result<Self, Fault> {
        // the gate put it there; without it nobody is known, who may do nothing
        Ok(parts.extensions.get::<Self>().cloned().unwrap_or(Self { name: String::new(), roles: Vec::new() }))
    }
}

pub fn too_large() -> Fault {
    Fault::new(Code::ServiceTooLarge, format!("a body may have {BODY} bytes"))
}
