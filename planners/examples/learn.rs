//! Learns floor plans that the robot does not know, and says how well:
//! `cargo run --release -p adit-planners --example learn -- SEEDS PLAN.json...`, with missions on what was learned; `film PLAN.json SEED` writes one as SVG.
//! With `PICTURE` in the environment each result is drawn over the truth.
#![allow(clippy::print_stdout, clippy::print_stderr)] // an example shows what it found

#[path = "../tests/specification/navigation/table.rs"]
mod table;

use std::path::Path;
use std::time::Instant;

use adit_planners::floor_plan::{Disc, FloorPlan, Network, Rule, read_floor_plan};
use adit_planners::geometry::Point;
use adit_planners::navigation::learn::{Exploration, Learned, score};
use adit_planners::navigation::{Building, Drivable, Ending, Outfit, ROOM_M, draw};
use adit_planners::pose::Pose;

/// Missions that are run with the given and with the learned model.
const MISSIONS: u64 = 20;

/// How sure a robot is of where it begins in a building that it has learned, metres.
const START_SIGMA_M: f64 = 0.05;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match &arguments[..] {
        [film, plan, seed] if film == "film" => {
            let plan = load(plan);
            let mut made = None;
            one(&plan, seed.parse().unwrap_or(1), Some(&mut made));
            let file = format!("learn-{}-{seed}.svg", plan.name);
            if let Some(film) = made {
                std::fs::write(&file, film.svg(20.0)).unwrap_or_else(|error| eprintln!("{file}: {error}"));
            }
        }
        [seeds, plans @ ..] => {
            for plan in plans {
                let plan = load(plan);
                for seed in 1..=seeds.parse().unwrap_or(1) {
                    one(&plan, seed, None);
                }
            }
        }
        [] => eprintln!("usage: learn SEEDS PLAN.json... | learn film PLAN.json SEED"),
    }
}

fn load(path: &str) -> FloorPlan {
    read_floor_plan(Path::new(path)).unwrap_or_else(|errors| panic!("{errors}"))
}

fn one(plan: &FloorPlan, seed: u64, film: Option<&mut Option<adit_planners::simulator::Film>>) {
    let start =
        plan.places().get(seed as usize % plan.places().len().max(1)).map_or_else(Default::default, |p| p.at);
    let exploration = Exploration { start: Pose { at: start, heading: 0.0 }, towards: None, seed };
    let before = Instant::now();
    let explored = exploration
        .run(plan, &Outfit::default(), &mut table::Table, |_| {}, film)
        .unwrap_or_else(|error| panic!("{error}"));
    println!(
        "{} seed {seed}: {:?}, {:.0} m, {:.0} s, {} looks, {} touches, overlap {:.1e}, error up to {:.3} m, {:.1} s of computing",
        plan.name,
        explored.ending,
        explored.path_m,
        explored.simulated_s,
        explored.looks,
        explored.touches,
        explored.overlap_m,
        explored.worst_error_m,
        before.elapsed().as_secs_f64(),
    );
    let before = Instant::now();
    match score(&explored.learned, plan) {
        Ok(score) => {
            println!("  {score:?}");
            missions(plan, &explored.learned, start);
        }
        Err(errors) => println!("  {errors}"),
    }
    if std::env::var_os("PICTURE").is_some() {
        picture(plan, &explored.learned, seed);
    }
    println!(
        "  {} walls, {} unseen, scored in {:.1} s",
        explored.learned.walls.len(),
        explored.learned.unseen.len(),
        before.elapsed().as_secs_f64()
    );
}

/// Says which places the learned network reaches, and how the same missions go with the given and with the learned model.
fn missions(plan: &FloorPlan, learned: &Learned, start: Point) {
    let outfit = Outfit { start_sigma_m: START_SIGMA_M, ..Outfit::default() };
    let disc = |margin| Disc { radius: learned.radius_m, margin };
    let network = |plan: &FloorPlan, margin: f64| {
        Network::new(plan, disc(margin)).unwrap_or_else(|errors| panic!("{errors}"))
    };
    let found = learned.plan("learned").unwrap_or_else(|errors| panic!("{errors}"));
    let ways = network(&found, 0.0);
    let is_reached = |at: Point| ways.path(start, at, Rule::Tight, |way| Some(way.length)).is_ok();
    let lost: Vec<&str> =
        plan.places().iter().filter(|place| !is_reached(place.at)).map(|place| place.name.as_str()).collect();
    println!(
        "  {} of {} places reached, not {lost:?}",
        plan.places().len() - lost.len(),
        plan.places().len()
    );
    let given = Building::new(plan, network(plan, ROOM_M));
    let known = Building::new(&found, network(&found, ROOM_M));
    let (mut arrived, mut lengths, mut collisions) = ([0, 0], [Vec::new(), Vec::new()], 0);
    for number in 0..MISSIONS {
        let Some(mission) = draw(plan, &given.network, learned.radius_m, number) else { continue };
        let outcomes = [&given, &known].map(|building| {
            mission
                .run(&Drivable::of(&given.walls, building), &outfit, None, &mut table::Table, |_| {}, None)
                .unwrap_or_else(|error| panic!("mission {number}: {error}"))
        });
        let has_arrived = outcomes.each_ref().map(|outcome| outcome.trip.ending == Ending::Arrived);
        for side in 0..2 {
            arrived[side] += usize::from(has_arrived[side]);
            if has_arrived == [true, true] {
                lengths[side].push(outcomes[side].trip.path_m());
            }
        }
        collisions += usize::from(outcomes[1].overlap_m > 1e-6);
    }
    let median = lengths.map(|mut lengths| {
        lengths.sort_by(f64::total_cmp);
        lengths.get(lengths.len() / 2).copied().unwrap_or(f64::NAN)
    });
    println!(
        "  {MISSIONS} missions on the given and on the learned model: {arrived:?} arrived, {median:.2?} m in the median of those \
         that did with both, {collisions} collisions"
    );
}

fn picture(plan: &FloorPlan, learned: &Learned, seed: u64) {
    use std::fmt::Write as _;
    let mut out = String::new();
    let path = |points: &[Point]| {
        points.iter().map(|p| format!("{:.3},{:.3}", p.x, p.y)).collect::<Vec<_>>().join(" ")
    };
    for [a, b] in plan.barriers() {
        let _ = writeln!(out, "<polyline points='{}' stroke='#bbb' stroke-width='.12'/>", path(&[a, b]));
    }
    for solid in &learned.unseen {
        let _ = writeln!(out, "<polygon points='{}' fill='#f66'/>", path(solid));
    }
    if let Ok(known) = learned.plan("") {
        for region in adit_planners::floor_plan::Regions::of(&known).regions {
            let _ = writeln!(
                out,
                "<polygon points='{}' fill='#9cf' fill-opacity='.4' stroke='#07a' stroke-width='.01'/>",
                path(&region.outline)
            );
        }
    }
    for wall in &learned.walls {
        let _ = writeln!(
            out,
            "<polyline points='{}' stroke='#000' stroke-width='.03'/>",
            path(&[wall.a, wall.b])
        );
    }
    let svg = format!(
        "<svg xmlns='http://www.w3.org/2000/svg' width='1400' height='1000' viewBox='-1 -1 36 26'><rect x='-1' y='-1' width='40' height='40' fill='#fff'/><g fill='none'>{out}</g></svg>"
    );
    let _ = std::fs::write(format!("learned-{}-{seed}.svg", plan.name), svg);
}
