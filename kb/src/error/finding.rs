//! One thing that is wrong, or that one should know, whoever found it. Its code is one of [`Code`] by its type.

use std::fmt;

use miette::{Diagnostic, LabeledSpan, NamedSource, Severity, SourceCode, SourceSpan};

use super::{Code, Nearest};

/// One thing that is wrong, or that one should know.
#[derive(Debug)]
pub struct Finding(Kind);

#[derive(Debug)]
enum Kind {
    Said(Said),
    Rule(adit_engine::Diagnostic),
    Map(adit_planners::read::Problem),
}

#[derive(Debug, thiserror::Error)]
#[error("{message}")]
struct Said {
    /// `None`: a note, with which nothing is wrong.
    code: Option<Code>,
    severity: Severity,
    message: String,
    help: Option<String>,
    place: Option<(NamedSource<String>, SourceSpan)>,
    nearest: Option<Nearest>,
}

impl Finding {
    /// Something that is wrong, and what to do about it.
    pub fn said(code: Code, message: impl Into<String>, help: Option<String>) -> Self {
        let (code, severity, message) = (Some(code), Severity::Error, message.into());
        Self(Kind::Said(Said { code, severity, message, help, place: None, nearest: None }))
    }

    /// Something that the expert should know, though nothing is wrong.
    pub fn note(message: String) -> Self {
        let (code, severity) = (None, Severity::Advice);
        Self(Kind::Said(Said { code, severity, message, help: None, place: None, nearest: None }))
    }

    /// As [`said`](Self::said), and nothing that keeps a site from being built.
    pub fn warning(code: Code, message: impl Into<String>, help: Option<String>) -> Self {
        Self::said(code, message, help).with(|said| said.severity = Severity::Warning)
    }

    /// Marks a place of a text.
    #[must_use]
    pub fn at(self, text: NamedSource<String>, span: impl Into<SourceSpan>) -> Self {
        self.with(|said| said.place = Some((text, span.into())))
    }

    /// Says which point could be taken instead of the one that is refused.
    #[must_use]
    pub fn instead(self, nearest: Option<Nearest>) -> Self {
        self.with(|said| said.nearest = nearest)
    }

    pub fn nearest(&self) -> Option<&Nearest> {
        match &self.0 {
            Kind::Said(said) => said.nearest.as_ref(),
            Kind::Rule(_) | Kind::Map(_) => None,
        }
    }

    fn with(mut self, change: impl FnOnce(&mut Said)) -> Self {
        if let Kind::Said(said) = &mut self.0 {
            change(said);
        }
        self
    }

    /// Whether it keeps what was asked for from being done.
    pub fn is_error(&self) -> bool {
        self.diagnostic().severity().is_none_or(|severity| severity == Severity::Error)
    }

    /// The text about what it marks, line by line, if it marks anything.
    pub fn text(&self) -> Option<String> {
        let diagnostic = self.diagnostic();
        let marked = diagnostic.labels()?.next()?;
        let text = diagnostic.source_code()?.read_span(marked.inner(), 1, 1).ok()?;
        Some(String::from_utf8_lossy(text.data()).into_owned())
    }

    pub fn code(&self) -> Option<Code> {
        match &self.0 {
            Kind::Said(said) => said.code,
            Kind::Rule(found) => Some(Code::Rule(found.code)),
            Kind::Map(problem) => Some(Code::Map(problem.code)),
        }
    }

    /// For printing with a caret.
    pub fn diagnostic(&self) -> &dyn Diagnostic {
        match &self.0 {
            Kind::Said(said) => said,
            Kind::Rule(found) => found,
            Kind::Map(problem) => problem,
        }
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.diagnostic())
    }
}

impl From<adit_engine::Diagnostic> for Finding {
    fn from(found: adit_engine::Diagnostic) -> Self {
        Self(Kind::Rule(found))
    }
}

impl From<adit_planners::read::Problem> for Finding {
    fn from(problem: adit_planners::read::Problem) -> Self {
        Self(Kind::Map(problem))
    }
}

impl Diagnostic for Said {
    fn code<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.code.map(|code| Box::new(code) as _)
    }

    fn severity(&self) -> Option<Severity> {
        Some(self.severity)
    }

    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.help.as_ref().map(|help| Box::new(help) as _)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.place.as_ref().map(|(text, _)| text as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let label = |(_, span): &(_, SourceSpan)| LabeledSpan::new_with_span(None, *span);
        self.place.as_ref().map(|place| Box::new(std::iter::once(label(place))) as _)
    }
}
