//! What the rules say though they were hardly meant to.

pub(crate) mod table;

use crate::diagnostic::Diagnostic;
use crate::rule::{Action, Rule};

/// What can be seen in the rules alone.
pub(crate) fn lint(rules: &[Rule]) -> Vec<Diagnostic> {
    let mut found = vec![];
    for rule in rules {
        if let Action::Table(table) = &rule.action {
            found.extend(self::table::lint(rule, table));
        }
    }
    found
}
