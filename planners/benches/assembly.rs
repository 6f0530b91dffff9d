//! Lee's section 4: `cargo bench -p adit-planners --bench assembly`. The decision is that of Table 1 at each junction,
//! without a rule engine, so that what is measured is the way, its sweep check included.

#[path = "../tests/specification/assembly/table1.rs"]
mod table1;

use adit_planners::channels::assembly::{Assembly, Cuboid, channels_of};
use divan::{Bencher, black_box};

use table1::{table_for_any_dimension, table1};

fn main() {
    divan::main();
}

const PART: Cuboid<2> = Cuboid::new([4.5, 1.01], [6.99, 4.0]);

fn channels() -> Vec<Cuboid<2>> {
    vec![
        Cuboid::new([1.0, 2.0], [5.0, 7.0]),
        Cuboid::new([1.0, 2.0], [7.0, 6.0]),
        Cuboid::new([4.0, 1.0], [7.0, 6.0]),
    ]
}

#[divan::bench(args = [0.01, 0.2])]
fn section_4(bencher: Bencher, gap: f64) {
    let assembly = Assembly::new(channels(), PART).expect("section 4 is a chain");
    bencher.bench_local(|| black_box(&assembly).disassemble(None, |facts| table1(facts, [gap; 2])));
}

#[divan::bench]
fn section_4_checked_and_walled(bencher: Bencher) {
    bencher.with_inputs(channels).bench_local_values(|channels| Assembly::new(channels, PART));
}

#[divan::bench]
fn channels_of_section_4(bencher: Bencher) {
    let female = [
        [0.0, 0.0],
        [0.0, 7.0],
        [1.0, 7.0],
        [1.0, 2.0],
        [4.0, 2.0],
        [4.0, 1.0],
        [7.0, 1.0],
        [7.0, 6.0],
        [5.0, 6.0],
        [5.0, 7.0],
        [8.0, 7.0],
        [8.0, 0.0],
    ];
    bencher.bench_local(|| channels_of(black_box(&female), &PART));
}

#[divan::bench]
fn two_elbows_in_space(bencher: Bencher) {
    let channels = vec![
        Cuboid::new([0.0, 0.0, 0.0], [3.0, 3.0, 9.0]),
        Cuboid::new([0.0, 0.0, 0.0], [10.0, 3.0, 3.0]),
        Cuboid::new([7.0, 0.0, 0.0], [10.0, 12.0, 3.0]),
    ];
    let assembly = Assembly::new(channels, Cuboid::new([7.5, 8.0, 0.5], [9.5, 10.0, 2.5])).expect("a chain");
    bencher.bench_local(|| {
        black_box(&assembly).disassemble(None, |facts| table_for_any_dimension(facts, [0.25; 3]))
    });
}
