//! `adit test`: the tests of the rules, a line a test.

use super::args::SiteArgs;
use super::build::open;
use super::output::{json, line, problems};
use crate::error::Result;

/// Runs the tests of the rule base that is in force; `false` where one fails.
pub fn run(args: &SiteArgs) -> Result<bool> {
    let tested = open(args)?.test()?;
    let failed = tested.outcomes.iter().filter(|outcome| !outcome.passed).count();
    if args.json {
        json(&serde_json::json!({
            "generation": tested.generation,
            "passed": failed == 0,
            "tests": tested.outcomes,
        }))?;
        return Ok(failed == 0);
    }
    for outcome in &tested.outcomes {
        let word = if outcome.passed { "ok    " } else { "FAILED" };
        line(&format!("{word} {} ({}, line {})", outcome.test, outcome.file, outcome.line));
    }
    line(&match (failed, tested.outcomes.len()) {
        (_, 0) => "there are no tests: they belong in `tests/*.toml` beside the rules".to_owned(),
        (0, all) => format!("{all} tests, all hold"),
        (failed, all) => format!("{failed} of {all} tests fail"),
    });
    let failures = tested.outcomes.into_iter().flat_map(|outcome| outcome.failures);
    problems(&failures.map(|failure| failure.diagnostic.into()).collect::<Vec<_>>());
    Ok(failed == 0)
}
