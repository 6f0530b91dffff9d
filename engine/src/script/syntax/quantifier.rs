//! What a clause asks of the objects of its class.

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Quantifier {
    Each,
    Least,
    Most,
    Some,
    None,
    /// How many objects pass: binds a number.
    Count,
    /// The sum of a number over the objects that pass: binds a number.
    Sum,
    /// Whether something holds of all objects that pass.
    All,
    /// Hidden: the object that a property names; unbound where there is none.
    Link,
}

impl Quantifier {
    pub(super) fn of(word: &str) -> Option<Self> {
        Some(match word {
            "each" => Self::Each,
            "least" => Self::Least,
            "most" => Self::Most,
            "some" => Self::Some,
            "none" => Self::None,
            "count" => Self::Count,
            "sum" => Self::Sum,
            "all" => Self::All,
            _ => return None,
        })
    }

    pub(crate) const fn word(self) -> &'static str {
        match self {
            Self::Each => "each",
            Self::Least => "least",
            Self::Most => "most",
            Self::Some => "some",
            Self::None => "none",
            Self::Count => "count",
            Self::Sum => "sum",
            Self::All => "all",
            Self::Link => "the object named by",
        }
    }

    /// Whether later clauses and the action may speak of the object.
    pub(crate) const fn binds(self) -> bool {
        matches!(self, Self::Each | Self::Least | Self::Most | Self::Some | Self::Link)
    }

    /// Whether a firing names the one object that decides.
    pub(crate) const fn names(self) -> bool {
        matches!(self, Self::Least | Self::Most | Self::Some | Self::None | Self::Link)
    }

    pub(crate) const fn counts(self) -> bool {
        matches!(self, Self::Count | Self::Sum)
    }

    pub(super) const fn ranks(self) -> bool {
        matches!(self, Self::Least | Self::Most | Self::Sum)
    }
}
