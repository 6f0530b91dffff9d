//! Rules that react: what they tell, when they come again, and in which order.

use adit_engine::{Class, Code, KnowledgeBase, Reactions, RuleBase, Told, Value};

use crate::support::{number, rules, text};

const CLOSURES: &str = r#"
    on "a door reported closed stays closed for an hour"
        each report in REPORTS where report.kind == "closed"
        none other in CLOSURES where other.door == report.door
        then {
            tell("CLOSURES", #{ door: report.door, ends: report.time + 3600 });
            report.handled = true;
            forget(report);
        }
    rule "closed doors are impassable"
        each door in DOORS
        none closure in CLOSURES where closure.door == door.door
        then { door.passable = true; }
        else { door.passable = false; }
"#;

fn doors() -> KnowledgeBase {
    let mut base = KnowledgeBase::new();
    base.assert(Class::new("DOORS", &["door"]).texts("door", ["front", "back"].map(Some))).unwrap();
    let reports = Class::new("REPORTS", &[])
        .texts("kind", [Some("open"), Some("closed"), Some("closed")])
        .texts("door", [Some("front"), Some("back"), Some("back")])
        .numbers("time", [Some(10.0), Some(20.0), Some(30.0)]);
    base.assert(reports).unwrap();
    base
}

/// Lamps `a`, `b`, `c` with a `level` each; their `note` and `spare` are unknown.
fn lamps(levels: [f64; 3]) -> KnowledgeBase {
    let mut base = KnowledgeBase::new();
    let class = Class::new("LAMPS", &["lamp"]).texts("lamp", ["a", "b", "c"].map(Some));
    let class = class.numbers("level", levels.map(Some)).numbers("spare", [None; 3]);
    base.assert(class.texts("note", [None::<&str>; 3])).unwrap();
    base
}

/// Rule and first object of each firing.
fn fired(run: &Reactions) -> Vec<(&str, &str)> {
    assert!(run.diagnostics.is_empty(), "{:?}", run.diagnostics);
    run.firings.iter().map(|firing| (firing.rule.as_str(), firing.witnesses[0].key.as_str())).collect()
}

fn set(base: &mut KnowledgeBase, lamp: &str, level: f64) {
    base.tell("LAMPS", lamp, "level", Some(level.into())).unwrap();
}

#[test]
fn what_on_tells_is_read_by_rules() {
    let (mut base, rules) = (doors(), rules(CLOSURES));
    let run = base.react(&rules);
    assert_eq!(fired(&run), [("a door reported closed stays closed for an hour", "2")]);
    assert_eq!(base.len("CLOSURES"), Some(1));
    assert_eq!(number(&base, "CLOSURES", "1", "ends"), Some(3620.0));
    assert_eq!(base.len("REPORTS"), Some(2));
    assert_eq!(text(&base, "DOORS", "back", "passable").as_deref(), Some("false"));
    assert_eq!(text(&base, "DOORS", "front", "passable").as_deref(), Some("true"));
    assert_eq!(run.changes.classes["CLOSURES"].added, [0]);
    assert_eq!(base.generation(), 1);
    assert!(base.react(&rules).firings.is_empty());
}

#[test]
fn a_rule_that_reads_what_was_never_told_does_not_wait_for_it() {
    let mut base = doors();
    base.assert(
        Class::new("REPORTS", &[])
            .texts("kind", [None::<&str>])
            .texts("door", [None::<&str>])
            .numbers("time", [None]),
    )
    .unwrap();
    assert!(base.react(&rules(CLOSURES)).firings.is_empty());
    assert_eq!(text(&base, "DOORS", "back", "passable").as_deref(), Some("true"));
}

#[test]
fn a_state_machine_goes_from_state_to_state() {
    let machine = rules(
        r#"
        on "a coin unlocks" each event in EVENTS where event.what == "coin"
            each gate in GATES where gate.gate == event.gate && gate.state == "locked"
            then { gate.state = "open"; gate.coins = (gate.coins ?? 0) + 1; forget(event); }
        on "a push locks again" each event in EVENTS where event.what == "push"
            each gate in GATES where gate.gate == event.gate && gate.state == "open"
            then { gate.state = "locked"; forget(event); }
        on "all else is ignored" priority -1 each event in EVENTS then { forget(event); }
    "#,
    );
    let mut base = KnowledgeBase::new();
    let gates =
        Class::new("GATES", &["gate"]).texts("gate", [Some("north")]).texts("state", [Some("locked")]);
    base.assert(gates.numbers("coins", [None])).unwrap();
    base.assert(Class::new("EVENTS", &[]).texts("what", [None::<&str>; 0]).texts("gate", [None::<&str>; 0]))
        .unwrap();
    let mut say = |what: &str| {
        base.add("EVENTS", &[("what", what.into()), ("gate", "north".into())]).unwrap();
        let run = base.react(&machine);
        let rule = fired(&run)[0].0.to_owned();
        assert_eq!(run.firings.len(), 1);
        assert_eq!(base.len("EVENTS"), Some(0));
        (rule, text(&base, "GATES", "north", "state").unwrap(), number(&base, "GATES", "north", "coins"))
    };
    let said = |rule: &str, state: &str, coins| (rule.to_owned(), state.to_owned(), coins);
    assert_eq!(say("push"), said("all else is ignored", "locked", None));
    assert_eq!(say("coin"), said("a coin unlocks", "open", Some(1.0)));
    assert_eq!(say("coin"), said("all else is ignored", "open", Some(1.0)));
    assert_eq!(say("push"), said("a push locks again", "locked", Some(1.0)));
    assert_eq!(say("coin"), said("a coin unlocks", "open", Some(2.0)));
}

#[test]
fn it_comes_again_when_what_it_reads_has_changed_and_not_before() {
    let rules = rules(r#"on "seen" each lamp in LAMPS where lamp.level > 1 then { lamp.note = "seen"; }"#);
    let mut base = lamps([0.0, 5.0, 0.0]);
    assert_eq!(fired(&base.react(&rules)), [("seen", "b")]);
    assert_eq!(fired(&base.react(&rules)), []);
    set(&mut base, "b", 5.0);
    base.tell("LAMPS", "b", "note", Some("of no interest".into())).unwrap();
    assert_eq!(fired(&base.react(&rules)), [], "what it reads is the same");
    set(&mut base, "b", 6.0);
    assert_eq!(fired(&base.react(&rules)), [("seen", "b")], "another value, which passes too");
    set(&mut base, "b", 0.0);
    assert_eq!(fired(&base.react(&rules)), []);
    set(&mut base, "b", 6.0);
    assert_eq!(fired(&base.react(&rules)), [("seen", "b")], "it went away and came back");
}

#[test]
fn it_also_comes_again_when_what_it_reads_is_concluded_anew() {
    let rules = rules(
        r#"rule "power" each lamp in LAMPS then { lamp.watts = floor(lamp.level / 10); }
           on "noted" each lamp in LAMPS where lamp.watts > 0 then { tell("NOTES", #{ lamp: lamp.lamp, watts: lamp.watts }); }"#,
    );
    let mut base = lamps([10.0, 0.0, 0.0]);
    assert_eq!(fired(&base.react(&rules)), [("noted", "a")]);
    set(&mut base, "a", 15.0);
    assert_eq!(fired(&base.react(&rules)), [], "a watt is a watt");
    set(&mut base, "a", 20.0);
    assert_eq!(fired(&base.react(&rules)), [("noted", "a")]);
    assert_eq!(base.numbers("NOTES", "watts").unwrap(), [Some(1.0), Some(2.0)]);
}

#[test]
fn it_comes_again_when_another_object_stops_standing_in_its_way() {
    let rules = rules(
        r#"on "darkest" each lamp in LAMPS none other in LAMPS where other.level < lamp.level then { lamp.note = "darkest"; }"#,
    );
    let mut base = lamps([1.0, 2.0, 3.0]);
    assert_eq!(fired(&base.react(&rules)), [("darkest", "a")]);
    set(&mut base, "b", 0.0);
    assert_eq!(fired(&base.react(&rules)), [("darkest", "b")]);
    set(&mut base, "b", 9.0);
    assert_eq!(fired(&base.react(&rules)), [("darkest", "a")]);
}

const ORDER: &str = r#"
    on "late" priority -1 each lamp in LAMPS then { lamp.note = "late"; }
    on "second" each lamp in LAMPS each other in LAMPS where other.level > lamp.level then { lamp.note = "second"; }
    on "third" each lamp in LAMPS then { lamp.note = "third"; }
    on "first" priority 5 each lamp in LAMPS where lamp.level > 1 then { lamp.note = "first"; }
"#;

#[test]
fn the_order_is_by_priority_then_files_then_rows() {
    let rules = rules(ORDER);
    let mut base = lamps([1.0, 2.0, 3.0]);
    let waiting = base.agenda(&rules);
    assert_eq!(base.generation(), 0, "nothing was done");
    let called = |activation: &adit_engine::Activation| {
        let keys: Vec<&str> = activation.witnesses.iter().map(|witness| witness.key.as_str()).collect();
        format!("{} {}", activation.rule, keys.join(""))
    };
    let order = [
        "first b",
        "first c",
        "second ab",
        "second ac",
        "second bc",
        "third a",
        "third b",
        "third c",
        "late a",
        "late b",
        "late c",
    ];
    assert_eq!(waiting.iter().map(called).collect::<Vec<_>>(), order);
    let run = base.react(&rules);
    let done: Vec<String> = run
        .firings
        .iter()
        .map(|firing| {
            let keys: Vec<&str> = firing.witnesses.iter().map(|witness| witness.key.as_str()).collect();
            format!("{} {}", firing.rule, keys.join(""))
        })
        .collect();
    assert_eq!(done, order);
    assert_eq!(
        run.firings.iter().map(|firing| firing.generation).collect::<Vec<_>>(),
        (1..=11).collect::<Vec<_>>()
    );
}

#[test]
fn the_order_does_not_rest_on_how_the_facts_came_about() {
    let rules = rules(ORDER);
    let mut base = lamps([3.0, 2.0, 9.0]);
    base.agenda(&rules);
    set(&mut base, "c", 3.0);
    set(&mut base, "a", 1.0);
    assert_eq!(base.agenda(&rules), lamps([1.0, 2.0, 3.0]).agenda(&rules));
}

#[test]
fn the_agenda_is_looked_at_anew_after_each_firing() {
    let rules = rules(
        r#"on "one is enough" each lamp in LAMPS where lamp.level > 0 none lit in LAMPS where lit.note == "lit"
           then { lamp.note = "lit"; }"#,
    );
    assert_eq!(fired(&lamps([0.0, 2.0, 3.0]).react(&rules)), [("one is enough", "b")]);
}

#[test]
fn what_is_told_stands_over_what_is_concluded_until_it_is_taken_back() {
    let rules = rules(
        r#"rule "bright" each lamp in LAMPS then { lamp.bright = lamp.level > 1; }
           on "hand over" each order in ORDERS each lamp in LAMPS where lamp.lamp == order.lamp
           then { lamp.bright = order.bright; forget(order); }"#,
    );
    let mut base = lamps([0.0, 0.0, 5.0]);
    base.assert(Class::new("ORDERS", &[]).texts("lamp", [Some("a")]).truths("bright", [Some(true)])).unwrap();
    base.react(&rules);
    assert_eq!(base.value("LAMPS", "a", "bright"), Some(true.into()));
    base.add("ORDERS", &[("lamp", "a".into())]).unwrap();
    base.react(&rules);
    assert_eq!(base.value("LAMPS", "a", "bright"), Some(false.into()), "unknown takes back what was told");
}

#[test]
fn a_body_may_loop_branch_and_call_and_sees_what_it_set_itself() {
    let rules = rules(
        r#"
        fn shout(text) { text + "!" }
        on "work" each lamp in LAMPS where lamp.level > 2
            count n of other in LAMPS where other.level < lamp.level
            then {
                for nth in 1..4 { if nth != 2 { tell("TICKS", #{ lamp: lamp.lamp, nth: nth }); } }
                lamp.note = shout("a");
                lamp.note += if lamp.spare == () { "b" } else { "c" };
                lamp.darker = n;
            }
    "#,
    );
    let mut base = lamps([1.0, 2.0, 3.0]);
    assert_eq!(fired(&base.react(&rules)), [("work", "c")]);
    assert_eq!(base.numbers("TICKS", "nth").unwrap(), [Some(1.0), Some(3.0)]);
    assert_eq!(text(&base, "LAMPS", "c", "note").as_deref(), Some("a!b"));
    assert_eq!(number(&base, "LAMPS", "c", "darker"), Some(2.0));
}

#[test]
fn an_action_is_done_whole_or_not_at_all() {
    let fails = |body: &str| {
        let mut base = lamps([1.0, 2.0, 3.0]);
        let rules = rules(&format!(
            "fn word() {{ \"high\" }} on \"r\" each lamp in LAMPS where lamp.level > 2 then {{ tell(\"NOTES\", #{{ n: 1 }}); lamp.note = \"x\"; {body} }}"
        ));
        base.agenda(&rules);
        base.update(&rules);
        let run = base.react(&rules);
        assert!(run.firings.is_empty() && run.changes.is_empty(), "{body}: {:?}", run.changes);
        assert_eq!(base.len("NOTES"), Some(0), "{body}");
        assert_eq!(text(&base, "LAMPS", "c", "note"), None, "{body}");
        assert!(base.react(&rules).diagnostics.is_empty(), "it is not tried again, {body}");
        run.diagnostics.iter().map(|problem| problem.message.clone()).collect::<Vec<_>>()
    };
    assert_eq!(fails("let x = 1; x.trim();").len(), 1);
    assert_eq!(fails("throw \"no\";"), [r#"rule "r": Runtime error: no (line 1, position 119)"#]);
    assert_eq!(fails("lamp.level = [1];"), [r#"rule "r": `level` cannot hold a value of type array"#]);
    assert_eq!(
        fails("lamp.level = word();"),
        [r#"rule "r" told what cannot be: LAMPS.level holds numbers, not high"#]
    );
    assert_eq!(
        fails("forget(lamp); tell(\"LAMPS\", #{ lamp: \"a\" });"),
        [r#"rule "r" told what cannot be: class LAMPS has two objects with the key a"#]
    );
}

#[test]
fn the_log_told_again_gives_the_same() {
    let rules = rules(CLOSURES);
    let mut base = doors();
    let log = base.react(&rules).log();
    assert!(
        matches!(log.as_slice(), [Told::Value { .. }, Told::Gone { .. }, Told::Object { .. }]),
        "{log:?}"
    );
    let mut again = doors();
    again.replay(&log).unwrap();
    again.conclude(&rules);
    for (class, property) in [("CLOSURES", "door"), ("DOORS", "passable"), ("REPORTS", "door")] {
        assert_eq!(again.len(class), base.len(class));
        for row in 0..base.len(class).unwrap() {
            let key = base.key(class, row).unwrap();
            assert_eq!(again.value(class, &key, property), base.value(class, &key, property));
        }
    }
    let json = serde_json::to_string(&log[2]).unwrap();
    assert_eq!(json, r#"{"object":{"class":"CLOSURES","properties":{"door":"back","ends":3620.0}}}"#);
}

#[test]
fn a_log_that_does_not_fit_is_not_told_at_all() {
    let mut base = lamps([1.0, 2.0, 3.0]);
    let value = |lamp: &str| Told::Value {
        class: "LAMPS".into(),
        key: lamp.into(),
        property: "level".into(),
        value: Some(Value::Number(9.0)),
        lasts: None,
    };
    let gone = Told::Gone { class: "LAMPS".into(), key: "b".into() };
    assert!(base.replay(&[value("a"), gone, value("nobody")]).is_err());
    assert_eq!(base.numbers("LAMPS", "level").unwrap(), [Some(1.0), Some(2.0), Some(3.0)]);
}

#[test]
fn other_rules_may_change_without_the_unchanged_firing_again() {
    let one = r#"on "one" each lamp in LAMPS where lamp.level > 2 then { lamp.note = "one"; }"#;
    let two = r#"on "two" each lamp in LAMPS where lamp.level > 2 then { lamp.note = "two"; }"#;
    let mut base = lamps([1.0, 2.0, 3.0]);
    assert_eq!(fired(&base.react(&rules(one))), [("one", "c")]);
    assert_eq!(fired(&base.react(&rules(&format!("{two}\n{one}")))), [("two", "c")]);
}

#[test]
fn a_class_asserted_in_another_order_keeps_what_was_carried_out() {
    let rules =
        rules(r#"on "seen" each lamp in LAMPS where lamp.level > 1 then { tell("NOTES", #{ n: 1 }); }"#);
    let mut base = lamps([1.0, 2.0, 3.0]);
    assert_eq!(fired(&base.react(&rules)), [("seen", "b"), ("seen", "c")]);
    let class = Class::new("LAMPS", &["lamp"]).texts("lamp", ["c", "d", "a", "b"].map(Some));
    let class = class.numbers("level", [3.0, 4.0, 1.0, 9.0].map(Some)).numbers("spare", [None; 4]);
    base.assert(class.texts("note", [None::<&str>; 4])).unwrap();
    assert_eq!(
        fired(&base.react(&rules)),
        [("seen", "d"), ("seen", "b")],
        "d is new, and b has another level"
    );
}

#[test]
fn looking_at_the_agenda_takes_no_changes_from_the_host() {
    let rules = rules(ORDER);
    let mut base = lamps([1.0, 2.0, 3.0]);
    base.update(&rules);
    set(&mut base, "a", 7.0);
    base.agenda(&rules);
    assert_eq!(base.update(&rules).rows("LAMPS", "level"), [0]);
    assert!(base.update(&rules).is_empty());
}

#[test]
fn names_of_what_is_told_are_checked() {
    let schema = lamps([0.0; 3]).schema();
    let said = |text: &str| -> Vec<(Code, String)> {
        let said = rules(text).check(&schema).into_iter();
        said.map(|problem| {
            (problem.code, format!("{} / {}", problem.message, problem.help.unwrap_or_default()))
        })
        .collect()
    };
    let right = r#"
        on "a" each lamp in LAMPS then { tell("NOTES", #{ lamp: lamp.lamp }); lamp.seen = true; }
        on "b" each lamp in LAMPS where lamp.seen each n in NOTES where n.lamp == lamp.lamp then { forget(n); }
        rule "c" each n in NOTES then { n.long = n.lamp == "a"; }
    "#;
    assert_eq!(said(right), []);
    assert_eq!(
        said(r#"on "a" each lamp in LAMPS then { tell("LAMP", #{ lamp: lamp.lamp }); }"#),
        [(Code::UnknownClass, "there is no class LAMP / did you mean `LAMPS`?".to_owned())]
    );
    assert_eq!(
        said(r#"on "a" each lamp in LAMPS then { lamp.levle = 3; }"#),
        [(Code::UnknownProperty, "LAMPS has no property `levle` / did you mean `level`?".to_owned())]
    );
    assert_eq!(
        said(r#"on "a" each lamp in LAMPS then { lamp.level = "high"; }"#),
        [(Code::Type, "LAMPS.level holds numbers, and this gives texts / ".to_owned())]
    );
}

#[test]
fn a_rule_waits_for_what_nobody_has_told() {
    let rules = rules(
        r#"on "r" each lamp in LAMPS none order in ORDERS where order.lamp == lamp.lamp then { lamp.note = "idle"; }"#,
    );
    let mut base = lamps([1.0, 2.0, 3.0]);
    assert_eq!(fired(&base.react(&rules)), []);
    base.assert(Class::new("ORDERS", &[]).texts("lamp", [Some("a")])).unwrap();
    assert_eq!(fired(&base.react(&rules)), [("r", "b"), ("r", "c")]);
}

#[test]
fn a_rule_base_without_reactions_reacts_to_nothing() {
    assert!(lamps([1.0, 2.0, 3.0]).react(&RuleBase::default()).firings.is_empty());
}

#[test]
fn reactions_look_through_links_and_at_classes_by_condition() {
    let rules = rules(
        r#"property LAMPS.room names ROOMS
           class DARK_ROOMS of ROOMS where light < 3
           on "switch on" each lamp in LAMPS where lamp.room.light < 3 && lamp.level == 0 then { lamp.level = 5; }
           on "lost" each lamp in LAMPS where unknown(lamp.room.light) && lamp.level == 0 then { lamp.note = "lost"; }
           on "dark" each room in DARK_ROOMS then { tell("NOTES", #{ room: room.room }); }"#,
    );
    let mut base = lamps([0.0, 0.0, 0.0]);
    for (lamp, room) in [("a", "hall"), ("b", "attic"), ("c", "cellar")] {
        base.tell("LAMPS", lamp, "room", Some(room.into())).unwrap();
    }
    let room = Class::new("ROOMS", &["room"]).texts("room", ["hall", "attic"].map(Some));
    base.assert(room.numbers("light", [Some(9.0), Some(1.0)])).unwrap();
    assert_eq!(fired(&base.react(&rules)), [("switch on", "b"), ("lost", "c"), ("dark", "attic")]);
    base.tell("ROOMS", "hall", "light", Some(2.0.into())).unwrap();
    assert_eq!(fired(&base.react(&rules)), [("switch on", "a"), ("dark", "hall")]);
    base.add("ROOMS", &[("room", "cellar".into()), ("light", 0.0.into())]).unwrap();
    assert_eq!(fired(&base.react(&rules)), [("switch on", "c"), ("dark", "cellar")]);
}

#[test]
fn asking_for_a_value_does_not_hide_a_change_from_the_agenda() {
    let rules = rules(r#"on "seen" each lamp in LAMPS where lamp.level > 1 then { lamp.note = "seen"; }"#);
    let mut base = lamps([0.0, 0.0, 0.0]);
    base.react(&rules);
    set(&mut base, "a", 5.0);
    base.ask_rows(&rules, "LAMPS", &[1], &["level"]);
    set(&mut base, "b", 5.0);
    base.conclude(&rules);
    assert_eq!(fired(&base.react(&rules)), [("seen", "a"), ("seen", "b")]);
}

#[test]
fn another_knowledge_base_of_the_same_facts_goes_on_where_the_first_one_stopped() {
    let rules = rules(
        r#"on "low" each lamp in LAMPS where lamp.level < 3 none other in LAMPS where other.note == "off"
           then { tell("NOTES", #{ lamp: lamp.lamp }); }
           on "a coin" each coin in COINS then { tell("NOTES", #{ lamp: "coin" }); }"#,
    );
    let coins = |count: usize| Class::new("COINS", &[]).texts("metal", vec![Some("gold"); count]);
    let mut base = lamps([1.0, 2.0, 3.0]);
    base.assert(coins(2)).unwrap();
    assert_eq!(base.react(&rules).firings.len(), 4);
    let done = base.carried_out(&rules);
    let because: Vec<&str> = done.iter().map(|of| of.because.as_str()).collect();
    assert_eq!(because, ["coin", "coin", "lamp a: level = 1", "lamp b: level = 2"]);

    let mut again = lamps([1.0, 2.5, 2.0]);
    again.assert(coins(3)).unwrap();
    again.resume(&rules, &done);
    let run = again.react(&rules);
    let fired: Vec<(&str, &str)> =
        run.firings.iter().map(|firing| (firing.rule.as_str(), firing.because.as_str())).collect();
    // one coin more, another value, and one that was not met before
    assert_eq!(fired, [("low", "lamp b: level = 2.5"), ("low", "lamp c: level = 2"), ("a coin", "coin")]);

    // what is not met any more is not carried out any more either
    again.tell("LAMPS", "a", "note", Some("off".into())).unwrap();
    assert_eq!(again.carried_out(&rules).len(), 3, "the coins");
}

#[test]
fn a_value_may_last_for_some_time_which_the_host_counts() {
    let rules = rules(
        r#"on "rest" each lamp in LAMPS where lamp.level > 2 then { lamp.note = lasting("rests", 90); lamp.spare = lamp.level; }"#,
    );
    let mut base = lamps([1.0, 2.0, 3.0]);
    let log = base.react(&rules).log();
    assert_eq!(text(&base, "LAMPS", "c", "note"), Some("rests".to_owned()));
    let lasts: Vec<Option<f64>> =
        log.iter().map(|told| if let Told::Value { lasts, .. } = told { *lasts } else { None }).collect();
    assert_eq!(lasts, [Some(90.0), None]);

    let wrong = |value: &str| {
        let text = format!("on \"r\" each lamp in LAMPS then {{ lamp.spare = {value}; }}");
        let run = lamps([1.0, 2.0, 3.0]).react(&crate::support::rules(&text));
        run.diagnostics.first().map(|problem| problem.message.clone()).unwrap_or_default()
    };
    assert_eq!(wrong("lasting(1, -1)"), "rule \"r\": `spare` cannot last -1 s");
    let said = wrong("lasting(1, \"an hour\")");
    assert!(said.contains("a value lasts for a number of seconds, not `an hour`"), "{said}");
    assert_eq!(wrong("lasting(\"long\", 5)"), "LAMPS.spare holds numbers, and this gives texts");
    let one = RuleBase::compile(&[adit_engine::SourceFile::new(
        "a.rhai",
        r#"on "r" each lamp in LAMPS then { lamp.spare = lasting(1); }"#,
    )]);
    assert_eq!(
        one.unwrap_err().0[0].message,
        "`lasting` takes a value and for how many seconds it holds, as in `door.closed = lasting(true, 3600)`"
    );
}

#[test]
fn objects_of_a_numbered_class_that_are_told_without_a_number_get_the_next_one() {
    let rules = rules(
        r#"on "note" each lamp in LAMPS where lamp.level > 1
           then { tell("NOTES", #{ lamp: lamp.lamp }); tell("NOTES", #{ lamp: "also " + lamp.lamp }); }"#,
    );
    let mut base = lamps([1.0, 2.0, 3.0]);
    let notes = Class::new("NOTES", &["note"]).numbers("note", [Some(7.0)]).texts("lamp", [Some("x")]);
    base.assert(notes.numbered()).unwrap();
    let run = base.react(&rules);
    assert_eq!(text(&base, "NOTES", "9", "lamp"), Some("also b".to_owned()));
    assert_eq!(text(&base, "NOTES", "11", "lamp"), Some("also c".to_owned()));
    let said = serde_json::to_value(&run.log()[0]).unwrap();
    assert_eq!(said["object"]["properties"]["note"], 8.0);
}
