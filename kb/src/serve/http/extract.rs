//! What requests bring, taken apart; what cannot be is a failure in the one shape.

use axum::extract::rejection::JsonRejection;
use axum::extract::{FromRequest, FromRequestParts, Json, Query, Request};
use axum::http::StatusCode;
use axum::http::request::Parts;
use serde::de::DeserializeOwned;

use crate::error::Code;
use crate::serve::fault::Fault;
use crate::serve::role::Caller;
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
