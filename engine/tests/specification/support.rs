//! What several specifications use.

use adit_engine::{Class, Code, Conclusions, KnowledgeBase, RuleBase, SourceFile, Value};

pub fn rules(text: &str) -> RuleBase {
    RuleBase::compile(&[SourceFile::new("test.rhai", text)]).unwrap_or_else(|wrong| panic!("{wrong}"))
}

/// The rules run once over the classes.
pub fn concluded(text: &str, classes: impl IntoIterator<Item = Class>) -> (KnowledgeBase, Conclusions) {
    let mut base = KnowledgeBase::new();
    for class in classes {
        base.assert(class).unwrap();
    }
    let report = base.conclude(&rules(text));
    let failures: Vec<_> =
        report.diagnostics.iter().filter(|problem| problem.code != Code::Conflict).collect();
    assert!(failures.is_empty(), "{failures:?}");
    (base, report)
}

pub fn number(base: &KnowledgeBase, class: &str, key: &str, property: &str) -> Option<f64> {
    match base.value(class, key, property) {
        Some(Value::Number(number)) => Some(number),
        None => None,
        other => panic!("{class} {key} {property} is {other:?}"),
    }
}

pub fn text(base: &KnowledgeBase, class: &str, key: &str, property: &str) -> Option<String> {
    base.value(class, key, property).map(|value| value.to_string())
}

/// A class of things numbered from 1, with one property of numbers.
pub fn things(property: &str, values: &[Option<f64>]) -> Class {
    Class::new("THINGS", &["thing"])
        .numbers("thing", (1..).take(values.len()).map(|n| Some(f64::from(n))))
        .numbers(property, values.iter().copied())
}

/// The five states of the paper's robot.
pub fn robots() -> Class {
    let states = ["STAND", "SIDE-STAND", "SQUAT", "LIE-FACE-DOWN", "IMPOSSIBLE"];
    let actions = ["WALK", "SIDE-WALK", "WALK-ON-KNEE", "CREEP", "NO-ACTION"];
    Class::new("ROBOTS", &["robot", "state"])
        .texts("robot", [Some("robot"); 5])
        .texts("state", states.map(Some))
        .texts("action", actions.map(Some))
        .numbers("height", [20.0, 20.0, 10.0, 5.0, 0.0].map(Some))
        .numbers("width", [3.0, 1.0, 5.0, 5.0, 0.0].map(Some))
        .numbers("hardness", [1.0, 2.0, 4.0, 8.0, 10000.0].map(Some))
}
