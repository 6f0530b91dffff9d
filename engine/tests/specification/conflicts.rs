//! Rules that disagree.

use adit_engine::{Class, Code, Reason, Severity, Value};

use crate::support::{concluded, number, things};

const TWO: &str = r#"
rule "short" each t in THINGS where t.size < 10 then { t.label = "short"; t.cost = 1.0; }
rule "light" each t in THINGS where t.size < 5 then { t.label = "light"; t.weight = 2.0; }
"#;

#[test]
fn two_values_for_one_property_are_a_conflict_and_no_value() {
    let (base, report) = concluded(TWO, [things("size", &[Some(3.0), Some(7.0)])]);
    let [conflict] = report.conflicts.as_slice() else { panic!("{:?}", report.conflicts) };
    assert_eq!((conflict.property.to_string().as_str(), conflict.key.as_str()), ("THINGS.label", "1"));
    let said: Vec<(&str, Value)> =
        conflict.values.iter().map(|(rule, value)| (rule.as_str(), value.clone())).collect();
    assert_eq!(said, [("short", "short".into()), ("light", "light".into())]);
    let [problem] = report.diagnostics.as_slice() else { panic!("{:?}", report.diagnostics) };
    assert_eq!((problem.code, problem.severity, problem.line), (Code::Conflict, Severity::Warning, 3));
    assert_eq!(
        problem.message,
        r#"rules disagree about THINGS.label of 1: "short" says short, "light" says light"#
    );
    assert_eq!(base.value("THINGS", "1", "label"), None);
    assert_eq!(base.value("THINGS", "2", "label"), Some("short".into()));
    let gap = report.gaps.iter().find(|gap| gap.property.property == "label").unwrap();
    assert_eq!(gap.reasons, [(Reason::Conflict, 1)]);
}

#[test]
fn rules_may_set_different_properties_of_one_object() {
    let (base, _) = concluded(TWO, [things("size", &[Some(3.0)])]);
    assert_eq!(number(&base, "THINGS", "1", "cost"), Some(1.0));
    assert_eq!(number(&base, "THINGS", "1", "weight"), Some(2.0));
}

#[test]
fn the_same_value_twice_is_no_conflict() {
    let (base, report) = concluded(&TWO.replace("\"light\";", "\"short\";"), [things("size", &[Some(3.0)])]);
    assert!(report.conflicts.is_empty());
    assert_eq!(base.value("THINGS", "1", "label"), Some("short".into()));
}

#[test]
fn one_rule_may_disagree_with_itself() {
    let neighbours = Class::new("PAIRS", &["a", "b"])
        .numbers("a", [1.0, 1.0, 2.0].map(Some))
        .numbers("b", [5.0, 6.0, 6.0].map(Some));
    let rule = r#"rule "r" each t in THINGS each p in PAIRS where p.a == t.thing then { t.other = p.b; }"#;
    let (base, report) = concluded(rule, [things("size", &[None, None]), neighbours]);
    assert_eq!(report.conflicts.len(), 1);
    assert_eq!(number(&base, "THINGS", "1", "other"), None);
    assert_eq!(number(&base, "THINGS", "2", "other"), Some(6.0));
}

#[test]
fn the_order_of_rules_does_not_matter_for_values() {
    let (one, two) = TWO.trim().split_once('\n').unwrap();
    let classes = || [things("size", &[Some(3.0), Some(7.0), Some(30.0)])];
    let (base, _) = concluded(TWO, classes());
    let (turned, _) = concluded(&format!("{two}\n{one}"), classes());
    for property in ["label", "cost", "weight"] {
        for key in ["1", "2", "3"] {
            assert_eq!(base.value("THINGS", key, property), turned.value("THINGS", key, property));
        }
    }
}
