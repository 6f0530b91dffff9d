//! Which of several rules is heard.

use crate::support::rules;

#[test]
fn a_rule_may_have_a_priority_and_has_0_without() {
    let base = rules(
        r#"rule "a" priority 10 each t in THINGS then { t.x = 1; }
           rule "b" priority -2 each t in THINGS then { t.x = 2; }
           rule "c" each t in THINGS then { t.x = 3; }"#,
    );
    let priorities: Vec<_> = base.rules().iter().map(|rule| (rule.name(), rule.priority())).collect();
    assert_eq!(priorities, [("a", 10), ("b", -2), ("c", 0)]);
}
