//! A rule as it was read: clauses, action, what it reads and what it sets.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use rhai::{Expr, Module, Position, Shared, StmtBlock};

use crate::diagnostic::{Code, Diagnostic};
use crate::script::source::SourceFile;
use crate::script::syntax::Quantifier;
use crate::suggest::nearest;
use crate::table::Table;
use crate::value::Value;

/// A property of a class, as rules name it: `DOORS.hardness`.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize)]
pub struct PropertyName {
    pub class: String,
    pub property: String,
}

impl PropertyName {
    pub fn new(class: impl Into<String>, property: impl Into<String>) -> Self {
        Self { class: class.into(), property: property.into() }
    }
}

impl fmt::Display for PropertyName {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{}.{}", self.class, self.property)
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Operator {
    /// `* amount`
    Times,
    /// `+ amount`
    Plus,
    /// `- amount`
    Minus,
    Max,
    Min,
}

impl Operator {
    pub const fn sign(self) -> &'static str {
        match self {
            Self::Times => "*",
            Self::Plus => "+",
            Self::Minus => "-",
            Self::Max => "max",
            Self::Min => "min",
        }
    }

    /// Whether the order of the two does not matter, rounding aside.
    pub(crate) fn commutes_with(self, other: Self) -> bool {
        let sum = |operator| matches!(operator, Self::Plus | Self::Minus);
        self == other || (sum(self) && sum(other))
    }

    pub(crate) fn apply(self, value: f64, amount: f64) -> f64 {
        match self {
            Self::Times => value * amount,
            Self::Plus => value + amount,
            Self::Minus => value - amount,
            Self::Max | Self::Min if value.is_nan() || amount.is_nan() => f64::NAN,
            Self::Max => value.max(amount),
            Self::Min => value.min(amount),
        }
    }
}

#[derive(Clone, Debug)]
pub(crate) struct Clause {
    pub(crate) quantifier: Quantifier,
    pub(crate) variable: String,
    pub(crate) position: Position,
    pub(crate) class: String,
    pub(crate) class_position: Position,
    pub(crate) by: Option<Expr>,
    pub(crate) condition: Option<Expr>,
    /// What `all` asks of each object that passes.
    pub(crate) have: Option<Expr>,
    /// The name of the number that `count` and `sum` give.
    pub(crate) number: Option<(String, Position)>,
    /// What makes an object one of the class as the rule names it.
    pub(crate) conditions: Vec<Condition>,
    /// Of a hidden clause: what names the object.
    pub(crate) link: Option<LinkUse>,
}

/// A condition that makes an object one of a class. Bare names are the object's properties.
#[derive(Clone, Debug)]
pub(crate) struct Condition {
    pub(crate) expr: Expr,
    pub(crate) file: Arc<FileScope>,
}

/// How a hidden clause finds its object: the property of another clause's object names it.
#[derive(Clone, Debug)]
pub(crate) struct LinkUse {
    pub(crate) clause: usize,
    pub(crate) property: String,
    /// The property of the object that is named; the class's key if it is not given.
    pub(crate) key: Option<String>,
    pub(crate) position: Position,
    /// Where the link is declared.
    pub(crate) declared: (Arc<FileScope>, Position),
}

impl Clause {
    /// A clause of which only the variable is known yet.
    pub(crate) fn new(quantifier: Quantifier, variable: String, position: Position) -> Self {
        Self {
            quantifier,
            variable,
            position,
            class: String::new(),
            class_position: Position::NONE,
            by: None,
            condition: None,
            have: None,
            number: None,
            conditions: vec![],
            link: None,
        }
    }
}

#[derive(Clone, Debug)]
pub(crate) enum Action {
    Conclude {
        then: Box<StmtBlock>,
        otherwise: Option<Box<StmtBlock>>,
    },
    Revise {
        target: (usize, String),
        operator: Operator,
        amount: Expr,
        level: i64,
        position: Position,
    },
    React(Box<Reaction>),
    Table(Box<Table>),
    /// What a property of the only clause's object is if nothing else gives it a value.
    Default {
        property: String,
        value: Option<Expr>,
        position: Position,
    },
}

/// What an `on` rule does. Its body runs in the interpreter; what can be seen of it without running is listed.
#[derive(Clone, Debug)]
pub(crate) struct Reaction {
    pub(crate) body: StmtBlock,
    /// For each variable the properties that the rule reads, in its clauses or in its body.
    pub(crate) reads: BTreeSet<(usize, String)>,
    pub(crate) tells: Vec<Telling>,
    pub(crate) sets: Vec<Setting>,
}

/// `tell("CLASS", #{ property: value })`
#[derive(Clone, Debug)]
pub(crate) struct Telling {
    pub(crate) class: String,
    pub(crate) position: Position,
    pub(crate) properties: Vec<(String, Position, Expr)>,
}

/// `variable.property = value`; the value is `None` of `+=` and the like.
#[derive(Clone, Debug)]
pub(crate) struct Setting {
    pub(crate) variable: usize,
    pub(crate) property: String,
    pub(crate) position: Position,
    pub(crate) value: Option<Expr>,
}

#[derive(Clone, Debug)]
pub(crate) struct FileScope {
    pub(crate) source: SourceFile,
    pub(crate) constants: BTreeMap<String, Value>,
    pub(crate) functions: Shared<Module>,
    pub(crate) function_names: BTreeSet<(String, usize)>,
    /// What its functions tell, for the reactions that call them.
    pub(crate) tells: Vec<Telling>,
}

impl FileScope {
    pub(crate) fn error(&self, code: Code, position: Position, message: impl Into<String>) -> Diagnostic {
        Diagnostic::error(code, &self.source.place(position), message)
    }

    /// The help names the nearest of the others, where one is near.
    pub(crate) fn unknown_class<'n>(
        &self,
        position: Position,
        class: &str,
        others: impl Iterator<Item = &'n str>,
    ) -> Diagnostic {
        let message = format!("there is no class {class}");
        self.error(Code::UnknownClass, position, message).did_you_mean(nearest(class, others))
    }

    /// As [`unknown_class`](Self::unknown_class).
    pub(crate) fn unknown_property<'n>(
        &self,
        position: Position,
        name: &PropertyName,
        others: impl Iterator<Item = &'n str>,
    ) -> Diagnostic {
        let message = format!("{} has no property `{}`", name.class, name.property);
        self.error(Code::UnknownProperty, position, message).did_you_mean(nearest(&name.property, others))
    }
}

#[derive(Clone, Debug)]
pub struct Rule {
    pub(crate) name: String,
    pub(crate) position: Position,
    pub(crate) line: usize,
    pub(crate) version: String,
    pub(crate) text: Arc<str>,
    pub(crate) priority: i64,
    pub(crate) clauses: Vec<Clause>,
    pub(crate) action: Action,
    pub(crate) reads: BTreeMap<PropertyName, Position>,
    pub(crate) sets: BTreeMap<PropertyName, Position>,
    /// What it proves or refutes of each object of its first clause: clause, property, place.
    pub(crate) hypothesis: Option<(usize, String, Position)>,
    pub(crate) file: Arc<FileScope>,
}

impl Rule {
    /// A rule whose names are not looked up yet.
    pub(crate) fn new(
        name: String,
        position: Position,
        clauses: Vec<Clause>,
        action: Action,
        file: &Arc<FileScope>,
    ) -> Self {
        Self {
            name,
            position,
            line: file.source.place(position).line,
            version: String::new(),
            text: Arc::default(),
            priority: 0,
            clauses,
            action,
            reads: BTreeMap::new(),
            sets: BTreeMap::new(),
            hypothesis: None,
            file: Arc::clone(file),
        }
    }

    /// What stands in its file, from its first word to its last.
    pub fn text(&self) -> &str {
        &self.text
    }

    pub fn name(&self) -> &str {
        &self.name
    }

    pub fn file(&self) -> &str {
        self.file.source.name()
    }

    /// The line of its name, from 1.
    pub const fn line(&self) -> usize {
        self.line
    }

    /// Where its name stands, for messages: the file, and the bytes.
    pub fn place(&self) -> (&SourceFile, Range<usize>) {
        let (start, length) = self.file.source.place(self.position).span;
        (&self.file.source, start..start + length)
    }

    /// A short hash of its text; of the file's constants and functions too, if it uses any.
    pub fn version(&self) -> &str {
        &self.version
    }

    /// Which rule is heard where several conclude one property of one object: the greatest with a known value.
    /// 0 if not given.
    pub const fn priority(&self) -> i64 {
        self.priority
    }

    /// The classes that its clauses range over, in their order.
    pub fn classes(&self) -> impl Iterator<Item = &str> {
        self.clauses.iter().map(|clause| clause.class.as_str())
    }

    /// Its variables with the classes that they stand for objects of, in the order of its clauses.
    pub fn variables(&self) -> impl Iterator<Item = (&str, &str)> {
        self.clauses.iter().map(|clause| (clause.variable.as_str(), clause.class.as_str()))
    }

    /// The properties that it reads, sorted.
    pub fn reads(&self) -> impl Iterator<Item = &PropertyName> {
        self.reads.keys()
    }

    /// The properties that it sets, sorted.
    pub fn sets(&self) -> impl Iterator<Item = &PropertyName> {
        self.sets.keys()
    }

    /// The property that is true for an object of the first clause where all clauses are met, false where one is
    /// not, and unknown where that is undecided.
    pub fn hypothesis(&self) -> Option<PropertyName> {
        let (clause, property, _) = self.hypothesis.as_ref()?;
        Some(PropertyName::new(&self.clauses[*clause].class, property))
    }

    /// Whether it is an `on` rule: one that reacts and tells, rather than concludes.
    pub const fn reacts(&self) -> bool {
        matches!(self.action, Action::React(_))
    }

    /// What the rule does once it is carried out; `None` for one that concludes or revises.
    pub(crate) const fn reaction(&self) -> Option<&Reaction> {
        match &self.action {
            Action::React(reaction) => Some(reaction),
            _ => None,
        }
    }

    /// The level of a revision; `None` for a rule that concludes.
    pub const fn level(&self) -> Option<i64> {
        match &self.action {
            Action::Revise { level, .. } => Some(*level),
            _ => None,
        }
    }
}
