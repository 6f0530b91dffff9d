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

/// What axum and serde say is wrong with a request, without the names that values have in Rust.
fn said(text: &str) -> String {
    const WHOLE: &str = "a whole number from 0 on";
    const NAMES: [(&str, &str); 9] = [
        ("u8", WHOLE),
        ("u16", WHOLE),
        ("u32", WHOLE),
        ("u64", WHOLE),
        ("usize", WHOLE),
        ("i64", "a whole number"),
        ("f64", "a number"),
        ("a sequence", "an array"),
        ("a map", "an object"),
    ];
    const PARTS: [(&str, &str); 4] = [
        ("Failed to deserialize the JSON body into the target type: ", "the body is not as expected: "),
        ("Failed to parse the request body as JSON: ", "the body is no JSON: "),
        ("Failed to deserialize query string: ", "the question is not as expected: "),
        ("Invalid URL: ", "the address is not as expected: "),
    ];
    let (part, rest) = PARTS
        .iter()
        .find_map(|(theirs, ours)| Some((*ours, text.strip_prefix(theirs)?)))
        .unwrap_or(("", text));
    if let Some((value, name)) =
        rest.strip_prefix("Cannot parse `").and_then(|rest| rest.trim_end_matches('`').split_once("` to a `"))
        && let Some((_, words)) = NAMES.iter().find(|(theirs, _)| *theirs == name)
    {
        return format!("{part}found `{value}`, expected {words}");
    }
    let Some((found, expected)) = rest.rsplit_once("expected ") else { return format!("{part}{rest}") };
    if let Some(of) = expected.strip_prefix("struct ") {
        let place =
            of.split_once(" at line ").map_or_else(String::new, |(_, place)| format!(" at line {place}"));
        return format!("{part}{found}expected an object{place}");
    }
    let name = NAMES.iter().find_map(|(theirs, words)| {
        let rest = expected.strip_prefix(theirs)?;
        (rest.is_empty() || rest.starts_with(' ')).then(|| format!("{words}{rest}"))
    });
    format!("{part}{found}expected {}", name.as_deref().unwrap_or(expected))
}

fn body_fault(rejection: &JsonRejection) -> Fault {
    let fault = |code| Fault::new(code, said(&rejection.body_text()));
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
            Err(rejection) => Err(Fault::new(Code::ServiceQuestion, said(&rejection.body_text()))),
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
            Err(rejection) => Err(Fault::new(Code::ServicePath, said(&rejection.body_text()))),
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

#[cfg(test)]
mod tests {
    use super::said;

    #[test]
    fn what_is_wrong_with_a_request_is_said_without_names_of_rust() {
        let body = "Failed to deserialize the JSON body into the target type: ";
        for (theirs, ours) in [
            (
                format!(
                    "{body}invalid length 0, expected struct BlockedBody with 8 elements at line 1 column 2"
                ),
                "the body is not as expected: invalid length 0, expected an object at line 1 column 2",
            ),
            (
                format!(
                    "{body}for_seconds: invalid type: floating point `60.0`, expected u32 at line 1 column 9"
                ),
                "the body is not as expected: for_seconds: invalid type: floating point `60.0`, expected a whole number from 0 on at line 1 column 9",
            ),
            (
                format!("{body}edit: unknown variant `cloze`, expected one of `close`, `open`"),
                "the body is not as expected: edit: unknown variant `cloze`, expected one of `close`, `open`",
            ),
            (
                "Invalid URL: Cannot parse `abc` to a `i64`".to_owned(),
                "the address is not as expected: found `abc`, expected a whole number",
            ),
            (
                "Failed to parse the request body as JSON: expected `:` at line 1 column 5".to_owned(),
                "the body is no JSON: expected `:` at line 1 column 5",
            ),
        ] {
            assert_eq!(said(&theirs), ours);
        }
    }
}
