//! A text that a rule asks for, and that nothing holds though something holds nearly the same, is named with what was meant.

use adit_engine::Class;

use crate::support::{concluded, robots, rules, things};

fn found(source: &str) -> Vec<String> {
    let (base, _) = concluded(source, [robots(), things("size", &[Some(6.0)])]);
    base.misspelt(&rules(source)).iter().map(ToString::to_string).collect()
}

#[test]
fn in_a_condition_and_in_a_cell_of_a_table() {
    let condition = |state: &str| {
        format!(
            "rule \"low\" each s in ROBOTS where s.hardness > 1 && s.state == \"{state}\" then {{ s.low = true; }}"
        )
    };
    let said = found(&condition("SQAT"));
    assert_eq!(said.len(), 1, "{said:?}");
    assert!(
        said[0].ends_with("line 1) asks for state \"SQAT\", which there is not: did you mean \"SQUAT\"?"),
        "{said:?}"
    );
    assert!(found(&condition("SQUAT")).is_empty());
    assert!(found(&condition("SWIM")).is_empty(), "like none that there are: it may be of another robot");
    let table = r#"table "low" first each s in ROBOTS given [s.state] set [s.low] rows [
        ["SQAT", true],
        [any, false],
    ]"#;
    let said = found(table);
    assert_eq!(said.len(), 1, "{said:?}");
    assert!(said[0].contains("\"low\"") && said[0].contains("\"SQUAT\"?"), "{said:?}");
}

#[test]
fn what_rules_give_themselves_may_hold_anything() {
    let source = r#"
        rule "a state" each t in THINGS where t.size < 1 then { t.state = "SQAT"; }
        rule "low" each t in THINGS where t.state == "SQAT" then { t.low = true; }
    "#;
    assert!(found(source).is_empty());
}

#[test]
fn cells_that_name_an_object_of_another_class_name_one_that_is_there() {
    let said = |state: &str| {
        let source = r#"
            property THINGS.worn names ROBOTS.state;
            rule "worn" each t in THINGS where t.worn.hardness > 1 then { t.hard = true; }
        "#;
        let worn =
            Class::new("THINGS", &["thing"]).texts("thing", [Some("hat")]).texts("worn", [Some(state)]);
        let (base, _) = concluded(source, [robots(), worn]);
        base.unmet(&rules(source)).iter().map(ToString::to_string).collect::<Vec<_>>()
    };
    assert!(said("SQUAT").is_empty());
    assert_eq!(
        said("SQAT"),
        ["THINGS hat has worn \"SQAT\", and ROBOTS has no such row: did you mean \"SQUAT\"?"]
    );
    assert_eq!(said("SWIM"), ["THINGS hat has worn \"SWIM\", and ROBOTS has no such row"]);
}
