//! The text of a JSON or YAML file with its values: what is wrong with one of them is said at its place. In a circle with the file of
//! values, since each knows the other.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::Path;

use serde_json::Value;
use serde_json::value::RawValue;

use super::diagnostic::{Code, Problem, Text};
use super::unique::Unique;
use super::value::{At, Read, Step};
use super::yaml::Yaml;

/// So much of a value is underlined.
const MARKED: usize = 60;

/// What a file holds, with its text.
#[derive(Debug)]
pub(crate) struct Source<'t> {
    named: Text,
    text: &'t str,
    values: Values<'t>,
}

#[derive(Debug)]
enum Values<'t> {
    Json(Value),
    Yaml(Yaml<'t>),
}

impl<'t> Source<'t> {
    /// Reads a text, as YAML where the extension of `file` says so. `file` is how messages call it.
    pub fn read(file: &str, text: &'t str) -> Read<Self> {
        // some editors put a mark of byte order before it
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let named = Text::new(file, text);
        let extension = Path::new(file).extension().and_then(|end| end.to_str()).unwrap_or_default();
        let values = if ["yaml", "yml", "tmap2"].contains(&extension) {
            let yaml = Yaml::read(text).map_err(|(span, words)| match span {
                Some(span) => named.problem(Code::Syntax, &span, words),
                None => Problem::of_file(Code::Syntax, format!("{file}: {words}")),
            })?;
            Values::Yaml(yaml)
        } else {
            let Unique(json) = serde_json::from_str(text).map_err(|error| {
                let words = error.to_string();
                let place = format!(" at line {} column {}", error.line(), error.column());
                let words = words.strip_suffix(&place).unwrap_or(&words);
                let words = if error.is_data() { words.to_owned() } else { format!("not JSON: {words}") };
                let start = byte(text, error.line(), error.column());
                named.problem(Code::Syntax, &(start..start + 1), words)
            })?;
            Values::Json(json)
        };
        Ok(Self { named, text, values })
    }

    /// All that it holds.
    pub fn top(&self) -> At<'_> {
        match &self.values {
            Values::Json(value) => At::top(self, value),
            Values::Yaml(yaml) => At::top(self, &yaml.value),
        }
    }

    /// Where it tells texts from numbers by how they look, which JSON does not.
    pub(super) const fn yaml(&self) -> Option<&Yaml<'t>> {
        match &self.values {
            Values::Json(_) => None,
            Values::Yaml(yaml) => Some(yaml),
        }
    }

    /// The text, as problems of it are said.
    pub const fn named(&self) -> &Text {
        &self.named
    }

    /// Where the value begins to which the steps lead, as much of it as is underlined; `None` where that is all of the file.
    fn span(&self, steps: &[Step<'_>]) -> Option<Range<usize>> {
        let span = match &self.values {
            _ if steps.is_empty() => None,
            Values::Json(_) => Some(self.stands(json(self.text, steps)?)),
            Values::Yaml(yaml) => yaml.span(steps),
        }?;
        Some(self.beginning(span))
    }

    /// Where the values of a list of so many begin.
    pub(super) fn item_spans(&self, steps: &[Step<'_>], count: usize) -> Vec<Range<usize>> {
        let raw = match &self.values {
            Values::Json(_) => json(self.text, steps),
            Values::Yaml(_) => None,
        };
        let items = raw.and_then(|raw| serde_json::from_str::<Vec<&RawValue>>(raw.get()).ok());
        match items {
            Some(items) => items.into_iter().map(|item| self.beginning(self.stands(item))).collect(),
            None => vec![self.span(steps).unwrap_or(0..0); count],
        }
    }

    fn stands(&self, raw: &RawValue) -> Range<usize> {
        let start = raw.get().as_ptr() as usize - self.text.as_ptr() as usize;
        start..start + raw.get().len()
    }

    /// What of a value is underlined: of one that goes on over lines, what stands first in it.
    fn beginning(&self, span: Range<usize>) -> Range<usize> {
        let Some(text) = self.text.get(span.clone()) else { return 0..0 };
        let is_long = text.starts_with(['{', '[']) && text.contains('\n');
        let first = if is_long { text[1..].trim_start() } else { text };
        let start = span.end - first.len();
        let line = first.split(['\n', '\r']).next().unwrap_or_default().trim_end_matches([' ', ',']);
        start..start + line.len().min(MARKED)
    }

    /// What is wrong with the value to which the steps lead.
    pub(super) fn problem(&self, code: Code, steps: &[Step<'_>], message: &str) -> Problem {
        match self.span(steps) {
            Some(span) => self.named.problem(code, &span, message),
            None => Problem::of_file(code, format!("{}: {message}", self.named.name())),
        }
    }
}

/// The byte at a line and column, both from 1; columns count bytes.
fn byte(text: &str, line: usize, column: usize) -> usize {
    let before: usize = text.split_inclusive('\n').take(line.saturating_sub(1)).map(str::len).sum();
    (before + column.saturating_sub(1)).min(text.len())
}

/// A value of a JSON text, as it stands there.
fn json<'t>(text: &'t str, steps: &[Step<'_>]) -> Option<&'t RawValue> {
    let mut here: &RawValue = serde_json::from_str(text).ok()?;
    for step in steps {
        here = match step {
            Step::Item(place) => serde_json::from_str::<Vec<&RawValue>>(here.get()).ok()?.get(*place)?,
            Step::Key(key) => {
                serde_json::from_str::<BTreeMap<String, &RawValue>>(here.get()).ok()?.remove(*key)?
            }
        };
    }
    Some(here)
}
