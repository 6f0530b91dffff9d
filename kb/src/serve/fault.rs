//! What a request that fails is answered with: one shape of JSON, whatever went wrong.

use axum::Json;
use axum::http::{HeaderValue, header};
use axum::response::{IntoResponse, Response};
use serde::Serialize;
use utoipa::ToSchema;

use super::share::Spent;
use crate::error::problem::Problem;
use crate::error::{Code, Error};

/// The body of every answer with a status of 400 or more.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub struct Failure {
    pub error: Fault,
}

#[derive(Clone, Debug, Serialize, ToSchema)]
pub struct Fault {
    /// The HTTP status: that of the code.
    status: u16,
    pub code: Code,
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

pub type Answered<T> = Result<T, Fault>;

impl Fault {
    pub fn new(code: Code, message: impl Into<String>) -> Self {
        let (status, message) = (code.http().as_u16(), message.into());
        Self { status, code, message, help: None, problems: Vec::new(), current: None }
    }

    /// A defect of the service itself; the log says more.
    pub fn internal() -> Self {
        let message = "something went wrong here that should not have; the log of the service says more";
        Self::new(Code::ServiceInternal, message)
    }

    /// An answer that takes too long; what was asked for is not begun, and will not be.
    pub fn late() -> Self {
        let message = "the answer took too long, and nothing was changed";
        Self::new(Code::ServiceLate, message)
    }

    /// The service ends before it came to what was asked for.
    pub fn ending() -> Self {
        let message = "the service ends, and nothing was changed";
        Self::new(Code::ServiceEnding, message)
    }

    /// More is asked at once than can be answered.
    pub fn busy() -> Self {
        let message = "too much is asked at once; try again in a moment";
        Self::new(Code::ServiceBusy, message)
    }

    /// One caller asks for more at once than its share.
    pub fn share() -> Self {
        let message =
            "you ask for more at once than one caller may while others ask, too; try again in a moment";
        Self::new(Code::ServiceShare, message)
    }

    #[must_use]
    pub fn with_problems(mut self, problems: Vec<Problem>) -> Self {
        self.problems = problems;
        self
    }

    #[must_use]
    pub fn helped(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }
}

impl From<Error> for Fault {
    fn from(error: Error) -> Self {
        let problems = Problem::all(error.problems());
        let Some(first) = problems.first() else { return Self::internal() };
        let message = match problems.len() {
            1 => first.message.clone(),
            more => format!("{}; and {} more", first.message, more - 1),
        };
        let (code, help) = (first.code.unwrap_or(Code::ServiceInternal), first.help.clone());
        Self { help, ..Self::new(code, message).with_problems(problems) }
    }
}

impl From<Spent> for Fault {
    fn from(spent: Spent) -> Self {
        match spent {
            Spent::Share => Self::share(),
            Spent::All => Self::busy(),
        }
    }
}

impl From<adit_db::Error> for Fault {
    fn from(error: adit_db::Error) -> Self {
        Error::from(error).into()
    }
}

impl IntoResponse for Fault {
    fn into_response(self) -> Response {
        let code = self.code;
        let mut response = (code.http(), Json(Failure { error: self })).into_response();
        if matches!(code, Code::ServiceBusy | Code::ServiceShare) {
            response.headers_mut().insert(header::RETRY_AFTER, HeaderValue::from_static("1"));
        }
        response
    }
}
