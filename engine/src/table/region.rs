//! The finitely many regions into which the cells of a table cut the values of an input.

use super::Test;
use crate::value::{Type, Value};

/// One region: all its values pass the same tests.
#[derive(Clone, Debug)]
pub(crate) struct Region {
    example: Value,
    /// How it reads after the input's name, as in `is below 3`; nothing if it is the only one.
    pub(crate) reads: String,
}

/// The regions of an input, by the tests in its column.
pub(crate) fn regions<'t>(tests: impl Iterator<Item = &'t Test>) -> Vec<Region> {
    let literals: Vec<Value> = tests.flat_map(Test::literals).collect();
    match literals.first().map(Value::kind) {
        None => vec![Region { example: Value::Truth(true), reads: String::new() }],
        Some(Type::Truth) => {
            let region = |truth: bool| Region { example: Value::Truth(truth), reads: format!("is {truth}") };
            vec![region(true), region(false)]
        }
        Some(Type::Text) => texts(&literals),
        Some(Type::Number) => numbers(&literals),
    }
}

fn texts(literals: &[Value]) -> Vec<Region> {
    let mut texts: Vec<&str> = vec![];
    for literal in literals {
        if let Value::Text(text) = literal
            && !texts.contains(&&**text)
        {
            texts.push(text);
        }
    }
    let region = |text: &&str| Region { example: Value::from(*text), reads: format!("is \"{text}\"") };
    let mut regions: Vec<Region> = texts.iter().map(region).collect();
    // A text that is longer than all of them is none of them.
    let longest = texts.iter().map(|text| text.len()).max().unwrap_or(0);
    let quoted: Vec<String> = texts.iter().map(|text| format!("\"{text}\"")).collect();
    let reads = match quoted.as_slice() {
        [only] => format!("is not {only}"),
        [first, rest @ ..] => format!("is neither {first} nor {}", rest.join(" nor ")),
        [] => String::new(),
    };
    regions.push(Region { example: Value::from("-".repeat(longest + 1).as_str()), reads });
    regions
}

fn numbers(literals: &[Value]) -> Vec<Region> {
    let mut limits: Vec<f64> = literals
        .iter()
        .filter_map(|literal| match literal {
            Value::Number(number) => Some(number + 0.0),
            _ => None,
        })
        .collect();
    limits.sort_by(f64::total_cmp);
    limits.dedup();
    let mut regions = vec![];
    // Between neighbours, or beyond infinity, there is nothing.
    let mut add = |number: f64, is_there: bool, reads: String| {
        if is_there {
            regions.push(Region { example: Value::Number(number), reads });
        }
    };
    let mut before: Option<f64> = None;
    for &limit in &limits {
        match before {
            None => add(below(limit), below(limit) < limit, format!("is below {limit}")),
            Some(before) => {
                let middle = before / 2.0 + limit / 2.0;
                add(middle, before < middle && middle < limit, format!("is between {before} and {limit}"));
            }
        }
        add(limit, true, format!("is {limit}"));
        before = Some(limit);
    }
    if let Some(last) = before {
        add(above(last), above(last) > last, format!("is above {last}"));
    }
    regions
}

fn below(limit: f64) -> f64 {
    if limit - 1.0 < limit { limit - 1.0 } else { limit.next_down() }
}

fn above(limit: f64) -> f64 {
    if limit + 1.0 > limit { limit + 1.0 } else { limit.next_up() }
}

impl Region {
    pub(crate) fn passes(&self, test: &Test) -> bool {
        test.passes(&self.example)
    }
}
