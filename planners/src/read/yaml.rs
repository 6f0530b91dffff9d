//! YAML as values, with the text of each scalar that is read as another thing than a text: a room may be called `1.10` or
//! `true` without quotes.

use std::cell::OnceCell;
use std::collections::BTreeMap;
use std::fmt;
use std::ops::Range;

use serde::Deserialize;
use serde::de::{DeserializeSeed, Deserializer, IgnoredAny, MapAccess, SeqAccess, Visitor};
use serde_json::Value;
use serde_saphyr::budget::BudgetBreach;
use serde_saphyr::{
    Error, MessageFormatter as _, NonFiniteFloatPolicy, Options, Spanned, UserMessageFormatter,
};

use super::fields::{span_in, span_of};
use super::value::Step;

/// How deep lists and objects may lie in each other.
const DEEPEST: usize = 64;

/// How many nodes and events any file may have; one that is longer may have more.
const NODES: usize = 250_000;
const EVENTS: usize = 1_000_000;

/// What a text of YAML says, and how its scalars stand there.
#[derive(Debug)]
pub(crate) struct Yaml<'t> {
    text: &'t str,
    pub value: Value,
    /// By where their values lie. Few files have names that want it, and it takes as long again as the values.
    written: OnceCell<BTreeMap<*const Value, String>>,
}

impl<'t> Yaml<'t> {
    /// Reads a text. The error is where it is wrong, and in words how.
    pub fn read(text: &'t str) -> Result<Self, (Option<Range<usize>>, String)> {
        let value = serde_saphyr::from_str_with_options(text, options(text)).map_err(|error| {
            let error = error.without_snippet();
            (error.location().map(|location| span_in(text, location)), in_words(error))
        })?;
        Ok(Self { text, value, written: OnceCell::new() })
    }

    /// Where a value stands.
    pub fn span(&self, steps: &[Step<'_>]) -> Option<Range<usize>> {
        let mut span = None;
        let find =
            |yaml: serde_saphyr::Deserializer<'_, '_>| Find { steps, span: &mut span }.deserialize(yaml);
        // it is read no further than to there
        let _ = serde_saphyr::with_deserializer_from_str_with_options(self.text, options(self.text), find);
        span
    }

    /// How a number, or true or false, of this text stands there.
    pub fn written(&self, of: &Value) -> String {
        let written = self.written.get_or_init(|| {
            let mut written = BTreeMap::new();
            let again = |yaml: serde_saphyr::Deserializer<'_, '_>| {
                AsWritten { value: &self.value, written: &mut written }.deserialize(yaml)
            };
            // a scalar with a tag of its own may be no text: from there on each is what its value is written as
            let _ =
                serde_saphyr::with_deserializer_from_str_with_options(self.text, options(self.text), again);
            written
        });
        written.get(&std::ptr::from_ref(of)).cloned().unwrap_or_else(|| of.to_string())
    }
}

/// A node takes a byte or more, so that the length of a text bounds what it can hold; aliases, which make much of little, are
/// bounded as always.
fn options(text: &str) -> Options {
    serde_saphyr::options! {
        budget: serde_saphyr::budget! {
            max_depth: DEEPEST,
            max_nodes: NODES.max(text.len()),
            max_events: EVENTS.max(4 * text.len()),
        },
        // a node may be called n, and a door `off`
        strict_booleans: true,
        non_finite_float_policy: NonFiniteFloatPolicy::AsString,
        with_snippet: false,
    }
}

/// What the library found, in words of people who write files rather than programs.
fn in_words(error: &Error) -> String {
    match error {
        Error::WithSnippet { error, .. } | Error::AliasError { error, .. } => in_words(error),
        Error::Budget { breach: BudgetBreach::Depth { .. }, .. } => {
            format!("nested deeper than {DEEPEST} levels")
        }
        // more nodes than a text has bytes are of aliases
        Error::Budget {
            breach:
                BudgetBreach::Nodes { .. }
                | BudgetBreach::Events { .. }
                | BudgetBreach::Aliases { .. }
                | BudgetBreach::Anchors { .. }
                | BudgetBreach::AliasAnchorRatio { .. }
                | BudgetBreach::MergeKeys { .. }
                | BudgetBreach::RecordedAnchorEvents { .. }
                | BudgetBreach::RecordedAnchorBytes { .. },
            ..
        }
        | Error::AliasReplayCounterOverflow { .. }
        | Error::AliasReplayLimitExceeded { .. }
        | Error::AliasExpansionLimitExceeded { .. }
        | Error::AliasReplayStackDepthExceeded { .. } => {
            "aliases (`*name`) stand for more than a lane graph can be, expected each value where it belongs"
                .to_owned()
        }
        Error::Budget { .. } => "holds more than Adit reads of one file".to_owned(),
        Error::DuplicateMappingKey { key: Some(key), .. } => {
            format!("the key `{key}` stands here twice, expected once")
        }
        Error::DuplicateMappingKey { key: None, .. } => "a key stands here twice, expected once".to_owned(),
        Error::MultipleDocuments { .. } => "a second document begins (`---`), expected one".to_owned(),
        Error::UnknownAnchor { .. } => {
            "an alias (`*name`) stands for nothing that was named before".to_owned()
        }
        _ => format!("not YAML: {}", UserMessageFormatter.format_message(error)),
    }
}

/// Reads a value once more, for how its scalars stand there.
struct AsWritten<'v, 'w> {
    value: &'v Value,
    written: &'w mut BTreeMap<*const Value, String>,
}

impl AsWritten<'_, '_> {
    const fn of<'w>(&'w mut self, value: &'w Value) -> AsWritten<'w, 'w> {
        AsWritten { value, written: self.written }
    }
}

impl<'de> DeserializeSeed<'de> for AsWritten<'_, '_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, yaml: D) -> Result<(), D::Error> {
        match self.value {
            Value::Number(_) | Value::Bool(_) => {
                self.written.insert(std::ptr::from_ref(self.value), String::deserialize(yaml)?);
                Ok(())
            }
            Value::Array(_) => yaml.deserialize_seq(self),
            Value::Object(_) => yaml.deserialize_map(self),
            Value::Null | Value::String(_) => IgnoredAny::deserialize(yaml).map(|_| ()),
        }
    }
}

impl<'de> Visitor<'de> for AsWritten<'_, '_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("what was read there before")
    }

    fn visit_seq<A: SeqAccess<'de>>(mut self, mut yaml: A) -> Result<(), A::Error> {
        for value in self.value.as_array().into_iter().flatten() {
            yaml.next_element_seed(self.of(value))?;
        }
        while yaml.next_element::<IgnoredAny>()?.is_some() {}
        Ok(())
    }

    fn visit_map<A: MapAccess<'de>>(mut self, mut yaml: A) -> Result<(), A::Error> {
        while let Some(key) = yaml.next_key::<String>()? {
            match self.value.get(&key) {
                Some(value) => yaml.next_value_seed(self.of(value))?,
                None => yaml.next_value::<IgnoredAny>().map(|_| ())?,
            }
        }
        Ok(())
    }
}

/// Goes to a value, for where it stands.
struct Find<'s> {
    steps: &'s [Step<'s>],
    span: &'s mut Option<Range<usize>>,
}

impl<'de> DeserializeSeed<'de> for Find<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, yaml: D) -> Result<(), D::Error> {
        match self.steps.first() {
            None => {
                *self.span = Some(span_of(Spanned::<IgnoredAny>::deserialize(yaml)?.referenced));
                Ok(())
            }
            Some(Step::Item(_)) => yaml.deserialize_seq(self),
            Some(Step::Key(_)) => yaml.deserialize_map(self),
        }
    }
}

impl<'de> Visitor<'de> for Find<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("what was read there before")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut yaml: A) -> Result<(), A::Error> {
        let [Step::Item(place), steps @ ..] = self.steps else { return Ok(()) };
        for _ in 0..*place {
            yaml.next_element::<IgnoredAny>()?;
        }
        yaml.next_element_seed(Find { steps, span: &mut *self.span })?;
        while yaml.next_element::<IgnoredAny>()?.is_some() {}
        Ok(())
    }

    fn visit_map<A: MapAccess<'de>>(self, mut yaml: A) -> Result<(), A::Error> {
        let [Step::Key(key), steps @ ..] = self.steps else { return Ok(()) };
        while let Some(next) = yaml.next_key::<String>()? {
            if next == *key {
                yaml.next_value_seed(Find { steps, span: &mut *self.span })?;
            } else {
                yaml.next_value::<IgnoredAny>()?;
            }
        }
        Ok(())
    }
}
