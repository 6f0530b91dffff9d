//! Floor plans of 25 rooms: `cargo bench -p adit-planners --bench floor_plan`. `plant` has rooms and doors, `furnished`
//! has pillars and free-standing walls in each room as well.

#[path = "../tests/specification/floor_plan/dice.rs"]
mod dice;
#[path = "../tests/specification/floor_plan/random_plan.rs"]
mod random_plan;

use std::path::Path;

use adit_planners::floor_plan::{Disc, FloorPlan, Network, Regions, Rule, read_floor_plan};
use adit_planners::geometry::{Point, RayGrid, Segment};
use divan::Bencher;

const DISC: Disc = Disc { radius: 0.25, margin: 0.0 };

fn main() {
    divan::main();
}

fn plan(name: &str) -> FloorPlan {
    if name == "furnished" {
        return random_plan::random_plan(24, 25);
    }
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden/floorplans/plant-25.json");
    read_floor_plan(&path).expect("the plan is a good one")
}

#[divan::bench(args = ["plant", "furnished"])]
fn regions(bencher: Bencher, name: &str) {
    let plan = plan(name);
    bencher.bench_local(|| Regions::of(&plan));
}

#[divan::bench(args = ["plant", "furnished"])]
fn network_with_its_regions(bencher: Bencher, name: &str) {
    let plan = plan(name);
    bencher.bench_local(|| Network::new(&plan, DISC));
}

#[divan::bench(args = ["plant", "furnished"])]
fn tight_path_between_the_first_and_the_last_place(bencher: Bencher, name: &str) {
    let plan = plan(name);
    let network = Network::new(&plan, DISC).expect("the disc fits");
    let (from, to) = (plan.places()[0].at, plan.places()[plan.places().len() - 1].at);
    bencher.bench_local(|| network.path(from, to, Rule::Tight, |way| Some(way.length)));
}

#[divan::bench(args = ["plant", "furnished"])]
fn scan_of_120_rays(bencher: Bencher, name: &str) {
    let plan = plan(name);
    let grid = RayGrid::new(plan.barriers().into_iter().map(Segment::from).collect());
    let from = plan.places()[0].at;
    bencher.bench_local(|| {
        let ray = |i: u32| {
            Point::new((f64::from(i) * 3.0).to_radians().cos(), (f64::from(i) * 3.0).to_radians().sin())
        };
        (0..120).filter_map(|i| grid.cast(from, ray(i), 8.0)).map(|echo| echo.distance).sum::<f64>()
    });
}
