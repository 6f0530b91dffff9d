//! A consultation: objects of one class that come one at a time, each judged by the rules as soon as it is known.

mod direct;
pub(crate) mod explain;
mod grain;

use std::sync::Arc;

use super::KnowledgeBase;
use crate::class::{Class, ClassError, value};
use crate::conclusions::Conclusions;
use crate::rule::PropertyName;
use crate::rule_base::RuleBase;
use crate::value::{Cell, Type, Value};
use direct::Direct;
pub use grain::Grain;

/// A value of a case; it borrows its text.
// The wide tag makes it quick to copy, as with `Cell`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(u64)]
pub enum Datum<'a> {
    Unknown,
    /// A number; NaN is unknown.
    Number(f64),
    Text(&'a str),
    Truth(bool),
}

impl From<f64> for Datum<'_> {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl<'a> From<&'a str> for Datum<'a> {
    fn from(text: &'a str) -> Self {
        Self::Text(text)
    }
}

impl From<bool> for Datum<'_> {
    fn from(truth: bool) -> Self {
        Self::Truth(truth)
    }
}

impl<'a, T: Into<Datum<'a>>> From<Option<T>> for Datum<'a> {
    fn from(value: Option<T>) -> Self {
        value.map_or(Self::Unknown, Into::into)
    }
}

/// What rules say of one object after the other, of a class that is known in advance.
///
/// The answer is what [`KnowledgeBase::conclude`] would give for a class of that one object. Where the rules of the
/// class look at the one object alone, and nothing of them is left to the interpreter, they run without the
/// bookkeeping of an inference, in fractions of a microsecond.
///
/// ```
/// use adit_engine::{Consultation, Datum, RuleBase, SourceFile, Type};
///
/// let rules = RuleBase::compile(&[SourceFile::new("post.rhai", r#"
///     table "postage" unique
///         each letter in LETTERS
///         given [ letter.grams, letter.abroad ]
///         set   [ letter.price ]
///         rows  [ [ below(20),   false, 0.95 ],
///                 [ below(20),   true,  1.25 ],
///                 [ at_least(20), any,  3.70 ] ]
/// "#)])?;
/// let inputs = [("grams", Type::Number), ("abroad", Type::Truth)];
/// let mut post = Consultation::new(rules.into(), "LETTERS", &inputs, &["price"])?;
/// post.consult(&[Datum::Number(12.0), Datum::Truth(true)]);
/// assert_eq!(post.number(0), Some(1.25));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Consultation {
    rules: Arc<RuleBase>,
    base: KnowledgeBase,
    class: String,
    inputs: Vec<String>,
    outputs: Vec<PropertyName>,
    direct: Option<Direct>,
    answers: Vec<Cell>,
    /// The last object, as far as the knowledge base was not told of it.
    untold: Option<Vec<Cell>>,
}

impl Consultation {
    /// Makes ready for objects with these properties, of which those outputs will be asked for.
    pub fn new(
        rules: Arc<RuleBase>,
        class: &str,
        inputs: &[(&str, Type)],
        outputs: &[&str],
    ) -> Result<Self, ClassError> {
        let mut object = Class::new(class, &[]);
        for &(name, kind) in inputs {
            object = object.values(name, kind, [None]);
        }
        let mut base = KnowledgeBase::new();
        base.assert(object)?;
        base.conclude(&rules);
        let mut consultation = Self {
            rules,
            base,
            class: class.to_owned(),
            inputs: inputs.iter().map(|(name, _)| (*name).to_owned()).collect(),
            outputs: outputs.iter().map(|output| PropertyName::new(class, *output)).collect(),
            direct: None,
            answers: vec![Cell::Unknown; outputs.len()],
            untold: None,
        };
        consultation.direct = consultation.plan_direct();
        Ok(consultation)
    }

    /// Asserts another class, whose objects the rules look at as well.
    pub fn assert(&mut self, class: Class) -> Result<(), ClassError> {
        self.base.assert(class)?;
        self.base.conclude(&self.rules);
        self.direct = self.plan_direct();
        Ok(())
    }

    /// Whether the rules of the class look at one object alone, so that no inference is needed.
    pub const fn is_direct(&self) -> bool {
        self.direct.is_some()
    }

    /// How closely the rules look at each input, in their order: who is asked about many objects need not ask about those that
    /// are alike to the rules. `None` where they look at other objects, too.
    pub fn grains(&self) -> Option<&[Grain]> {
        self.direct.as_ref().map(|direct| direct.grains.as_slice())
    }

    /// Whether an input may count: what the rules do not look at need not be found out.
    pub fn looks_at(&self, input: usize) -> bool {
        self.grains().and_then(|grains| grains.get(input)).is_none_or(|grain| *grain != Grain::Nothing)
    }

    pub fn rules(&self) -> Arc<RuleBase> {
        Arc::clone(&self.rules)
    }

    /// Judges an object: a value for each input, in their order; what is left out, or of another type, is unknown.
    pub fn consult(&mut self, object: &[Datum]) {
        let mut untold = self.untold.take().unwrap_or_default();
        untold.clear();
        let symbols = self.base.symbols.get_mut();
        untold.extend((0..self.inputs.len()).map(|at| match object.get(at) {
            None | Some(Datum::Unknown) => Cell::Unknown,
            Some(Datum::Number(number)) => Cell::number(*number),
            Some(Datum::Text(text)) => Cell::Text(symbols.intern(text)),
            Some(Datum::Truth(truth)) => Cell::Truth(*truth),
        }));
        self.untold = Some(untold);
        let Some(direct) = &mut self.direct else {
            self.infer();
            for (answer, name) in self.answers.iter_mut().zip(&self.outputs) {
                *answer = self.base.column(name).map_or(Cell::Unknown, |column| column.cell(0));
            }
            return;
        };
        let inputs = self.untold.as_deref().unwrap_or_default();
        direct.run(&self.base, inputs, &mut self.answers);
    }

    /// An output, by its number, as a number; `None` where it is unknown or none.
    pub fn number(&self, output: usize) -> Option<f64> {
        if let Cell::Number(number) = self.answers[output] { Some(number) } else { None }
    }

    pub fn truth(&self, output: usize) -> Option<bool> {
        if let Cell::Truth(truth) = self.answers[output] { Some(truth) } else { None }
    }

    pub fn text(&self, output: usize) -> Option<Arc<str>> {
        if let Cell::Text(symbol) = self.answers[output] {
            self.base.symbols.read().text(symbol).cloned()
        } else {
            None
        }
    }

    pub fn is(&self, output: usize, text: &str) -> bool {
        matches!(self.answers[output], Cell::Text(symbol)
            if self.base.symbols.read().text(symbol).is_some_and(|known| **known == *text))
    }

    pub fn value(&self, output: usize) -> Option<Value> {
        value(self.answers[output], &self.base.symbols.read())
    }

    /// What an inference reports of the last object: conflicts, gaps, what failed.
    pub fn report(&mut self) -> Conclusions {
        self.infer();
        self.base.conclude(&self.rules)
    }

    /// What failed when the last object was judged: a rule that was stopped, or a value of another type, with its file
    /// and line. Rules that run directly leave nothing to the interpreter, and cannot fail.
    pub fn failure(&self) -> Option<String> {
        if self.is_direct() {
            return None;
        }
        self.base.problems(&self.rules).first().map(|problem| {
            format!("{}:{}:{}: {}", problem.file, problem.line, problem.column, problem.message)
        })
    }

    /// The knowledge base that holds the last object, to ask why.
    pub fn knowledge(&mut self) -> &KnowledgeBase {
        self.infer();
        &self.base
    }

    fn plan_direct(&self) -> Option<Direct> {
        Direct::of(&self.base, &self.rules, &self.class, &self.inputs, &self.outputs)
    }

    fn infer(&mut self) {
        let Some(object) = self.untold.take() else { return };
        for (name, cell) in self.inputs.iter().zip(&object) {
            let told = value(*cell, &self.base.symbols.read());
            // A value of another type is unknown, as it is to rules that run directly.
            if self.base.tell_row(&self.class, 0, name, told).is_err() {
                self.base.tell_row(&self.class, 0, name, None).ok();
            }
        }
        self.base.update(&self.rules);
    }
}
