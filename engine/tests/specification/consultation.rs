//! A consultation gives for one object what an inference over a class of that one object gives.

use std::collections::HashMap;

use adit_engine::{Class, Consultation, Datum, Grain, KnowledgeBase, Type, Value};
use proptest::prelude::*;

use crate::support::rules;

/// Rules of every form that looks at one object alone.
const DIRECT: &str = r#"
    const LIMIT = 2;
    rule "sum" each o in OBJECTS then { let twice = o.a * 2; o.sum = twice + o.b; }
    rule "sign" each o in OBJECTS where known(o.sum) then {
        if o.sum > LIMIT { o.sign = "up"; o.up = true; } else if o.sum < 0 { o.sign = "down"; } else { o.sign = o.t; }
    }
    rule "often" each o in OBJECTS where o.p || o.a > o.b then { o.often = max(o.a, o.b); }
    rule "seldom" priority 1 each o in OBJECTS where o.t == "left" then { o.often = o.b ?? 7; }
    rule "told or not" each o in OBJECTS then { o.c = o.a - o.b; }
    rule "disagrees" each o in OBJECTS where o.p then { o.c = 1; }
    table "unique" unique
        each o in OBJECTS where o.p
        given [ o.t, o.sum ]
        set   [ o.row, o.margin ]
        rows  [ [ "left",               below(0),      1, "low" ],
                [ "left",               at_least(0),   2, "high" ],
                [ ["right", "up"],      any,           3, o.t ],
                [ not(["left", "right", "up"]), between(0, 5), 4, "middle" ] ]
    ;
    table "first" first
        each o in OBJECTS
        given [ o.p, o.margin ]
        set   [ o.first ]
        rows  [ [ true, "low", 1.0 ], [ any, "low", 2.0 ], [ any, any, o.a ] ]
    ;
    table "collect" collect sum
        each o in OBJECTS
        given [ o.a, o.b ]
        set   [ o.points ]
        rows  [ [ above(0), any, 1 ], [ any, above(0), 2 ], [ below(0), below(0), 4 ] ]
    ;
    property OBJECTS.d from table, default 3;
    class BIG of OBJECTS where a > 1;
    rule "big ones" each o in BIG then { o.big = o.a + " is big"; }
    revise "more" each o in OBJECTS where o.p set o.sum by + o.b
    revise "much more" each o in BIG set o.sum by * 2 level 3
    rule "reads the last level" each o in OBJECTS then { o.last = o.sum + o.d; }
"#;

/// The same, and a rule that looks at another object.
const NOT_DIRECT: &str = r#"
    rule "the other one" each o in OBJECTS some other in OTHERS where other.name == o.t then { o.other = other.weight; }
"#;

const INPUTS: [(&str, Type); 6] = [
    ("a", Type::Number),
    ("b", Type::Number),
    ("c", Type::Number),
    ("d", Type::Number),
    ("t", Type::Text),
    ("p", Type::Truth),
];
const OUTPUTS: [&str; 13] =
    ["sum", "sign", "up", "often", "c", "row", "margin", "first", "points", "big", "last", "d", "other"];

type Case = ([Option<f64>; 4], Option<&'static str>, Option<bool>);

fn cases() -> impl Strategy<Value = Vec<Case>> {
    let number = || prop::option::weighted(0.8, (-4..4_i32).prop_map(|n| f64::from(n) / 2.0));
    let text = prop::option::weighted(0.8, prop::sample::select(vec!["left", "right", "up", "elsewhere"]));
    let case = (prop::array::uniform4(number()), text, prop::option::weighted(0.8, any::<bool>()));
    prop::collection::vec(case, 1..6)
}

fn others() -> Class {
    Class::new("OTHERS", &["name"])
        .texts("name", [Some("left"), Some("right")])
        .numbers("weight", [Some(1.5), Some(2.5)])
}

fn from_scratch(text: &str, ([a, b, c, d], t, p): Case) -> Vec<Option<Value>> {
    let mut base = KnowledgeBase::new();
    base.assert(others()).unwrap();
    let object = Class::new("OBJECTS", &[]).texts("t", [t]).truths("p", [p]);
    base.assert(object.numbers("a", [a]).numbers("b", [b]).numbers("c", [c]).numbers("d", [d])).unwrap();
    base.conclude(&rules(text));
    OUTPUTS.iter().map(|output| base.value_at("OBJECTS", 0, output)).collect()
}

fn judged(consultation: &mut Consultation, ([a, b, c, d], t, p): Case) -> Vec<Option<Value>> {
    consultation.consult(&[a.into(), b.into(), c.into(), d.into(), t.into(), p.into()]);
    (0..OUTPUTS.len()).map(|output| consultation.value(output)).collect()
}

proptest! {
    #[test]
    fn one_object_after_the_other_is_judged_as_an_inference_would(cases in cases()) {
        let mut direct = Consultation::new(rules(DIRECT).into(), "OBJECTS", &INPUTS, &OUTPUTS).unwrap();
        prop_assert!(direct.is_direct());
        let whole = format!("{DIRECT}{NOT_DIRECT}");
        let mut inferring = Consultation::new(rules(&whole).into(), "OBJECTS", &INPUTS, &OUTPUTS).unwrap();
        inferring.assert(others()).unwrap();
        prop_assert!(!inferring.is_direct());
        for case in cases {
            prop_assert_eq!(judged(&mut direct, case), from_scratch(DIRECT, case));
            prop_assert_eq!(judged(&mut inferring, case), from_scratch(&whole, case));
        }
    }
}

/// Numbers that are compared only, numbers that count whole, and those of which both is so.
const LOOKED_AT: &str = r#"
    rule "kept" each o in OBJECTS then { o.often = o.a < 1.5 && (o.t == "left" || o.a >= -1); }
    table "band" first
        each o in OBJECTS
        given [ o.b, o.p ]
        set   [ o.row ]
        rows  [ [ 0, true, 1 ], [ below(1), any, 2 ], [ any, any, 3 ] ]
    ;
    rule "bent" each o in OBJECTS where o.c > 1 then { o.sum = o.c * 2; }
    rule "told" each o in OBJECTS where o.a > 0 then { o.last = 7; }
"#;

/// An object as far as rules can tell it from others.
fn looks(([a, b, c, d], t, p): Case, grains: &[Grain]) -> String {
    let number = |number: Option<f64>, grain: &Grain| match (number, grain) {
        (_, Grain::Nothing) => String::new(),
        (Some(number), Grain::Among(known)) => {
            format!("{:?}", known.iter().map(|known| number.partial_cmp(known)).collect::<Vec<_>>())
        }
        (number, _) => format!("{number:?}"),
    };
    let numbers = [a, b, c, d].into_iter().zip(grains).map(|(value, grain)| number(value, grain));
    format!("{:?} {t:?} {p:?}", numbers.collect::<Vec<_>>())
}

proptest! {
    #[test]
    fn objects_are_judged_alike_that_rules_cannot_tell_apart(
        cases in prop::collection::vec(cases(), 40)
    ) {
        for text in [DIRECT, LOOKED_AT] {
            let mut direct = Consultation::new(rules(text).into(), "OBJECTS", &INPUTS, &OUTPUTS).unwrap();
            let grains = direct.grains().unwrap().to_vec();
            let mut said = HashMap::new();
            for case in cases.iter().flatten() {
                let now = judged(&mut direct, *case);
                let before = said.entry(looks(*case, &grains)).or_insert_with(|| now.clone());
                prop_assert_eq!(&now, before, "{:?}", case);
            }
        }
    }
}

#[test]
fn of_what_rules_look_at_it_is_told_how_closely() {
    let grains = |text: &str| {
        let consultation = Consultation::new(rules(text).into(), "OBJECTS", &INPUTS, &OUTPUTS).unwrap();
        consultation.grains().map(<[Grain]>::to_vec)
    };
    // of what a table is given all counts, and so does "d", which is asked for
    let compared = Grain::Among(vec![-1.0, 0.0, 1.5]);
    let [b, c, d, t, p] = [const { Grain::Whole }; 5];
    assert_eq!(grains(LOOKED_AT), Some(vec![compared, b, c, d, t, p]));
    assert_eq!(grains(r#"rule "none" each o in OBJECTS then { o.sum = 1; }"#).unwrap()[0], Grain::Nothing);
    assert_eq!(grains(NOT_DIRECT), None);
}

#[test]
fn values_of_another_type_are_unknown_and_inputs_left_out_too() {
    let text = r#"rule "double" each o in OBJECTS then { o.double = o.a * 2; o.known = known(o.b); }"#;
    let inputs = [("a", Type::Number), ("b", Type::Text)];
    let mut consultation =
        Consultation::new(rules(text).into(), "OBJECTS", &inputs, &["double", "known"]).unwrap();
    consultation.consult(&[Datum::Text("four")]);
    assert_eq!((consultation.number(0), consultation.truth(1)), (None, Some(false)));
    consultation.consult(&[Datum::Number(4.0), Datum::Text("four")]);
    assert_eq!((consultation.number(0), consultation.truth(1)), (Some(8.0), Some(true)));
    assert_eq!(consultation.text(0), None);
}

#[test]
fn each_row_of_a_table_says_why_it_did_not_speak() {
    let text = r#"table "sides" unique
    each o in OBJECTS
    given [ o.side, o.size ]
    set   [ o.margin ]
    rows  [ [ "left",            any,      1 ],
            [ "right",           below(3), 2 ],
            [ ["up", "down"],    any,      3 ] ]"#;
    let inputs = [("side", Type::Text), ("size", Type::Number)];
    let mut consultation = Consultation::new(rules(text).into(), "OBJECTS", &inputs, &["margin"]).unwrap();
    consultation.consult(&["right".into(), Datum::Number(5.0)]);
    let said = |consultation: &mut Consultation| -> Vec<(Option<usize>, usize, Option<String>)> {
        let rows = consultation.considered("margin");
        rows.into_iter().map(|row| (row.row, row.line, row.miss.map(|miss| miss.to_string()))).collect()
    };
    assert_eq!(
        said(&mut consultation),
        [
            (Some(1), 5, Some("o.side is right, not \"left\"".to_owned())),
            (Some(2), 6, Some("o.size is 5, not below 3".to_owned())),
            (Some(3), 7, Some("o.side is right, not \"up\" or \"down\"".to_owned())),
        ]
    );
    consultation.consult(&["left".into(), Datum::Unknown]);
    assert_eq!(said(&mut consultation)[0], (Some(1), 5, None));
    assert_eq!(consultation.number(0), Some(1.0));
}

#[test]
fn what_went_wrong_is_reported_for_the_last_object() {
    let text = r#"
        rule "one" each o in OBJECTS then { o.x = 1; }
        rule "two" each o in OBJECTS where o.a > 0 then { o.x = 2; }"#;
    let inputs = [("a", Type::Number)];
    let mut consultation = Consultation::new(rules(text).into(), "OBJECTS", &inputs, &["x"]).unwrap();
    consultation.consult(&[Datum::Number(1.0)]);
    assert_eq!(consultation.number(0), None);
    assert_eq!(consultation.report().conflicts.len(), 1);
    consultation.consult(&[Datum::Number(-1.0)]);
    assert_eq!((consultation.number(0), consultation.report().conflicts.len()), (Some(1.0), 0));
}

#[test]
fn a_rule_that_fails_is_named_until_an_object_is_judged_without_a_failure() {
    let text = r#"
        rule "one" each o in OBJECTS then { o.x = 1; }
        rule "two" priority 5 each o in OBJECTS where o.a > 0 then { throw "a fit"; o.x = 2; }"#;
    let inputs = [("a", Type::Number)];
    let mut consultation = Consultation::new(rules(text).into(), "OBJECTS", &inputs, &["x"]).unwrap();
    consultation.consult(&[Datum::Number(1.0)]);
    let failure = consultation.failure().unwrap();
    assert!(failure.contains(":3:") && failure.contains("a fit"), "{failure}");
    consultation.consult(&[Datum::Number(-1.0)]);
    assert_eq!((consultation.number(0), consultation.failure()), (Some(1.0), None));
}
