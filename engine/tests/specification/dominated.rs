//! What a choice can never choose is found before anybody wonders.

use adit_engine::{Class, KnowledgeBase};
use proptest::prelude::*;

use crate::support::{concluded, robots, rules, text, things};

const FITS: &str = r#"
    rule "who fits"
        each  t in THINGS
        least s in ROBOTS by hardness where s.height < t.size && s.width < t.size
        then { t.state = s.state; }
"#;

#[test]
fn a_state_that_another_one_beats_everywhere_is_named_with_it() {
    let rules = rules(FITS);
    let (mut base, _) = concluded(FITS, [robots(), things("size", &[Some(6.0)])]);
    base.conclude(&rules);
    assert!(base.dominated(&rules).is_empty(), "each of the five is good for something");

    base.tell("ROBOTS", "robot/LIE-FACE-DOWN", "hardness", Some(3.0.into())).unwrap();
    base.update(&rules);
    let found = base.dominated(&rules);
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(
        found[0].to_string(),
        "ROBOTS robot/SQUAT can never be `s` in rule \"who fits\": robot/LIE-FACE-DOWN passes every test that it \
         passes, and comes before it"
    );
    assert_eq!(serde_json::to_value(&found[0]).unwrap()["by"], "robot/LIE-FACE-DOWN");
}

#[test]
fn of_equal_states_the_later_row_is_never_chosen() {
    let rules = rules(FITS);
    let (mut base, _) = concluded(FITS, [robots(), things("size", &[Some(6.0)])]);
    base.tell("ROBOTS", "robot/SIDE-STAND", "hardness", Some(1.0.into())).unwrap();
    base.tell("ROBOTS", "robot/SIDE-STAND", "width", Some(3.0.into())).unwrap();
    base.conclude(&rules);
    let found = base.dominated(&rules);
    assert_eq!((found[0].key.as_str(), found[0].by.as_str()), ("robot/SIDE-STAND", "robot/STAND"));
}

#[test]
fn a_choice_among_those_of_the_same_kind_is_left_alone() {
    let joined = r#"
        rule "who fits"
            each  t in THINGS
            least s in ROBOTS by hardness where s.width == t.size && s.height < 3
            then { t.state = s.state; }
    "#;
    let rules = rules(joined);
    let (mut base, _) = concluded(joined, [robots(), things("size", &[Some(6.0)])]);
    base.conclude(&rules);
    assert!(base.dominated(&rules).is_empty());
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 64, ..ProptestConfig::default() })]

    /// Whatever the things are like, what is said to be never chosen is not; and what is not said to be has a thing
    /// that chooses it.
    #[test]
    fn exactly_those_are_named_that_nothing_can_choose(
        states in prop::collection::vec((0..4_i32, 0..4_i32, 0..4_i32), 1..7),
    ) {
        let rules = rules(r#"
            rule "who fits"
                each t in THINGS
                least s in STATES by hardness where s.low <= t.a && s.high >= t.b
                then { t.state = s.state; }
        "#);
        let column = |of: fn(&(i32, i32, i32)) -> i32| states.iter().map(move |s| Some(f64::from(of(s))));
        let mut base = KnowledgeBase::new();
        base.assert(
            Class::new("STATES", &["state"])
                .texts("state", (0..states.len()).map(|n| Some(n.to_string())))
                .numbers("hardness", column(|s| s.0))
                .numbers("low", column(|s| s.1))
                .numbers("high", column(|s| s.2)),
        ).unwrap();
        // Every pair of limits that tells states apart.
        base.assert(
            Class::new("THINGS", &["thing"])
                .numbers("thing", (0..16).map(|n| Some(f64::from(n))))
                .numbers("a", (0..16).map(|n| Some(f64::from(n / 4))))
                .numbers("b", (0..16).map(|n| Some(f64::from(n % 4)))),
        ).unwrap();
        base.conclude(&rules);
        let chosen: Vec<String> =
            (0..16).filter_map(|n| text(&base, "THINGS", &n.to_string(), "state")).collect();
        let named: Vec<String> = base.dominated(&rules).into_iter().map(|found| found.key).collect();
        for state in (0..states.len()).map(|n| n.to_string()) {
            prop_assert_eq!(named.contains(&state), !chosen.contains(&state), "state {}", state);
        }
    }
}
