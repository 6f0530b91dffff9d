//! The order in which facts are told does not matter for what is derived.
//!
//! Rows are in the order in which objects were added, and of objects that are equally good the first row is taken. So
//! objects are added in any order where no rule meets equals, and in the same order where rules do.

use adit_engine::{Class, KnowledgeBase, RuleBase, Value};
use proptest::prelude::*;

use crate::incremental::{PROPERTIES, RULES, Row, cells, class_name, compiled, row, seen};

/// How many objects each class has at first.
const OBJECTS: usize = 5;

#[derive(Clone, Debug)]
enum Fact {
    Value {
        class: bool,
        key: usize,
        property: usize,
        row: Row,
    },
    Object {
        class: bool,
        key: usize,
        row: Row,
    },
    /// No fact: what follows from those before is made right.
    Update,
}

/// Facts of which no two speak of the same value or object, in two orders.
fn facts() -> impl Strategy<Value = (Vec<Fact>, Vec<Fact>)> {
    let place = (any::<bool>(), 0..OBJECTS, 0..PROPERTIES.len());
    let values = prop::collection::btree_map(place, row(), 10..45);
    let objects = prop::collection::btree_map((any::<bool>(), OBJECTS..OBJECTS + 6), row(), 0..6);
    (values, objects, 0..4_usize).prop_flat_map(|(values, objects, updates)| {
        let values = values.into_iter();
        let values = values.map(|((class, key, property), row)| Fact::Value { class, key, property, row });
        let objects = objects.into_iter().map(|((class, key), row)| Fact::Object { class, key, row });
        let facts: Vec<Fact> = values.chain(objects).chain(vec![Fact::Update; updates]).collect();
        (Just(facts.clone()).prop_shuffle(), Just(facts).prop_shuffle())
    })
}

/// Whether rules may meet objects that are equally good.
#[derive(Clone, Copy, PartialEq)]
enum Equals {
    Met,
    /// Every object has an x that is its own, and a distance of its own to those of the other class.
    Avoided,
}

fn values(equals: Equals, class: bool, key: usize, row: &Row) -> Vec<Option<Value>> {
    let mut values = cells(row);
    if let (Equals::Avoided, Some(Value::Number(x))) = (equals, &mut values[0]) {
        *x += key as f64 / 1024.0 + if class { 1.0 / 4096.0 } else { 0.0 };
    }
    values
}

fn tell(base: &mut KnowledgeBase, rules: &RuleBase, equals: Equals, fact: &Fact) {
    match fact {
        Fact::Value { class, key, property, row } => {
            // A told z stands before what rules conclude of it.
            let value = values(equals, *class, *key, row)[if *property == 4 { 0 } else { *property }].clone();
            base.tell(class_name(*class), &key.to_string(), PROPERTIES[*property], value).unwrap();
        }
        Fact::Object { class, key, row } => {
            let mut object = vec![(if *class { "t" } else { "u" }, Value::from(*key as f64))];
            for (property, value) in PROPERTIES.into_iter().zip(values(equals, *class, *key, row)) {
                object.extend(value.map(|value| (property, value)));
            }
            base.add(class_name(*class), &object).unwrap();
        }
        Fact::Update => drop(base.update(rules)),
    }
}

fn told(rules: &RuleBase, equals: Equals, facts: &[Fact]) -> KnowledgeBase {
    let mut base = KnowledgeBase::new();
    for (class, key) in [("T", "t"), ("U", "u")] {
        let none = || [None; OBJECTS];
        base.assert(
            Class::new(class, &[key])
                .numbers(key, (0..OBJECTS).map(|key| Some(key as f64)))
                .numbers("x", none())
                .numbers("y", none())
                .texts("s", [None::<&str>; OBJECTS])
                .truths("b", [None; OBJECTS])
                .numbers("z", none()),
        )
        .unwrap();
    }
    for fact in facts {
        tell(&mut base, rules, equals, fact);
    }
    base
}

/// The same facts, with the objects in the order of their keys.
fn objects_in_order(facts: Vec<Fact>) -> Vec<Fact> {
    let key = |fact: &Fact| match fact {
        Fact::Object { key, .. } => *key,
        _ => 0,
    };
    let mut objects: Vec<Fact> =
        facts.iter().filter(|fact| matches!(fact, Fact::Object { .. })).cloned().collect();
    objects.sort_by_key(key);
    let mut objects = objects.into_iter();
    let take = |fact| if matches!(fact, Fact::Object { .. }) { objects.next() } else { Some(fact) };
    facts.into_iter().filter_map(take).collect()
}

/// Every value that can be seen, to the bit, in the order of keys.
fn by_key(base: &KnowledgeBase, rules: &RuleBase) -> Vec<String> {
    let mut out = vec![];
    for name in rules.concluded() {
        for row in 0..base.len(&name.class).unwrap() {
            let key = base.key(&name.class, row).unwrap();
            let value = base.value_at(&name.class, row, &name.property).map(|value| match value {
                Value::Number(number) => format!("{:016x}", number.to_bits()),
                other => other.to_string(),
            });
            out.push(format!("{name} of {key}: {value:?}"));
        }
    }
    out.sort();
    out
}

/// Which of the rules of the pool are taken; `some` and links take the first row of several.
fn chosen() -> impl Strategy<Value = Vec<bool>> {
    prop::collection::vec(prop::bool::weighted(0.7), RULES.len())
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 128, ..ProptestConfig::default() })]

    #[test]
    fn values_may_be_told_in_any_order((one, other) in facts(), chosen in chosen()) {
        let rules = compiled(&chosen);
        let [one, other] = [one, other].map(|facts| {
            let mut base = told(&rules, Equals::Met, &objects_in_order(facts));
            let report = base.conclude(&rules);
            seen(&base, &rules, &report)
        });
        prop_assert_eq!(one, other);
    }

    #[test]
    fn objects_may_be_added_in_any_order((one, other) in facts(), chosen in chosen()) {
        let first_row_counts = |rule: &str| rule.contains(" some ") || rule.contains(" names ");
        let chosen: Vec<bool> =
            chosen.iter().zip(RULES).map(|(chosen, rule)| *chosen && !first_row_counts(rule)).collect();
        let rules = compiled(&chosen);
        let [one, other] = [one, other].map(|facts| {
            let mut base = told(&rules, Equals::Avoided, &facts);
            base.conclude(&rules);
            by_key(&base, &rules)
        });
        prop_assert_eq!(one, other);
    }
}
