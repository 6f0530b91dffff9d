//! Problems as programs read them.

use std::fmt;

use miette::Severity;
use serde::Serialize;
use utoipa::ToSchema;

use super::{Code, Finding, Nearest};

/// One thing that is wrong, or that one should know, with its place where it has one.
#[derive(Clone, Debug, PartialEq, Serialize, ToSchema)]
pub struct Problem {
    /// What kind of thing is wrong; null for a note.
    pub code: Option<Code>,
    /// error, warning or advice.
    pub severity: &'static str,
    /// In one sentence.
    pub message: String,
    pub file: Option<String>,
    /// Line, from 1.
    pub line: Option<usize>,
    /// Column, from 1.
    pub column: Option<usize>,
    /// Line where the place ends.
    pub end_line: Option<usize>,
    /// The column after its last character.
    pub end_column: Option<usize>,
    /// What to do about it.
    pub help: Option<String>,
    /// What could be taken instead of the point of a route that is refused.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub nearest: Option<Nearest>,
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { file, line, column, message, help, .. } = self;
        let place =
            [file.clone(), line.map(|line| line.to_string()), column.map(|column| column.to_string())];
        for part in place.into_iter().flatten() {
            write!(f, "{part}:")?;
        }
        let space = if file.is_some() { " " } else { "" };
        write!(f, "{space}{message}")?;
        match help {
            Some(help) => write!(f, " ({help})"),
            None => Ok(()),
        }
    }
}

impl Problem {
    /// Whether it is the place where edits are saved that is at fault, and not what a caller or a file says.
    pub(crate) fn is_of_the_database(&self) -> bool {
        let is_it = |code: Code| {
            let (family, _) = code.as_str().split_once('/').unwrap_or((code.as_str(), ""));
            code.http().is_server_error() && ["database", "postgres"].contains(&family)
        };
        self.code.is_some_and(is_it)
    }

    pub(crate) fn of(found: &Finding) -> Self {
        let diagnostic = found.diagnostic();
        let severity = match diagnostic.severity() {
            Some(Severity::Advice) => "advice",
            Some(Severity::Warning) => "warning",
            _ => "error",
        };
        let mut problem = Self {
            code: found.code(),
            severity,
            message: found.to_string(),
            file: None,
            line: None,
            column: None,
            end_line: None,
            end_column: None,
            help: diagnostic.help().map(|help| help.to_string()),
            nearest: found.nearest().cloned(),
        };
        let label = diagnostic.labels().and_then(|mut labels| labels.next());
        let place = diagnostic.source_code().zip(label);
        if let Some((text, label)) = place
            && let Ok(found) = text.read_span(label.inner(), 0, 0)
        {
            problem.file = found.name().map(str::to_owned);
            let (line, column) = (found.line() + 1, found.column() + 1);
            let marked = String::from_utf8_lossy(found.data());
            let length = |line: &str| line.chars().count();
            let (end_line, end_column) = match marked.rsplit_once('\n') {
                Some((before, last)) => (line + before.matches('\n').count() + 1, length(last) + 1),
                None => (line, column + length(&marked)),
            };
            (problem.line, problem.column) = (Some(line), Some(column));
            (problem.end_line, problem.end_column) = (Some(end_line), Some(end_column));
        }
        problem
    }

    pub(crate) fn all(found: &[Finding]) -> Vec<Self> {
        found.iter().map(Self::of).collect()
    }
}
