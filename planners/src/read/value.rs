//! A value of a JSON or YAML file with the way that leads to it, so that a message can name both.

use std::fmt::Write as _;
use std::ops::Range;

use serde_json::{Map, Value};

use super::diagnostic::{Code, Problem};
use super::fields::reckoned;
use super::source::Source;
use crate::geometry::Point;

/// Coordinates, lengths and costs beyond it are slips.
const LARGEST: f64 = 1e9;

#[derive(Clone)]
pub(crate) struct At<'v> {
    source: &'v Source<'v>,
    pub value: &'v Value,
    steps: Vec<Step<'v>>,
}

/// From a list or an object to one of its values.
#[derive(Clone, Copy, Debug)]
pub(super) enum Step<'v> {
    Item(usize),
    Key(&'v str),
}

pub(crate) type Read<T> = Result<T, Problem>;

impl<'v> At<'v> {
    pub const fn top(source: &'v Source<'v>, value: &'v Value) -> Self {
        Self { source, value, steps: Vec::new() }
    }

    /// What is wrong with it.
    pub fn problem(&self, code: Code, message: &str) -> Problem {
        self.source.problem(code, &self.steps, &format!("{} {message}", self.path()))
    }

    /// What is wrong, in a sentence that says what it is of without the way to it.
    pub fn said(&self, code: Code, sentence: &str) -> Problem {
        self.source.problem(code, &self.steps, sentence)
    }

    /// Where the values of a list stand in its text, in one go.
    pub fn item_spans(&self) -> Vec<Range<usize>> {
        self.source.item_spans(&self.steps, self.value.as_array().map_or(0, Vec::len))
    }

    /// The way to it, as `layouts[0].nodes[2]`.
    fn path(&self) -> String {
        let mut path = String::new();
        for step in &self.steps {
            let _ = match step {
                Step::Item(place) => write!(path, "[{place}]"),
                Step::Key(key) if path.is_empty() => write!(path, "{key}"),
                Step::Key(key) => write!(path, ".{key}"),
            };
        }
        if path.is_empty() { "the whole file".to_owned() } else { path }
    }

    pub fn wrong(&self, expected: &str) -> Problem {
        self.problem(Code::WrongType, &format!("is {}, expected {expected}", found(self.value)))
    }

    /// What stands under a key; `None` where nothing does, or null.
    pub fn get(&self, key: &str) -> Option<Self> {
        let (key, value) = self.value.as_object()?.get_key_value(key)?;
        (!value.is_null()).then(|| self.part(value, Step::Key(key)))
    }

    fn part(&self, value: &'v Value, step: Step<'v>) -> Self {
        let steps = self.steps.iter().copied().chain([step]).collect();
        Self { source: self.source, value, steps }
    }

    pub fn need(&self, key: &str) -> Read<Self> {
        match self.value {
            Value::Object(_) => {
                self.get(key).ok_or_else(|| self.problem(Code::MissingKey, &format!("has no `{key}`")))
            }
            _ => Err(self.wrong(&format!("an object with `{key}`"))),
        }
    }

    pub fn items(&self) -> Read<Vec<Self>> {
        let Value::Array(values) = self.value else { return Err(self.wrong("a list")) };
        let item = |(place, value)| self.part(value, Step::Item(place));
        Ok(values.iter().enumerate().map(item).collect())
    }

    /// The entries of a list under a key, none where it is missing.
    pub fn list(&self, key: &str) -> Read<Vec<Self>> {
        self.get(key).map_or(Ok(Vec::new()), |list| list.items())
    }

    pub fn entries(&self) -> Read<Vec<(&'v str, Self)>> {
        let Value::Object(entries) = self.value else { return Err(self.wrong("an object")) };
        let entry = |(key, value): (&'v String, &'v Value)| (key.as_str(), self.part(value, Step::Key(key)));
        Ok(entries.iter().map(entry).collect())
    }

    /// The entries of an object under a key, none where it is missing.
    pub fn object(&self, key: &str) -> Read<Vec<(&'v str, Self)>> {
        self.get(key).map_or(Ok(Vec::new()), |object| object.entries())
    }

    pub fn number(&self) -> Read<f64> {
        let number = self.value.as_f64().ok_or_else(|| self.wrong("a number"))?;
        if number.abs() <= LARGEST {
            return Ok(reckoned(number));
        }
        Err(self.problem(Code::NotFinite, &format!("is {number:e}, expected at most {LARGEST:e}")))
    }

    pub fn positive(&self) -> Read<f64> {
        let number = self.number()?;
        if number > 0.0 {
            return Ok(number);
        }
        Err(self.problem(Code::NotPositive, &format!("is {number}, expected more than 0")))
    }

    pub fn maybe_number(&self, key: &str) -> Read<Option<f64>> {
        self.get(key).map(|value| value.number()).transpose()
    }

    pub fn zero_or_more(&self) -> Read<f64> {
        let number = self.number()?;
        if number >= 0.0 {
            return Ok(number);
        }
        Err(self.problem(Code::NotPositive, &format!("is {number}, expected 0 or more")))
    }

    pub fn not_negative(&self, key: &str) -> Read<Option<f64>> {
        self.get(key).map(|value| value.zero_or_more()).transpose()
    }

    /// The place of an entry of a list of so many.
    pub fn index(&self, count: usize, of: &str) -> Read<usize> {
        let number =
            self.value.as_u64().ok_or_else(|| self.wrong(&format!("the number of one of the {of}")))?;
        if (number as usize) < count {
            return Ok(number as usize);
        }
        let message = format!("is {number}, and the number of {of} is {count}, counted from 0");
        Err(self.problem(Code::Impossible, &message))
    }

    /// A text. In YAML any scalar is one where a text is expected, as it stands there: rooms are called 101.
    pub fn text(&self) -> Read<String> {
        match (self.value, self.source.yaml()) {
            (Value::String(text), _) => Ok(text.clone()),
            (Value::Number(_) | Value::Bool(_), Some(yaml)) => Ok(yaml.written(self.value)),
            _ => Err(self.wrong("a text")),
        }
    }

    /// A name, where an empty one is none.
    pub fn name(&self, key: &str) -> Read<Option<String>> {
        let text = self.get(key).map(|value| value.text()).transpose()?;
        Ok(text.filter(|text| !text.trim().is_empty()))
    }

    /// What tells an object apart: a text, or a whole number.
    pub fn id(&self) -> Read<String> {
        match self.value {
            Value::String(text) if !text.trim().is_empty() => Ok(text.clone()),
            Value::Number(number) if number.is_u64() || number.is_i64() => Ok(number.to_string()),
            Value::Number(_) | Value::Bool(_) if self.source.yaml().is_some() => self.text(),
            _ => Err(self.wrong("an id, a text or a whole number")),
        }
    }

    /// True or false. YAML's older words for them are texts elsewhere.
    pub fn truth(&self) -> Read<bool> {
        let word = self.value.as_str().filter(|_| self.source.yaml().is_some()).map(str::to_lowercase);
        match (self.value, word.as_deref()) {
            (Value::Bool(truth), _) => Ok(*truth),
            (_, Some("yes" | "y" | "on")) => Ok(true),
            (_, Some("no" | "n" | "off")) => Ok(false),
            _ => Err(self.wrong("true or false")),
        }
    }

    pub fn maybe_truth(&self, key: &str) -> Read<Option<bool>> {
        self.get(key).map(|value| value.truth()).transpose()
    }

    pub fn point(&self) -> Read<Point> {
        match self.items()?.as_slice() {
            [x, y, ..] => Ok(Point::new(x.number()?, y.number()?)),
            _ => Err(self.wrong("[x, y]")),
        }
    }

    /// The object without those keys.
    pub fn rest(&self, without: &[&str]) -> Map<String, Value> {
        let Value::Object(entries) = self.value else { return Map::new() };
        let kept = entries.iter().filter(|(key, _)| !without.contains(&key.as_str()));
        kept.map(|(key, value)| (key.clone(), value.clone())).collect()
    }
}

/// A value as a message shows it.
fn found(value: &Value) -> String {
    let mut text = value.to_string();
    if let Some((end, _)) = text.char_indices().nth(40) {
        text.truncate(end);
        text.push('…');
    }
    let mut said = String::new();
    let _ = match value {
        Value::Null => write!(said, "nothing"),
        Value::String(_) => write!(said, "the text {text}"),
        _ => write!(said, "{text}"),
    };
    said
}
