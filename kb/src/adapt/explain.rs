//! Which rules decided what, counted.

use std::collections::BTreeMap;

use adit_engine::Considered;
use serde::Serialize;

/// What rules decided, in the order of the questions.
#[derive(Clone, Debug, Default)]
pub struct Explained(BTreeMap<Asked, u64>);

#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Asked {
    question: &'static str,
    answer: String,
    rule: String,
    row: Option<usize>,
    file: String,
    line: usize,
}

/// One decision, for programs.
#[derive(Clone, Debug, Serialize)]
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
    pub times: u64,
}

impl Explained {
    /// Counts the rules that spoke.
    pub(super) fn add(&mut self, question: &'static str, answer: &str, considered: &[Considered]) {
        for rule in considered.iter().filter(|rule| rule.miss.is_none()) {
            let asked = Asked {
                question,
                answer: answer.to_owned(),
                rule: rule.rule.clone(),
                row: rule.row,
                file: rule.file.clone(),
                line: rule.line,
            };
            *self.0.entry(asked).or_default() += 1;
        }
    }

    pub fn decisions(&self) -> Vec<Decision> {
        let decision = |(asked, times): (&Asked, &u64)| Decision {
            question: asked.question,
            answer: asked.answer.clone(),
            rule: asked.rule.clone(),
            row: asked.row,
            file: asked.file.clone(),
            line: asked.line,
            times: *times,
        };
        self.0.iter().map(decision).collect()
    }

    pub fn lines(&self) -> Vec<String> {
        let line = |decision: Decision| {
            let row = decision.row.map_or_else(String::new, |row| format!(", row {row}"));
            let times =
                if decision.times == 1 { String::new() } else { format!(" ({} times)", decision.times) };
            format!(
                "  {}: {}{times}, by {}{row} (line {} of {})",
                decision.question, decision.answer, decision.rule, decision.line, decision.file
            )
        };
        self.decisions().into_iter().map(line).collect()
    }
}
