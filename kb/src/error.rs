//! What can go wrong, gathered from all crates, so that a caller has one type and the command line one printer.

pub(crate) mod code;
pub(crate) mod finding;
mod nearest;
pub(crate) mod problem;

use std::fmt;
use std::path::Path;

pub use code::Code;
pub use finding::Finding;
pub use nearest::Nearest;
pub use problem::Problem;

/// One or more problems, none of them half-done work: whatever failed has left the site as it was.
pub struct Error {
    problems: Vec<Finding>,
}

/// The result of everything that can fail.
pub type Result<T> = std::result::Result<T, Error>;

impl Error {
    /// Several problems of one kind.
    pub fn all(problems: impl IntoIterator<Item: Into<Finding>>) -> Self {
        Self { problems: problems.into_iter().map(Into::into).collect() }
    }

    /// A problem in one sentence, with what to do about it.
    pub fn said(code: Code, message: impl Into<String>, help: Option<String>) -> Self {
        Self::all([Finding::said(code, message, help)])
    }

    /// Makes what something else says into a problem with this code.
    pub(crate) fn of<E: fmt::Display>(code: Code) -> impl Fn(E) -> Self {
        move |error| Self::said(code, error.to_string(), None)
    }

    /// A file that cannot be read or written.
    pub fn io(doing: &str, path: &Path, error: &std::io::Error) -> Self {
        let (reason, help) = if error.kind() == std::io::ErrorKind::InvalidData {
            ("it is not UTF-8 text".to_owned(), Some("save it as plain text in UTF-8".to_owned()))
        } else {
            (error.to_string(), None)
        };
        Self::said(Code::FileUnreadable, format!("cannot {doing} {}: {reason}", path.display()), help)
    }

    pub(crate) fn into_problems(self) -> Vec<Finding> {
        self.problems
    }

    /// The problems, to be printed one by one.
    pub fn problems(&self) -> &[Finding] {
        &self.problems
    }

    /// The exit status of a program that ends with it: 1 where all that is wrong is that there is no route or that a
    /// check failed, else 2.
    pub fn exit(&self) -> u8 {
        let errors = self.problems.iter().filter(|problem| problem.is_error());
        errors.map(|problem| problem.code().map_or(2, Code::exit)).max().unwrap_or(2)
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
        for problem in Problem::all(&self.problems) {
            writeln!(f, "{problem}")?;
        }
        Ok(())
    }
}

impl std::error::Error for Error {}

impl From<adit_db::Error> for Error {
    fn from(error: adit_db::Error) -> Self {
        let help = match &error {
            adit_db::Error::Missing(file) => Some(match file.parent().filter(|_| file.ends_with("site.db")) {
                Some(site) if site != Path::new("") => format!("`adit build {}` makes it", site.display()),
                _ => "`adit build` makes it".to_owned(),
            }),
            adit_db::Error::NotAdit(_) => {
                Some("build the site first, then make tables of your own in its site.db; or name another file with --db".to_owned())
            }
            adit_db::Error::Taken { table, .. } => Some(format!(
                "`ALTER TABLE {table} RENAME TO ...` and its class in the rules with it; or keep plans elsewhere: --db"
            )),
            _ => None,
        };
        Self::said(Code::from(&error), error.to_string(), help)
    }
}
