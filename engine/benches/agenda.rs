//! `cargo bench -p adit-engine --bench agenda`: Miss Manners and Waltz's labelling, as the examples have them.
//!
//! The classical sizes; the inputs are our own, so the numbers of firings differ a little from those of others.

#[path = "../examples/manners/party.rs"]
mod party;
#[path = "../examples/waltz/scene.rs"]
mod scene;

use adit_engine::Limits;
use divan::Bencher;

fn main() {
    divan::main();
}

fn limits() -> Limits {
    Limits { firings: 1_000_000, ..Limits::default() }
}

#[divan::bench(args = [16, 32, 64, 128], max_time = 10)]
fn manners(bencher: Bencher, count: usize) {
    let guests = party::guests(count, 1);
    let rules = party::rules().expect("the rules are right");
    let make = || party::table(&guests, limits()).expect("the guests are right");
    // Not a faster wrong answer.
    let mut checked = make();
    checked.react(&rules);
    let order = party::seating(&checked).expect("everybody found a seat");
    party::checked(&guests, &order).expect("neighbours can talk");
    bencher.with_inputs(make).bench_local_values(|mut base| {
        base.react(&rules);
        base
    });
}

#[divan::bench(args = [12, 25, 37, 50], max_time = 10)]
fn waltz(bencher: Bencher, regions: usize) {
    let lines = scene::scene(5);
    let rules = scene::rules().expect("the rules are right");
    let make = || scene::picture(&lines, regions, limits()).expect("the lines are right");
    let mut checked = make();
    checked.react(&rules);
    assert_eq!(scene::labels(&checked).len(), 2 * regions * lines.len(), "every edge has a label");
    bencher.with_inputs(make).bench_local_values(|mut base| {
        base.react(&rules);
        base
    });
}
