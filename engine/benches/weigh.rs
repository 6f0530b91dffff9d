//! The shipped rules over many doors, beside the same in compiled Rust; edits of what they read; joins on equality.
//!
//! `cargo bench -p adit-engine`

#[path = "support/doors.rs"]
mod doors;
#[path = "support/edits.rs"]
mod edits;
#[path = "support/layers.rs"]
mod layers;

use adit_engine::{Class, KnowledgeBase};
use divan::{Bencher, black_box};
use doors::{Door, Facts, TABLE_6, compiled, concluded, expected, states, told, weigh};
use edits::{Case, cases};

fn main() {
    divan::main();
}

/// Doors drawn as in the published comparison of rule engines: multiples of 0.001, so that no memo over dimensions
/// helps; 1 % decided by the lowest state.
fn drawn(count: usize) -> Vec<Door> {
    let mut seed = 19_900_607_u64;
    let mut draw = move |from: u64, to: u64| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        from + (seed >> 33) % (to - from + 1)
    };
    let height = |draw: &mut dyn FnMut(u64, u64) -> u64| match draw(0, 9999) {
        0..65 => draw(5001, 10000) as f64 / 1000.0,
        65..265 => draw(1, 5000) as f64 / 1000.0,
        _ => draw(10001, 26000) as f64 / 1000.0,
    };
    let mut door = || {
        let mut door = [0.0; 7];
        for side in [0, 3] {
            door[side] = height(&mut draw);
            door[side + 1] = draw(1, 8000) as f64 / 1000.0;
            door[side + 2] = draw(1, 400) as f64 / 8.0;
        }
        door[6] = draw(1, 8000) as f64 / 1000.0;
        door
    };
    (0..count).map(|_| door()).collect()
}

fn facts(doors: usize) -> Facts {
    Facts { doors: drawn(doors), states: states("IMPOSSIBLE") }
}

#[divan::bench(args = [1_000, 10_000, 100_000, 1_000_000], max_time = 5)]
fn compiled_rust(bencher: Bencher, count: usize) {
    let Facts { doors, states } = facts(count);
    bencher.bench(|| black_box(&doors).iter().map(|door| weigh(&states, door)).collect::<Vec<_>>());
}

#[divan::bench(args = [1_000, 10_000, 100_000, 1_000_000], max_time = 5)]
fn table_6(bencher: Bencher, count: usize) {
    let (facts, rules) = (facts(count), compiled(TABLE_6));
    let mut checked = told(&facts);
    checked.conclude(&rules);
    assert!(concluded(&checked) == expected(&facts), "the rule says what the Rust says");
    bencher.with_inputs(|| told(&facts)).bench_local_values(|mut base| {
        base.conclude(&rules);
        base
    });
}

#[divan::bench(args = [1_000, 10_000, 100_000], max_time = 5)]
fn by_state(bencher: Bencher, count: usize) {
    let (layers, rules) = (layers::made(count), layers::compiled());
    let mut checked = layers::told(&layers);
    checked.conclude(&rules);
    layers::check(&layers, &checked);
    bencher.with_inputs(|| layers::told(&layers)).bench_local_values(|mut base| {
        base.conclude(&rules);
        base
    });
}

/// An edit and the one that takes it back, by turns, on 100,000 weighted doors.
#[divan::bench(args = cases(&drawn(1_000)).into_iter().map(|case| case.name), max_time = 2)]
fn edit_and_back(bencher: Bencher, name: &str) {
    let (mut facts, rules) = (facts(100_000), compiled(TABLE_6));
    let Case { there, back, .. } =
        cases(&facts.doors).into_iter().find(|case| case.name == name).expect("it is one of the cases");
    let mut base = told(&facts);
    base.conclude(&rules);
    base.update(&rules);
    bencher.bench_local(|| {
        for edit in [&there, &back] {
            edit.tell(&mut base, &mut facts);
            black_box(base.update(&rules));
        }
    });
}

/// 50,000 rooms, 200,000 doors, two joins on equality for each door.
#[divan::bench(max_time = 5)]
fn join_200_000_doors_with_50_000_rooms(bencher: Bencher) {
    let rules = compiled(
        r#"rule "sum" each door in DOORS
           some from in ROOMS where from.room == door.room1
           some to in ROOMS where to.room == door.room2
           then { door.hardness = from.hardness + to.hardness; }"#,
    );
    let (rooms, doors) = (50_000, 200_000);
    let make = || {
        let mut base = KnowledgeBase::new();
        let room = |n: usize| Some(format!("room {}", n % rooms));
        let hardness = (0..rooms).map(|n| Some(n as f64));
        let class = Class::new("ROOMS", &["room"]).texts("room", (0..rooms).map(room));
        base.assert(class.numbers("hardness", hardness)).expect("rooms are named");
        let class = Class::new("DOORS", &["door"])
            .numbers("door", (0..doors).map(|n| Some(n as f64)))
            .texts("room1", (0..doors).map(|n| room(n * 7)))
            .texts("room2", (0..doors).map(|n| room(n * 11 + 3)));
        base.assert(class).expect("doors are numbered");
        base
    };
    bencher.with_inputs(make).bench_local_values(|mut base| {
        base.conclude(&rules);
        base
    });
}
