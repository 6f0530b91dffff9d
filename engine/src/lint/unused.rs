//! Constants and functions of a file that nobody in the file uses.

use std::collections::BTreeMap;

use crate::diagnostic::{Code, Diagnostic};
use crate::rule::FileScope;

pub(crate) fn lint(file: &FileScope) -> Vec<Diagnostic> {
    let words = words(file.source.text());
    let functions = file.function_names.iter().map(|(name, _)| ("function", name));
    let constants = file.constants.keys().map(|name| ("constant", name));
    let mut found = vec![];
    for (what, name) in functions.chain(constants) {
        if let Some([only]) = words.get(name.as_str()).map(Vec::as_slice) {
            let place = file.source.place_at(*only);
            let message = format!("the {what} `{name}` is never used");
            found.push(Diagnostic::error(Code::Unused, &place, message).warning());
        }
    }
    found
}

/// Where each name stands, comments aside. What stands in a text counts: it may be an interpolated one.
fn words(text: &str) -> BTreeMap<&str, Vec<usize>> {
    let mut words: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    let mut at = 0;
    while let Some(next) = text[at..].chars().next() {
        let rest = &text[at..];
        let len = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if rest.starts_with("/*") {
            rest.find("*/").map_or(rest.len(), |end| end + 2)
        } else if next.is_alphanumeric() || next == '_' {
            let len = rest.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(rest.len());
            words.entry(&rest[..len]).or_default().push(at);
            len
        } else {
            next.len_utf8()
        };
        at += len;
    }
    words
}
