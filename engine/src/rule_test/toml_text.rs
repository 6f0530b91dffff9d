//! Values of a TOML text with their places; what is not as it should be is reported there, and reading goes on.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::diagnostic::{Code, Diagnostic};
use crate::script::source::SourceFile;
use crate::suggest::nearest;
use crate::value::Value;

/// Something with its place in the text, in bytes.
#[derive(Clone, Debug)]
pub(super) struct Located<T> {
    pub(super) value: T,
    pub(super) span: Range<usize>,
}

pub(super) type Entry<'t> = Spanned<DeValue<'t>>;

/// A text that is being read, and what is wrong with it so far.
pub(super) struct Reader<'s> {
    pub(super) source: &'s SourceFile,
    pub(super) problems: Vec<Diagnostic>,
}

impl Reader<'_> {
    pub(super) fn refuse(&mut self, span: &Range<usize>, message: impl Into<String>) {
        self.problems.push(Diagnostic::error(Code::TestSyntax, &self.source.place_of(span), message));
    }

    /// A table whose keys are among these.
    pub(super) fn table<'t, 'i>(
        &mut self,
        entry: &'t Entry<'i>,
        what: &str,
        known: &[&str],
    ) -> Option<&'t DeTable<'i>> {
        let table = self.free_table(entry, what)?;
        self.refuse_others(table, what, known);
        Some(table)
    }

    pub(super) fn refuse_others(&mut self, table: &DeTable<'_>, what: &str, known: &[&str]) {
        for key in table.keys().filter(|key| !known.contains(&&**key.get_ref())) {
            let place = self.source.place_of(&key.span());
            let message = format!("`{}` is no part of {what}", key.get_ref());
            let problem = Diagnostic::error(Code::TestSyntax, &place, message);
            let meant = nearest(key.get_ref(), known.iter().copied());
            self.problems.push(match meant {
                Some(_) => problem.did_you_mean(meant),
                None => problem.help(format!("it may have {}", known.join(", "))),
            });
        }
    }

    pub(super) fn free_table<'t, 'i>(&mut self, entry: &'t Entry<'i>, what: &str) -> Option<&'t DeTable<'i>> {
        let DeValue::Table(table) = entry.get_ref() else {
            self.wrong_kind(entry, what, "a table");
            return None;
        };
        Some(table)
    }

    /// The entries of a list; none where there is no such list.
    pub(super) fn list<'t, 'i>(&mut self, entry: Option<&'t Entry<'i>>, what: &str) -> Vec<&'t Entry<'i>> {
        match entry.map(|entry| (entry, entry.get_ref())) {
            None => vec![],
            Some((_, DeValue::Array(entries))) => entries.iter().collect(),
            Some((entry, _)) => {
                self.wrong_kind(entry, what, "a list");
                vec![]
            }
        }
    }

    pub(super) fn text(&mut self, entry: &Entry<'_>, what: &str) -> Option<String> {
        let DeValue::String(text) = entry.get_ref() else {
            self.wrong_kind(entry, what, "a text in quotes");
            return None;
        };
        Some(text.to_string())
    }

    /// A value of a property; `{ unknown = true }` is `None`.
    pub(super) fn value(&mut self, entry: &Entry<'_>) -> Located<Option<Value>> {
        let value = match entry.get_ref() {
            DeValue::String(text) => Some(Value::from(&**text)),
            DeValue::Boolean(truth) => Some(Value::from(*truth)),
            DeValue::Table(table) if is_unknown(table) => None,
            other => {
                let found = number(other);
                if found.is_none() {
                    self.wrong_kind(entry, "a value", "a number, a text, true, false or { unknown = true }");
                }
                found.filter(|number| !number.is_nan()).map(Value::from)
            }
        };
        Located { value, span: entry.span() }
    }

    /// A number that is not negative.
    pub(super) fn tolerance(&mut self, entry: &Entry<'_>) -> f64 {
        let number = number(entry.get_ref()).filter(|number| *number >= 0.0);
        number.unwrap_or_else(|| {
            self.wrong_kind(entry, "`tolerance`", "a number that is not negative");
            0.0
        })
    }

    fn wrong_kind(&mut self, entry: &Entry<'_>, what: &str, wanted: &str) {
        let found = entry.get_ref().type_str();
        self.refuse(&entry.span(), format!("{what} must be {wanted}, and this is of the kind `{found}`"));
    }
}

pub(super) fn get<'t, 'i>(table: &'t DeTable<'i>, key: &str) -> Option<&'t Entry<'i>> {
    table.iter().find(|(name, _)| &**name.get_ref() == key).map(|(_, entry)| entry)
}

/// The entries of a table in the order of the text.
pub(super) fn in_order<'t, 'i>(table: &'t DeTable<'i>) -> Vec<(Located<String>, &'t Entry<'i>)> {
    let located = |key: &Spanned<_>| -> Located<String> {
        let text: &std::borrow::Cow<'_, str> = key.get_ref();
        Located { value: text.to_string(), span: key.span() }
    };
    let mut entries: Vec<_> = table.iter().map(|(key, entry)| (located(key), entry)).collect();
    entries.sort_by_key(|(key, _)| key.span.start);
    entries
}

fn is_unknown(table: &DeTable<'_>) -> bool {
    table.len() == 1 && matches!(get(table, "unknown").map(Spanned::get_ref), Some(DeValue::Boolean(true)))
}

fn number(value: &DeValue<'_>) -> Option<f64> {
    match value {
        DeValue::Integer(integer) => {
            i64::from_str_radix(integer.as_str(), integer.radix()).ok().map(|integer| integer as f64)
        }
        DeValue::Float(float) => float.as_str().parse().ok(),
        _ => None,
    }
}
