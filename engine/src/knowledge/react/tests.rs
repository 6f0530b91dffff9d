//! The matches that are kept are those that a search from scratch finds.

use std::fmt::Write as _;

use proptest::prelude::*;

use super::*;
use crate::class::Class;
use crate::script::source::SourceFile;
use crate::value::Value;

/// Clauses of every kind; `f` is a function of the file, so it stays with the interpreter.
const CLAUSES: [&str; 17] = [
    "each a in A where a.x > 1 each b in B where b.k == a.k && b.y != a.y",
    "each a in A none b in B where b.k == a.k && b.x > a.x",
    "each a in A least b in B by x where b.k == a.k each c in A where c.x == b.x",
    "each a in A most b in B by x + a.x where b.y != a.y",
    "some a in A where a.x == 2 each b in B where b.y == a.y none c in A where c.k == b.k && c.x > b.x",
    "each a in A count n of b in B where b.k == a.k each c in B where c.x == n",
    "each a in A sum n of b in B by x where b.y == a.y least c in A by x where c.x > n",
    "each a in A all b in B where b.k == a.k have b.x > a.x",
    "each a in A each b in B where b.k == a.k && f(a.x, b.x)",
    "each a in A where a.z > 2 none b in A where b.z == a.z && b.id != a.id",
    "each a in A each b in B where a.x == 1 || b.x == 1 || a.k == b.k",
    "each a in A each b in A where b.x == a.k + 1 && a.y == \"p\" some c in B where c.y == a.y && c.x == b.x",
    "each a in A where known(a.y) && a.y + \"p\" != \"pp\" count n of b in A where b.k == a.k && n_less(b.x, a.x)",
    "each a in A none b in B where b.y == a.y none c in B where c.k == a.x most d in B by x each e in A where e.k == d.k",
    "each a in A least b in A by k where b.x != a.x all c in B where c.y == a.y have c.k != b.k",
    "each a in A count n of b in B where b.k == a.k && b.x == a.x each c in A where c.x == n none d in B where d.k == c.k && d.x == n",
    "each a in A each b in B where b.k == a.k sum n of c in A by x where c.y == b.y && c.k == a.x none d in B where d.x == n",
];

const FILE: &str = "fn f(a, b) { a <= b } fn n_less(a, b) { a < b }
    rule \"z\" each a in A least b in B by x where b.k == a.k then { a.z = b.x + 1; }\n";

fn rules(word: &str) -> RuleBase {
    let mut text = FILE.to_owned();
    for (nth, clauses) in CLAUSES.iter().enumerate() {
        let body = if word == "on" { String::new() } else { format!("a.hit{nth} = true;") };
        writeln!(text, "{word} \"{nth}\" {clauses} then {{ {body} }}").unwrap();
    }
    RuleBase::compile(&[SourceFile::new("test.rhai", text)]).unwrap_or_else(|wrong| panic!("{wrong}"))
}

#[derive(Clone, Debug)]
enum Change {
    Tell { class: bool, row: usize, property: usize, value: Option<u8> },
    Add { class: bool, values: [Option<u8>; 3] },
    Remove { class: bool, row: usize },
    React,
}

fn change() -> impl Strategy<Value = Change> {
    let value = || prop::option::weighted(0.9, 0..4_u8);
    prop_oneof![
        6 => (any::<bool>(), 0..8_usize, 0..3_usize, value())
            .prop_map(|(class, row, property, value)| Change::Tell { class, row, property, value }),
        2 => (any::<bool>(), [value(), value(), value()])
            .prop_map(|(class, values)| Change::Add { class, values }),
        2 => (any::<bool>(), 0..8_usize).prop_map(|(class, row)| Change::Remove { class, row }),
        1 => Just(Change::React),
    ]
}

const PROPERTIES: [&str; 3] = ["k", "x", "y"];

fn value_of(property: usize, value: u8) -> Value {
    if PROPERTIES[property] == "y" {
        ["p", "q", "pp", "r"][value as usize].into()
    } else {
        f64::from(value).into()
    }
}

fn class_of(class: bool) -> &'static str {
    if class { "A" } else { "B" }
}

struct Site {
    base: KnowledgeBase,
    next: u32,
}

impl Site {
    fn new() -> Self {
        let mut site = Self { base: KnowledgeBase::new(), next: 0 };
        for class in ["A", "B"] {
            let class = Class::new(class, &["id"])
                .numbers("id", [])
                .numbers("k", [])
                .numbers("x", [])
                .texts::<&str>("y", []);
            site.base.assert(class).unwrap();
        }
        for nth in 0..6_u8 {
            site.add(nth % 2 == 0, [Some(nth % 3), Some(nth % 4), Some(nth % 2)]);
        }
        site
    }

    fn add(&mut self, class: bool, values: [Option<u8>; 3]) {
        let mut object = vec![("id", Value::from(f64::from(self.next)))];
        for (property, value) in values.into_iter().enumerate() {
            object.extend(value.map(|value| (PROPERTIES[property], value_of(property, value))));
        }
        self.next += 1;
        self.base.add(class_of(class), &object).unwrap();
    }

    fn change(&mut self, change: &Change, rules: &RuleBase) {
        let rows = |base: &KnowledgeBase, class: bool| base.len(class_of(class)).unwrap();
        match *change {
            Change::Tell { class, row, property, value } => {
                let rows = rows(&self.base, class);
                if rows > 0 {
                    let value = value.map(|value| value_of(property, value));
                    self.base.tell_row(class_of(class), row % rows, PROPERTIES[property], value).unwrap();
                }
            }
            Change::Add { class, values } => self.add(class, values),
            Change::Remove { class, row } => {
                let rows = rows(&self.base, class);
                if rows > 0 {
                    self.base.remove_row(class_of(class), row % rows).unwrap();
                }
            }
            Change::React => {
                let run = self.base.react(rules);
                assert!(run.diagnostics.is_empty(), "{:?}", run.diagnostics);
            }
        }
    }

    /// Another knowledge base that was told the same.
    fn told(&self) -> KnowledgeBase {
        let mut base = KnowledgeBase::new();
        for class in ["A", "B"] {
            let mut copy = Class::new(class, &["id"]);
            for property in ["id", "k", "x"] {
                copy = copy.numbers(property, self.base.numbers(class, property).unwrap());
            }
            let texts = self.base.texts(class, "y").unwrap();
            base.assert(copy.texts("y", texts.iter().map(|text| text.as_deref()))).unwrap();
        }
        base
    }

    /// The matches of each rule that are kept, by rows; what was carried out too.
    fn kept(&mut self, rules: &RuleBase) -> Vec<Vec<Vec<Option<usize>>>> {
        self.base.agenda(rules);
        let number = |nth: usize| rules.rules.iter().position(|rule| rule.name == nth.to_string()).unwrap();
        let by_rows = |nth: usize| {
            let all = self.base.agenda.all(number(nth));
            all.iter().map(|binding| self.base.rows(number(nth), binding)).collect()
        };
        (0..CLAUSES.len()).map(by_rows).collect()
    }
}

/// What the search of an inference binds, sorted by rows.
fn concluded(base: &mut KnowledgeBase, rules: &RuleBase) -> Vec<Vec<Vec<Option<usize>>>> {
    base.conclude(rules);
    let bound = |nth: usize| {
        let number = rules.rules.iter().position(|rule| rule.name == nth.to_string()).unwrap();
        let memory = base.network.nodes[number].memory.as_ref().unwrap();
        let clauses = memory.witnesses.len();
        let row = |clause, firing| Some(memory.witness(clause, firing)).filter(|&row| row != NO_ROW);
        let binding = |firing| (0..clauses).map(|clause| Some(row(clause, firing)? as usize)).collect();
        let fired = (0..memory.firings()).filter(|&firing| memory.claim(0, firing).is_some());
        let mut all: Vec<Vec<Option<usize>>> = fired.map(binding).collect();
        all.sort();
        all
    };
    (0..CLAUSES.len()).map(bound).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, ..ProptestConfig::default() })]

    #[test]
    fn kept_matches_are_those_from_scratch(
        steps in prop::collection::vec(prop::collection::vec(change(), 1..4), 1..10),
    ) {
        let (on, rule) = (rules("on"), rules("rule"));
        let mut site = Site::new();
        site.kept(&on);
        for step in &steps {
            for change in step {
                site.change(change, &on);
            }
            let kept = site.kept(&on);
            let following = std::mem::take(&mut site.base.agenda);
            prop_assert_eq!(&kept, &site.kept(&on), "from scratch, after {:?}", step);
            site.base.agenda = following;
            prop_assert_eq!(&kept, &concluded(&mut site.told(), &rule), "as rules, after {:?}", step);
        }
    }
}
