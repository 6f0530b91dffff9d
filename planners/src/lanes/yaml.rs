//! YAML as values, with the text of each scalar that is read as another thing than a text: a room may be called `1.10` or
//! `true` without quotes.

use std::collections::BTreeMap;
use std::fmt;

use serde::Deserialize;
use serde::de::{DeserializeSeed, Deserializer, Error as _, IgnoredAny, MapAccess, SeqAccess, Visitor};
use serde_json::Value;
use serde_saphyr::budget::BudgetBreach;
use serde_saphyr::{Error, MessageFormatter as _, NonFiniteFloatPolicy, Options, UserMessageFormatter};

use super::value::Read;
use crate::read::{Code, Problem};

/// How deep lists and objects may lie in each other.
const DEEPEST: usize = 64;

/// How many nodes and events any file may have; one that is longer may have more.
const NODES: usize = 250_000;
const EVENTS: usize = 1_000_000;

/// How scalars stand in a file, where they are not what their values are written as.
#[derive(Debug, Default)]
pub(super) enum Written {
    #[default]
    Same,
    Scalar(String),
    Items(BTreeMap<usize, Written>),
    Entries(BTreeMap<String, Written>),
}

static SAME: Written = Written::Same;

impl Written {
    pub fn item(&self, place: usize) -> &Self {
        let Self::Items(items) = self else { return &SAME };
        items.get(&place).unwrap_or(&SAME)
    }

    pub fn entry(&self, key: &str) -> &Self {
        let Self::Entries(entries) = self else { return &SAME };
        entries.get(key).unwrap_or(&SAME)
    }

    /// The text of a number, or of true or false.
    pub fn text(&self, value: &Value) -> String {
        if let Self::Scalar(text) = self { text.clone() } else { value.to_string() }
    }
}

/// Reads a text; `file` is how messages call it.
pub(super) fn read(file: &str, text: &str) -> Read<(Value, Written)> {
    let value = serde_saphyr::from_str_with_options(text, options(text)).map_err(|error| {
        let error = error.without_snippet();
        let place = error
            .location()
            .map_or_else(String::new, |at| format!(", line {}, column {}", at.line(), at.column()));
        Problem::of_file(Code::Syntax, format!("{file}{place}: {}", in_words(error)))
    })?;
    let again = |yaml: serde_saphyr::Deserializer<'_, '_>| AsWritten(&value).deserialize(yaml);
    // a scalar with a tag of its own may be no text: then each is what its value is written as
    let written = serde_saphyr::with_deserializer_from_str_with_options(text, options(text), again);
    let written = written.unwrap_or_default();
    Ok((value, written))
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
struct AsWritten<'v>(&'v Value);

impl<'de> DeserializeSeed<'de> for AsWritten<'_> {
    type Value = Written;

    fn deserialize<D: Deserializer<'de>>(self, yaml: D) -> Result<Written, D::Error> {
        match self.0 {
            Value::Number(_) | Value::Bool(_) => {
                let text = String::deserialize(yaml)?;
                Ok(if text == self.0.to_string() { Written::Same } else { Written::Scalar(text) })
            }
            Value::Array(_) => yaml.deserialize_seq(self),
            Value::Object(_) => yaml.deserialize_map(self),
            Value::Null | Value::String(_) => IgnoredAny::deserialize(yaml).map(|_| Written::Same),
        }
    }
}

impl<'de> Visitor<'de> for AsWritten<'_> {
    type Value = Written;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("what was read there before")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut yaml: A) -> Result<Written, A::Error> {
        let mut items = BTreeMap::new();
        for (place, value) in self.0.as_array().into_iter().flatten().enumerate() {
            match yaml.next_element_seed(AsWritten(value))? {
                None => return Err(A::Error::invalid_length(place, &self)),
                Some(Written::Same) => {}
                Some(written) => {
                    items.insert(place, written);
                }
            }
        }
        while yaml.next_element::<IgnoredAny>()?.is_some() {}
        Ok(if items.is_empty() { Written::Same } else { Written::Items(items) })
    }

    fn visit_map<A: MapAccess<'de>>(self, mut yaml: A) -> Result<Written, A::Error> {
        let mut entries = BTreeMap::new();
        while let Some(key) = yaml.next_key::<String>()? {
            match self.0.get(&key) {
                None => {
                    yaml.next_value::<IgnoredAny>()?;
                }
                Some(value) => match yaml.next_value_seed(AsWritten(value))? {
                    Written::Same => {}
                    written => {
                        entries.insert(key, written);
                    }
                },
            }
        }
        Ok(if entries.is_empty() { Written::Same } else { Written::Entries(entries) })
    }
}
