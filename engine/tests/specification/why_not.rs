//! Why not: for every loser the test that failed or the value by which it lost.

use adit_engine::{Class, KnowledgeBase, Rejection, WhyNot};

use crate::support::{concluded, robots, rules, things};

const FITS: &str = r#"
rule "who fits" each t in THINGS
    least s in ROBOTS by hardness where s.height < t.size && s.width < 4
    then { t.state = s.state; }
"#;

fn why_not(text: &str, (base, key, property): (&mut KnowledgeBase, &str, &str)) -> WhyNot {
    base.why_not(&rules(text), "THINGS", key, property).unwrap()
}

fn sentences(why: &WhyNot) -> Vec<String> {
    why.rejected.iter().map(ToString::to_string).collect()
}

#[test]
fn each_state_that_was_not_chosen_names_the_test_or_the_value() {
    let (mut base, _) = concluded(FITS, [robots(), things("size", &[Some(25.0)])]);
    let why = why_not(FITS, (&mut base, "1", "state"));
    assert_eq!(
        sentences(&why),
        [
            "rule \"who fits\" does not take ROBOTS robot/SQUAT as `s`: s.width < 4 is false (5 against 4)",
            "rule \"who fits\" does not take ROBOTS robot/LIE-FACE-DOWN as `s`: s.width < 4 is false (5 against 4)",
            "rule \"who fits\" does not take ROBOTS robot/SIDE-STAND as `s`: hardness 2 against 1 of ROBOTS robot/STAND",
            "rule \"who fits\" does not take ROBOTS robot/IMPOSSIBLE as `s`: hardness 10000 against 1 of ROBOTS \
             robot/STAND",
        ]
    );
    assert!(why.to_string().starts_with("THINGS 1 state is STAND; rule \"who fits\""), "{why}");
    let json = serde_json::to_value(&why).unwrap();
    assert_eq!(json["rejected"][0]["reason"], "failed");
    assert_eq!(json["rejected"][0]["test"], "s.width < 4");
    assert_eq!(json["rejected"][2]["winner"], "robot/STAND");
}

#[test]
fn a_clause_that_nothing_meets_says_so_after_each_of_its_candidates() {
    let (mut base, _) = concluded(FITS, [robots(), things("size", &[Some(-1.0)])]);
    let why = why_not(FITS, (&mut base, "1", "state"));
    assert_eq!(why.rejected.len(), 6);
    assert_eq!(why.rejected[5].to_string(), "rule \"who fits\" finds no `s` among 5 objects of ROBOTS");
    assert_eq!(why.value, None);
}

#[test]
fn what_is_unknown_is_said_to_be() {
    let (mut base, _) = concluded(FITS, [robots(), things("size", &[None])]);
    let why = why_not(FITS, (&mut base, "1", "state"));
    assert!(sentences(&why).iter().any(|sentence| {
        sentence.ends_with("ROBOTS robot/STAND as `s`: s.height < t.size is unknown (20 against unknown)")
    }));
}

#[test]
fn an_object_that_a_rule_does_not_speak_of_names_the_condition() {
    let rule = r#"rule "big" each t in THINGS where t.size > 6 || t.size == 3 then { t.big = true; }"#;
    let (mut base, _) = concluded(rule, [things("size", &[Some(5.0), Some(7.0)])]);
    let why = why_not(rule, (&mut base, "1", "big"));
    assert_eq!(
        sentences(&why),
        ["rule \"big\" does not take THINGS 1 as `t`: (t.size > 6) || (t.size == 3) is false"]
    );
    assert!(why_not(rule, (&mut base, "2", "big")).rejected.is_empty());
    assert!(base.why_not(&rules(rule), "THINGS", "9", "big").is_none());
}

#[test]
fn a_rule_that_waits_and_one_that_is_not_heard_say_so() {
    let rule = r#"
        rule "waits" each t in THINGS some s in SHELVES where s.size > t.size then { t.kind = "shelved"; }
        rule "usual" each t in THINGS then { t.kind = "usual"; }
        rule "special" priority 5 each t in THINGS where t.size > 6 then { t.kind = "special"; }
        rule "told" each t in THINGS then { t.size = 9; }
    "#;
    let (mut base, _) = concluded(rule, [things("size", &[Some(7.0)])]);
    assert_eq!(
        sentences(&why_not(rule, (&mut base, "1", "kind"))),
        ["rule \"waits\" waits for SHELVES", "rule \"usual\" is not heard: \"special\" stands against it"]
    );
    assert_eq!(
        sentences(&why_not(rule, (&mut base, "1", "size"))),
        ["rule \"told\" is not heard: the value was told"]
    );
}

#[test]
fn none_all_some_and_each_say_what_stopped_them() {
    let rule = r#"
        rule "none" each t in THINGS none o in THINGS where o.size > t.size then { t.greatest = true; }
        rule "all" each t in THINGS all o in THINGS have o.size > 1 then { t.all_big = true; }
        rule "some" each t in THINGS some o in THINGS where o.size > 1 then { t.other = o.size; }
        rule "each" each t in THINGS each o in THINGS where o.size > t.size + 9 then { t.far = true; }
        rule "count" each t in THINGS count n of o in THINGS where o.size > 0
            some p in THINGS where p.size == n then { t.as_many = p.size; }
    "#;
    let (mut base, report) = concluded(rule, [things("size", &[Some(1.0), Some(3.0), Some(8.0)])]);
    assert!(report.diagnostics.is_empty(), "{:?}", report.diagnostics);
    let mut last = |property: &str| sentences(&why_not(rule, (&mut base, "1", property))).pop().unwrap();
    assert_eq!(last("greatest"), "rule \"none\" wants no `o`, and THINGS 2 is one");
    assert_eq!(last("all_big"), "rule \"all\" finds no `o` among 3 objects of THINGS");
    assert_eq!(last("other"), "rule \"some\" does not take THINGS 3 as `o`: THINGS 2 comes before it");
    assert_eq!(last("far"), "rule \"each\" finds no `o` among 3 objects of THINGS");
    assert_eq!(
        last("as_many"),
        "rule \"count\" does not take THINGS 3 as `p`: p.size == n is false (8 against 3)"
    );
}

#[test]
fn what_the_interpreter_runs_is_asked_too_and_many_objects_are_cut_off() {
    let rule = r#"
        fn digits(n) { let s = "" + n; s.len() }
        rule "r" each t in THINGS least o in THINGS by o.size where digits(o.size) > 7 then { t.least = o.size; }
    "#;
    let sizes: Vec<Option<f64>> = (0..3000).map(|size| Some(f64::from(size))).collect();
    let (mut base, _) = concluded(rule, [things("size", &sizes)]);
    let why = why_not(rule, (&mut base, "1", "least"));
    assert!(why.truncated);
    assert!(why.rejected.len() <= 1_001);
    assert!(
        matches!(&why.rejected[0].reason, Rejection::Failed { test, .. } if test == "digits(o.size) > 7"),
        "{:?}",
        why.rejected[0]
    );
}

#[test]
fn a_variable_that_is_not_the_first_is_asked_of_every_binding_before_it() {
    let rule = r#"rule "best" each o in ROBOTS where o.height < 15 each t in THINGS where t.size == o.height
        then { t.robot = o.state; }"#;
    let (mut base, _) = concluded(
        rule,
        [
            robots(),
            Class::new("THINGS", &["thing"]).texts("thing", [Some("1")]).numbers("size", [Some(10.0)]),
        ],
    );
    let why = why_not(rule, (&mut base, "1", "robot"));
    assert_eq!(why.value.as_ref().map(ToString::to_string).as_deref(), Some("SQUAT"));
    assert!(sentences(&why).contains(
        &"rule \"best\" does not take THINGS 1 as `t`: t.size == o.height is false (10 against 5)".to_owned()
    ));
}

#[test]
fn each_row_of_a_table_names_its_first_cell_that_fails() {
    let table = r#"
        table "size" first each t in THINGS given [t.size, t.thing] set [t.kind] rows [
            [below(3), any, "small"], [between(4, 6), 2, "second"], [any, above(7), "late"] ]
    "#;
    let (mut base, _) = concluded(table, [things("size", &[Some(5.0)])]);
    assert_eq!(
        sentences(&why_not(table, (&mut base, "1", "kind"))),
        [
            "rule \"size\" row 1 wants t.size below 3, and it is 5",
            "rule \"size\" row 2 wants t.thing 2, and it is 1",
            "rule \"size\" row 3 wants t.thing above 7, and it is 1",
        ]
    );
}

#[test]
fn classes_by_condition_and_links_are_asked_too() {
    let rule = r#"
        class SMALL of THINGS where size < 3
        property THINGS.size names THINGS.thing
        rule "small" each t in SMALL then { t.kind = "small"; }
        rule "next" each t in THINGS where t.size.size > 5 then { t.next = true; }
    "#;
    let (mut base, _) = concluded(rule, [things("size", &[Some(3.0), Some(9.0), Some(4.0)])]);
    assert_eq!(
        sentences(&why_not(rule, (&mut base, "1", "kind"))),
        ["rule \"small\" does not take THINGS 1 as `t`: size < 3 is false (3 against 3)"]
    );
    let next = sentences(&why_not(rule, (&mut base, "1", "next")));
    assert!(next.last().unwrap().ends_with("is false (4 against 5)"), "{next:?}");
}

#[test]
fn in_a_large_class_an_equation_chooses_who_is_a_candidate() {
    let rule = r#"rule "r" each t in THINGS some o in THINGS where o.thing == t.size && o.size > 100
        then { t.big = true; }"#;
    let sizes: Vec<Option<f64>> = (1..=3000).map(|size| Some(f64::from(size))).collect();
    let (mut base, _) = concluded(rule, [things("size", &sizes)]);
    let why = why_not(rule, (&mut base, "50", "big"));
    assert_eq!(
        sentences(&why),
        [
            "rule \"r\" does not take THINGS 50 as `o`: o.size > 100 is false (50 against 100)",
            "rule \"r\" finds no `o` among 3000 objects of THINGS",
        ]
    );
    assert!(!why.truncated);
    assert!(why_not(rule, (&mut base, "2500", "big")).rejected.is_empty(), "found beyond the first thousand");
}
