//! Why there is no path, and which rules were looked at.

use std::fmt;

use adit_db::mission::Decided;
use adit_engine::{Considered, Consultation, Severity};
use serde::Serialize;

/// There is no path: a result, not an error.
#[derive(Clone, Debug, PartialEq)]
pub struct NoPath {
    /// The junction at which it ended; `None` where it is not about one.
    pub junction: Option<usize>,
    /// In a sentence, with the numbers.
    pub reason: String,
}

/// A rule, or a row of a table, at a junction.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Spoke {
    pub rule: String,
    /// Its row, from 1, of a table.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub row: Option<usize>,
    pub file: String,
    pub line: usize,
    pub spoke: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub because: Option<String>,
}

impl From<Considered> for Spoke {
    fn from(found: Considered) -> Self {
        let because = found.miss.map(|miss| miss.to_string());
        let Considered { rule, file, line, row, .. } = found;
        Self { rule, row, file, line, spoke: because.is_none(), because }
    }
}

/// A rule that spoke, as it is kept.
pub(crate) fn decided(spoke: &Considered) -> Decided {
    Decided {
        rule: spoke.rule.clone(),
        row: spoke.row.map(|row| row as i64),
        file: spoke.file.clone(),
        line: spoke.line as i64,
    }
}

impl Spoke {
    /// As people read it: `Lee, Table 1, row 2: step.next_side is left, not "right"`.
    pub fn text(&self) -> String {
        let row = self.row.map_or(String::new(), |row| format!(", row {row}"));
        match &self.because {
            None => format!("{}{row} (line {} of {})", self.rule, self.line, self.file),
            Some(because) => format!("{}{row}: {because}", self.rule),
        }
    }
}

impl fmt::Display for NoPath {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(&self.reason)
    }
}

impl NoPath {
    /// At a junction, for this reason alone.
    pub(super) fn at(junction: usize, reason: String) -> Self {
        Self { junction: Some(junction), ..Self::because(reason) }
    }

    /// For a reason that is not about one junction.
    pub(super) fn because(reason: String) -> Self {
        Self { junction: None, reason }
    }
}

/// No rule gave a property, or several gave different ones.
pub(super) fn silent(
    consultation: &mut Consultation,
    class: &str,
    junction: usize,
    property: &str,
) -> NoPath {
    let report = consultation.report();
    let is_it = |name: &adit_engine::PropertyName| name.class == class && name.property == property;
    let conflict = report.conflicts.iter().find(|conflict| is_it(&conflict.property));
    let failed = report.diagnostics.iter().find(|found| found.severity == Severity::Error);
    let reason = match (conflict, failed) {
        (Some(conflict), _) => {
            let said: Vec<String> =
                conflict.values.iter().map(|(rule, value)| format!("\"{rule}\" says {value}")).collect();
            format!("at junction {junction} rules disagree on {property}: {}", said.join(", "))
        }
        (None, Some(failed)) => format!("at junction {junction} a rule failed: {failed}"),
        (None, None) => format!("at junction {junction} no rule gives {property}"),
    };
    NoPath::at(junction, reason)
}
