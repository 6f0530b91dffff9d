//! Rule bases over each other.

use std::collections::BTreeMap;

use adit_engine::{Instead, KnowledgeBase, RuleBase, SourceFile};
use proptest::prelude::*;

use crate::support::{number, rules, things};

fn over(texts: &[&str]) -> RuleBase {
    let named = |(place, text): (usize, &&str)| vec![SourceFile::new(format!("base {place}.rhai"), *text)];
    let files: Vec<Vec<SourceFile>> = texts.iter().enumerate().map(named).collect();
    let files: Vec<&[SourceFile]> = files.iter().map(Vec::as_slice).collect();
    RuleBase::compile_over(&files).unwrap_or_else(|wrong| panic!("{wrong}"))
}

fn value(base: &RuleBase, property: &str) -> Option<f64> {
    let mut knowledge = KnowledgeBase::new();
    knowledge.assert(things("width", &[Some(2.0)])).unwrap();
    knowledge.conclude(base);
    number(&knowledge, "THINGS", "1", property)
}

#[test]
fn a_rule_replaces_the_one_of_its_name_beneath_and_both_are_told() {
    let base = over(&[
        "rule \"a\" each t in THINGS then { t.x = 1.0; }\nrule \"b\" each t in THINGS then { t.y = 1.0; }",
        "\nrule \"a\" each t in THINGS then { t.x = 2.0; }",
    ]);
    assert_eq!((value(&base, "x"), value(&base, "y")), (Some(2.0), Some(1.0)));
    let [replaced] = base.replaced() else { panic!("{:?}", base.replaced()) };
    assert_eq!((replaced.beneath.file.as_str(), replaced.beneath.line), ("base 0.rhai", 1));
    let Instead::Rule(by) = &replaced.by else { panic!("{replaced:?}") };
    assert_eq!((by.file.as_str(), by.line), ("base 1.rhai", 2));
    assert_ne!(by.version, replaced.beneath.version);
}

#[test]
fn a_base_may_go_without_a_rule() {
    let base = over(&["rule \"a\" each t in THINGS then { t.x = 1.0; }", "without \"a\""]);
    assert_eq!(value(&base, "x"), None);
    assert!(matches!(&base.replaced()[0].by, Instead::Without { line: 1, .. }));
}

#[test]
fn going_without_what_is_not_there_is_an_error_with_a_place() {
    let files = [SourceFile::new("beneath.rhai", "rule \"walks\" each t in THINGS then { t.x = 1.0; }")];
    let above = [SourceFile::new("above.rhai", "without \"walk\"")];
    let wrong = RuleBase::compile_over(&[&files, &above]).unwrap_err();
    assert_eq!(wrong.0.len(), 1);
    assert_eq!((wrong.0[0].code.as_str(), wrong.0[0].line, wrong.0[0].column), ("rule/unknown-rule", 1, 9));
    assert!(wrong.0[0].help.as_deref().is_some_and(|help| help.contains("walks")), "{wrong}");
}

#[test]
fn what_is_declared_above_counts() {
    let beneath = "property THINGS.x from table, default 1.0;\nclass WIDE of THINGS where width > 1.0;\n\
                   rule \"wide\" each t in WIDE then { t.wide = 1.0; }";
    let base = over(&[beneath]);
    assert_eq!((value(&base, "x"), value(&base, "wide")), (Some(1.0), Some(1.0)));
    let base = over(&[
        beneath,
        "property THINGS.x from table, default 7.0;\nclass WIDE of THINGS where width > 5.0;",
    ]);
    assert_eq!((value(&base, "x"), value(&base, "wide")), (Some(7.0), None));
}

#[test]
fn what_is_wrong_with_a_rule_that_does_not_count_is_nobodys_trouble() {
    let base = over(&[
        "rule \"a\" each t in THINGS then { t.x = unheard_of(t.width); }",
        "rule \"a\" each t in THINGS then { t.x = 2.0; }",
    ]);
    assert_eq!(value(&base, "x"), Some(2.0));
}

/// What a base says of a rule.
#[derive(Clone, Debug)]
enum Said {
    Rule(u8),
    Without,
}

fn base() -> impl Strategy<Value = BTreeMap<u8, Said>> {
    let said = prop_oneof![3 => (0_u8..50).prop_map(Said::Rule), 1 => Just(Said::Without)];
    prop::collection::btree_map(0_u8..6, said, 0..6)
}

proptest! {
    /// By definition a rule is the one of the uppermost base that says anything of it.
    #[test]
    fn bases_say_what_the_rules_say_that_are_left(all in prop::collection::vec(base(), 1..5)) {
        let text = |rule: u8, value: u8| format!("rule \"r{rule}\" each t in THINGS then {{ t.p{rule} = {value}.0; }}\n");
        let mut seen: BTreeMap<u8, u8> = BTreeMap::new();
        let mut texts = vec![];
        let mut ever = std::collections::BTreeSet::new();
        for one in &all {
            let mut own = String::new();
            let before = ever.clone();
            for (rule, said) in one {
                match said {
                    Said::Rule(value) => {
                        own.push_str(&text(*rule, *value));
                        seen.insert(*rule, *value);
                        ever.insert(*rule);
                    }
                    Said::Without if before.contains(rule) => {
                        own += "without \"r";
                        own += &rule.to_string();
                        own += "\"\n";
                        seen.remove(rule);
                    }
                    Said::Without => {}
                }
            }
            texts.push(own);
        }
        let texts: Vec<&str> = texts.iter().map(String::as_str).collect();
        let left: String = seen.iter().map(|(rule, value)| text(*rule, *value)).collect();
        let (laid, flat) = (over(&texts), rules(&left));
        let names = |base: &RuleBase| {
            let mut names: Vec<(String, String)> =
                base.rules().iter().map(|rule| (rule.name().to_owned(), rule.version().to_owned())).collect();
            names.sort();
            names
        };
        prop_assert_eq!(names(&laid), names(&flat));
        for rule in 0..6 {
            let property = format!("p{rule}");
            prop_assert_eq!(value(&laid, &property), value(&flat, &property));
        }
        let lost = texts.iter().map(|text| text.matches("rule \"").count()).sum::<usize>() - seen.len();
        prop_assert_eq!(laid.replaced().len(), lost);
    }
}
