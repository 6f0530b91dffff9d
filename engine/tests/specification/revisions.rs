//! Revisions: level by level, each with one operator.

use adit_engine::{Class, Code, KnowledgeBase, RuleBase, SourceFile};

use crate::support::{concluded, number, rules, things};

fn spots(order: [usize; 3]) -> Class {
    let (names, at) = (["p", "q", "r"], [1.0, 1.0, 2.0]);
    let factor = [0.1, 0.7, 3.0];
    Class::new("SPOTS", &["spot"])
        .texts("spot", order.map(|n| Some(names[n])))
        .numbers("at", order.map(|n| Some(at[n])))
        .numbers("factor", order.map(|n| Some(factor[n])))
}

const COST: &str = r#"rule "cost" each t in THINGS then { t.cost = t.size; }
"#;

#[test]
fn each_contributes_for_every_binding_and_some_once() {
    let each = format!(
        "{COST} revise \"r\" each t in THINGS each s in SPOTS where s.at == t.thing set t.cost by + 1"
    );
    let (base, _) =
        concluded(&each, [things("size", &[Some(10.0), Some(20.0), Some(30.0)]), spots([0, 1, 2])]);
    assert_eq!(base.numbers("THINGS", "cost").unwrap(), [Some(12.0), Some(21.0), Some(30.0)]);
    let some = each.replace("each s", "some s");
    let (base, _) =
        concluded(&some, [things("size", &[Some(10.0), Some(20.0), Some(30.0)]), spots([0, 1, 2])]);
    assert_eq!(base.numbers("THINGS", "cost").unwrap(), [Some(11.0), Some(21.0), Some(30.0)]);
}

#[test]
fn each_level_starts_from_the_level_below_whatever_the_order_in_the_file() {
    let rule = format!(
        "{COST} revise \"a\" each t in THINGS set t.cost by + 1 level 20
         revise \"b\" each t in THINGS where t.cost > 15 set t.cost by * 2 level 10
         revise \"c\" each t in THINGS set t.cost by min 50 level 30
         rule \"reads the top\" each t in THINGS then {{ t.seen = t.cost; }}"
    );
    let (base, _) = concluded(&rule, [things("size", &[Some(10.0), Some(20.0), Some(30.0)])]);
    assert_eq!(base.numbers("THINGS", "cost").unwrap(), [Some(11.0), Some(41.0), Some(50.0)]);
    assert_eq!(base.numbers("THINGS", "seen"), base.numbers("THINGS", "cost"));
}

#[test]
fn equal_facts_give_equal_bits_in_any_order_of_rows() {
    let rule = format!("{COST} revise \"r\" each t in THINGS each s in SPOTS set t.cost by * s.factor");
    let bits = |order| {
        let (base, _) = concluded(&rule, [things("size", &[Some(1.1)]), spots(order)]);
        number(&base, "THINGS", "1", "cost").unwrap().to_bits()
    };
    for order in [[0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]] {
        assert_eq!(bits([0, 1, 2]), bits(order));
    }
}

#[test]
fn an_unknown_amount_makes_the_value_unknown() {
    let rule = format!("{COST} revise \"r\" each t in THINGS where t.thing == 1 set t.cost by max t.weight");
    let class = things("size", &[Some(1.0), Some(2.0)]).numbers("weight", [None, Some(1.0)]);
    let (base, _) = concluded(&rule, [class]);
    assert_eq!(base.numbers("THINGS", "cost").unwrap(), [None, Some(2.0)]);
}

#[test]
fn a_told_value_is_revised_too() {
    let rule = "revise \"r\" each t in THINGS set t.size by - 1";
    let (base, _) = concluded(rule, [things("size", &[Some(1.0), None])]);
    assert_eq!(base.numbers("THINGS", "size").unwrap(), [Some(0.0), None]);
}

#[test]
fn two_operators_at_one_level_are_refused_plus_and_minus_aside() {
    let compile = |a: &str, b: &str| {
        let text =
            format!("revise \"a\" each t in T set t.x by {a} 2 revise \"b\" each t in T set t.x by {b} 3");
        RuleBase::compile(&[SourceFile::new("test.rhai", text)])
    };
    assert!(compile("+", "-").is_ok());
    assert!(compile("max", "max").is_ok());
    let wrong = compile("*", "+").unwrap_err();
    assert_eq!(wrong.0[0].code, Code::Operator);
    assert_eq!(wrong.0[0].message, "level 0 of T.x is revised by `+` here and by `*` in \"a\"");
}

#[test]
fn taking_a_revision_away_takes_its_effect_away() {
    let with = format!("{COST} revise \"r\" each t in THINGS set t.cost by * 3");
    let (mut base, _) = concluded(&with, [things("size", &[Some(2.0)])]);
    assert_eq!(number(&base, "THINGS", "1", "cost"), Some(6.0));
    base.conclude(&crate::support::rules(COST));
    assert_eq!(number(&base, "THINGS", "1", "cost"), Some(2.0));
}

/// Found by a journey: a revision waited for itself when its class came after a first inference.
#[test]
fn a_revision_that_had_to_wait_goes_on_when_its_class_comes() {
    let text = r#"
        rule "hard" each r in ROOMS some s in STATES where s.state == r.state then { r.hardness = s.hardness; }
        revise "wet" each r in ROOMS some w in WET where w.x < r.x set r.hardness by * 1.5 level 10
        rule "reads" each r in ROOMS where r.hardness > 1 then { r.hard = true; }"#;
    let states =
        Class::new("STATES", &["state"]).texts("state", [Some("a")]).numbers("hardness", [Some(2.0)]);
    let wet = Class::new("WET", &[]).numbers("x", [Some(1.0)]);
    let rooms = Class::new("ROOMS", &[]).texts("state", [Some("a")]).numbers("x", [Some(5.0)]);
    let rules = rules(text);
    let mut base = KnowledgeBase::new();
    base.assert(states).unwrap();
    base.assert(wet).unwrap();
    assert_eq!(base.conclude(&rules).waiting.len(), 3);
    base.assert(rooms).unwrap();
    assert!(base.conclude(&rules).waiting.is_empty());
    assert_eq!(base.numbers("ROOMS", "hardness"), Some(vec![Some(3.0)]));
    assert_eq!(base.truths("ROOMS", "hard"), Some(vec![Some(true)]));
}
