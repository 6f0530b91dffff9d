//! The rows of a decision table that do not match.

use super::of_rule;
use super::walk::{Walk, one};
use crate::machine::lane::Frame;
use crate::rejection::Rejection;
use crate::rule::Action;
use crate::table::{Literal, Test};
use crate::value::Value;

impl Walk<'_> {
    /// Whether the rule goes on to conclude: always, but for a table, of which a row must match.
    pub(super) fn rows(&mut self, frame: &Frame) -> bool {
        let Action::Table(table) = &self.machine.rule.action else { return true };
        let value = |node| self.knowledge.host_value(self.machine.evaluate(node, one(frame)).cell(0));
        let inputs: Vec<Option<Value>> = self.tests.inputs.iter().map(value).collect();
        let mut matched = false;
        for (number, row) in (1..).zip(&table.rows) {
            let failed =
                row.tests.iter().zip(&inputs).position(|((test, _), input)| !passes(test, input.as_ref()));
            let Some(column) = failed else {
                matched = true;
                continue;
            };
            let reason = Rejection::Row {
                row: number,
                input: table.given[column].1.clone(),
                cell: wording(&row.tests[column].0),
                value: inputs[column].clone(),
            };
            self.rejected.push(of_rule(self.machine.rule, reason));
        }
        matched
    }
}

fn passes(test: &Test, input: Option<&Value>) -> bool {
    let literal = match input {
        None => return *test == Test::Any,
        Some(Value::Number(number)) => Literal::Number(*number),
        Some(Value::Text(text)) => Literal::Text(text.to_string()),
        Some(Value::Truth(truth)) => Literal::Truth(*truth),
    };
    test.passes(&literal)
}

/// What a cell asks, in words.
fn wording(test: &Test) -> String {
    match test {
        Test::Any => "any".to_owned(),
        Test::OneOf(literals) => literals.iter().map(ToString::to_string).collect::<Vec<_>>().join(" or "),
        Test::Not(test) => format!("not {}", wording(test)),
        Test::Below(limit) => format!("below {limit}"),
        Test::AtMost(limit) => format!("at most {limit}"),
        Test::Above(limit) => format!("above {limit}"),
        Test::AtLeast(limit) => format!("at least {limit}"),
        Test::Between(from, to) => format!("from {from} up to {to}"),
    }
}
