//! What is wrong with a map, said so that it can be mended: a stable code, one sentence, the place in the file
//! and a help.

use std::ops::Range;
use std::sync::Arc;

use miette::{Diagnostic, LabeledSpan, NamedSource, Severity, SourceCode};

/// The codes with the names that users and programs see.
macro_rules! codes {
    ($(#[doc = $meaning:literal] $code:ident = $name:literal,)*) => {
        /// Stable names of what can be wrong with a map or with what a site lays over it.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
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
    /// The file cannot be read at all.
    Unreadable = "map/unreadable",
    /// The file's extension says nothing that a reader knows.
    UnknownFormat = "map/unknown-format",
    /// The text is not TOML, YAML or JSON.
    Syntax = "map/syntax",
    /// A key that means nothing here.
    UnknownKey = "map/unknown-key",
    /// A key that must be there.
    MissingKey = "map/missing-key",
    /// A value of the wrong type or with the wrong number of entries.
    WrongType = "map/wrong-type",
    /// Not a number, or infinite.
    NotFinite = "map/not-finite",
    /// Zero or negative where only more than zero makes sense.
    NotPositive = "map/not-positive",
    /// A rectangle without an area.
    Degenerate = "map/degenerate",
    /// Wholly outside of the environment.
    Outside = "map/outside",
    /// Lone wall pixels of an image that are taken for noise, or might be, a note.
    Salt = "map/salt",
    /// The axes of an image lie turned in ROS's map frame, a note.
    Turned = "map/turned",
    /// Partly outside of the environment: cut at the edge, a note.
    Clipped = "map/clipped",
    /// A polygon with fewer than three distinct corners.
    FewCorners = "map/few-corners",
    /// A polygon with more corners than can be checked in seconds.
    TooManyCorners = "map/too-many-corners",
    /// A polygon whose outline crosses or touches itself.
    SelfCrossing = "map/self-crossing",
    /// A name without a character.
    EmptyName = "map/empty-name",
    /// Two places of one name.
    DuplicatePlace = "map/duplicate-place",
    /// Two areas or doors, or one and a place, of one name.
    DuplicateName = "map/duplicate-name",
    /// A named door that lies in walls wholly, a note.
    DoorInWall = "map/door-in-wall",
    /// A place in something solid.
    PlaceInWall = "map/place-in-wall",
    /// A place outside of the environment.
    PlaceOutside = "map/place-outside",
    /// Thresholds outside of 0 to 1, or in the wrong order.
    Thresholds = "map/thresholds",
    /// A `mode` that is not trinary, scale or raw.
    Mode = "map/mode",
    /// The image file is missing.
    ImageMissing = "map/image-missing",
    /// The image file holds no PGM or PNG image.
    NotAnImage = "map/not-an-image",
    /// An image with more than 8 bits a channel.
    ImageDepth = "map/image-depth",
    /// An image file that ends before its last pixel.
    ImageTruncated = "map/image-truncated",
    /// A grid so fine that the map has more cells than a planner takes.
    GridTooFine = "map/grid-too-fine",
    /// An image with more pixels than a map may have.
    ImageTooLarge = "map/image-too-large",
    /// A wall that bounds no free space, or no walls that do.
    OpenOutline = "map/open-outline",
    /// Two walls that cross or lie on one another.
    CrossingWalls = "map/crossing-walls",
    /// A robot that fits through no doorway.
    RobotTooWide = "map/robot-too-wide",
    /// A world of a planner that cannot be as it is given.
    Impossible = "map/impossible",
}

/// One thing that is wrong (or, with [`Severity::Advice`], worth a note), with its place in the text.
#[derive(Clone, Debug, thiserror::Error)]
#[error("{message}")]
pub struct Problem {
    pub code: Code,
    /// One sentence with the values in it.
    pub message: String,
    pub help: Option<String>,
    pub severity: Severity,
    text: Option<Text>,
    labels: Vec<LabeledSpan>,
}

impl Problem {
    /// A problem of a file as a whole, without a place in a text.
    pub fn of_file(code: Code, message: impl Into<String>) -> Self {
        let (text, labels) = (None, Vec::new());
        Self { code, message: message.into(), help: None, severity: Severity::Error, text, labels }
    }

    #[must_use]
    pub fn with_help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// Makes it a note.
    #[must_use]
    pub fn as_advice(mut self) -> Self {
        self.severity = Severity::Advice;
        self
    }

    /// Marks a second place of the same text.
    #[must_use]
    pub fn and_at(mut self, span: &Range<usize>, label: &str) -> Self {
        self.labels.push(LabeledSpan::new_with_span(Some(label.to_owned()), span.clone()));
        self
    }
}

impl Diagnostic for Problem {
    fn code<'a>(&'a self) -> Option<Box<dyn std::fmt::Display + 'a>> {
        Some(Box::new(self.code.as_str()))
    }

    fn severity(&self) -> Option<Severity> {
        Some(self.severity)
    }

    fn help<'a>(&'a self) -> Option<Box<dyn std::fmt::Display + 'a>> {
        self.help.as_ref().map(|help| Box::new(help) as _)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.text.as_ref().map(|text| &*text.0 as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        (!self.labels.is_empty()).then(|| Box::new(self.labels.iter().cloned()) as _)
    }
}

/// Everything that is wrong with a map, in the order of the file; never empty.
#[derive(Clone, Debug, thiserror::Error, Diagnostic)]
#[error("{}", summary(.problems))]
pub struct MapErrors {
    #[related]
    pub problems: Vec<Problem>,
}

impl From<Problem> for MapErrors {
    fn from(problem: Problem) -> Self {
        Self { problems: vec![problem] }
    }
}

fn summary(problems: &[Problem]) -> String {
    match problems {
        [only] => only.message.clone(),
        [first, rest @ ..] => format!("{} (and {} more)", first.message, rest.len()),
        [] => String::new(),
    }
}

/// A line of more bytes is not shown.
const SHOWN: usize = 400;

/// The text of a file with its name, shared by all that is said about it.
#[derive(Clone, Debug)]
pub struct Text(Arc<NamedSource<String>>);

impl Text {
    /// A text as read from the file `name`.
    pub fn new(name: &str, text: &str) -> Self {
        Self(Arc::new(NamedSource::new(name, text.to_owned())))
    }

    pub fn name(&self) -> &str {
        self.0.name()
    }

    /// Line number, from 1, of a byte of the text.
    pub fn line(&self, byte: usize) -> usize {
        self.0.inner().match_indices('\n').take_while(|&(end, _)| end < byte).count() + 1
    }

    /// A problem at a place of this text, shown with its line where people can read that: a file that a program wrote may be one
    /// line.
    pub fn problem(&self, code: Code, span: &Range<usize>, message: impl Into<String>) -> Problem {
        let text = self.0.inner();
        let start = text.floor_char_boundary(span.start);
        let span = start..text.floor_char_boundary(span.end).max(start);
        let first = text[..start].rfind('\n').map_or(0, |end| end + 1);
        let last = text[start..].find('\n').map_or(text.len(), |end| start + end);
        if last - first > SHOWN {
            let (line, column) = (self.line(start), text[first..start].chars().count() + 1);
            let message = format!("{}, line {line}, column {column}: {}", self.name(), message.into());
            return Problem::of_file(code, message);
        }
        let mut problem = Problem::of_file(code, message);
        problem.text = Some(self.clone());
        problem.labels.push(LabeledSpan::new_primary_with_span(None, span));
        problem
    }
}
