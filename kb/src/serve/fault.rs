//! What a request that fails is answered with: one shape of JSON, whatever went wrong.

use axum::Json;
use axum::http::StatusCode;
use axum::response::{IntoResponse, Response};
use serde::Serialize;
use utoipa::ToSchema;

use crate::error::Error;
use crate::error::problem::Problem;

/// The body of every answer with a status of 400 or more.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub struct Failure {
    /// What went wrong.
    pub error: Fault,
}

/// What went wrong.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub struct Fault {
    /// The HTTP status.
    pub status: u16,
    /// Its kind, as `edit/conflict`.
    pub code: String,
    /// In one sentence.
    pub message: String,
    /// What to do about it.
    pub help: Option<String>,
    /// Each problem with its place, where rules, tests or files are wrong.
    pub problems: Vec<Problem>,
    /// What is there now, where an edit expected something else.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(value_type = Option<serde_json::Value>)]
    pub current: Option<Box<serde_json::Value>>,
}

/// The outcome of everything that answers.
pub type Answered<T> = Result<T, Fault>;

impl Fault {
    /// A failure in one sentence.
    pub fn new(status: StatusCode, code: &str, message: impl Into<String>) -> Self {
        Self {
            status: status.as_u16(),
            code: code.to_owned(),
            message: message.into(),
            help: None,
            problems: Vec::new(),
            current: None,
        }
    }

    /// A request that cannot be understood.
    pub fn bad(code: &str, message: impl Into<String>) -> Self {
        Self::new(StatusCode::BAD_REQUEST, code, message)
    }

    /// Something that is not there.
    pub fn missing(code: &str, message: impl Into<String>) -> Self {
        Self::new(StatusCode::NOT_FOUND, code, message)
    }

    /// Something that is another by now than the caller thought.
    pub fn conflict(code: &str, message: impl Into<String>) -> Self {
        Self::new(StatusCode::CONFLICT, code, message)
    }

    /// A defect of the service itself; the log says more.
    pub fn internal() -> Self {
        let message = "something went wrong here that should not have; the log of the service says more";
        Self::new(StatusCode::INTERNAL_SERVER_ERROR, "service/internal", message)
    }

    /// An answer that takes too long; what was asked for is not begun, and will not be.
    pub fn late() -> Self {
        let message = "the answer took too long, and nothing was changed";
        Self::new(StatusCode::SERVICE_UNAVAILABLE, "service/late", message)
    }

    /// The service ends before it came to what was asked for.
    pub fn ending() -> Self {
        let message = "the service ends, and nothing was changed";
        Self::new(StatusCode::SERVICE_UNAVAILABLE, "service/ending", message)
    }

    /// More is asked at once than can be answered.
    pub fn busy() -> Self {
        let message = "too much is asked at once; try again in a moment";
        Self::new(StatusCode::SERVICE_UNAVAILABLE, "service/busy", message)
    }

    /// With what to do about it.
    #[must_use]
    pub fn helped(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }
}

impl From<Error> for Fault {
    fn from(error: Error) -> Self {
        let problems = Problem::all(error.problems());
        let Some(first) = problems.first().cloned() else { return Self::internal() };
        let code = first.code.unwrap_or_else(|| "failed".to_owned());
        let message = match problems.len() {
            1 => first.message,
            more => format!("{}; and {} more", first.message, more - 1),
        };
        Self { status: status(&code).as_u16(), code, message, help: first.help, problems, current: None }
    }
}

impl From<adit_db::Error> for Fault {
    fn from(error: adit_db::Error) -> Self {
        Error::from(error).into()
    }
}

/// The status that a kind of problem has.
fn status(code: &str) -> StatusCode {
    let (class, kind) = code.split_once('/').unwrap_or((code, ""));
    match (class, kind) {
        ("rule" | "rules" | "test" | "map" | "rooms" | "site" | "hours", _) => {
            StatusCode::UNPROCESSABLE_ENTITY
        }
        (_, "missing" | "nothing-to-undo") => StatusCode::NOT_FOUND,
        (_, kind) if kind.starts_with("unknown") => StatusCode::NOT_FOUND,
        ("database", "refused") => StatusCode::BAD_REQUEST,
        ("database", "locked") => StatusCode::SERVICE_UNAVAILABLE,
        ("planner", _) => StatusCode::UNPROCESSABLE_ENTITY,
        ("file" | "database" | "live", _) => StatusCode::INTERNAL_SERVER_ERROR,
        _ => StatusCode::BAD_REQUEST,
    }
}

impl IntoResponse for Fault {
    fn into_response(self) -> Response {
        let status = StatusCode::from_u16(self.status).unwrap_or(StatusCode::INTERNAL_SERVER_ERROR);
        (status, Json(Failure { error: self })).into_response()
    }
}
