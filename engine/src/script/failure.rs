//! What a script that failed says to the author of its rule.

use rhai::{EvalAltResult, Position};

use crate::diagnostic::{Code, Diagnostic};
use crate::rule::Rule;

/// The message, and whether a limit stopped the script.
pub(crate) fn failure(rule: &Rule, start: Position, error: &EvalAltResult) -> (Diagnostic, bool) {
    let cause = error.unwrap_inner();
    let limit =
        matches!(cause, EvalAltResult::ErrorTerminated(..) | EvalAltResult::ErrorTooManyOperations(_));
    let position = error.position();
    let code = if limit { Code::Deadline } else { Code::Evaluation };
    let reason = match cause {
        EvalAltResult::ErrorTerminated(reason, _) => reason.to_string(),
        EvalAltResult::ErrorTooManyOperations(_) => "more steps than a rule may take".to_owned(),
        _ => error.to_string(),
    };
    (
        rule.file.error(
            code,
            if position.is_none() { start } else { position },
            format!("rule \"{}\": {reason}", rule.name),
        ),
        limit,
    )
}
