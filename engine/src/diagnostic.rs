//! What is wrong in a rule file, and where.

use std::fmt;
use std::sync::Arc;

use miette::{LabeledSpan, NamedSource, SourceCode};

use crate::script::source::{Place, SourceFile};

/// The codes with the names that users and programs see.
macro_rules! codes {
    ($(#[doc = $meaning:literal] $code:ident = $name:literal,)*) => {
        /// Stable names of what can be wrong.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[non_exhaustive]
        pub enum Code {
            $(#[doc = $meaning] $code,)*
        }

        impl Code {
            pub const ALL: &[Self] = &[$(Self::$code,)*];

            /// The name that users and programs see.
            pub const fn as_str(self) -> &'static str {
                match self {
                    $(Self::$code => $name,)*
                }
            }

            /// What it means, in one sentence for users.
            pub const fn meaning(self) -> &'static str {
                match self {
                    $(Self::$code => $meaning,)*
                }
            }
        }
    };
}

codes! {
    /// The file does not read as rules.
    Syntax = "rule/syntax",
    /// A file is larger than is accepted.
    TooLarge = "rule/too-large",
    /// Something other than a rule, a function or a constant stands in the file.
    Statement = "rule/statement",
    /// Two rules have one name.
    DuplicateName = "rule/duplicate-name",
    /// No rule of this name in a rule base beneath.
    UnknownRule = "rule/unknown-rule",
    /// No such class.
    UnknownClass = "rule/unknown-class",
    /// No such property of a class.
    UnknownProperty = "rule/unknown-property",
    /// No such variable in the rule.
    UnknownVariable = "rule/unknown-variable",
    /// No such function.
    UnknownFunction = "rule/unknown-function",
    /// A value of the wrong type.
    Type = "rule/type",
    /// Something that cannot be set, or not like this.
    Assignment = "rule/assignment",
    /// Rules that need each other's conclusions.
    Cycle = "rule/cycle",
    /// A declaration that cannot be, or that a rule does not keep to.
    Declaration = "rule/declaration",
    /// A table that does not read as one.
    Table = "rule/table",
    /// Rows of a table that match the same.
    Overlap = "rule/overlap",
    /// Inputs for which a table has no row, or objects for which no rule gives what is needed.
    Gap = "rule/gap",
    /// A row, or a rule, that never counts.
    Unreachable = "rule/unreachable",
    /// What is named and never used.
    Unused = "rule/unused",
    /// A hypothesis that is concluded in another way too, or is not the first object's.
    Hypothesis = "rule/hypothesis",
    /// Two operators at one level of revision.
    Operator = "rule/operator",
    /// Two rules set one property of one object to different values.
    Conflict = "rule/conflict",
    /// A part that the interpreter runs has failed.
    Evaluation = "rule/evaluation",
    /// A rule took longer, or did more, than it may.
    Deadline = "rule/deadline",
    /// Reactions without an end.
    Loop = "rule/loop",
    /// A rule that reacts has more matches than are kept.
    Matches = "rule/matches",
    /// The engine itself failed.
    Panic = "rule/panic",
    /// A file of rule tests does not read as tests.
    TestSyntax = "test/syntax",
    /// A rule test does not hold.
    TestFailed = "test/failed",
}

impl serde::Serialize for Code {
    fn serialize<S: serde::Serializer>(&self, out: S) -> Result<S::Ok, S::Error> {
        out.serialize_str(self.as_str())
    }
}

impl fmt::Display for Code {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(self.as_str())
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// The rules work, but perhaps not as meant.
    Warning,
    Error,
}

/// One message about a rule file. It prints with a caret through [`miette`].
#[derive(Clone, Debug, serde::Serialize)]
pub struct Diagnostic {
    pub code: Code,
    pub severity: Severity,
    /// One sentence with the names and values in it.
    pub message: String,
    /// File name as the host gave it.
    pub file: String,
    /// First byte and number of bytes that the caret marks.
    pub span: (usize, usize),
    /// Line from 1.
    pub line: usize,
    /// Column from 1, in characters.
    pub column: usize,
    /// What stands at the caret.
    pub label: Option<String>,
    pub help: Option<String>,
    #[serde(skip)]
    source: Arc<NamedSource<String>>,
}

impl Diagnostic {
    pub(crate) fn error(code: Code, place: &Place, message: impl Into<String>) -> Self {
        Self {
            code,
            severity: Severity::Error,
            message: message.into(),
            file: place.source.name().to_owned(),
            span: place.span,
            line: place.line,
            column: place.column,
            label: None,
            help: None,
            source: Arc::clone(place.source.named()),
        }
    }

    /// The same, of another file with the same lines where it stands.
    #[must_use]
    pub(crate) fn moved_to(mut self, source: &SourceFile) -> Self {
        let before: usize = source.text().split_inclusive('\n').take(self.line - 1).map(str::len).sum();
        let line = &source.text()[before..];
        self.span.0 = before + line.char_indices().nth(self.column - 1).map_or(line.len(), |(at, _)| at);
        self.source = Arc::clone(source.named());
        self
    }

    /// The same as a warning.
    #[must_use]
    pub fn warning(mut self) -> Self {
        self.severity = Severity::Warning;
        self
    }

    #[must_use]
    pub(crate) fn label(mut self, label: impl Into<String>) -> Self {
        self.label = Some(label.into());
        self
    }

    #[must_use]
    pub(crate) fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    #[must_use]
    pub(crate) fn did_you_mean(self, name: Option<&str>) -> Self {
        match name {
            Some(name) => self.help(format!("did you mean `{name}`?")),
            None => self,
        }
    }
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(&self.message)
    }
}

impl std::error::Error for Diagnostic {}

impl miette::Diagnostic for Diagnostic {
    fn code<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new(self.code))
    }

    fn severity(&self) -> Option<miette::Severity> {
        Some(match self.severity {
            Severity::Warning => miette::Severity::Warning,
            Severity::Error => miette::Severity::Error,
        })
    }

    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.help.as_ref().map(|help| Box::new(help) as Box<dyn fmt::Display + 'a>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        Some(self.source.as_ref())
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let (start, len) = self.span;
        Some(Box::new(std::iter::once(LabeledSpan::new(self.label.clone(), start, len))))
    }
}

/// All that is wrong with a set of rule files; never empty as an error.
#[derive(Clone, Debug)]
pub struct Diagnostics(pub Vec<Diagnostic>);

impl fmt::Display for Diagnostics {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (nth, diagnostic) in self.0.iter().enumerate() {
            let gap = if nth == 0 { "" } else { "\n" };
            let Diagnostic { file, line, column, message, code, .. } = diagnostic;
            write!(out, "{gap}{file}:{line}:{column}: {message} [{code}]")?;
        }
        Ok(())
    }
}

impl std::error::Error for Diagnostics {}
