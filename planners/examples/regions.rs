//! Times the floor plan, the regions and the network of maps: `cargo run --release -p adit-planners --example regions -- MAP.yaml …`.
#![allow(clippy::print_stderr)]
use std::path::Path;
use std::time::Instant;

use adit_planners::floor_plan::{Disc, FloorPlan, Network, Regions};
use adit_planners::read::{MapSettings, read_map};

fn main() {
    for map in std::env::args().skip(1) {
        let (world, _) = read_map(Path::new(&map), &MapSettings::default()).expect("a map");
        let start = Instant::now();
        let plan = FloorPlan::of_world(&world, None).expect("a plan");
        let read = start.elapsed().as_secs_f64();
        let start = Instant::now();
        let regions = Regions::of(&plan);
        let cut = start.elapsed().as_secs_f64();
        let start = Instant::now();
        let network = Network::new(&plan, Disc { radius: 0.2, margin: 0.02 });
        let laid = start.elapsed().as_secs_f64();
        eprintln!(
            "{map}: {} barriers, plan {read:.2} s, {} regions {cut:.2} s, network {:.2} s of {} ways",
            plan.barriers().len(),
            regions.regions.len(),
            laid - cut,
            network.map_or(0, |network| network.ways.len())
        );
    }
}
