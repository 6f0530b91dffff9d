//! Quantifiers over several objects.

use adit_engine::Class;

use crate::support::{concluded, number, text, things};

fn areas() -> Class {
    Class::new("AREAS", &["area"])
        .texts("area", ["near", "far"].map(Some))
        .numbers("from", [0.0, 5.0].map(Some))
        .numbers("to", [6.0, 20.0].map(Some))
}

#[test]
fn some_takes_the_first_row_that_passes_and_none_needs_that_there_is_none() {
    let rule = r#"
        rule "in" each t in THINGS some a in AREAS where a.from <= t.size && t.size < a.to then { t.area = a.area; }
        rule "out" each t in THINGS none a in AREAS where a.from <= t.size && t.size < a.to then { t.area = "nowhere"; }
    "#;
    let (base, _) = concluded(rule, [areas(), things("size", &[Some(5.5), Some(6.5), Some(30.0)])]);
    assert_eq!(
        base.texts("THINGS", "area").unwrap().into_iter().flatten().collect::<Vec<_>>().join(" "),
        "near far nowhere"
    );
}

#[test]
fn most_is_the_greatest() {
    let rule = r#"rule "r" each t in THINGS most a in AREAS by a.to where a.from < t.size then { t.area = a.area; }"#;
    let (base, _) = concluded(rule, [areas(), things("size", &[Some(1.0), Some(9.0)])]);
    assert_eq!(text(&base, "THINGS", "1", "area").as_deref(), Some("near"));
    assert_eq!(text(&base, "THINGS", "2", "area").as_deref(), Some("far"));
}

#[test]
fn least_may_compare_what_depends_on_other_objects() {
    let rule =
        r#"rule "nearest" each t in THINGS least a in AREAS by abs(a.to - t.size) then { t.area = a.area; }"#;
    let (base, _) = concluded(rule, [areas(), things("size", &[Some(1.0), Some(14.0), Some(13.0)])]);
    let areas: Vec<_> = base.texts("THINGS", "area").unwrap().into_iter().flatten().collect();
    assert_eq!(areas.join(" "), "near far near", "13 is as near to 6 as to 20: the first row");
}

#[test]
fn each_twice_binds_every_pair_and_may_set_either() {
    let rule = r#"
        rule "r" each t in THINGS each a in AREAS where a.from == t.size then { a.count = 1.0; t.met = a.area + "!"; }"#;
    let (base, _) = concluded(rule, [areas(), things("size", &[Some(5.0), Some(7.0)])]);
    assert_eq!(number(&base, "AREAS", "far", "count"), Some(1.0));
    assert_eq!(number(&base, "AREAS", "near", "count"), None);
    assert_eq!(text(&base, "THINGS", "1", "met").as_deref(), Some("far!"));
}

/// Whatever way a clause is searched (by index, by candidate, by binding), it finds the same.
#[test]
fn ways_of_searching_agree() {
    let size = 3000;
    let many = |name: &str| {
        Class::new(name, &["n"])
            .numbers("n", (0..size).map(|n| Some(f64::from(n))))
            .numbers("group", (0..size).map(|n| Some(f64::from(n * 7 % 40))))
            .numbers("cost", (0..size).map(|n| Some(f64::from(n * 31 % 97))))
    };
    let find = |condition: &str| {
        let rule = format!(
            r#"rule "r" each a in A where a.n < 60 least b in B by b.cost + 0 * a.n where {condition} then {{ a.found = b.n; }}
               rule "s" each a in A where a.n < 60 least b in B by b.cost where {condition} then {{ a.also = b.n; }}"#
        );
        let (base, _) = concluded(&rule, [many("A"), many("B")]);
        assert_eq!(base.numbers("A", "found"), base.numbers("A", "also"));
        base.numbers("A", "found").unwrap()
    };
    let indexed = find("b.group == a.group");
    assert_eq!(indexed, find("b.group >= a.group && b.group <= a.group"));
    assert_eq!(indexed.iter().flatten().count(), 60);
    let few = |rule: &str| concluded(rule, [many("A"), many("B")]).0.numbers("A", "found");
    let by_candidate = few(
        r#"rule "r" each a in A some b in B where b.n < 50 && b.group <= a.group then { a.found = b.n; }"#,
    );
    let by_binding = few(
        r#"rule "r" each a in A some b in B where b.n < 50 + 0 * a.n && b.group <= a.group then { a.found = b.n; }"#,
    );
    assert_eq!(by_candidate, by_binding);
}

#[test]
fn unknown_joins_nothing() {
    let rule =
        r#"rule "r" each t in THINGS some u in OTHERS where u.size == t.size then { t.found = true; }"#;
    let others = Class::new("OTHERS", &[]).numbers("size", [None, Some(-0.0)]);
    let (base, _) = concluded(rule, [things("size", &[None, Some(0.0)]), others]);
    assert_eq!(base.truths("THINGS", "found").unwrap(), [None, Some(true)]);
}
