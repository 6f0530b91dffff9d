//! What a careless author cannot do.

use std::time::{Duration, Instant};

use adit_engine::{Class, Code, KnowledgeBase, Limits, RuleBase, RuleTests, Schema, SourceFile};

use crate::support::{rules, things};

fn problems(text: &str) -> Vec<Code> {
    let limits =
        Limits { rule: Duration::from_millis(300), inference: Duration::from_secs(2), ..Limits::default() };
    let mut base = KnowledgeBase::with_limits(limits);
    base.assert(things("x", &[Some(1.0), Some(2.0)])).unwrap();
    let started = Instant::now();
    let report = base.conclude(&rules(text));
    assert!(started.elapsed() < Duration::from_secs(5), "{text}");
    report.diagnostics.iter().map(|problem| problem.code).collect()
}

/// A loop leaves the whole action to the interpreter, as it is written.
fn action(body: &str) -> String {
    format!(
        "fn again(x) {{ again(x) }} rule \"r\" each t in THINGS then {{ while false {{ }} {body} t.y = 1; }}"
    )
}

#[test]
fn endless_work_is_stopped() {
    for body in [
        "loop { }",
        "let n = 0; while true { n += 1; }",
        "let a = []; for i in 0..9999 { a.push(i); } a.map(|m| { let n = 0; for i in 0..1000 { n += i; } n });",
    ] {
        assert_eq!(problems(&action(body)), [Code::Deadline], "{body}");
    }
}

#[test]
fn what_grows_without_end_is_refused() {
    for body in [
        "let n = again(1);",
        "let s = \"x\"; loop { s += s; }",
        "let a = [1]; loop { a.push(1); }",
        "let s = \"\"; s.pad(100000000000, \"x\");",
    ] {
        // On a busy machine the time may be up before the size is.
        let found = problems(&action(body));
        assert!(matches!(found[..], [Code::Evaluation | Code::Deadline]), "{body}: {found:?}");
    }
}

/// Found in review: rhai measures what a native function gave. Two texts of 60,000 letters made 3.6 GB, nothing to pad with
/// never ended, and a length whose product with the item's overflows ended the process.
#[test]
fn what_would_grow_in_one_call_is_measured_before_it_grows() {
    let texts = "let s = \"\"; s.pad(60000, \"y\"); let u = \"\"; u.pad(60000, \"z\");";
    for body in [
        "s.replace(\"y\", u);",
        "s.replace('y', u);",
        "s.replace(\"\", u);",
        "let e = \"e\"; e.pad(10, \"\");",
        "let i = []; i.pad(63, 0); let a = []; a.pad(288230376151711744, i);",
        "let i = []; i.pad(9000, 0); let a = []; a.pad(9000, i);",
    ] {
        assert_eq!(problems(&action(&format!("{texts} {body}"))), [Code::Evaluation], "{body}");
    }
    let fits = "let e = \"e\"; e.pad(6, \"ab\"); e.replace(\"ab\", \"xyz\"); e.replace('a', \"..\");
                if e != \"exyzxyz..\" { throw e; } let a = [1]; a.pad(3, [2]); if a != [1, [2], [2]] { throw a; }";
    assert_eq!(problems(&action(fits)), []);
}

/// `f = f.curry(f)` doubles what `f` holds, and nothing measures a function's arguments. Closures do without it.
#[test]
fn functions_do_not_carry_arguments() {
    let doubles = action("let g = Fn(\"again\"); for i in 0..40 { g = g.curry(g); }");
    let wrong = RuleBase::compile(&[SourceFile::new("test.rhai", doubles)]).unwrap_err();
    assert_eq!(wrong.0[0].code, Code::Syntax);
    assert_eq!(problems(&action("let n = 2; if [1, 2].map(|m| m * n) != [2, 4] { throw 0; }")), []);
}

#[test]
fn all_tests_of_a_rule_base_have_one_deadline() {
    let rules = rules("rule \"endless\" each t in THINGS where t.x > 0 then { loop { } t.y = 1; }");
    let test = |number: usize| {
        format!("[[test]]\nname = \"{number}\"\ngiven.THINGS = [{{ x = 1.0 }}]\nconclude.THINGS.1.y = 1\n")
    };
    let text: String = (0..30).map(test).collect();
    let tests = RuleTests::read(&[SourceFile::new("test.toml", text)]).unwrap();
    let limits = Limits { inference: Duration::from_secs(1), ..Limits::default() };
    let started = Instant::now();
    let outcomes = tests.run_within(&rules, &Schema::default(), limits).unwrap();
    assert!(started.elapsed() < Duration::from_secs(5));
    assert!(outcomes.iter().all(|outcome| outcome.failures[0].diagnostic.message.contains("rule may")));
}

#[test]
fn sleeping_is_refused() {
    assert_eq!(problems(&action("sleep(2);")), [Code::Evaluation]);
    assert_eq!(problems(&action("sleep(2.5);")), [Code::Evaluation]);
}

#[test]
fn code_from_elsewhere_is_refused_when_the_file_is_read() {
    for body in ["eval(\"1\");", "import \"x\" as x;"] {
        let wrong = RuleBase::compile(&[SourceFile::new("test.rhai", action(body))]).unwrap_err();
        assert_eq!(wrong.0[0].code, Code::Syntax, "{body}");
    }
}

#[test]
fn a_million_million_matches_are_stopped() {
    let many = Class::new("MANY", &[]).numbers("n", (0..1_000_000).map(|n| Some(f64::from(n))));
    let limits =
        Limits { rule: Duration::from_millis(200), inference: Duration::from_secs(2), ..Limits::default() };
    let mut base = KnowledgeBase::with_limits(limits);
    base.assert(many).unwrap();
    let began = Instant::now();
    let report = base
        .conclude(&rules("rule \"r\" each a in MANY each b in MANY where a.n + b.n < 0 then { a.x = 1; }"));
    assert_eq!(report.diagnostics[0].code, Code::Deadline);
    assert!(report.diagnostics[0].message.starts_with("rule \"r\" was stopped"));
    // 40 s before, for 200 ms that it was given: a batch in which nothing passed was gone through to its end
    assert!(began.elapsed() < Duration::from_secs(6), "{:?}", began.elapsed());
}

#[test]
fn a_file_of_more_than_a_million_bytes_is_not_read() {
    let text = " ".repeat(adit_engine::MAX_FILE_BYTES + 1);
    let wrong = RuleBase::compile(&[SourceFile::new("big.rhai", text)]).unwrap_err();
    assert_eq!(wrong.0[0].code, Code::TooLarge);
    let text = " ".repeat(adit_engine::MAX_FILE_BYTES);
    assert!(RuleBase::compile(&[SourceFile::new("big.rhai", text)]).is_ok());
}

#[test]
fn what_nests_too_deep_is_refused_and_the_deepest_that_is_allowed_runs() {
    for (open, close) in [("(", ")"), ("[", "]"), ("!", ""), ("-", ""), ("{", "}"), ("1+(", ")")] {
        for depth in [1_000, 50_000] {
            let text = format!(
                "rule \"r\" each t in THINGS then {{ t.y = {}1{}; }}",
                open.repeat(depth),
                close.repeat(depth)
            );
            assert!(RuleBase::compile(&[SourceFile::new("deep.rhai", text)]).is_err(), "{open}");
        }
    }
    let long = format!("rule \"r\" each t in THINGS then {{ t.y = 1{}; }}", "+1".repeat(100_000));
    drop(RuleBase::compile(&[SourceFile::new("long.rhai", long)]));
    let depth = 20;
    let deep = format!("t.y = {}t.x{};", "abs(".repeat(depth), ")".repeat(depth));
    let deep = format!(
        "fn f(n) {{ if n == 0 {{ 0 }} else {{ f(n - 1) }} }} rule \"r\" each t in THINGS then {{ {deep} t.z = f(20); }}"
    );
    assert_eq!(problems(&deep), []);
}

/// Found in review: the objects that an edit did not concern kept their values in a rule that was stopped by it.
#[test]
fn a_rule_that_an_edit_makes_endless_leaves_nothing_and_comes_back_with_the_edit_undone() {
    let rules = rules(
        "fn stuck(x) { while x == 3.0 { } x } rule \"r\" each t in THINGS then { t.y = stuck(t.x); }
         rule \"s\" each t in THINGS where t.y > 0 then { t.z = t.y; }",
    );
    let limits = Limits { rule: Duration::from_millis(200), ..Limits::default() };
    let things = |second: f64| things("x", &[Some(1.0), Some(second), Some(4.0)]);
    let concluded = |base: &KnowledgeBase| ["y", "z"].map(|property| base.numbers("THINGS", property));
    let mut base = KnowledgeBase::with_limits(limits);
    base.assert(things(2.0)).unwrap();
    base.conclude(&rules);
    let before = concluded(&base);
    base.tell("THINGS", "2", "x", Some(3.0.into())).unwrap();
    assert_eq!(base.conclude(&rules).diagnostics[0].code, Code::Deadline);
    let unknown = Some(vec![None; 3]);
    assert_eq!(concluded(&base), [unknown.clone(), unknown]);
    base.tell("THINGS", "2", "x", Some(2.0.into())).unwrap();
    assert!(base.conclude(&rules).diagnostics.is_empty());
    assert_eq!(concluded(&base), before);
}
