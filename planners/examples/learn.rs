//! Learns floor plans that the robot does not know, and says how well:
//! `cargo run --release -p adit-planners --example learn -- SEEDS PLAN.json...`; `film PLAN.json SEED` writes one as SVG.
//! With `PICTURE` in the environment each result is drawn over the truth.
#![allow(clippy::print_stdout, clippy::print_stderr)] // an example shows what it found

#[path = "../tests/navigation/table.rs"]
mod table;

use std::path::Path;
use std::time::Instant;

use adit_planners::floor_plan::{FloorPlan, read_floor_plan};
use adit_planners::navigation::Outfit;
use adit_planners::navigation::learn::{Exploration, score};
use adit_planners::pose::Pose;

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
        Ok(score) => println!("  {score:?}"),
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

fn picture(plan: &FloorPlan, learned: &adit_planners::navigation::learn::Learned, seed: u64) {
    use std::fmt::Write as _;
    let mut out = String::new();
    let path = |points: &[adit_planners::geometry::Point]| {
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
