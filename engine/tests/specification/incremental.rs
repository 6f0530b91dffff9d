//! After any edits of facts, tables and rules, everything is as if it had been concluded from scratch, to the bit.

use std::collections::BTreeMap;

use adit_engine::{Class, Conclusions, KnowledgeBase, RuleBase, Schema, SourceFile, Value};
use proptest::prelude::*;

/// Rules to choose from. T and U have a key, numbers x and y, a text s and a truth b, any of which may be unknown.
pub const RULES: [&str; 39] = [
    "rule \"own\" each t in T where t.x > 0 then { t.twice = t.x * 2; t.name = t.s + \"!\"; }",
    "rule \"least\" each t in T least u in U by x where u.y < t.x then { t.least = u.x + t.y; t.who = u.s; }",
    "rule \"least of two\" each t in T least u in U by x where u.y < t.x && u.x <= t.y then { t.two = u.y; } else { t.two = -1; }",
    "rule \"most\" each t in T most u in U by u.x + u.y where u.b then { t.most = u.s; }",
    "rule \"near\" each t in T least u in U by abs(u.x - t.x) then { t.near = u.u; }",
    "rule \"some\" each t in T some u in U where u.s == t.s && u.x > 1 then { t.some = u.x; } else { t.some = 0; }",
    "rule \"joined\" each t in T some u in U where u.s == t.s some v in U where v.x == u.y then { t.joined = v.x + u.x; }",
    "rule \"none\" each t in T none u in U where u.x == t.x && u.y > 0 then { t.alone = true; } else { t.alone = false; }",
    "rule \"none at all\" each t in T none u in U where u.x > t.x then { t.top = true; }",
    "rule \"pairs\" each t in T each u in U where u.s == t.s then { u.reached = true; }",
    "rule \"disagree\" each t in T each u in U where u.y < t.y then { t.said = u.x; }",
    "rule \"set another\" each t in T some u in U where u.s == t.s then { u.seen = t.b; }",
    "rule \"chain\" each t in T where t.twice > 2 least u in U by y where u.x < t.twice then { t.chain = u.y + t.twice; }",
    "rule \"later\" each u in U some t in T where t.who == u.s && t.chain > 1 then { u.late = t.chain; } else { u.late = 0; }",
    "rule \"choice\" each t in T then { if t.x > t.y { t.choice = \"x\"; } else if t.b { t.choice = \"y\"; t.c2 = t.y; } }",
    "rule \"first\" each t in T where t.b then { t.both = 1; }",
    "rule \"second\" each t in T where t.x > 1 then { t.both = if t.y > 2 { 2 } else { 1 }; }",
    "rule \"told or not\" each t in T where t.y > 0 then { t.z = t.y; }",
    "revise \"up\" each t in T some u in U where u.s == t.s set t.z by * u.x",
    "revise \"more\" each t in T each u in U where u.y == t.y set t.z by + u.x + 0.1 level 2",
    "rule \"reads z\" each t in T where t.z > 1 then { t.zz = t.z * 3; }",
    "rule \"counted\" each t in T count n of u in U where u.s == t.s && u.y > 0 then { t.count = n; }",
    "rule \"summed\" each t in T sum load of u in U by y where u.x > t.x least v in U by x where v.y < load then { t.load = load + v.x; }",
    "rule \"all of them\" each t in T all u in U where u.s == t.s have u.b then { t.all = true; } else { t.all = false; }",
    "rule \"proved\" each t in T some u in U where u.s == t.s && u.x > t.x hypothesis t.good",
    "rule \"proved too\" each t in T where t.b each u in U where u.y > t.y hypothesis t.good then { t.extra = t.x; }",
    "rule \"good\" each t in T where t.good then { t.better = t.x + 1; }",
    "rule \"exception\" priority 3 each t in T some u in U where u.s == t.s && u.b then { t.both = 7; t.z = u.x; }",
    "rule \"counts z\" each u in U count n of t in T where t.zz > u.x then { u.n = n; }",
    "class BIG of T where x > 0.5\nrule \"of a class\" each t in BIG least u in U by y where u.x < t.y then { t.big = u.y; }",
    "property T.z from table, rule, default y * 2",
    "property U.seen from rule, table, default true\nrule \"seen by\" each t in T some u in U where u.s == t.s then { t.saw = u.seen; }",
    "property T.s names U.s\nrule \"through a link\" each t in T where t.x > 0 then { t.link = t.s.x; t.known = known(t.s.late); }",
    "property T.y names U.x\nrule \"where a link leads\" each t in T where t.y.b || t.y.y > 1 then { t.there = t.x; }",
    "property U.s names T.s\nrule \"where two links lead\" each t in T each u in U where u.s.b && u.x > t.x then { t.two_links = true; }",
    "property T.x names U.x\nproperty U.y names T.y\nrule \"where a link leads on\" each t in T where t.x.y.b then { t.chained = true; }",
    "class SMALL of U where y < 1\nclass TINY of SMALL where x < 0.5\nproperty TINY.size from default x\nproperty SMALL.size from rule, default 7\nrule \"size\" each u in TINY where u.b then { u.size = 3; }",
    "rule \"sizes\" each t in T sum n of u in U by size where u.s == t.s then { t.sizes = n; }",
    "fn f(a, b) { if a > b { a } else { b + 1 } }\nrule \"script\" each t in T some u in U where u.s == t.s then { t.f = f(t.x, u.x); }",
];

pub type Row = (Option<i32>, Option<i32>, Option<usize>, Option<bool>);

#[derive(Clone, Debug)]
enum Edit {
    Tell {
        class: bool,
        row: usize,
        property: usize,
        value: Row,
    },
    Add {
        class: bool,
        value: Row,
    },
    Remove {
        class: bool,
        row: usize,
    },
    Assert {
        class: bool,
        rows: Vec<(u8, Row)>,
    },
    /// Nothing is told of z any more, which is as if there were none.
    RetractZ {
        class: bool,
    },
    Rule(usize),
    Ask,
}

pub fn row() -> impl Strategy<Value = Row> {
    let number = || prop::option::weighted(0.9, -2..5_i32);
    (number(), number(), prop::option::weighted(0.9, 0..3_usize), prop::option::weighted(0.9, any::<bool>()))
}

fn edit() -> impl Strategy<Value = Edit> {
    let rows = prop::collection::btree_map(0..9_u8, row(), 0..7)
        .prop_map(|rows| rows.into_iter().collect::<Vec<_>>());
    prop_oneof![
        6 => (any::<bool>(), 0..7_usize, 0..5_usize, row())
            .prop_map(|(class, row, property, value)| Edit::Tell { class, row, property, value }),
        2 => (any::<bool>(), row()).prop_map(|(class, value)| Edit::Add { class, value }),
        2 => (any::<bool>(), 0..7_usize).prop_map(|(class, row)| Edit::Remove { class, row }),
        1 => (any::<bool>(), rows.prop_shuffle()).prop_map(|(class, rows)| Edit::Assert { class, rows }),
        1 => any::<bool>().prop_map(|class| Edit::RetractZ { class }),
        1 => (0..RULES.len()).prop_map(Edit::Rule),
        2 => Just(Edit::Ask),
    ]
}

const TEXTS: [&str; 3] = ["a", "b", "c"];
pub const PROPERTIES: [&str; 5] = ["x", "y", "s", "b", "z"];

/// What is told, kept beside the knowledge base.
#[derive(Clone, Debug, Default)]
struct Facts {
    tables: [Vec<(f64, Vec<Option<Value>>)>; 2],
    /// Whether they have no z.
    lack_z: [bool; 2],
    next: f64,
}

pub fn cells(row: &Row) -> Vec<Option<Value>> {
    let number = |n: i32| Value::from(f64::from(n) / 2.0);
    vec![row.0.map(number), row.1.map(number), row.2.map(|s| TEXTS[s].into()), row.3.map(Into::into), None]
}

pub fn class_name(class: bool) -> &'static str {
    if class { "T" } else { "U" }
}

impl Facts {
    /// Rows of `T` and of `U`, numbered.
    fn of((one, other): &(Vec<Row>, Vec<Row>)) -> Self {
        let numbered = |rows: &[Row]| (0_u32..).map(f64::from).zip(rows.iter().map(cells)).collect();
        Self { tables: [numbered(other), numbered(one)], ..Self::default() }
    }

    /// A knowledge base to which all of them are told.
    fn told(&self) -> KnowledgeBase {
        let mut base = KnowledgeBase::new();
        base.assert(self.class(true)).unwrap();
        base.assert(self.class(false)).unwrap();
        base
    }

    fn class(&self, class: bool) -> Class {
        let rows = &self.tables[usize::from(class)];
        let number = |value: &Option<Value>| match value {
            Some(Value::Number(number)) => Some(*number),
            _ => None,
        };
        let text = |value: &Option<Value>| match value {
            Some(Value::Text(text)) => Some(text.to_string()),
            _ => None,
        };
        let truth = |value: &Option<Value>| match value {
            Some(Value::Truth(truth)) => Some(*truth),
            _ => None,
        };
        let (name, key) = if class { ("T", "t") } else { ("U", "u") };
        let told = Class::new(name, &[key])
            .numbers(key, rows.iter().map(|row| Some(row.0)))
            .numbers("x", rows.iter().map(|row| number(&row.1[0])))
            .numbers("y", rows.iter().map(|row| number(&row.1[1])))
            .texts("s", rows.iter().map(|row| text(&row.1[2])))
            .truths("b", rows.iter().map(|row| truth(&row.1[3])));
        if self.lack_z[usize::from(class)] {
            return told;
        }
        told.numbers("z", rows.iter().map(|row| number(&row.1[4])))
    }

    fn apply(&mut self, edit: &Edit, base: &mut KnowledgeBase) {
        match edit {
            Edit::Tell { class, row, property, value } => {
                let name = class_name(*class);
                let Some(row) = self.tables[usize::from(*class)].get_mut(*row) else { return };
                // A told z stands before what rules conclude of it.
                let value = cells(value)[if *property == 4 { 0 } else { *property }].clone();
                base.tell(name, &row.0.to_string(), PROPERTIES[*property], value.clone()).unwrap();
                self.lack_z[usize::from(*class)] &= *property != 4 || value.is_none();
                row.1[*property] = value;
            }
            Edit::Add { class, value } => {
                self.next += 1.0;
                let key = 100.0 + self.next;
                let cells = cells(value);
                let mut object = vec![(if *class { "t" } else { "u" }, Value::from(key))];
                for (property, value) in PROPERTIES.into_iter().zip(&cells) {
                    object.extend(value.clone().map(|value| (property, value)));
                }
                base.add(class_name(*class), &object).unwrap();
                self.tables[usize::from(*class)].push((key, cells));
            }
            Edit::Remove { class, row } => {
                let rows = &mut self.tables[usize::from(*class)];
                if *row < rows.len() {
                    let (key, _) = rows.remove(*row);
                    base.remove(class_name(*class), &key.to_string()).unwrap();
                }
            }
            Edit::Assert { class, rows } => {
                self.tables[usize::from(*class)] =
                    rows.iter().map(|(key, row)| (f64::from(*key), cells(row))).collect();
                base.assert(self.class(*class)).unwrap();
            }
            Edit::RetractZ { class } => {
                base.retract_property(class_name(*class), "z").unwrap();
                self.lack_z[usize::from(*class)] = true;
                self.tables[usize::from(*class)].iter_mut().for_each(|(_, cells)| cells[4] = None);
            }
            Edit::Rule(_) | Edit::Ask => {}
        }
    }
}

pub fn compiled(chosen: &[bool]) -> RuleBase {
    // Functions stand in files of their own rules.
    let files: Vec<SourceFile> = (0..RULES.len())
        .filter(|&nth| chosen[nth])
        .map(|nth| SourceFile::new(format!("{nth}.rhai"), RULES[nth]))
        .collect();
    RuleBase::compile(&files).unwrap()
}

/// All that can be seen: values, reports, reasons.
pub fn seen(base: &KnowledgeBase, rules: &RuleBase, report: &Conclusions) -> Vec<String> {
    let mut out = vec![];
    for class in ["T", "U"] {
        let concluded = rules.concluded();
        let properties =
            concluded.iter().filter(|name| name.class == class).map(|name| name.property.as_str());
        for property in properties.chain(PROPERTIES) {
            for row in 0..base.len(class).unwrap_or(0) {
                let key = base.key(class, row).unwrap();
                let value = base.value(class, &key, property).map(|value| match value {
                    Value::Number(number) => format!("{:016x}", number.to_bits()),
                    other => other.to_string(),
                });
                out.push(format!("{class} {key} {property} {value:?}"));
                out.extend(base.why(rules, class, &key, property).map(|why| why.to_string()));
            }
        }
    }
    out.extend(report.waiting.iter().map(|waiting| format!("{waiting:?}")));
    out.extend(report.conflicts.iter().map(|conflict| format!("{conflict:?}")));
    out.extend(report.gaps.iter().map(|gap| format!("{gap:?}")));
    out.extend(report.left_out.iter().map(|left_out| format!("{left_out:?}")));
    out.extend(report.diagnostics.iter().map(ToString::to_string));
    out
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn edited_step_by_step_is_as_concluded_from_scratch(
        first in (prop::collection::vec(row(), 0..6), prop::collection::vec(row(), 0..6)),
        chosen in prop::collection::vec(any::<bool>(), RULES.len()),
        edits in prop::collection::vec(edit(), 1..24),
    ) {
        let mut chosen = chosen;
        let mut facts = Facts::of(&first);
        let mut base = facts.told();
        let mut rules = compiled(&chosen);
        base.conclude(&rules);
        for edit in edits.iter().chain([&Edit::Ask]) {
            facts.apply(edit, &mut base);
            match edit {
                Edit::Rule(number) => {
                    chosen[*number] = !chosen[*number];
                    rules = compiled(&chosen);
                }
                Edit::Ask => {
                    let report = base.conclude(&rules);
                    let mut scratch = facts.told();
                    let anew = scratch.conclude(&rules);
                    prop_assert_eq!(seen(&base, &rules, &report), seen(&scratch, &rules, &anew));
                }
                _ => {}
            }
        }
    }
}

/// What a host that keeps values with their reasons sees of the objects: by class, key and property.
fn kept(base: &KnowledgeBase, rules: &RuleBase) -> BTreeMap<(String, String, String), String> {
    let mut kept = BTreeMap::new();
    for name in rules.concluded() {
        let (class, property) = (&name.class, &name.property);
        let rows: Vec<u32> = (0..base.len(class).unwrap_or(0) as u32).collect();
        let (grounds, places) = base.grounds(class, property, &rows);
        let revised = base.revised(rules, class, property);
        for (&row, place) in rows.iter().zip(places) {
            let key = base.key(class, row as usize).unwrap();
            let value = base.value_at(class, row as usize, property);
            let rule = place.map(|place| rules.rules()[grounds[place].rule].name());
            let by: Vec<&str> = revised
                .iter()
                .flat_map(|(rule, rows)| rows.iter().filter(|&&of| of == row).map(|_| rule.name()))
                .collect();
            kept.insert((class.clone(), key, property.clone()), format!("{value:?} {rule:?} {by:?}"));
        }
    }
    kept
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn changes_name_every_object_that_stayed_and_whose_value_or_reason_is_another(
        first in (prop::collection::vec(row(), 0..6), prop::collection::vec(row(), 0..6)),
        chosen in prop::collection::vec(any::<bool>(), RULES.len()),
        edits in prop::collection::vec(edit(), 1..24),
    ) {
        let mut facts = Facts::of(&first);
        let mut base = facts.told();
        let rules = compiled(&chosen);
        base.update(&rules);
        for edit in edits {
            let before = kept(&base, &rules);
            facts.apply(&edit, &mut base);
            let changes = base.update(&rules);
            for (of, now) in kept(&base, &rules) {
                let (class, key, property) = &of;
                let row = base.row(class, key).unwrap() as u32;
                let named = [changes.rows(class, property), changes.reasons(class, property)];
                let is_new = changes.classes.get(class).is_some_and(|class| class.added.contains(&row));
                let is_named = is_new || named.iter().any(|rows| rows.contains(&row));
                prop_assert!(before.get(&of) == Some(&now) || is_named, "{of:?}: {:?}, now {now}", before.get(&of));
            }
        }
    }
}

/// The rules of the property test mean something: each of them can be used as it stands.
#[test]
fn every_rule_of_the_pool_is_right() {
    let mut schema = Schema::default();
    for class in ["T", "U"] {
        let facts = Facts::default();
        let mut base = KnowledgeBase::new();
        base.assert(facts.class(class == "T")).unwrap();
        for property in ["t", "u", "x", "y", "s", "b", "z"] {
            if let Some(kind) = base.schema().kind(class, property) {
                schema.add(class, property, kind);
            }
        }
    }
    let problems = compiled(&[true; RULES.len()]).check(&schema);
    assert!(problems.is_empty(), "{problems:?}");
}
