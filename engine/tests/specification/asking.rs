//! Backward chaining: only what a question needs is computed, source by source.

use adit_engine::{Answer, Changes, Class, KnowledgeBase, RuleBase, SourceFile, Value};

use crate::support::{number, rules};

const WEIGH: &str = r#"
    rule "a room is as hard as its floor"
        each room in ROOMS some floor in FLOORS where floor.floor == room.floor
        then { room.hardness = floor.hardness; }
    rule "a door is as hard as its rooms"
        each door in DOORS
        some from in ROOMS where from.room == door.room1
        some to   in ROOMS where to.room == door.room2
        then { door.hardness = from.hardness + to.hardness; }
    rule "stiff doors take longer"
        each door in DOORS where door.stiff
        then { door.seconds = door.hardness * 2; }
"#;

/// `count` rooms in a row, a door from each to the next.
fn row_of_rooms(count: usize) -> KnowledgeBase {
    let mut base = KnowledgeBase::new();
    let numbers = |from: usize, to: usize| (from..to).map(|n| Some(n as f64));
    base.assert(
        Class::new("FLOORS", &["floor"])
            .texts("floor", ["wood", "stone"].map(Some))
            .numbers("hardness", [1.0, 2.5].map(Some)),
    )
    .unwrap();
    base.assert(
        Class::new("ROOMS", &["room"])
            .numbers("room", numbers(0, count))
            .texts("floor", (0..count).map(|n| Some(if n % 3 == 0 { "wood" } else { "stone" }))),
    )
    .unwrap();
    base.assert(
        Class::new("DOORS", &["door"])
            .numbers("door", numbers(1, count))
            .numbers("room1", numbers(0, count - 1))
            .numbers("room2", numbers(1, count))
            .truths("stiff", (1..count).map(|n| Some(n % 2 == 0))),
    )
    .unwrap();
    base
}

fn evaluated(changes: &Changes) -> Vec<(&str, usize)> {
    changes.evaluated.iter().map(|(rule, objects)| (rule.as_str(), *objects)).collect()
}

#[test]
fn only_what_a_question_needs_is_computed() {
    let rules = rules(WEIGH);
    let mut base = row_of_rooms(1000);
    let changes = base.ask_rows(&rules, "DOORS", &[6], &["hardness"]);
    let expected = [("a room is as hard as its floor", 2), ("a door is as hard as its rooms", 1)];
    assert_eq!(evaluated(&changes), expected);
    assert_eq!(number(&base, "DOORS", "7", "hardness"), Some(1.0 + 2.5));
    assert_eq!(base.value("DOORS", "8", "hardness"), None, "nobody asked for it");
    assert_eq!(base.value("DOORS", "7", "seconds"), None, "nor for this");
    assert!(base.ask_rows(&rules, "DOORS", &[6], &["hardness"]).evaluated.is_empty(), "it is known");
    let next = base.ask_rows(&rules, "DOORS", &[7], &["seconds"]);
    let expected = [
        ("a room is as hard as its floor", 1),
        ("a door is as hard as its rooms", 1),
        ("stiff doors take longer", 1),
    ];
    assert_eq!(evaluated(&next), expected, "one of its rooms was asked for before");
}

#[test]
fn what_was_asked_for_stays_right_and_the_rest_comes_when_all_is_concluded() {
    let rules = rules(WEIGH);
    let mut base = row_of_rooms(100);
    base.ask_rows(&rules, "DOORS", &[0, 40], &["seconds", "hardness"]);
    base.tell("FLOORS", "stone", "hardness", Some(10.0.into())).unwrap();
    let changes = base.ask_rows(&rules, "DOORS", &[], &[]);
    assert_eq!(changes.rows("DOORS", "hardness"), [0, 40]);
    assert_eq!(number(&base, "DOORS", "1", "hardness"), Some(11.0));
    base.conclude(&rules);
    let mut scratch = row_of_rooms(100);
    scratch.tell("FLOORS", "stone", "hardness", Some(10.0.into())).unwrap();
    scratch.conclude(&rules);
    for property in ["hardness", "seconds"] {
        assert_eq!(base.numbers("DOORS", property), scratch.numbers("DOORS", property));
    }
}

const SOURCES: &str = r#"
    class LOW_DOORS of DOORS where height < 1.5
    property DOORS.width from table, rule, default 0.9
    property LOW_DOORS.width from ask "How wide is door {door}, {height} m high?", default 0.5
    rule "measured" each door in DOORS some m in MEASURES where m.door == door.door then { door.width = m.width; }
    rule "passable" each door in DOORS then { door.passable = door.width > 0.8; }
"#;

fn doors() -> KnowledgeBase {
    let mut base = KnowledgeBase::new();
    base.assert(
        Class::new("DOORS", &["door"])
            .numbers("door", [1.0, 2.0, 3.0, 4.0].map(Some))
            .numbers("height", [2.0, 2.0, 2.0, 1.0].map(Some))
            .numbers("width", [Some(0.7), None, None, None]),
    )
    .unwrap();
    base.assert(
        Class::new("MEASURES", &["door"])
            .numbers("door", [1.0, 2.0].map(Some))
            .numbers("width", [1.5, 1.2].map(Some)),
    )
    .unwrap();
    base
}

#[test]
fn sources_are_asked_in_their_order() {
    let rules = RuleBase::compile(&[SourceFile::new("a.rhai", SOURCES)]).unwrap();
    let mut base = doors();
    let mut ask = |door: &str, property| base.ask(&rules, "DOORS", door, property).unwrap();
    assert_eq!(ask("1", "width"), Answer::Known(Value::Number(0.7)), "told");
    assert_eq!(ask("2", "width"), Answer::Known(Value::Number(1.2)), "by the rule");
    assert_eq!(ask("3", "width"), Answer::Known(Value::Number(0.9)), "by default");
    assert_eq!(ask("2", "passable"), Answer::Known(Value::Truth(true)));
}

#[test]
fn a_told_value_that_is_taken_back_leaves_the_concluded_one() {
    let rules = RuleBase::compile(&[SourceFile::new("a.rhai", SOURCES)]).unwrap();
    let mut base = doors();
    base.conclude(&rules);
    assert_eq!(number(&base, "DOORS", "1", "width"), Some(0.7));
    base.tell("DOORS", "1", "width", None).unwrap();
    base.update(&rules);
    assert_eq!(number(&base, "DOORS", "1", "width"), Some(1.5));
}

#[test]
fn what_no_source_gives_is_asked_of_the_user_and_may_be_not_known() {
    let text = SOURCES
        .replace(", default 0.5", "")
        .replace("property DOORS.width from table, rule, default 0.9\n", "");
    let text = format!("{text}\nproperty DOORS.width from table, rule");
    let rules = RuleBase::compile(&[SourceFile::new("a.rhai", text)]).unwrap();
    let mut base = doors();
    let Answer::Ask(question) = base.ask(&rules, "DOORS", "4", "width").unwrap() else {
        panic!("it is asked")
    };
    assert_eq!(question.text, "How wide is door 4, 1 m high?");
    assert_eq!(base.ask(&rules, "DOORS", "3", "width").unwrap(), Answer::NotKnown, "of low doors alone");
    base.tell_not_known("DOORS", "4", "width");
    assert_eq!(base.ask(&rules, "DOORS", "4", "width").unwrap(), Answer::NotKnown);
    base.tell("DOORS", "4", "width", Some(1.0.into())).unwrap();
    assert_eq!(base.ask(&rules, "DOORS", "4", "passable").unwrap(), Answer::Known(Value::Truth(true)));
    assert!(base.ask(&rules, "DOORS", "9", "width").is_err());
}

const REPAIR: &str = r#"
    property CARS.starts from ask "Does {car} start?"
    property CARS.lights from ask "Do the lights of {car} burn?"
    property CARS.fuel   from ask "How many litres are in the tank of {car}?"
    property CARS.age    from table
    rule "no current" each car in CARTS_AND_CARS where !car.starts && !car.lights then { car.fault = "battery"; }
    rule "no fuel"    each car in CARTS_AND_CARS where !car.starts && car.lights && car.fuel < 1 then { car.fault = "tank"; }
    rule "what to do" each car in CARTS_AND_CARS some shop in SHOPS where shop.mends == car.fault
        then { car.advice = shop.name; }
"#;

fn cars() -> (RuleBase, KnowledgeBase) {
    let rules = rules(&REPAIR.replace("CARTS_AND_CARS", "CARS"));
    let mut base = KnowledgeBase::new();
    let cars = (0..50_000).map(|n| Some(format!("car {n}")));
    base.assert(Class::new("CARS", &["car"]).texts("car", cars)).unwrap();
    base.assert(
        Class::new("SHOPS", &["name"])
            .texts("name", ["Volt", "Oil"].map(Some))
            .texts("mends", ["battery", "tank"].map(Some)),
    )
    .unwrap();
    (rules, base)
}

#[test]
fn what_rules_lack_is_asked_one_after_the_other_until_it_is_settled() {
    let (rules, mut base) = cars();
    let asked = |base: &mut KnowledgeBase| match base.ask(&rules, "CARS", "car 7", "advice").unwrap() {
        Answer::Ask(question) => question.text,
        other => format!("{other:?}"),
    };
    assert_eq!(asked(&mut base), "Does car 7 start?");
    base.tell("CARS", "car 7", "starts", Some(false.into())).unwrap();
    assert_eq!(asked(&mut base), "Do the lights of car 7 burn?");
    base.tell("CARS", "car 7", "lights", Some(true.into())).unwrap();
    assert_eq!(asked(&mut base), "How many litres are in the tank of car 7?");
    base.tell_not_known("CARS", "car 7", "fuel");
    assert_eq!(base.ask(&rules, "CARS", "car 7", "advice").unwrap(), Answer::NotKnown);
    base.tell("CARS", "car 7", "fuel", Some(0.5.into())).unwrap();
    assert_eq!(base.ask(&rules, "CARS", "car 7", "advice").unwrap(), Answer::Known("Oil".into()));
    let (answer, changes) = base.ask_row(&rules, "CARS", 8, "advice");
    assert!(matches!(answer, Answer::Ask(_)));
    assert!(changes.evaluated.iter().all(|(_, objects)| *objects == 1), "{:?}", changes.evaluated);
}

#[test]
fn what_cannot_matter_any_more_is_not_asked() {
    let (rules, mut base) = cars();
    base.tell("CARS", "car 7", "starts", Some(true.into())).unwrap();
    assert_eq!(
        base.ask(&rules, "CARS", "car 7", "fault").unwrap(),
        Answer::NotKnown,
        "no rule says anything of it"
    );
    base.tell("CARS", "car 8", "lights", Some(false.into())).unwrap();
    base.tell("CARS", "car 8", "starts", Some(false.into())).unwrap();
    assert_eq!(base.ask(&rules, "CARS", "car 8", "fault").unwrap(), Answer::Known("battery".into()));
}
