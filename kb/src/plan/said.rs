//! What rules said at each junction of a path.

use serde::Serialize;

use super::keep::Fact;
use super::refusal::Spoke;

/// What rules were told at a junction, what they concluded, and which of them spoke.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Said {
    /// Number of the junction.
    pub junction: usize,
    /// The rules that were looked at, tables row by row.
    pub considered: Vec<Spoke>,
    /// Told and concluded.
    #[serde(skip)]
    pub facts: Vec<Fact>,
}

impl Said {
    /// For people: the rule that spoke, then why the others did not.
    pub fn lines(&self) -> Vec<String> {
        let (spoke, silent): (Vec<_>, Vec<_>) = self.considered.iter().partition(|rule| rule.spoke);
        let mut lines = vec![format!("junction {}", self.junction)];
        lines.extend(spoke.iter().map(|rule| format!("  {} spoke", rule.text())));
        lines.extend(silent.iter().map(|rule| format!("  {}", rule.text())));
        lines
    }
}
