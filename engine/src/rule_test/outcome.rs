//! What came of a rule test.

use std::fmt;

use crate::diagnostic::Diagnostic;
use crate::value::Value;

#[derive(Clone, Debug, serde::Serialize)]
pub struct TestOutcome {
    pub test: String,
    pub file: String,
    /// Its line, from 1.
    pub line: usize,
    pub passed: bool,
    /// What is not as expected, in the order of the file.
    pub failures: Vec<TestFailure>,
}

#[derive(Clone, Debug, serde::Serialize)]
pub struct TestFailure {
    /// Number of the edit (`[[test.then]]`) after which it was expected; 0 before all edits.
    pub step: usize,
    pub class: String,
    pub key: String,
    pub property: String,
    /// What the test expects; `None` is unknown.
    pub expected: Option<Value>,
    /// What was told or concluded; `None` is unknown.
    pub found: Option<Value>,
    /// Where the value comes from, or why there is none.
    pub why: String,
    /// All of it, at its place in the test's file.
    #[serde(skip)]
    pub diagnostic: Diagnostic,
}

/// One sentence: `DOORS 7 hardness is 4 and should be 3: DOORS 7 hardness is 4, by rule ...`.
impl fmt::Display for TestFailure {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(&self.diagnostic.message)?;
        if self.why.is_empty() { Ok(()) } else { write!(out, ": {}", self.why) }
    }
}
