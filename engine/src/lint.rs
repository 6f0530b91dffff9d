//! What the rules say though they were hardly meant to.

mod contradiction;
pub(crate) mod outvoted;
pub(crate) mod table;
mod texts;
pub(crate) mod unused;

use crate::diagnostic::Diagnostic;
use crate::rule::{Action, Rule};

pub(crate) fn lint(rules: &[Rule]) -> Vec<Diagnostic> {
    let mut found = vec![];
    for rule in rules {
        found.extend(contradiction::lint(rule));
        if let Action::Table(table) = &rule.action {
            found.extend(self::table::lint(rule, table).into_iter().map(|found| found.said));
        }
    }
    found
}
