//! The texts with which rules compare properties.

use std::collections::BTreeSet;

use super::contradiction::asked;
use crate::rule::{Action, PropertyName, Rule};
use crate::script::names::property_of;
use crate::table::Test;
use crate::value::Value;

impl Rule {
    /// Properties that its conditions, or the cells of its table, compare with a text as it stands there, and that text.
    pub(crate) fn compared_texts(&self) -> BTreeSet<(PropertyName, String)> {
        let mut found = BTreeSet::new();
        let mut add = |variable: &str, property: &str, test: &Test| {
            let Some(clause) = self.clauses.iter().find(|clause| clause.variable == variable) else { return };
            for literal in test.literals() {
                if let Value::Text(text) = literal {
                    found.insert((PropertyName::new(&clause.class, property), text.to_string()));
                }
            }
        };
        for (path, test, _) in self.clauses.iter().flat_map(|clause| asked(self, clause)) {
            if let Some((variable, property)) = path.split_once('.') {
                add(variable, property, &test);
            }
        }
        if let Action::Table(table) = &self.action {
            let cells = table.rows.iter().flat_map(|row| table.given.iter().zip(&row.tests));
            for ((input, _), (test, _)) in cells {
                if let Some((variable, property, _)) = property_of(input) {
                    add(variable, property, test);
                }
            }
        }
        found
    }
}
