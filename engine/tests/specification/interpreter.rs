//! What is compiled gives what rhai's interpreter gives.

use std::fmt::Write as _;

use adit_engine::{Class, Code, KnowledgeBase, Value};
use proptest::prelude::*;

use crate::support::{concluded, rules};

/// Expressions of numbers over `$x`, `$y`.
fn numbers() -> impl Strategy<Value = String> + Clone {
    let leaf = prop_oneof![
        Just("$x".to_owned()),
        Just("$y".to_owned()),
        (-9..9_i32).prop_map(|n| format!("({n})")),
        (-9..9_i32).prop_map(|n| format!("({:.2})", f64::from(n) / 4.0)),
    ];
    leaf.prop_recursive(3, 16, 3, |inner| {
        prop_oneof![
            (inner.clone(), prop::sample::select(vec!["+", "-", "*"]), inner.clone())
                .prop_map(|(a, op, b)| format!("({a} {op} {b})")),
            (inner.clone(), prop::sample::select(vec!["/", "%"]), 1..9_i32)
                .prop_map(|(a, op, b)| format!("({a} {op} {b})")),
            (inner.clone(), 1..3_i32).prop_map(|(a, b)| format!("({a} ** {b})")),
            (inner.clone(), prop::sample::select(vec!["min", "max", "hypot"]), inner.clone())
                .prop_map(|(a, f, b)| format!("{f}({a}, {b})")),
            (inner.clone(), prop::sample::select(vec!["abs", "floor", "ceil", "round"]))
                .prop_map(|(a, f)| format!("{f}({a})")),
            inner.clone().prop_map(|a| format!("sqrt(abs({a}))")),
            inner.clone().prop_map(|a| format!("(-{a})")),
            (inner.clone(), inner.clone(), inner.clone(), inner)
                .prop_map(|(a, b, c, d)| format!("(if {a} < {b} {{ {c} }} else {{ {d} }})")),
        ]
    })
}

/// Expressions of texts over `$s` and the numbers.
fn texts() -> impl Strategy<Value = String> + Clone {
    let leaf = prop_oneof![Just("$s".to_owned()), "[a-c]{0,2}".prop_map(|text| format!("\"{text}\""))];
    leaf.prop_recursive(2, 6, 2, |inner| {
        prop_oneof![
            (inner.clone(), inner.clone()).prop_map(|(a, b)| format!("({a} + {b})")),
            inner.prop_map(|a| format!("({a} + $x)")),
        ]
    })
}

/// Conditions over all of them and `$b`.
fn truths() -> impl Strategy<Value = String> + Clone {
    let comparison = || prop::sample::select(vec!["==", "!=", "<", "<=", ">", ">="]);
    let leaf = prop_oneof![
        Just("$b".to_owned()),
        (numbers(), comparison(), numbers()).prop_map(|(a, op, b)| format!("({a} {op} {b})")),
        (texts(), comparison(), texts()).prop_map(|(a, op, b)| format!("({a} {op} {b})")),
    ];
    leaf.prop_recursive(2, 8, 2, |inner| {
        prop_oneof![
            (inner.clone(), prop::sample::select(vec!["&&", "||", "=="]), inner.clone())
                .prop_map(|(a, op, b)| format!("({a} {op} {b})")),
            inner.prop_map(|a| format!("(!{a})")),
        ]
    })
}

/// Statements over the variables `v`, a number, and `s`, a text; `#` stands for the letter of a rule.
fn statements() -> impl Strategy<Value = String> + Clone {
    let plain = prop::sample::select(vec![
        "s += \"bc\";",
        "s += v;",
        "s.pad(5, \"y\");",
        "pad(s, 4, \"z\");",
        "s.truncate(1);",
        "s.make_upper();",
        "let u = s.pop(); s += u;",
        "let u = s.len(); v -= u;",
        "let v = v + 1;",
        "t.w# = v;",
        "t.z# = s;",
        "t.w# = if v > 2 { v += 1; v } else { v };",
    ]);
    let leaf = prop_oneof![
        3 => plain.prop_map(str::to_owned),
        1 => (prop::sample::select(vec!["=", "+=", "-=", "*="]), numbers())
            .prop_map(|(sign, value)| format!("v {sign} {value};")),
        1 => texts().prop_map(|value| format!("s = {value};")),
    ];
    let one = leaf.prop_recursive(2, 8, 2, |inner| {
        prop_oneof![
            4 => (truths(), inner.clone(), inner.clone())
                .prop_map(|(c, a, b)| format!("if {c} {{ {a} }} else {{ {b} }}")),
            2 => (inner.clone(), inner.clone()).prop_map(|(a, b)| format!("{{ let v = 2.5; {a} {b} }}")),
            1 => (inner.clone(), inner.clone())
                .prop_map(|(a, b)| format!("switch s {{ \"a\" => {{ {a} }}, _ => {{ {b} }} }}")),
            1 => inner.prop_map(|a| format!("for i in 0..2 {{ {a} }}")),
        ]
    });
    prop::collection::vec(one, 1..4).prop_map(|statements| of_object(&statements.join("\n")))
}

/// Values of x, y, s and b.
type Row<'a> = (Option<f64>, Option<f64>, Option<&'a str>, Option<bool>);

fn class(rows: &[Row]) -> Class {
    Class::new("T", &[])
        .numbers("x", rows.iter().map(|row| row.0))
        .numbers("y", rows.iter().map(|row| row.1))
        .texts("s", rows.iter().map(|row| row.2))
        .truths("b", rows.iter().map(|row| row.3))
}

const ROWS: [Row; 4] = [
    (Some(0.0), Some(1.5), Some("a"), Some(true)),
    (Some(-2.25), Some(3.0), Some(""), Some(false)),
    (Some(7.0), Some(-1.0), Some("bc"), Some(true)),
    (Some(0.125), Some(0.125), Some("c"), Some(false)),
];

/// How deep brackets nest; the interpreter reads 32 levels in a function, and counts several for a bracket.
fn depth(expression: &str) -> i32 {
    let steps = expression.chars().map(|c| i32::from("({".contains(c)) - i32::from(")}".contains(c)));
    let depths = steps.scan(0, |depth, step| {
        *depth += step;
        Some(*depth)
    });
    depths.max().unwrap_or(0)
}

fn of_object(expression: &str) -> String {
    expression.replace('$', "t.")
}

fn values(base: &KnowledgeBase, property: &str) -> Vec<Option<Value>> {
    (1..=ROWS.len()).map(|row| base.value("T", &row.to_string(), property)).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn an_expression_is_compiled_as_it_is_interpreted(
        number in numbers(), text in texts(), truth in truths()
    ) {
        prop_assume!([&number, &text, &truth].into_iter().all(|expression| depth(expression) <= 8));
        let mut script = String::new();
        for (nth, expression) in [number, text, truth].iter().enumerate() {
            let (compiled, plain) = (of_object(expression), expression.replace('$', ""));
            write!(script, "rule \"c{nth}\" each t in T then {{ t.c{nth} = {compiled}; }}
                fn f{nth}(x, y, s, b) {{ {plain} }}
                rule \"i{nth}\" each t in T then {{ t.i{nth} = f{nth}(t.x, t.y, t.s, t.b); }}
            ").unwrap();
        }
        let (base, _) = concluded(&script, [class(&ROWS)]);
        for nth in 0..3 {
            prop_assert_eq!(values(&base, &format!("c{nth}")), values(&base, &format!("i{nth}")), "{}", script);
        }
    }

    /// Kleene's logic says true or false only where every value of the unknown would say the same.
    #[test]
    fn what_is_concluded_from_unknown_holds_whatever_it_is(truth in truths()) {
        let rule = format!("rule \"r\" each t in T then {{ t.r = {}; }}", of_object(&truth));
        let unknown = |which: usize| ROWS.map(|(x, y, s, b)| (
            x.filter(|_| which != 0), y.filter(|_| which != 1), s.filter(|_| which != 2), b.filter(|_| which != 3),
        ));
        let known = concluded(&rule, [class(&ROWS)]).0.truths("T", "r").unwrap();
        for which in 0..4 {
            let partly = concluded(&rule, [class(&unknown(which))]).0.truths("T", "r").unwrap();
            for (partly, known) in partly.iter().zip(&known) {
                prop_assert!(partly.is_none() || partly == known, "{}", rule);
            }
        }
    }

    /// Reactions have an evaluator of their own, for one binding at a time.
    #[test]
    fn reactions_match_where_rules_do(number in numbers(), text in texts(), truth in truths(), which in 0..5) {
        let rows = ROWS.map(|(x, y, s, b)| (
            x.filter(|_| which != 0), y.filter(|_| which != 1), s.filter(|_| which != 2), b.filter(|_| which != 3),
        ));
        let (number, text, truth) = (of_object(&number), of_object(&text), of_object(&truth));
        let mut script = String::new();
        for (nth, condition) in
            [truth, format!("{number} > t.x"), format!("{text} >= \"b\""), format!("known({number}) || {text} == t.s")]
                .iter()
                .enumerate()
        {
            write!(script, "rule \"{nth}\" each t in T where {condition} then {{ t.c{nth} = true; }}
                on \"on {nth}\" each t in T where {condition} then {{ }}\n").unwrap();
        }
        let rules = rules(&script);
        let (mut base, _) = concluded(&script, [class(&rows)]);
        let agenda = base.agenda(&rules);
        for nth in 0..4 {
            let name = format!("on {nth}");
            let activated = agenda.iter().filter(|activation| activation.rule == name);
            let activated: Vec<&str> = activated.map(|activation| activation.witnesses[0].key.as_str()).collect();
            let concluded = values(&base, &format!("c{nth}"));
            let concluded = (1..).zip(concluded).filter(|(_, value)| value.is_some());
            let concluded: Vec<String> = concluded.map(|(row, _): (u32, _)| row.to_string()).collect();
            prop_assert_eq!(activated, concluded, "{}", script);
        }
    }

    #[test]
    fn an_action_is_compiled_as_it_is_interpreted(
        a in numbers(), b in numbers(), c in truths(), d in truths(), more in statements()
    ) {
        let body = format!("
            let v = {a};
            let s = t.s;
            if {c} {{ v = {b}; t.p# = v + 1; }} else {{ let v = 2.5; t.q# = v * {a}; }}
            if {d} {{ v += 1; t.p# = {b}; }}
            {more}
            t.r# = v;
            t.s# = s;", a = of_object(&a), b = of_object(&b), c = of_object(&c), d = of_object(&d));
        // The loop keeps the second action from being compiled.
        let script = format!("rule \"c\" each t in T then {{ {} }}
            rule \"i\" each t in T then {{ for i in 0..1 {{ }} {} }}", body.replace('#', "c"), body.replace('#', "i"));
        let (base, _) = concluded(&script, [class(&ROWS)]);
        for property in ["p", "q", "r", "s", "w", "z"] {
            prop_assert_eq!(
                values(&base, &format!("{property}c")), values(&base, &format!("{property}i")), "{}", script
            );
        }
    }
}

#[test]
fn zero_has_no_sign() {
    let rule = r#"
        rule "c" each t in T then {
            t.a = "" + -(0 + 0); t.k = "" + 0 * -3; t.c = `${-t.x}`; t.d = "" + round(-0.2); t.e = 1 / (t.x * -1);
        }
        rule "i" each t in T then {
            for i in 0..1 { }
            t.f = "" + -(0 + 0); t.g = "" + 0 * -3; t.h = `${-t.x}`; t.i = "" + round(-0.2); t.j = 1 / (t.x * -1);
        }"#;
    let (base, _) = concluded(rule, [class(&ROWS)]);
    for (compiled, interpreted) in ["a", "k", "c", "d"].iter().zip(["f", "g", "h", "i"]) {
        assert_eq!(base.value("T", "1", compiled), Some("0".into()), "{compiled}");
        assert_eq!(base.value("T", "1", interpreted), Some("0".into()), "{interpreted}");
    }
    assert_eq!(base.value("T", "1", "e"), Some(f64::INFINITY.into()));
    assert_eq!(base.value("T", "1", "j"), Some(f64::INFINITY.into()));
}

#[test]
fn functions_of_the_file_and_of_the_library_may_be_called_anywhere() {
    let rule = r#"
        const FAR = 5;
        fn slope(a, b) { if b == 0.0 { FAR_AWAY() } else { a / b } }
        fn FAR_AWAY() { 1000.0 }
        rule "r" each t in T where slope(t.x, t.y) < FAR
            least u in T by slope(u.x, t.y) + y where u.s.len() > 0 && u.s.contains("c")
            then { t.r = u.s.to_upper(); t.wide = `x is ${t.x}`; }
    "#;
    let (base, _) = concluded(rule, [class(&ROWS)]);
    assert_eq!(base.texts("T", "r").unwrap().iter().flatten().count(), 4);
    assert_eq!(base.value("T", "1", "r"), Some("C".into()));
    assert_eq!(base.value("T", "3", "r"), Some("BC".into()));
    assert_eq!(base.value("T", "3", "wide"), Some("x is 7".into()));
}

#[test]
fn switch_and_loops_run_in_the_interpreter() {
    let rule = r#"
        rule "r" each t in T then {
            switch t.s { "a" => t.kind = "first", "bc" | "c" => t.kind = "later", _ => t.kind = "none" }
            let sum = 0;
            for i in 1..4 { sum += i; }
            t.sum = sum;
        }"#;
    let (base, report) = concluded(rule, [class(&ROWS)]);
    let kinds: Vec<_> = base.texts("T", "kind").unwrap().into_iter().flatten().collect();
    assert_eq!(kinds.join(" "), "first none later later");
    assert_eq!(base.numbers("T", "sum").unwrap(), [Some(6.0); 4]);
    assert!(report.gaps.is_empty());
}

#[test]
fn what_is_unknown_is_not_handed_to_functions() {
    let rule = r#"fn f(x) { if x == () { 1 } else { 2 } } rule "r" each t in T then { t.r = f(t.x); }"#;
    let (base, _) = concluded(rule, [class(&[(None, None, None, None), ROWS[0]])]);
    assert_eq!(base.numbers("T", "r").unwrap(), [None, Some(2.0)]);
}

#[test]
fn a_failing_part_gives_unknown_and_one_message_with_its_place() {
    let text = "fn f(x) { throw \"no\" }\nrule \"r\" each t in T then { t.r = f(t.x); t.ok = true; }";
    let mut base = KnowledgeBase::new();
    base.assert(class(&ROWS)).unwrap();
    let report = base.conclude(&rules(text));
    let [problem] = report.diagnostics.as_slice() else { panic!("{:?}", report.diagnostics) };
    assert_eq!((problem.code, problem.line), (Code::Evaluation, 2));
    assert_eq!(problem.help.as_deref(), Some("it failed 4 times; this is the first"));
    assert_eq!(base.truths("T", "ok").unwrap(), [Some(true); 4]);
    assert_eq!(base.value("T", "1", "r"), None);
}

#[test]
fn a_part_behind_a_deciding_condition_does_not_run() {
    let text = r#"fn f(x) { throw "no" } rule "r" each t in T then {
        t.r = t.x > 100 && f(t.x) || t.x <= 100;
        t.s2 = if t.x > 100 { f(t.x) } else { 3 };
    }"#;
    let (base, _) = concluded(text, [class(&ROWS)]);
    assert_eq!(base.truths("T", "r").unwrap(), [Some(true); 4]);
    assert_eq!(base.numbers("T", "s2").unwrap(), [Some(3.0); 4]);
}

/// Found by the property tests: a whole power was multiplied out by one and not by the other.
#[test]
fn powers_agree_to_the_last_bit() {
    let rule = r#"fn f(x) { sqrt(abs(x)) ** 2 } rule "r" each t in T then { t.c = sqrt(abs(t.x)) ** 2; t.i = f(t.x); }"#;
    let (base, _) = concluded(rule, [class(&ROWS)]);
    assert_eq!(base.numbers("T", "c"), base.numbers("T", "i"));
}

/// Found by the property tests: rhai takes numbers that differ in the last bit for equal.
#[test]
fn equality_is_exact_in_both() {
    let rule = r#"fn same(x) { x + 0.1 + 0.2 == x + 0.3 } rule "r" each t in T then {
        t.c = t.x + 0.1 + 0.2 == t.x + 0.3; t.i = same(t.x); }"#;
    let (base, _) = concluded(rule, [class(&ROWS)]);
    assert_eq!(base.truths("T", "c").unwrap()[0], Some(false));
    assert_eq!(base.truths("T", "c"), base.truths("T", "i"));
}

/// Found by the property tests: an "and" within an "or" was taken apart, as if it were within an "and".
#[test]
fn an_and_within_an_or_stays_together() {
    let rule = r#"rule "r" each t in T then { t.r = t.b || (t.b && t.x < 100); }"#;
    let (base, _) = concluded(rule, [class(&ROWS)]);
    assert_eq!(base.truths("T", "r"), base.truths("T", "b"));
}

/// Statements whose effect is on a variable were looked through for mistakes, and dropped.
#[test]
fn what_changes_a_variable_is_not_dropped() {
    let cases = [
        (r#"let v = ""; v.pad(5, "y"); t.r = v.len();"#, 5.0),
        (r#"let v = "abc"; pad(v, 5, "y"); t.r = v.len();"#, 5.0),
        (r#"let v = "abc"; let last = v.pop(); t.r = v.len();"#, 2.0),
        (r#"let v = "abc"; let last = pop(v); t.r = v.len();"#, 2.0),
        (r#"let v = "abc"; if v.pop() == "c" { t.r = v.len(); }"#, 2.0),
        (r#"let v = "abc"; v += "d"; v += 5; t.r = v.len();"#, 5.0),
        (r#"t.q = "abc"; t.q.truncate(1); t.r = t.q.len();"#, 1.0),
        (r#"let v = "abc"; switch t.b { true => v.clear(), _ => v.clear() } t.r = v.len();"#, 0.0),
        ("let v = [1]; v.push(2); t.r = v.len();", 2.0),
        ("let v = [1, 2]; v[0] = 7; t.r = v[0];", 7.0),
        ("let v = [1, 2]; v += [3]; t.r = v.len();", 3.0),
        ("let v = [1, 2]; v = [3]; t.r = v.len();", 1.0),
        ("let v = #{ a: 1 }; v.a += 2; t.r = v.a;", 3.0),
        ("let v = 1; let w = if t.b { v += 1; v } else { 0 }; t.r = v + w;", 4.0),
        ("let v = 1; t.r = switch t.b { true => { v += 1; v }, _ => 0 } + v;", 4.0),
        ("let v = 1; [1, 2].for_each(|i| v += i); t.r = v;", 2.0),
        ("let v = [3, 1]; let f = |a| a + v.len(); t.r = f.call(1);", 3.0),
        ("let f = |a| a + 2; t.r = f.call(1);", 3.0),
        ("let v = 1; { let v = 2; v += 1; } t.r = v;", 1.0),
        ("let v = 1; let v = v + 1; { v += 1; } t.r = v;", 3.0),
        ("let v = 1; while v < 5 { v += 1; } t.r = v;", 5.0),
        ("let v = 1; let w = loop { v += 1; if v > 3 { break v; } }; t.r = v + w;", 8.0),
    ];
    for (action, wanted) in cases {
        // The loop leaves the whole action to the interpreter.
        for before in ["", "for i in 0..1 { } "] {
            let text = format!("rule \"r\" each t in T then {{ {before}{action} }}");
            let mut base = KnowledgeBase::new();
            base.assert(class(&ROWS[..1])).unwrap();
            let problems = base.conclude(&rules(&text)).diagnostics;
            assert_eq!(base.value("T", "1", "r"), Some(wanted.into()), "{problems:?} {text}");
        }
    }
}

#[test]
fn a_variable_is_itself_after_another_of_its_block_is_declared_twice() {
    for body in [
        "let s = t.s; { let v = 2.5; let v = v + 1; let u = s.len(); t.n = u + v; }",
        "let s = t.s; let v = 2.5; let v = v + 1; let u = s.len(); t.n = u + v;",
        "let v = 2.5; let s = t.s; let v = v + 1; if v > 3 { let w = v; let u = s.len(); t.n = u + w; }",
        "let v = 2.5; let v = v + 1; let s = t.s; { let s = s + s; let v = 1; let v = s.len(); t.n = v; }",
    ] {
        let (base, _) = concluded(&format!("rule \"c\" each t in T then {{ {body} }}"), [class(&ROWS)]);
        let (reference, _) = concluded(
            &format!("rule \"i\" each t in T then {{ for i in 0..1 {{ }} {body} }}"),
            [class(&ROWS)],
        );
        assert_eq!(base.numbers("T", "n"), reference.numbers("T", "n"), "{body}");
        assert!(base.numbers("T", "n").unwrap().iter().any(Option::is_some), "{body}");
    }
}
