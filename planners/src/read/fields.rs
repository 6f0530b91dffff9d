//! The keys of one TOML table, read strictly: whatever is missing, unknown or of another type is reported with
//! its place, and reading goes on so that one run shows everything.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::diagnostic::{Code, MapErrors, Problem, Text};
use super::suggest::nearest;
use crate::world::Property;

/// The largest number that a file may hold. In metres it is far beyond any floor; beyond it the centimetres of a
/// coordinate would be lost, and sums of hardness would not stay finite.
pub const LARGEST: f64 = 1e15;

/// What is nearer to 0 is 0: the products of such numbers have hardly any digits left, or none.
const LEAST: f64 = 1e-100;

/// A number without what is too little to be reckoned with.
pub fn reckoned(number: f64) -> f64 {
    if number.abs() < LEAST { 0.0 } else { number }
}

/// A TOML document that was parsed, to be read field by field.
pub struct Document<'i> {
    table: Spanned<DeTable<'i>>,
    text: Text,
}

impl<'i> Document<'i> {
    /// Parses a text.
    ///
    /// # Arguments
    /// `name` is how messages call the file, `text` its content.
    pub fn parse(name: &str, text: &'i str) -> Result<Self, MapErrors> {
        let source = Text::new(name, text);
        let table = DeTable::parse(text).map_err(|error| syntax_problem(&source, &error))?;
        Ok(Self { table, text: source })
    }

    /// Its outermost table; `what` is how messages call it. Whatever is missing there is missing at the start.
    pub fn fields<'a>(&'a self, what: &'a str) -> Fields<'a, 'i> {
        Fields { what, table: self.table.get_ref(), span: 0..0, text: &self.text }
    }
}

/// A value with its place in the text, in bytes.
#[derive(Clone, Debug, PartialEq)]
pub struct Located<T> {
    pub value: T,
    pub span: Range<usize>,
}

impl<T: Clone> From<&serde_saphyr::Spanned<T>> for Located<T> {
    fn from(value: &serde_saphyr::Spanned<T>) -> Self {
        Self { value: value.value.clone(), span: span_of(value.referenced) }
    }
}

/// What the parser of YAML and JSON found, for whoever wrote the text.
pub fn in_words(error: &serde_saphyr::Error) -> String {
    use serde_saphyr::Error;
    match error {
        Error::NullIntoString { .. } => "nothing stands here, expected a text".to_owned(),
        Error::DuplicateMappingKey { key: Some(key), .. } => format!("`{key}` stands there twice"),
        Error::DuplicateMappingKey { .. } => "a key stands there twice".to_owned(),
        other => other.to_string(),
    }
}

/// Where a place of a YAML or JSON text lies, in bytes.
pub(crate) fn span_of(location: serde_saphyr::Location) -> Range<usize> {
    let span = location.span();
    let start = span.byte_offset().unwrap_or(0) as usize;
    start..start + span.byte_len().unwrap_or(0) as usize
}

/// Where an error of a YAML text is, in bytes; some are told by line and column alone.
pub(crate) fn span_in(text: &str, location: serde_saphyr::Location) -> Range<usize> {
    let span = span_of(location);
    if span.start > 0 || location.line() < 2 && location.column() < 2 {
        return span;
    }
    let (line, column) = (location.line() as usize, location.column() as usize);
    let before: usize = text.split_inclusive('\n').take(line.saturating_sub(1)).map(str::len).sum();
    let rest = text.get(before..).unwrap_or_default();
    let within = rest.char_indices().nth(column.saturating_sub(1)).map_or(rest.len(), |(byte, _)| byte);
    before + within..before + within
}

fn is_meant(key: &str) -> String {
    format!("did you mean `{key}`?")
}

/// One table of a document, and where to report what is wrong with it.
pub struct Fields<'a, 'i> {
    /// How messages call it: `[[obstacle]]`.
    pub what: &'a str,
    pub table: &'a DeTable<'i>,
    /// Where it stands in the text, bytes.
    pub span: Range<usize>,
    pub text: &'a Text,
}

impl Fields<'_, '_> {
    /// Refuses every key that is not one of `known`.
    pub fn refuse_unknown(&self, known: &[&str], problems: &mut Vec<Problem>) {
        for key in self.table.keys().filter(|key| !known.contains(&&**key.get_ref())) {
            let message = self.unknown(key.get_ref());
            let help = match nearest(key.get_ref(), known) {
                Some(meant) => is_meant(meant),
                None => format!("known keys: {}", known.join(", ")),
            };
            problems.push(self.text.problem(Code::UnknownKey, &key.span(), message).with_help(help));
        }
    }

    fn unknown(&self, key: &str) -> String {
        format!("`{key}` is not a key of {}", self.what)
    }

    /// Whether a key that is not there stands there in another spelling, and that is said already.
    fn is_misspelt(&self, key: &str, problems: &[Problem]) -> bool {
        let mut said = problems.iter().filter(|problem| problem.help.as_ref() == Some(&is_meant(key)));
        said.any(|problem| self.table.keys().any(|other| problem.message == self.unknown(other.get_ref())))
    }

    pub fn get(&self, key: &str) -> Option<&Spanned<DeValue<'_>>> {
        self.table.iter().find(|(name, _)| &**name.get_ref() == key).map(|(_, value)| value)
    }

    /// The value of a key that must be there.
    fn require(&self, key: &str, problems: &mut Vec<Problem>) -> Option<&Spanned<DeValue<'_>>> {
        let value = self.get(key);
        if value.is_none() && !self.is_misspelt(key, problems) {
            let message = format!("{} needs a `{key}`", self.what);
            problems.push(self.text.problem(Code::MissingKey, &self.span, message));
        }
        value
    }

    /// A finite number that must be there.
    pub fn number(&self, key: &str, problems: &mut Vec<Problem>) -> Option<Located<f64>> {
        let value = self.require(key, problems)?;
        self.finite(key, value, problems).map(|number| Located { value: number, span: value.span() })
    }

    /// A finite number more than zero that must be there.
    pub fn positive(&self, key: &str, problems: &mut Vec<Problem>) -> Option<Located<f64>> {
        let number = self.number(key, problems)?;
        if number.value > 0.0 {
            return Some(number);
        }
        let message = format!("`{key}` is {} and must be more than 0", number.value);
        problems.push(self.text.problem(Code::NotPositive, &number.span, message));
        None
    }

    /// A text that must be there.
    pub fn string(&self, key: &str, problems: &mut Vec<Problem>) -> Option<Located<String>> {
        let value = self.require(key, problems)?;
        match value.get_ref() {
            DeValue::String(text) => Some(Located { value: text.to_string(), span: value.span() }),
            other => {
                problems.push(self.wrong_type(key, "a text in quotes", other, value.span()));
                None
            }
        }
    }

    /// True or false under a key that must be there.
    pub fn truth(&self, key: &str, problems: &mut Vec<Problem>) -> Option<bool> {
        let value = self.require(key, problems)?;
        match value.get_ref() {
            DeValue::Boolean(truth) => Some(*truth),
            other => {
                problems.push(self.wrong_type(key, "true or false", other, value.span()));
                None
            }
        }
    }

    /// Exactly `N` finite numbers under a key that must be there.
    pub fn numbers<const N: usize>(
        &self,
        key: &str,
        problems: &mut Vec<Problem>,
    ) -> Option<Located<[f64; N]>> {
        let value = self.require(key, problems)?;
        self.array(key, value, problems).map(|numbers| Located { value: numbers, span: value.span() })
    }

    /// Points `[[x, y], ...]` under a key that must be there.
    pub fn points(&self, key: &str, problems: &mut Vec<Problem>) -> Option<Located<Vec<Located<[f64; 2]>>>> {
        self.each(key, "a list of [x, y]", problems, |entry, problems| self.array(key, entry, problems))
    }

    /// Lists of finite numbers `[[a, b, ...], ...]` under a key that must be there, of any lengths.
    pub fn lists(&self, key: &str, problems: &mut Vec<Problem>) -> Option<Located<Vec<Located<Vec<f64>>>>> {
        self.each(key, "a list of lists of numbers", problems, |entry, problems| {
            self.list(key, entry, problems)
        })
    }

    /// The entries of a list under a key that must be there, each of them read.
    fn each<T>(
        &self,
        key: &str,
        wanted: &str,
        problems: &mut Vec<Problem>,
        read: impl Fn(&Spanned<DeValue<'_>>, &mut Vec<Problem>) -> Option<T>,
    ) -> Option<Located<Vec<Located<T>>>> {
        let value = self.require(key, problems)?;
        let DeValue::Array(entries) = value.get_ref() else {
            problems.push(self.wrong_type(key, wanted, value.get_ref(), value.span()));
            return None;
        };
        let mut read = |entry: &Spanned<DeValue<'_>>| {
            read(entry, problems).map(|value| Located { value, span: entry.span() })
        };
        let all: Vec<_> = entries.iter().filter_map(&mut read).collect();
        (all.len() == entries.len()).then(|| Located { value: all, span: value.span() })
    }

    pub fn list(
        &self,
        key: &str,
        value: &Spanned<DeValue<'_>>,
        problems: &mut Vec<Problem>,
    ) -> Option<Vec<f64>> {
        let DeValue::Array(entries) = value.get_ref() else {
            problems.push(self.wrong_type(key, "a list of numbers", value.get_ref(), value.span()));
            return None;
        };
        let numbers: Vec<f64> =
            entries.iter().filter_map(|entry| self.finite(key, entry, problems)).collect();
        (numbers.len() == entries.len()).then_some(numbers)
    }

    /// The table of `[key]`; `None` where the key is missing.
    pub fn table<'b>(
        &'b self,
        key: &str,
        what: &'b str,
        problems: &mut Vec<Problem>,
    ) -> Option<Fields<'b, 'b>> {
        let value = self.get(key)?;
        match value.get_ref() {
            DeValue::Table(table) => Some(Fields { what, table, span: value.span(), text: self.text }),
            other => {
                problems.push(self.wrong_type(key, what, other, value.span()));
                None
            }
        }
    }

    /// The tables of `[[key]]`, in the order of the file; none where the key is missing.
    pub fn tables<'b>(
        &'b self,
        key: &str,
        what: &'b str,
        problems: &mut Vec<Problem>,
    ) -> Vec<Fields<'b, 'b>> {
        let Some(value) = self.get(key) else { return Vec::new() };
        let DeValue::Array(entries) = value.get_ref() else {
            problems.push(self.wrong_type(key, what, value.get_ref(), value.span()));
            return Vec::new();
        };
        let mut tables = Vec::with_capacity(entries.len());
        for entry in entries {
            match entry.get_ref() {
                DeValue::Table(table) => {
                    tables.push(Fields { what, table, span: entry.span(), text: self.text });
                }
                other => problems.push(self.wrong_type(key, what, other, entry.span())),
            }
        }
        tables
    }

    /// A finite number under a key that is there; of anything else it is said that it must be `wanted`.
    pub(super) fn number_or(&self, key: &str, wanted: &str, problems: &mut Vec<Problem>) -> Option<Property> {
        let value = self.get(key)?;
        if matches!(value.get_ref(), DeValue::Integer(_) | DeValue::Float(_)) {
            return self.finite(key, value, problems).map(Property::Number);
        }
        problems.push(self.wrong_type(key, wanted, value.get_ref(), value.span()));
        None
    }

    fn array<const N: usize>(
        &self,
        key: &str,
        value: &Spanned<DeValue<'_>>,
        problems: &mut Vec<Problem>,
    ) -> Option<[f64; N]> {
        let wanted = format!("a list of {N} numbers");
        let DeValue::Array(entries) = value.get_ref() else {
            problems.push(self.wrong_type(key, &wanted, value.get_ref(), value.span()));
            return None;
        };
        let numbers: Vec<f64> =
            entries.iter().filter_map(|entry| self.finite(key, entry, problems)).collect();
        if entries.len() != N {
            let message = format!("`{key}` has {} entries and needs {N}", entries.len());
            problems.push(self.text.problem(Code::WrongType, &value.span(), message));
            return None;
        }
        numbers.try_into().ok()
    }

    /// A finite number; of anything else it is said what it is.
    pub fn finite(
        &self,
        key: &str,
        value: &Spanned<DeValue<'_>>,
        problems: &mut Vec<Problem>,
    ) -> Option<f64> {
        let number = match value.get_ref() {
            DeValue::Integer(integer) => i64::from_str_radix(integer.as_str(), integer.radix())
                .map_or(f64::INFINITY, |integer| integer as f64),
            DeValue::Float(float) => float.as_str().parse().unwrap_or(f64::NAN),
            other => {
                problems.push(self.wrong_type(key, "a number", other, value.span()));
                return None;
            }
        };
        if number.abs() <= LARGEST {
            return Some(reckoned(number));
        }
        let message = if number.is_finite() {
            format!("`{key}` is {number:e}, and numbers up to {LARGEST:e} are read")
        } else {
            format!("`{key}` must be a finite number")
        };
        problems.push(self.text.problem(Code::NotFinite, &value.span(), message));
        None
    }

    /// Says that a value should be something else.
    pub fn wrong_type(&self, key: &str, wanted: &str, found: &DeValue<'_>, span: Range<usize>) -> Problem {
        let message = format!("`{key}` of {} must be {wanted}, not {}", self.what, article(found.type_str()));
        self.text.problem(Code::WrongType, &span, message)
    }
}

fn article(noun: &str) -> String {
    let an = noun.starts_with(['a', 'e', 'i', 'o', 'u']);
    format!("{} {noun}", if an { "an" } else { "a" })
}

fn syntax_problem(source: &Text, error: &toml::de::Error) -> Problem {
    let span = error.span().unwrap_or(0..0);
    let problem = source.problem(Code::Syntax, &span, error.message().replace('\n', ", "));
    if error.message().starts_with("duplicate key") {
        return problem.with_help("a list stands either as `key = [...]` or as [[key]] entries, not as both");
    }
    problem
}
