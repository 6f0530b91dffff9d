//! Which rules decided what, counted.

use std::collections::BTreeMap;

use adit_engine::Considered;
use serde::Serialize;

/// What rules decided, in the order of the questions, and how often.
#[derive(Clone, Debug, Default)]
pub struct Explained(BTreeMap<Decision, u64>);

#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct Decision {
    /// `strategy`, `landmark` or `trust`.
    pub question: &'static str,
    pub answer: String,
    /// The rule or table that spoke.
    pub rule: String,
    /// The row of a table, from 1.
    pub row: Option<usize>,
    pub file: String,
    pub line: usize,
}

/// A decision, and how often it was made.
#[derive(Clone, Debug, Serialize)]
pub struct Counted<'e> {
    #[serde(flatten)]
    pub decision: &'e Decision,
    pub times: u64,
}

impl Explained {
    pub(super) fn add(&mut self, question: &'static str, answer: &str, considered: &[Considered]) {
        for rule in considered.iter().filter(|rule| rule.miss.is_none()) {
            let decision = Decision {
                question,
                answer: answer.to_owned(),
                rule: rule.rule.clone(),
                row: rule.row,
                file: rule.file.clone(),
                line: rule.line,
            };
            *self.0.entry(decision).or_default() += 1;
        }
    }

    pub fn decisions(&self) -> Vec<Counted<'_>> {
        self.0.iter().map(|(decision, times)| Counted { decision, times: *times }).collect()
    }

    pub fn lines(&self) -> Vec<String> {
        let line = |(Decision { question, answer, rule, row, file, line }, times): (&Decision, &u64)| {
            let row = row.map_or_else(String::new, |row| format!(", row {row}"));
            let times = if *times == 1 { String::new() } else { format!(" ({times} times)") };
            format!("  {question}: {answer}{times}, by {rule}{row} (line {line} of {file})")
        };
        self.0.iter().map(line).collect()
    }
}
