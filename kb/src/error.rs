//! What can go wrong, gathered from all crates, so that a caller has one type and the command line one printer.

pub(crate) mod problem;

use std::fmt;
use std::path::Path;

use miette::{Diagnostic, Report};

/// One or more problems, none of them half-done work: whatever failed has left the site as it was.
pub struct Error {
    problems: Vec<Report>,
}

/// The result of everything that can fail.
pub type Result<T> = std::result::Result<T, Error>;

impl Error {
    /// Several problems of one kind.
    pub fn all<D: Diagnostic + Send + Sync + 'static>(problems: impl IntoIterator<Item = D>) -> Self {
        Self { problems: problems.into_iter().map(Report::new).collect() }
    }

    /// A problem in one sentence, with what to do about it.
    pub fn said(code: &'static str, message: impl Into<String>, help: Option<String>) -> Self {
        Self::all([Said { code, message: message.into(), help }])
    }

    /// A file that cannot be read or written.
    pub fn io(doing: &str, path: &Path, error: &std::io::Error) -> Self {
        Self::said("file/unreadable", format!("cannot {doing} {}: {error}", path.display()), None)
    }

    /// The problems, one by one.
    pub fn into_problems(self) -> Vec<Report> {
        self.problems
    }

    /// The problems, to be printed one by one.
    pub fn problems(&self) -> &[Report] {
        &self.problems
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, problem) in self.problems.iter().enumerate() {
            if index > 0 {
                writeln!(f)?;
            }
            write!(f, "{problem}")?;
        }
        Ok(())
    }
}

impl fmt::Debug for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for problem in &self.problems {
            writeln!(f, "{problem:?}")?;
        }
        Ok(())
    }
}

impl std::error::Error for Error {}

impl From<adit_db::Error> for Error {
    fn from(error: adit_db::Error) -> Self {
        let help = match &error {
            adit_db::Error::Missing(_) => Some("`adit build` makes it".to_owned()),
            adit_db::Error::NotAdit(_) => {
                Some("build the site first, then make tables of your own in its site.db; or name another file with --db".to_owned())
            }
            _ => None,
        };
        let code = match &error {
            adit_db::Error::Refused { .. }
            | adit_db::Error::Conflict { .. }
            | adit_db::Error::UnknownTable(_)
            | adit_db::Error::UnknownColumn { .. }
            | adit_db::Error::UnknownKey { .. }
            | adit_db::Error::AmbiguousKey { .. }
            | adit_db::Error::NotEditable(_)
            | adit_db::Error::NotANumber { .. } => "database/refused",
            error if error.is_busy() => "database/locked",
            _ => "database",
        };
        Self::said(code, error.to_string(), help)
    }
}

/// A problem without a place in a text.
#[derive(Debug, thiserror::Error)]
#[error("{message}")]
struct Said {
    code: &'static str,
    message: String,
    help: Option<String>,
}

impl Diagnostic for Said {
    fn code<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new(self.code))
    }

    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.help.as_ref().map(|help| Box::new(help) as _)
    }
}
