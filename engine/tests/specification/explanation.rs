//! Why, for every value; and why there is none.

use adit_engine::{Origin, Reason};

use crate::support::{concluded, robots, rules, things};

const RULE: &str = r#"
rule "who fits" each t in THINGS
    least s in ROBOTS by hardness where s.height < t.size
    then { t.state = s.state; }
revise "more" each t in THINGS where t.size > 6 set t.size by * 2"#;

#[test]
fn a_conclusion_names_its_rule_its_version_and_its_witnesses() {
    let (base, _) = concluded(RULE, [robots(), things("size", &[Some(6.0)])]);
    let why = base.why(&rules(RULE), "THINGS", "1", "state").unwrap();
    let Origin::Rule(support) = &why.origin else { panic!("{why}") };
    assert_eq!(support.rule, "who fits");
    assert_eq!(support.version, rules(RULE).rules()[0].version());
    assert_eq!(
        why.to_string(),
        format!(
            "THINGS 1 state is LIE-FACE-DOWN, by rule \"who fits\" (test.rhai, line 2, version {}) \
             with t = THINGS 1, s = ROBOTS robot/LIE-FACE-DOWN",
            support.version
        )
    );
}

#[test]
fn a_told_value_says_so_and_a_revised_one_says_by_what() {
    let (base, _) = concluded(RULE, [robots(), things("size", &[Some(6.0), Some(7.0)])]);
    let why = |key: &str, property: &str| base.why(&rules(RULE), "THINGS", key, property).unwrap();
    assert_eq!(why("1", "thing").to_string(), "THINGS 1 thing is 1, as told");
    assert_eq!(why("1", "size").to_string(), "THINGS 1 size is 6, as told");
    assert!(
        why("2", "size")
            .to_string()
            .starts_with("THINGS 2 size is 14, as told; revised * 2 by rule \"more\"")
    );
}

#[test]
fn a_whole_column_of_justifications_is_numbers() {
    let (base, _) = concluded(RULE, [robots(), things("size", &[Some(6.0), None, Some(60.0)])]);
    let why = base.justifications("THINGS", "state").unwrap();
    assert_eq!(why.rules[0].0, "who fits");
    assert_eq!(why.of_row, [Some(0), None, Some(0)]);
    let (grounds, places) = base.grounds("THINGS", "state", &[0, 1, 2, 0]);
    let witnesses: Vec<_> = grounds.into_iter().map(|by| by.witnesses).collect();
    assert_eq!(
        (witnesses, places),
        (vec![vec![Some(3)], vec![Some(0)]], vec![Some(0), None, Some(1), Some(0)])
    );
}

#[test]
fn what_a_row_names_itself_is_no_ground_of_its_own() {
    const NAMED: &str = r#"
rule "the next one's" each t in THINGS
    some  next in THINGS where next.thing == t.size
    some  far  in THINGS where far.thing == next.size
    least s    in ROBOTS by hardness where s.height < next.size
    then { t.state = s.state; }"#;
    let (base, _) = concluded(NAMED, [robots(), things("size", &[Some(2.0), Some(1.0), Some(1.0)])]);
    let (grounds, places) = base.grounds("THINGS", "state", &[0, 1, 2]);
    assert_eq!((grounds.len(), places), (1, vec![Some(0); 3]));
    for by in grounds {
        assert!(matches!(by.witnesses.as_slice(), [None, None, Some(_)]), "{by:?}");
    }
    let why = base.why(&rules(NAMED), "THINGS", "1", "state").unwrap().to_string();
    assert!(why.contains("next = THINGS 2, far = THINGS 1, s = ROBOTS"), "{why}");
}

#[test]
fn objects_that_got_nothing_are_listed_with_the_reason() {
    let (_, report) = concluded(RULE, [robots(), things("size", &[Some(-1.0), None, Some(6.0), Some(-2.0)])]);
    let gap = &report.gaps[0];
    assert_eq!((gap.property.to_string().as_str(), gap.rows.as_slice()), ("THINGS.state", &[0, 1, 3][..]));
    let (rule, variable) = ("who fits".to_owned(), "s".to_owned());
    assert_eq!(
        gap.reasons,
        [
            (Reason::Unmet { rule: rule.clone(), variable: variable.clone() }, 2),
            (Reason::Undecided { rule, variable }, 1)
        ]
    );
}

#[test]
fn an_object_that_stands_in_the_way_is_not_called_missing() {
    let reason = |clause: &str| {
        let text = format!("rule \"r\" each t in THINGS {clause} then {{ t.free = true; }}");
        let (_, report) = concluded(&text, [robots(), things("size", &[Some(3.0)])]);
        report.gaps[0].reasons[0].0.to_string()
    };
    assert_eq!(
        reason("none s in ROBOTS where s.height > t.size"),
        "rule \"r\" found a `s`, and needs that there is none"
    );
    assert_eq!(
        reason("all s in ROBOTS have s.height > t.size"),
        "rule \"r\" found a `s` that lacks what it needs of all"
    );
    assert_eq!(reason("some s in ROBOTS where s.height > 99"), "rule \"r\" found no `s`");
}
