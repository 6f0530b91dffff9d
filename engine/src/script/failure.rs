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
        EvalAltResult::ErrorFunctionNotFound(signature, _) => not_there(signature),
        EvalAltResult::ErrorMismatchDataType(expected, found, _)
        | EvalAltResult::ErrorMismatchOutputType(expected, found, _)
            if !expected.is_empty() && !found.is_empty() =>
        {
            match (kind(found), kind(expected)) {
                ("a number", "a number") => "this is a number, expected a whole number".to_owned(),
                (found, expected) => format!("this is {found}, expected {expected}"),
            }
        }
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

/// The signs that have to do with the bits of whole numbers.
const BITS: [&str; 5] = ["<<", ">>", "&", "|", "^"];

/// That there is no such function of such values, as in `<< (f64, f64)`.
fn not_there(signature: &str) -> String {
    let (name, types) = signature.split_once(" (").unwrap_or((signature, ")"));
    let types = types.strip_suffix(')').unwrap_or(types);
    let kinds: Vec<&str> = types.split(", ").filter(|of| !of.is_empty()).map(kind).collect();
    if BITS.contains(&name) && kinds.iter().all(|kind| *kind == "a number") {
        return format!("`{name}` takes whole numbers alone: it works on their bits");
    }
    match kinds.split_last() {
        None => format!("there is no function `{name}` that is given nothing"),
        Some((only, [])) => format!("there is no `{name}` of {only}"),
        Some((last, others)) => format!("there is no `{name}` of {} and {last}", others.join(", ")),
    }
}

/// The kind of value that rhai's name of a type stands for.
fn kind(of: &str) -> &str {
    match of.trim_start_matches('&').trim_start_matches("mut ") {
        "i64" | "f64" | "int" | "float" => "a number",
        "bool" => "a truth value",
        "string" | "str" | "char" => "a text",
        "array" => "a list",
        "map" => "a map",
        "()" => "what is unknown",
        "Fn" => "a function",
        _ if of.contains("String") => "a text",
        _ => of,
    }
}
