//! Unknown is a third truth value, and no number.

use crate::support::{concluded, things};

/// What a condition gives for an object whose `x` is unknown and whose `t` is true and `f` is false.
fn truth(condition: &str) -> Option<bool> {
    let rule = format!("rule \"r\" each t in THINGS then {{ t.holds = {condition}; }}");
    let class =
        things("x", &[None]).truths("yes", [Some(true)]).truths("no", [Some(false)]).truths("u", [None]);
    concluded(&rule, [class]).0.truths("THINGS", "holds").unwrap()[0]
}

#[test]
fn and_or_and_not_are_kleenes() {
    assert_eq!(truth("t.u && t.yes"), None);
    assert_eq!(truth("t.u && t.no"), Some(false));
    assert_eq!(truth("t.no && t.u"), Some(false));
    assert_eq!(truth("t.u || t.yes"), Some(true));
    assert_eq!(truth("t.u || t.no"), None);
    assert_eq!(truth("!t.u"), None);
    assert_eq!(truth("!(t.u && t.no)"), Some(true));
}

#[test]
fn comparing_and_computing_with_unknown_is_unknown() {
    for condition in ["t.x < 1", "t.x == t.x", "t.x != 3", "min(t.x, 1) < 2", "t.x * 0 == 0", "t.x ** 0 == 1"]
    {
        assert_eq!(truth(condition), None, "{condition}");
    }
}

#[test]
fn known_and_a_substitute_decide() {
    assert_eq!(truth("known(t.x)"), Some(false));
    assert_eq!(truth("unknown(t.x)"), Some(true));
    assert_eq!(truth("(t.x ?? 3) == 3"), Some(true));
}

#[test]
fn what_is_not_a_number_is_unknown() {
    assert_eq!(truth("known(sqrt(0 - 1))"), Some(false));
    assert_eq!(truth("0 / 0 > 1"), None);
    assert_eq!(truth("1 / 0 > 1"), Some(true), "infinity is a number");
}

#[test]
fn an_unknown_condition_leaves_unknown_what_either_branch_sets() {
    let rule = r#"
        rule "r" each t in THINGS then {
            let v = 1;
            if t.x > 1 { t.a = 5; v = 2; }
            t.b = v;
            t.c = if t.x > 1 { 1 } else { 2 };
        }"#;
    let (base, report) = concluded(rule, [things("x", &[None, Some(0.0), Some(2.0)])]);
    assert_eq!(base.numbers("THINGS", "a").unwrap(), [None, None, Some(5.0)]);
    assert_eq!(base.numbers("THINGS", "b").unwrap(), [None, Some(1.0), Some(2.0)]);
    assert_eq!(base.numbers("THINGS", "c").unwrap(), [None, Some(2.0), Some(1.0)]);
    let reasons: Vec<String> =
        report.gaps[0].reasons.iter().map(|(reason, objects)| format!("{objects}: {reason}")).collect();
    assert_eq!(reasons, ["1: rule \"r\" computed with something unknown", "1: no rule applied"]);
}

#[test]
fn objects_without_what_is_compared_are_left_out_and_counted() {
    let rule = r#"rule "r" each t in THINGS least u in THINGS by x then { t.least = u.thing; }"#;
    let (base, report) = concluded(rule, [things("x", &[None, Some(4.0), Some(f64::NAN), Some(3.0)])]);
    assert_eq!(base.numbers("THINGS", "least").unwrap(), [Some(4.0); 4]);
    assert_eq!((report.left_out[0].variable.as_str(), report.left_out[0].objects), ("u", 2));
}

#[test]
fn where_needs_true() {
    let rule = r#"rule "r" each t in THINGS where t.x > 1 then { t.big = true; }"#;
    let (base, _) = concluded(rule, [things("x", &[None, Some(4.0)])]);
    assert_eq!(base.truths("THINGS", "big").unwrap(), [None, Some(true)]);
}
