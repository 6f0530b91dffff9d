//! What a value is, and what would settle it: only what it needs is weighed, and what nobody told is asked.

use std::collections::BTreeSet;

use adit_engine::{Answer, Type, Value};
use serde::Serialize;

use super::Reasoned;
use super::subject::Subject;
use crate::error::{Code, Error, Result};
use crate::live::Live;
use crate::state::State;
use crate::words::suggest::did_you_mean;

/// How far behind a conclusion those are told that it rests on.
const DEEPEST: usize = 8;

/// What came of asking for a value.
#[derive(Clone, Debug, PartialEq, Serialize, utoipa::ToSchema)]
pub struct Asked {
    /// The state of the knowledge base that it rests on.
    pub generation: u64,
    /// What was asked for, as `cars.7.advice`.
    pub what: String,
    /// What there is now: `known`, `asks` (more has to be known), or `unknown` (nothing settles it).
    pub status: &'static str,
    /// The value, where it is known.
    #[schema(value_type = serde_json::Value)]
    pub value: Option<Value>,
    /// Why it is so: the value, then what it rests on.
    pub why: Vec<String>,
    /// What is asked next.
    pub question: Option<Question>,
    /// How many objects rules weighed for it.
    pub weighed: usize,
}

/// Something to be told by whoever asks.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, utoipa::ToSchema)]
pub struct Question {
    /// What is asked, as `cars.7.lights`.
    pub what: String,
    /// In the words of the rule base.
    pub text: String,
}

/// An answer to a question.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Said {
    /// What was asked, as `cars.7.lights`.
    pub what: String,
    /// The value as people write it; `None`: it is not known.
    pub value: Option<String>,
}

/// A property of an object.
struct Wanted {
    class: String,
    row: usize,
    key: String,
    property: String,
    name: String,
}

impl Live {
    /// What a value is where these answers hold. Nothing is kept of them.
    pub fn ask(&self, what: &str, said: &[Said]) -> Result<Asked> {
        self.fork().ask(what, said)
    }
}

impl State {
    /// As [`Live::ask`], of the state that was forked.
    pub fn ask(mut self, what: &str, said: &[Said]) -> Result<Asked> {
        for answer in said {
            let of = self.wanted(&answer.what)?;
            match &answer.value {
                None => self.knowledge.tell_not_known(&of.class, &of.key, &of.property),
                Some(text) => {
                    let value = self.read(&of, text)?;
                    let told = self.knowledge.tell_row(&of.class, of.row, &of.property, Some(value));
                    told.map_err(Error::of(Code::TellType))?;
                }
            }
        }
        let of = self.wanted(what)?;
        let rules = &self.inputs.rules;
        let (answer, changes) = self.knowledge.ask_row(rules, &of.class, of.row, &of.property);
        let weighed = changes.evaluated.iter().map(|(_, objects)| objects).sum();
        let mut asked = Asked {
            generation: self.generation,
            what: what.to_owned(),
            status: "unknown",
            value: None,
            why: Vec::new(),
            question: None,
            weighed,
        };
        match answer {
            Answer::Known(value) => {
                (asked.status, asked.value) = ("known", Some(value));
                asked.why = self.because(&of)?;
            }
            Answer::Ask(question) => {
                let class = question.property.class.to_lowercase();
                let what = format!("{class}.{}.{}", question.key, question.property.property);
                asked.status = "asks";
                asked.question = Some(Question { what, text: question.text });
            }
            Answer::NotKnown => asked.why = self.because(&of).unwrap_or_default(),
        }
        Ok(asked)
    }

    /// `class.key.property`, understood.
    fn wanted(&self, text: &str) -> Result<Wanted> {
        let wrong = |message: String, help: Option<String>| Error::said(Code::WhyUnknown, message, help);
        let parts =
            text.trim().split_once('.').and_then(|(class, rest)| Some((class, rest.rsplit_once('.')?)));
        let Some((class, (key, property))) = parts else {
            let help = "say class, object and property, as in `orders.2.total`".to_owned();
            return Err(wrong(format!("`{text}` names no property of an object"), Some(help)));
        };
        let schema = self.site.schema(&self.told);
        let class = class.to_uppercase();
        if !schema.has(&class) {
            let help = did_you_mean(&class, schema.classes());
            return Err(wrong(format!("there is no class {class}"), help));
        }
        let subject = Subject::find(self, &format!("{}.{key}", class.to_lowercase()))?;
        let row = self.knowledge.row(&class, &subject.key);
        let row = row.ok_or_else(|| wrong(format!("{class} has no {key}"), None))?;
        let rules = &self.inputs.rules;
        let named = rules.rules().iter().flat_map(|rule| rule.reads().chain(rule.sets()));
        let named = named.filter(|name| name.class == class).map(|name| name.property.as_str());
        let known: BTreeSet<&str> = named.chain(schema.properties(&class)).collect();
        if !known.contains(property) {
            let help = did_you_mean(property, known.iter().copied());
            return Err(wrong(format!("{class} has no property {property}"), help));
        }
        Ok(Wanted { class, row, key: subject.key, property: property.to_owned(), name: subject.name })
    }

    /// A value as people write it.
    fn read(&self, of: &Wanted, text: &str) -> Result<Value> {
        let text = text.trim();
        let truth = match text.to_lowercase().as_str() {
            "true" | "yes" => Some(true),
            "false" | "no" => Some(false),
            _ => None,
        };
        let number = text.parse::<f64>().ok().filter(|number| number.is_finite());
        let kind = self.knowledge.kind_of(&of.class, &of.property);
        let found = match kind {
            Some(Type::Truth) => truth.map(Value::Truth),
            Some(Type::Number) => number.map(Value::Number),
            Some(Type::Text) => Some(Value::from(text)),
            None => truth.map(Value::Truth).or(number.map(Value::Number)).or(Some(Value::from(text))),
        };
        found.ok_or_else(|| {
            let wanted = if kind == Some(Type::Truth) { "yes or no" } else { "a number" };
            let message = format!("{} {}: `{text}` was said, and {wanted} is asked", of.name, of.property);
            Error::said(Code::TellType, message, None)
        })
    }

    /// Why a value is as it is, and then what that rests on, each conclusion once.
    fn because(&self, of: &Wanted) -> Result<Vec<String>> {
        let mut said = Vec::new();
        let mut next = vec![(of.class.clone(), of.key.clone(), of.property.clone())];
        let mut seen = BTreeSet::new();
        for _ in 0..DEEPEST {
            let mut behind = Vec::new();
            for (class, key, property) in next {
                if !seen.insert((class.clone(), key.clone(), property.clone())) {
                    continue;
                }
                let subject = Subject::find(self, &format!("{}.{key}", class.to_lowercase()))?;
                let subject = Subject { property: Some(property.clone()), ..subject };
                let Ok((found, facts)) = self.conclusions(&subject) else {
                    let value = self.knowledge.value(&class, &key, &property);
                    said.extend(
                        value.map(|value| format!("{} {property} is {value}, as told", subject.name)),
                    );
                    continue;
                };
                said.extend(found.into_iter().map(|Reasoned { why, .. }| why));
                for fact in facts {
                    behind.extend(
                        fact.properties
                            .into_iter()
                            .filter(|(_, value)| !value.is_null())
                            .map(|(property, _)| (fact.class.clone(), fact.key.clone(), property)),
                    );
                }
            }
            next = behind;
        }
        Ok(said)
    }
}
