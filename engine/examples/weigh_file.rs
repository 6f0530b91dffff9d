//! Times the shipped rules, as lines of tab-separated words to set beside the peers'; `tests/peers/rules.sh` does so.
//!
//! `weigh_file full DOORS.csv RUNS | edits DOORS.csv ROUNDS | memory DOORS.csv | layers DOORS RUNS`
#![allow(clippy::print_stdout, reason = "its output is the measurement")]

#[path = "../benches/support/doors.rs"]
mod doors;
#[path = "../benches/support/edits.rs"]
mod edits;
#[path = "../benches/support/layers.rs"]
mod layers;

use std::time::Instant;

use adit_engine::{Changes, KnowledgeBase, RuleBase};
use doors::{Door, Facts, TABLE_6, compiled, concluded, expected, states, told};
use edits::{Case, Edit, cases};

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match *arguments.as_slice() {
        ["full", file, runs] => full(&read(file), number(runs)),
        ["edits", file, rounds] => edit(&read(file), number(rounds)),
        ["memory", file] => memory(read(file)),
        ["layers", count, runs] => by_state(number(count), number(runs)),
        _ => panic!("usage: weigh_file full|edits DOORS.csv TIMES | memory DOORS.csv | layers DOORS TIMES"),
    }
}

fn number(text: &str) -> usize {
    text.parse().expect("a number")
}

/// Doors as `gen_doors.py` writes them: a line of names, then a number and the properties of a door on each line.
fn read(path: &str) -> Vec<Door> {
    let text = std::fs::read_to_string(path).expect("a file of doors");
    let door = |line: &str| {
        let values = line.split(',').skip(1).map(|value| value.parse().expect("a number"));
        values.collect::<Vec<f64>>().try_into().expect("seven numbers")
    };
    text.lines().skip(1).map(door).collect()
}

/// The names of the last state. By its own, the shipped rule gives the doors that it decides its hardness and no
/// distance; the peers' rule does not know of that, so for them it has another name.
const LAST: [(&str, &str); 2] = [("shipped", "IMPOSSIBLE"), ("as-peers", "NOTHING")];

/// Full weighting of a fresh base.
fn full(doors: &[Door], runs: usize) {
    let rules = compiled(TABLE_6);
    for (what, last) in LAST {
        let facts = Facts { doors: doors.to_vec(), states: states(last) };
        let mut times = vec![];
        for run in 0..runs {
            let mut base = told(&facts);
            times.push(timed(|| base.conclude(&rules)).1);
            if run == 0 {
                assert!(concluded(&base) == expected(&facts), "the rule says what compiled Rust says");
                println!("sum\t{what}\t{}", sum(&base));
            }
        }
        print_times("full", what, times, doors.len());
    }
}

/// Every kind of edit, there and back: the time of telling and updating.
fn edit(doors: &[Door], rounds: usize) {
    let rules = compiled(TABLE_6);
    for (what, last) in LAST {
        for case in cases(doors) {
            let mut facts = Facts { doors: doors.to_vec(), states: states(last) };
            rounds_of(&case, what, &mut facts, &rules, rounds);
        }
    }
    // The peers edit one after the other.
    let mut facts = Facts { doors: doors.to_vec(), states: states("NOTHING") };
    let mut base = weighed(&facts, &rules);
    for Case { name, there, .. } in cases(doors).iter().take(2) {
        tell(there, &mut base, &mut facts, &rules);
        println!("sum\t{name}\t{}", sum(&base));
    }
}

fn rounds_of(case: &Case, what: &str, facts: &mut Facts, rules: &RuleBase, rounds: usize) {
    let mut base = weighed(facts, rules);
    let (mut there, mut back, mut rows) = (vec![], vec![], 0);
    for round in 0..rounds {
        for (edit, times) in [(&case.there, &mut there), (&case.back, &mut back)] {
            let before = (round == 0).then(|| concluded(&base));
            let (changes, time) = tell(edit, &mut base, facts, rules);
            times.push(time);
            if let Some(before) = before {
                rows = check(&base, facts, rules, &before, &changes);
            }
        }
    }
    print_times("there", &format!("{what}\t{}", case.name), there, rows);
    print_times("back", &format!("{what}\t{}", case.name), back, rows);
}

fn weighed(facts: &Facts, rules: &RuleBase) -> KnowledgeBase {
    let mut base = told(facts);
    base.conclude(rules);
    base.update(rules);
    base
}

fn tell(edit: &Edit, base: &mut KnowledgeBase, facts: &mut Facts, rules: &RuleBase) -> (Changes, f64) {
    timed(|| {
        edit.tell(base, facts);
        base.update(rules)
    })
}

/// Panics unless the base says the same, to the bit, as one that weighs all anew and as compiled Rust, and reports
/// the rows that changed. How many did.
fn check(
    base: &KnowledgeBase,
    facts: &Facts,
    rules: &RuleBase,
    before: &[doors::Weighed],
    changes: &Changes,
) -> usize {
    let now = concluded(base);
    let mut anew = told(facts);
    anew.conclude(rules);
    assert!(now == concluded(&anew), "an edit gives what weighing anew gives");
    assert!(now == expected(facts), "an edit gives what compiled Rust gives");
    let changed = before.iter().zip(&now).zip(0..).filter(|((before, now), _)| before.0 != now.0);
    let changed: Vec<u32> = changed.map(|(_, row)| row).collect();
    assert_eq!(changes.rows("DOORS", "hardness"), changed, "the rows that changed are told");
    changed.len()
}

/// The peak of the whole process after weighing and each edit, which holds the facts of the file besides.
fn memory(doors: Vec<Door>) {
    let rules = compiled(TABLE_6);
    let cases = cases(&doors);
    let mut facts = Facts { doors, states: states("IMPOSSIBLE") };
    println!("memory\tfacts in the process\t{:.1}", peak_mib());
    let mut base = told(&facts);
    println!("memory\ttold\t{:.1}", peak_mib());
    base.conclude(&rules);
    println!("memory\tweighed\t{:.1}", peak_mib());
    base.update(&rules);
    for case in cases {
        tell(&case.there, &mut base, &mut facts, &rules);
        tell(&case.back, &mut base, &mut facts, &rules);
    }
    println!("memory\tedited\t{:.1}", peak_mib());
}

/// The rules of rooms cut for each state.
fn by_state(count: usize, runs: usize) {
    let (rules, layers) = (layers::compiled(), layers::made(count));
    let mut times = vec![];
    for run in 0..runs {
        let mut base = layers::told(&layers);
        times.push(timed(|| base.conclude(&rules)).1);
        if run == 0 {
            layers::check(&layers, &base);
        }
    }
    print_times("full", "by-state", times, count);
}

fn sum(base: &KnowledgeBase) -> f64 {
    base.numbers("DOORS", "hardness").expect("the rule sets it").into_iter().flatten().sum()
}

/// What an action gives, and its time in ms.
fn timed<T>(action: impl FnOnce() -> T) -> (T, f64) {
    let begin = Instant::now();
    let given = action();
    (given, begin.elapsed().as_secs_f64() * 1e3)
}

/// One line: the first time, the best and the median, in ms, and how many rows changed.
fn print_times(kind: &str, what: &str, mut times: Vec<f64>, rows: usize) {
    let first = times[0];
    times.sort_by(f64::total_cmp);
    println!("{kind}\t{what}\t{first:.6}\t{:.6}\t{:.6}\t{rows}", times[0], times[times.len() / 2]);
}

/// The greatest resident size so far, as Linux tells it.
fn peak_mib() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").expect("Linux");
    let line = status.lines().find(|line| line.starts_with("VmHWM:")).expect("a peak");
    line.split_whitespace().nth(1).and_then(|kib| kib.parse::<f64>().ok()).expect("KiB") / 1024.0
}
