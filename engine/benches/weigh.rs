//! Table 6's rule over many doors, beside the same in compiled Rust; and joins on equality.
//!
//! `cargo bench -p adit-engine`

use adit_engine::{Class, KnowledgeBase, RuleBase, SourceFile};
use divan::{Bencher, black_box};

fn main() {
    divan::main();
}

const WEIGH: &str = r#"
rule "weigh a door"
    each  door    in DOORS
    least first   in ROBOTS by first.hardness where first.height < door.height1 && first.width < door.width1
    least second  in ROBOTS by second.hardness where second.height < door.height2 && second.width < door.width2
    least through in ROBOTS by through.hardness where through.height < door.height1 && through.height < door.height2 && through.width < door.width
    then {
        door.hardness = door.distance1 * first.hardness + door.distance2 * second.hardness + through.hardness;
        door.action   = through.action;
        door.passable = true;
    }
"#;

const STATES: [(f64, f64, f64); 5] =
    [(20.0, 3.0, 1.0), (20.0, 1.0, 2.0), (10.0, 5.0, 4.0), (5.0, 5.0, 8.0), (0.0, 0.0, 10000.0)];

/// Doors as `height1, width1, distance1, height2, width2, distance2, width`, drawn as in the published comparison
/// of rule engines: multiples of 0.001, so that no memo over dimensions helps; 1 % decided by the lowest state.
fn doors(count: usize) -> Vec<[f64; 7]> {
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
    (0..count)
        .map(|_| {
            let mut door = [0.0; 7];
            for side in [0, 3] {
                door[side] = height(&mut draw);
                door[side + 1] = draw(1, 8000) as f64 / 1000.0;
                door[side + 2] = draw(1, 400) as f64 / 8.0;
            }
            door[6] = draw(1, 8000) as f64 / 1000.0;
            door
        })
        .collect()
}

fn numbered(class: Class, key: &str, count: usize) -> Class {
    class.numbers(key, (0..count).map(|n| Some(n as f64)))
}

fn knowledge(doors: &[[f64; 7]]) -> KnowledgeBase {
    let names = ["height1", "width1", "distance1", "height2", "width2", "distance2", "width"];
    let mut class = numbered(Class::new("DOORS", &["door"]), "door", doors.len());
    for (nth, name) in names.into_iter().enumerate() {
        class = class.numbers(name, doors.iter().map(|door| Some(door[nth])));
    }
    let mut base = KnowledgeBase::new();
    base.assert(class).expect("the doors are numbered");
    base.assert(robots()).expect("the states are named");
    base
}

fn robots() -> Class {
    let actions = ["WALK", "SIDE-WALK", "WALK-ON-KNEE", "CREEP", "NO-ACTION"];
    Class::new("ROBOTS", &["action"])
        .texts("action", actions.map(Some))
        .numbers("height", STATES.map(|state| Some(state.0)))
        .numbers("width", STATES.map(|state| Some(state.1)))
        .numbers("hardness", STATES.map(|state| Some(state.2)))
}

fn rules(text: &str) -> RuleBase {
    RuleBase::compile(&[SourceFile::new("weigh.rhai", text)]).expect("the rule is right")
}

fn best(height: f64, width: f64) -> (f64, usize) {
    let mut best = (f64::INFINITY, 0);
    for (nth, state) in STATES.iter().enumerate() {
        if state.0 < height && state.1 < width && state.2 < best.0 {
            best = (state.2, nth);
        }
    }
    best
}

fn weigh(&[h1, w1, d1, h2, w2, d2, width]: &[f64; 7]) -> (f64, usize) {
    let (first, second, through) = (best(h1, w1), best(h2, w2), best(h1.min(h2), width));
    (d1 * first.0 + d2 * second.0 + through.0, through.1)
}

#[divan::bench(args = [1_000, 10_000, 100_000, 1_000_000], max_time = 5)]
fn compiled_rust(bencher: Bencher, count: usize) {
    let doors = doors(count);
    bencher.bench(|| black_box(&doors).iter().map(weigh).collect::<Vec<_>>());
}

#[divan::bench(args = [1_000, 10_000, 100_000, 1_000_000], max_time = 5)]
fn rule(bencher: Bencher, count: usize) {
    let doors = doors(count);
    let rules = rules(WEIGH);
    let mut checked = knowledge(&doors);
    checked.conclude(&rules);
    // Not a faster wrong answer.
    let concluded = checked.numbers("DOORS", "hardness").expect("the rule sets it");
    let right =
        doors.iter().map(|door| weigh(door).0).map(|hardness| Some(hardness).filter(|h| h.is_finite()));
    assert!(concluded.into_iter().eq(right), "the rule says what the Rust says");
    bencher.with_inputs(|| knowledge(&doors)).bench_local_values(|mut base| {
        base.conclude(&rules);
        base
    });
}

/// 50,000 rooms, 200,000 doors, two joins on equality for each door.
#[divan::bench(max_time = 5)]
fn join_200_000_doors_with_50_000_rooms(bencher: Bencher) {
    let rules = rules(
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
        let class = numbered(Class::new("DOORS", &["door"]), "door", doors)
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
