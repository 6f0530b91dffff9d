//! Where the reading of an item stands, and what was read of it.

use rhai::{ImmutableString, LexError, ParseError, Position};

use super::quantifier::Quantifier;
use super::word::Word;

/// What an input of the custom syntax is; there is one for each input, in order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Slot {
    Name(Word),
    /// The policy of a table; what its values are ranked by; how they are brought together.
    Hit,
    HitValues,
    HitFold,
    Given,
    Set,
    Rows,
    /// A declared class: its parent and condition.
    Parent,
    Declared,
    /// Where a property links to: class and key.
    LinkClass,
    LinkKey,
    Source,
    Ask,
    Default,
    Priority,
    Number,
    Variable(Quantifier),
    Class,
    Where,
    By,
    Have,
    Hypothesis,
    Then,
    Else,
    Target,
    Operator,
    Amount,
    Level,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum At {
    Name,
    Declaring(Declaring),
    Tabling(Tabling),
    Priority,
    Clause,
    Number(Quantifier),
    Of(Quantifier),
    Variable(Quantifier),
    In,
    Class,
    Options { by: bool, condition: bool },
    By,
    Where,
    Have,
    Hypothesis,
    AfterHypothesis,
    Then,
    AfterThen,
    Else,
    Target,
    TargetBy,
    Operator,
    Amount,
    AfterAmount,
    Level,
    End,
    Done,
}

#[derive(Clone, Debug)]
pub(crate) struct Shape {
    pub(crate) slots: Vec<Slot>,
    pub(super) at: At,
    pub(super) item: Word,
    pub(super) clause: Option<Quantifier>,
    pub(super) needs_have: bool,
    /// Whether the next token begins an item on its own.
    pub(super) keyed: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Declaring {
    Of,
    Parent,
    AfterParent,
    Condition,
    Dot,
    Property,
    AfterProperty,
    Link,
    AfterLink,
    LinkKey,
    Source,
    Ask,
    Default,
    AfterSource,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Tabling {
    Hit,
    Values,
    Fold,
    Given,
    AfterGiven,
    Set,
    AfterSet,
    Rows,
}

/// How rhai shows the end of the file.
const END: &str = "{EOF}";

pub(super) type Next = Result<Option<ImmutableString>, ParseError>;

impl Shape {
    #[allow(clippy::unnecessary_wraps)] // it is the answer itself
    pub(super) fn input(&mut self, slot: Slot, at: At, marker: &'static str) -> Next {
        self.slots.push(slot);
        self.at = at;
        Ok(Some(marker.into()))
    }

    #[allow(clippy::unnecessary_wraps)] // it is the answer itself
    pub(super) fn word(&mut self, word: &'static str, at: At) -> Next {
        self.at = at;
        Ok(Some(word.into()))
    }
}

pub(super) fn found(ahead: &str) -> String {
    if ahead == END { "the end of the file".to_owned() } else { format!("`{ahead}`") }
}

pub(super) fn wrong(message: String) -> Next {
    Err(LexError::ImproperSymbol(String::new(), message).into_err(Position::NONE))
}
