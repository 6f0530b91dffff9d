//! Tuning from experience: what fits, how sure that is, and what cannot be said.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use adit::fit::{Estimate, Observation, estimate};
use adit_tests::TestSite;

/// Numbers that look like chance, the same every time (Knuth's linear congruential generator).
struct Chance(u64);

impl Chance {
    fn of(seed: u64) -> Self {
        let mut chance = Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
        (0..3).for_each(|_| {
            chance.next();
        });
        chance
    }

    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Box and Muller's.
    fn normal(&mut self) -> f64 {
        let (one, two) = (self.next().max(1e-300), self.next());
        (-2.0 * one.ln()).sqrt() * (TAU * two).cos()
    }
}

const TRUE: [(&str, f64); 4] = [("STAND", 1.0), ("SIDE", 2.0), ("SQUAT", 4.0), ("CREEP", 0.0)];

/// A hundred missions of some states each. What is measured scatters by 10 % of itself.
fn missions(seed: u64) -> Vec<Observation> {
    let mut chance = Chance::of(seed);
    let mission = |_| {
        let mut observation = Observation::measured(0.0);
        let mut expected = 0.0;
        for (state, hardness) in TRUE {
            if chance.next() < 0.55 {
                let metres = 1.0 + 20.0 * chance.next();
                expected += metres * hardness;
                observation.metres.insert(state.to_owned(), metres);
            }
        }
        observation.measured = (expected * (1.0 + 0.1 * chance.normal())).max(0.0);
        observation
    };
    (0..100).map(mission).collect()
}

fn half_width((low, high): (f64, f64)) -> f64 {
    (high - low) / 2.0
}

/// The share of intervals that hold the true number, and the median of their half-widths as a share of it.
fn judged(interval: impl Fn(&Estimate, &str) -> Option<(f64, f64)>, truths: &[(&str, f64)]) -> (f64, f64) {
    let (mut held, mut all, mut widths) = (0, 0, Vec::new());
    for seed in 0..1_000 {
        let found = estimate(&missions(seed));
        for &(state, truth) in truths {
            let (low, high) = interval(&found, state).unwrap();
            all += 1;
            held += usize::from(low <= truth && truth <= high);
            widths.push(half_width((low, high)) / truth);
        }
    }
    widths.sort_by(f64::total_cmp);
    (f64::from(held as u32) / f64::from(all), widths[widths.len() / 2])
}

#[test]
fn over_a_thousand_seeds_intervals_of_95_percent_hold_the_true_hardness_about_95_times_in_100() {
    let (held, width) = judged(|found, state| found.values[state].interval, &TRUE[..3]);
    println!("held {held}, median half-width {width}");
    assert!((0.93..=0.97).contains(&held), "{held}");
    assert!(width <= 0.1, "{width}");
}

#[test]
fn intervals_of_how_many_times_harder_a_state_is_than_the_reference_hold_as_often() {
    let ratio = |found: &Estimate, state: &str| found.ratio(&found.values[state], &found.values["STAND"]);
    let (held, width) = judged(ratio, &TRUE[1..3]);
    println!("held {held}, median half-width {width}");
    assert!((0.93..=0.97).contains(&held), "{held}");
    // the reference is not certain either
    assert!(width <= 0.15, "{width}");
}

#[test]
fn a_state_that_costs_nothing_is_never_estimated_below_it() {
    for seed in 0..200 {
        let found = estimate(&missions(seed));
        assert!(found.values["CREEP"].value.unwrap() >= 0.0);
        let (low, high) = found.values["CREEP"].interval.unwrap();
        assert!(low >= 0.0 && high < 0.5, "{low} {high}");
    }
}

#[test]
fn exact_measurements_give_the_exact_hardness() {
    let mission = |metres: [f64; 2]| Observation {
        metres: BTreeMap::from([("A".to_owned(), metres[0]), ("B".to_owned(), metres[1])]),
        measured: 1.5 * metres[0] + 6.0 * metres[1],
    };
    let found = estimate(&[mission([3.0, 1.0]), mission([10.0, 0.0]), mission([2.0, 8.0])]);
    assert!((found.values["A"].value.unwrap() - 1.5).abs() < 1e-12);
    assert!((found.values["B"].value.unwrap() - 6.0).abs() < 1e-12);
}

#[test]
fn states_that_are_always_driven_in_the_same_proportion_are_not_guessed() {
    let mission = |share: f64, other: f64| Observation {
        metres: BTreeMap::from([
            ("A".to_owned(), 4.0 * share),
            ("B".to_owned(), 1.0 * share),
            ("C".to_owned(), other),
        ]),
        measured: 10.0 * share + 2.0 * other,
    };
    let found = estimate(&[mission(1.0, 0.0), mission(2.0, 5.0), mission(3.0, 1.0), mission(1.0, 9.0)]);
    assert_eq!((found.values["A"].value, found.values["B"].value), (None, None));
    assert!((found.values["C"].value.unwrap() - 2.0).abs() < 1e-9);
    assert!(found.notes()[0].starts_with("A cannot be told apart from B"), "{:?}", found.notes());
}

const HEAD: &str = "mission,state,distance,measured\n";

#[test]
fn traversals_come_from_a_file_and_the_state_with_most_metres_keeps_its_hardness() {
    let site = TestSite::example("paper").built();
    let rows = "m1,STAND,10,20\n,STAND,20,40\n,SQUAT,5,35\nm2,STAND,8,30\nm2,SQUAT,2,30\n,SQUAT,3,21\n,STAND,30,60\n";
    site.write("run.csv", format!("{HEAD}{rows}"));
    let file = site.path().join("run.csv");
    let args = ["--add", file.to_str().unwrap(), "--measure", "seconds", "--json"];
    let fit = site.adit("fit", &args).expecting(0).json();
    assert_eq!(
        (&fit["observations"], &fit["reference"], &fit["measure"]),
        (&6.into(), &"STAND".into(), &"seconds".into())
    );
    let cell =
        |key: &str| fit["cells"].as_array().unwrap().iter().find(|cell| cell["key"] == key).unwrap().clone();
    let present: f64 = site.sqlite3("SELECT hardness FROM robots WHERE state = 'STAND'")[0].parse().unwrap();
    assert_eq!(cell("robot/STAND")["proposed"].as_f64(), Some(present));
    // 2 seconds a metre against 7
    assert!((cell("robot/SQUAT")["proposed"].as_f64().unwrap() - 3.5 * present).abs() < 0.01, "{fit:#}");
    let low = cell("robot/SQUAT")["low"].as_f64().unwrap();
    assert!(
        low <= 3.5 * present
            && fit["notes"]
                .as_array()
                .unwrap()
                .iter()
                .any(|note| note.as_str().unwrap().starts_with("never driven in"))
    );
    let raw = site.adit("fit", &["--per-metre", "--json"]).expecting(0).json();
    let stand =
        raw["cells"].as_array().unwrap().iter().find(|cell| cell["key"] == "robot/STAND").unwrap().clone();
    assert!((stand["proposed"].as_f64().unwrap() - 2.0).abs() < 0.01, "{raw:#}");
    assert!(site.adit("fit", &[]).expecting(0).stdout.contains("robots.robot/SQUAT.hardness"));
    site.adit("fit", &["--clear"]).expect_status(0);
    assert_eq!(site.sqlite3("SELECT count(*) FROM traversals"), ["0"]);
}

#[test]
fn a_state_in_which_no_room_is_cut_is_not_said_to_be_idle() {
    let site = TestSite::example("clinic").built();
    assert_eq!(site.sqlite3("SELECT count(*) FROM robots WHERE state = 'IMPOSSIBLE'"), ["1"]);
    let said = site.adit("fit", &[]).expecting(0).stdout;
    assert!(said.contains("never driven in: STAND, SIDE-STAND, SQUAT, LIE\n"), "{said}");
}

#[test]
fn one_bad_row_and_nothing_is_added() {
    let site = TestSite::example("paper").built();
    let file = site.path().join("run.csv");
    for (rows, complaint) in [
        (",STAND,10,20\n,STANT,1,2\n", "row 2: robot has no state `STANT`"),
        (",STAND,10,20\n,STAND,far,2\n", "row 2: distance is `far`"),
        (",STAND,10,20\n,STAND,-3,2\n", "row 2: distance is -3"),
        (",STAND,10,20\n,STAND,3,-2\n", "row 2: measured is -2"),
        ("m,STAND,10,20\nm,SQUAT,1,21\n", "row 2: mission `m` measured 21 here and 20 in another row"),
        (",STAND,10\n", "row 1: 3 values under 4 names"),
        (",,10,20\n", "row 1: it names no state and no action"),
        ("", "there is no row to add"),
    ] {
        site.write("run.csv", format!("{HEAD}{rows}"));
        let args = ["--add", file.to_str().unwrap(), "--measure", "seconds"];
        site.adit("fit", &args).expecting(2).complains(&[complaint]);
        assert_eq!(site.sqlite3("SELECT count(*) FROM traversals"), ["0"], "{rows}");
    }
    site.write("run.csv", "state,action,distance,measured\nSTAND,WALK,1,2\nSTAND,SIDE-WALK,1,2\n");
    let args = ["--add", file.to_str().unwrap(), "--measure", "seconds"];
    site.adit("fit", &args)
        .expecting(2)
        .complains(&["row 2: the action of STAND is `WALK`, and not `SIDE-WALK`"]);
    assert_eq!(site.sqlite3("SELECT count(*) FROM traversals"), ["0"]);
    site.write("run.csv", "state;distance;taken\nSTAND;1;2\n");
    site.adit("fit", &["--add", file.to_str().unwrap()]).expecting(2).complains(&["a column `taken`"]);
}
