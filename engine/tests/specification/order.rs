//! Which rules run, in which order, and which cannot.

use adit_engine::{Code, RuleBase, SourceFile};

use crate::support::{concluded, number, rules, things};

fn wrong(text: &str) -> Vec<(Code, String)> {
    let outcome = RuleBase::compile(&[SourceFile::new("test.rhai", text)]);
    outcome.unwrap_err().0.into_iter().map(|problem| (problem.code, problem.message)).collect()
}

#[test]
fn a_chain_of_rules_runs_from_facts_to_conclusions() {
    let rule = r#"
        rule "c" each t in THINGS then { t.c = t.b + 1; }
        rule "b" each t in THINGS then { t.b = t.a + 1; }
        rule "a" each t in THINGS then { t.a = t.size + 1; }"#;
    let (base, report) = concluded(rule, [things("size", &[Some(1.0)])]);
    assert_eq!(number(&base, "THINGS", "1", "c"), Some(4.0));
    assert_eq!(report.evaluated, ["a", "b", "c"]);
}

#[test]
fn rules_that_need_each_other_are_refused_with_the_cycle_named() {
    let wrong = wrong(
        r#"rule "b" each t in THINGS then { t.b = t.a; }
           rule "a" each t in THINGS least u in THINGS by u.b then { t.a = u.b; }
           rule "apart" each t in THINGS then { t.c = t.a; }"#,
    );
    assert_eq!(wrong.len(), 1);
    assert_eq!(wrong[0].0, Code::Cycle);
    assert_eq!(
        wrong[0].1,
        "these rules wait for each other: THINGS.b -> rule \"a\" -> THINGS.a -> rule \"b\" -> THINGS.b"
    );
}

#[test]
fn a_later_line_may_read_what_an_earlier_one_has_set() {
    let rule = r#"rule "r" each t in THINGS then { t.a = t.size * 2; t.b = t.a + 1; let c = t.b; c += 1; t.d = c; }"#;
    let (base, _) = concluded(rule, [things("size", &[Some(1.0)])]);
    assert_eq!(number(&base, "THINGS", "1", "b"), Some(3.0));
    assert_eq!(number(&base, "THINGS", "1", "d"), Some(4.0));
}

#[test]
fn within_a_rule_the_last_assignment_counts_and_only_those_reached() {
    let rule = r#"
        rule "r" each t in THINGS then {
            t.a = 1;
            let big = t.size > 5;
            if big { t.a = 2; t.b = 3; } else if t.size > 3 { t.b = if t.size > 4 { 5 } else { 4 }; }
        }"#;
    let (base, _) = concluded(rule, [things("size", &[Some(1.0), Some(4.0), Some(4.5), Some(9.0)])]);
    assert_eq!(base.numbers("THINGS", "a").unwrap(), [Some(1.0), Some(1.0), Some(1.0), Some(2.0)]);
    assert_eq!(base.numbers("THINGS", "b").unwrap(), [None, Some(4.0), Some(5.0), Some(3.0)]);
}

#[test]
fn equal_names_are_refused_across_files() {
    let file = |name| SourceFile::new(name, r#"rule "r" each t in THINGS then { t.a = 1; }"#);
    let wrong = RuleBase::compile(&[file("one.rhai"), file("two.rhai")]).unwrap_err();
    assert_eq!(wrong.0[0].code, Code::DuplicateName);
    assert_eq!(wrong.0[0].file, "two.rhai");
    assert_eq!(wrong.0[0].help.as_deref(), Some("the first is in one.rhai, line 1"));
}

#[test]
fn every_file_is_reported() {
    let files = [
        SourceFile::new("one.rhai", "rule \"a\" each t THINGS then { }"),
        SourceFile::new("two.rhai", r#"rule "b" each t in THINGS then { t.x = tt.y; t.z = nothing(1); }"#),
    ];
    let wrong = RuleBase::compile(&files).unwrap_err();
    let found: Vec<_> = wrong.0.iter().map(|problem| (problem.file.as_str(), problem.code)).collect();
    assert_eq!(
        found,
        [
            ("one.rhai", Code::Syntax),
            ("two.rhai", Code::UnknownVariable),
            ("two.rhai", Code::UnknownFunction)
        ]
    );
}

#[test]
fn rules_and_revisions_follow_each_other_without_semicolons() {
    let base = rules(
        r#"revise "a" each t in THINGS set t.x by * 2 level 3
           revise "b" each t in THINGS set t.x by + 2
           rule "c" each t in THINGS then { t.x = 1; }
           fn twice(x) { 2 * x }
           revise "d" each t in THINGS set t.x by max twice(t.size) level 12"#,
    );
    let names: Vec<_> = base.rules().iter().map(|rule| (rule.name(), rule.level())).collect();
    assert_eq!(names, [("a", Some(3)), ("b", Some(0)), ("c", None), ("d", Some(12))]);
}
