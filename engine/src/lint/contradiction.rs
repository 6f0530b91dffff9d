//! Conditions that nothing can pass.

use rhai::{Expr, Position};

use crate::diagnostic::{Code, Diagnostic};
use crate::rule::{Clause, FileScope, Rule};
use crate::script::names::property_of;
use crate::table::region::regions;
use crate::table::{Test, plain};
use crate::value::Value;

/// What a condition asks of one property: the path, the test, the place.
pub(super) type Asked = (String, Test, Position);

pub(super) fn lint(rule: &Rule) -> Vec<Diagnostic> {
    let mut before: Vec<Asked> = vec![];
    let mut found = vec![];
    for clause in &rule.clauses {
        let asked = asked(rule, clause);
        if let Some((path, _, position)) = asked.iter().find(|(path, ..)| contradicts(path, &asked, &before))
        {
            let message = format!("nothing can pass: what is asked of `{path}` contradicts itself");
            found.push(rule.file.error(Code::Unreachable, *position, message).warning());
        }
        if clause.quantifier.binds() {
            before.extend(asked);
        }
    }
    found
}

fn contradicts(path: &str, asked: &[Asked], before: &[Asked]) -> bool {
    let of_path = asked.iter().chain(before).filter(|(other, ..)| other == path).map(|(_, test, _)| test);
    let tests: Vec<&Test> = of_path.collect();
    let mut kinds = tests.iter().flat_map(|test| test.literals()).map(|literal| literal.kind());
    let Some(kind) = kinds.next() else { return false };
    // What mixes types is complained about elsewhere.
    kinds.all(|other| other == kind)
        && !regions(tests.iter().copied()).iter().any(|region| tests.iter().all(|test| region.passes(test)))
}

pub(super) fn asked(rule: &Rule, clause: &Clause) -> Vec<Asked> {
    let mut asked = vec![];
    for condition in &clause.conditions {
        let named = |expr: &Expr| match expr {
            Expr::Variable(name, ..) if !condition.file.constants.contains_key(name.1.as_str()) => {
                Some(format!("{}.{}", clause.variable, name.1))
            }
            _ => None,
        };
        let start = asked.len();
        collect(&condition.expr, &condition.file, &named, &mut asked);
        // The class is named in the rule; the condition may stand in another file.
        asked[start..].iter_mut().for_each(|(.., position)| *position = clause.class_position);
    }
    if let Some(condition) = &clause.condition {
        let named =
            |expr: &Expr| property_of(expr).map(|(variable, property, _)| format!("{variable}.{property}"));
        collect(condition, &rule.file, &named, &mut asked);
    }
    asked
}

/// Goes through what is joined by "and".
fn collect(expr: &Expr, file: &FileScope, named: &dyn Fn(&Expr) -> Option<String>, asked: &mut Vec<Asked>) {
    match expr {
        Expr::And(parts, _) => parts.iter().for_each(|part| collect(part, file, named, asked)),
        Expr::FnCall(call, position) if call.args.len() == 2 => {
            let (a, b) = (&call.args[0], &call.args[1]);
            let (path, value, turned) = match (named(a), named(b)) {
                (Some(path), None) => (path, literal(b, file), false),
                (None, Some(path)) => (path, literal(a, file), true),
                _ => return,
            };
            if let Some(test) = value.and_then(|value| test(&call.name, value, turned)) {
                asked.push((path, test, *position));
            }
        }
        _ => {}
    }
}

fn literal(expr: &Expr, file: &FileScope) -> Option<Value> {
    match expr {
        Expr::Variable(name, ..) => file.constants.get(name.1.as_str()).cloned(),
        other => plain(other),
    }
}

/// `turned` is the value on the left: `3 < door.width`.
fn test(operator: &str, value: Value, turned: bool) -> Option<Test> {
    let number = || if let Value::Number(number) = value { Some(number) } else { None };
    Some(match (operator, turned) {
        ("==", _) => Test::OneOf(vec![value]),
        ("!=", _) => Test::Not(Box::new(Test::OneOf(vec![value]))),
        ("<", false) | (">", true) => Test::Below(number()?),
        ("<=", false) | (">=", true) => Test::AtMost(number()?),
        (">", false) | ("<", true) => Test::Above(number()?),
        (">=", false) | ("<=", true) => Test::AtLeast(number()?),
        _ => return None,
    })
}
