//! Objects that rules are asked about one at a time: what rules are told of each, as a table of its properties, and what
//! they are asked.

mod memory;

use std::sync::Arc;

use adit_engine::{ClassError, Consultation, Datum, RuleBase, Type};

pub use memory::Memory;

/// What rules may be told of objects of one class, and what they are asked.
#[derive(Debug)]
pub struct Class {
    pub name: &'static str,
    pub told: Vec<(&'static str, Type)>,
    pub asked: &'static [&'static str],
}

/// How a property follows from the facts of an object, by the type of its value.
#[derive(Debug)]
pub enum Of<F> {
    Number(fn(&F) -> f64),
    /// A number that is not always known.
    Perhaps(fn(&F) -> Option<f64>),
    Text(fn(&F) -> Option<&str>),
    Truth(fn(&F) -> bool),
}

/// A property of an object, and how it follows from the facts.
pub type Property<F> = (&'static str, Of<F>);

pub fn typed<F>(properties: impl IntoIterator<Item = Property<F>>) -> Vec<(&'static str, Type)> {
    let kind = |of: &Of<F>| match of {
        Of::Number(_) | Of::Perhaps(_) => Type::Number,
        Of::Text(_) => Type::Text,
        Of::Truth(_) => Type::Truth,
    };
    properties.into_iter().map(|(name, of)| (name, kind(&of))).collect()
}

/// The values of an object, in the order of its properties.
pub fn object<F, const N: usize>(properties: [Property<F>; N], facts: &F) -> [Datum<'_>; N] {
    object_of(properties, facts, |_| true)
}

/// The same, of which only those are told whose numbers are wanted.
pub fn object_of<F, const N: usize>(
    properties: [Property<F>; N],
    facts: &F,
    is_told: impl Fn(usize) -> bool,
) -> [Datum<'_>; N] {
    let mut input = 0..;
    properties.map(|(_, of)| {
        let is_told = input.next().is_some_and(&is_told);
        match of {
            _ if !is_told => Datum::Unknown,
            Of::Number(of) => of(facts).into(),
            Of::Perhaps(of) => of(facts).into(),
            Of::Text(of) => of(facts).into(),
            Of::Truth(of) => of(facts).into(),
        }
    })
}

impl Class {
    /// A class of objects with these properties, of which rules conclude those that are `asked` for.
    pub fn new<F, const N: usize>(
        name: &'static str,
        properties: [Property<F>; N],
        asked: &'static [&'static str],
    ) -> Self {
        Self { name, told: typed(properties), asked }
    }

    pub fn consultation(&self, rules: &Arc<RuleBase>) -> Result<Consultation, ClassError> {
        Consultation::new(Arc::clone(rules), self.name, &self.told, self.asked)
    }
}

/// Asks rules about an object. A rule that fails says nothing of it, and the one below it would count in its stead: its
/// failure becomes the `trouble`, where there is none yet.
pub fn consult(consultation: &mut Consultation, object: &[Datum<'_>], trouble: &mut Option<String>) {
    consultation.consult(object);
    if trouble.is_none() {
        *trouble = consultation.failure();
    }
}

/// What the word in an output stands for; otherwise what is there.
pub fn meant<T: Copy>(
    consultation: &Consultation,
    output: usize,
    words: &[(&str, T)],
) -> Result<T, Option<String>> {
    let found = words.iter().find(|(word, _)| consultation.is(output, word));
    found.map(|(_, meant)| *meant).ok_or_else(|| consultation.value(output).map(|value| value.to_string()))
}

/// The word that stands for a thing.
pub fn word_for<T: PartialEq>(words: &[(&'static str, T)], meant: &T) -> Option<&'static str> {
    words.iter().find(|(_, known)| known == meant).map(|(word, _)| *word)
}

/// Whether two names are the same; asked when compiled.
pub const fn is_same(one: &str, other: &str) -> bool {
    let (one, other) = (one.as_bytes(), other.as_bytes());
    if one.len() != other.len() {
        return false;
    }
    let mut at = 0;
    while at < one.len() {
        if one[at] != other[at] {
            return false;
        }
        at += 1;
    }
    true
}
