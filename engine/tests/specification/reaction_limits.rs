//! What a careless author of reactions cannot do.

use std::time::{Duration, Instant};

use adit_engine::{Class, Code, KnowledgeBase, Limits, Reactions};

use crate::support::{number, rules, things};

fn react(text: &str, limits: Limits) -> (KnowledgeBase, Reactions) {
    let mut base = KnowledgeBase::with_limits(limits);
    base.assert(things("x", &[Some(1.0), Some(2.0)])).unwrap();
    let started = Instant::now();
    let run = base.react(&rules(text));
    assert!(started.elapsed() < Duration::from_secs(10), "{text}");
    (base, run)
}

fn limits() -> Limits {
    Limits { rule: Duration::from_millis(300), reactions: Duration::from_secs(3), ..Limits::default() }
}

#[test]
fn a_rule_that_fires_for_ever_is_stopped_and_named_and_its_run_taken_back() {
    let text = r#"on "more" each t in THINGS where t.x > 1 then { t.x = t.x + 1; tell("LOG", #{ x: t.x }); forget(t); tell("THINGS", #{ thing: t.thing, x: t.x }); }"#;
    let (mut base, run) = react(text, limits());
    let said: Vec<_> =
        run.diagnostics.iter().map(|problem| (problem.code, problem.message.as_str())).collect();
    assert_eq!(said, [(Code::Loop, "rule \"more\" fires again and again: no end after 10000 firings")]);
    assert!(run.firings.is_empty());
    assert_eq!(
        (number(&base, "THINGS", "2", "x"), base.len("THINGS"), base.len("LOG")),
        (Some(2.0), Some(2), Some(0))
    );
    assert_eq!(base.generation(), 0);
    assert_eq!(base.agenda(&rules(text)).len(), 1, "it waits as it did before");
}

#[test]
fn rules_that_undo_each_other_are_both_named() {
    let text = r#"
        on "start" priority 9 each t in THINGS where unknown(t.lit) then { t.lit = false; }
        on "ping" each t in THINGS where t.lit == false then { t.lit = true; }
        on "pong" each t in THINGS where t.lit == true then { t.lit = false; }
    "#;
    let (base, run) = react(text, limits());
    assert_eq!(
        run.diagnostics[0].message,
        "rules \"ping\" and \"pong\" fire in turn: no end after 10000 firings"
    );
    assert_eq!(run.diagnostics.len(), 1);
    assert_eq!(base.value("THINGS", "1", "lit"), None);
}

#[test]
fn a_run_that_is_taken_back_leaves_what_was_carried_out_before() {
    let text = r#"
        on "once" each t in THINGS then { tell("LOG", #{ thing: t.thing }); }
        on "for ever" each t in THINGS where t.y > 0 then { t.y = t.y + 1; }
    "#;
    let (mut base, run) = react(text, limits());
    assert_eq!(run.firings.len(), 2);
    base.tell("THINGS", "1", "y", Some(1.0.into())).unwrap();
    let run = base.react(&rules(text));
    assert_eq!(run.diagnostics[0].code, Code::Loop);
    let waiting: Vec<String> =
        base.agenda(&rules(text)).into_iter().map(|activation| activation.rule).collect();
    assert_eq!(waiting, ["for ever"]);
    assert_eq!(base.len("LOG"), Some(2));
}

#[test]
fn as_many_firings_as_are_allowed_are_no_loop() {
    let text = r#"on "count" each t in THINGS where t.x < 51 then { t.x = t.x + 1; }"#;
    let (_, run) = react(text, Limits { firings: 99, ..limits() });
    assert!(run.diagnostics.is_empty() && run.firings.len() == 99, "{:?}", run.diagnostics);
    let (base, run) = react(text, Limits { firings: 98, ..limits() });
    assert_eq!(run.diagnostics[0].code, Code::Loop);
    assert_eq!(number(&base, "THINGS", "1", "x"), Some(1.0));
}

#[test]
fn a_body_that_loops_is_stopped_and_the_others_go_on() {
    let text = r#"
        on "stuck" priority 1 each t in THINGS then { tell("LOG", #{ stuck: true }); loop { } }
        on "fine" each t in THINGS then { tell("LOG", #{ fine: true }); }
    "#;
    let (base, run) = react(text, limits());
    assert_eq!(run.diagnostics.len(), 1);
    assert_eq!(run.diagnostics[0].code, Code::Deadline);
    assert!(run.diagnostics[0].message.starts_with("rule \"stuck\""));
    assert_eq!((run.firings.len(), base.len("LOG")), (2, Some(2)));
}

#[test]
fn a_condition_that_loops_is_named_and_the_others_go_on() {
    let text = r#"
        fn stuck(x) { loop { } }
        on "stuck" priority 1 each t in THINGS where stuck(t.x) then { tell("LOG", #{ stuck: true }); }
        on "fine" each t in THINGS then { tell("LOG", #{ fine: true }); }
    "#;
    let (base, run) = react(text, limits());
    assert_eq!(run.diagnostics.len(), 1);
    assert_eq!(run.diagnostics[0].code, Code::Deadline);
    assert!(run.diagnostics[0].message.starts_with("rule \"stuck\""));
    assert_eq!((run.firings.len(), base.len("LOG")), (2, Some(2)));
}

#[test]
fn what_a_body_may_not_call_fails_alone() {
    let text = r#"on "sleepy" each t in THINGS then { sleep(5); }"#;
    let (_, run) = react(text, limits());
    assert_eq!(run.diagnostics[0].code, Code::Evaluation);
    assert_eq!(run.diagnostics[0].help.as_deref(), Some("it failed 2 times; this is the first"));
}

#[test]
fn a_million_matches_are_too_many_where_fewer_are_kept() {
    let class = |name: &str| Class::new(name, &[]).numbers("n", (0..1000).map(|n| Some(f64::from(n))));
    let mut base = KnowledgeBase::with_limits(Limits { matches: 100_000, ..Limits::default() });
    base.assert(class("LEFT")).unwrap();
    base.assert(class("RIGHT")).unwrap();
    let text = r#"on "all pairs" each a in LEFT each b in RIGHT where a.n != b.n then { tell("PAIRS", #{ n: a.n }); }"#;
    let run = base.react(&rules(text));
    let said: Vec<_> =
        run.diagnostics.iter().map(|problem| (problem.code, problem.message.as_str())).collect();
    assert_eq!(said, [(Code::Matches, "rule \"all pairs\" has more matches than the 100000 that are kept")]);
    assert!(run.firings.is_empty());
}

#[test]
fn matching_without_end_is_stopped_in_time() {
    let class = |name: &str| Class::new(name, &[]).numbers("n", (0..2000).map(|n| Some(f64::from(n))));
    let limits = Limits { reactions: Duration::from_millis(300), ..Limits::default() };
    let mut base = KnowledgeBase::with_limits(limits);
    for name in ["A", "B", "C"] {
        base.assert(class(name)).unwrap();
    }
    let text = "on \"r\" each a in A each b in B each c in C where a.n + b.n + c.n < 0 then { forget(a); }";
    let started = Instant::now();
    let run = base.react(&rules(text));
    assert!(started.elapsed() < Duration::from_secs(3));
    assert_eq!(run.diagnostics[0].code, Code::Deadline);
    assert_eq!(base.len("A"), Some(2000));
}
