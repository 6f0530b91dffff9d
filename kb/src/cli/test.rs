//! `adit test`: the tests of the rules, a line a test.

use super::args::SiteArgs;
use super::build::unbuilt;
use super::output::{json, line, problems};
use crate::error::Result;
use crate::words::number::counted;

/// Runs the tests of the rule base that is in force; `false` where one fails.
pub fn run(args: &SiteArgs) -> Result<bool> {
    let tested = unbuilt(args)?.test()?;
    let failed = tested.outcomes.iter().filter(|outcome| !outcome.passed).count();
    if args.json {
        json(&serde_json::json!({
            "generation": tested.generation,
            "passed": failed == 0,
            "tests": tested.outcomes,
            "beneath": tested.beneath.iter().map(|beneath| serde_json::json!({
                "rules": beneath.base,
                "tests": beneath.outcomes,
                "trouble": beneath.trouble.as_ref().map(ToString::to_string),
            })).collect::<Vec<_>>(),
        }))?;
        return Ok(failed == 0);
    }
    for outcome in &tested.outcomes {
        let word = if outcome.passed { "ok    " } else { "FAILED" };
        line(&format!("{word} {} ({}, line {})", outcome.test, outcome.file, outcome.line));
    }
    line(&match (failed, tested.outcomes.len()) {
        (_, 0) => "there are no tests: they belong in `tests/*.toml` beside the rules".to_owned(),
        (0, 1) => "1 test, which holds".to_owned(),
        (0, all) => format!("{all} tests, all hold"),
        (1, all) => format!("1 of {} fails", counted(all, "test")),
        (failed, all) => format!("{failed} of {all} tests fail"),
    });
    for beneath in &tested.beneath {
        let failed = beneath.outcomes.iter().filter(|outcome| !outcome.passed).count();
        let (base, all) = (&beneath.base, beneath.outcomes.len());
        match failed {
            0 if all > 0 => line(&format!("beneath, {base}: {}, all hold", counted(all, "test"))),
            0 => {}
            _ => line(&format!(
                "beneath, {base}: {failed} of {all} tests do not hold with your rules; they need not"
            )),
        }
        problems(&beneath.findings());
    }
    let failures = tested.outcomes.into_iter().flat_map(|outcome| outcome.failures);
    problems(&failures.map(|failure| failure.diagnostic.into()).collect::<Vec<_>>());
    Ok(failed == 0)
}
