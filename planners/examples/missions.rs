//! Seeded missions over floor plans with obstacles that the robot does not know, and a table of how they went:
//! `cargo run --release -p adit-planners --example missions -- 60 plan.json...`; `film plan.json NUMBER` writes one as SVG.
//! A plan is a floor plan (`.json`) or a map as sites have it (`.toml`, `.yaml`).
#![allow(clippy::print_stdout, clippy::print_stderr)] // an example shows what it found

#[path = "../tests/specification/navigation/table.rs"]
mod table;

use std::ops::Range;
use std::path::Path;
use std::time::Instant;

use adit_planners::floor_plan::{Disc, FloorPlan, Network, read_floor_plan};
use adit_planners::navigation::{
    Building, Drivable, Ending, Happening, Mission, Outcome, Outfit, Possible, ROOM_M, draw,
};
use adit_planners::read::{MapErrors, MapSettings, read_world};
use rayon::prelude::*;

struct Case {
    number: u64,
    outcome: Outcome,
    possible: Possible,
    has_movers: bool,
    wall_s: f64,
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match &arguments[..] {
        [film, plan, number] if film == "film" => watch(plan, number.parse().unwrap_or(0)),
        [count, plans @ ..] => {
            for plan in plans {
                table_of(plan, numbers(count));
            }
        }
        [] => eprintln!("usage: missions COUNT|FROM..TO PLAN.json... | missions film PLAN.json NUMBER"),
    }
}

fn numbers(told: &str) -> Range<u64> {
    let (from, to) = told.split_once("..").unwrap_or(("0", told));
    from.parse().unwrap_or(0)..to.parse().unwrap_or(60)
}

/// How high the robot is: lower bridges of a map are solid, metres.
const HEIGHT_M: f64 = 1.0;

fn read(path: &Path) -> Result<FloorPlan, MapErrors> {
    if path.extension().is_some_and(|extension| extension == "json") {
        return read_floor_plan(path);
    }
    let (world, _) = read_world(path, &MapSettings::default())?;
    FloorPlan::of_world(&world, Some(HEIGHT_M))
}

fn load(path: &str) -> (FloorPlan, Building, Outfit) {
    let plan = read(Path::new(path)).unwrap_or_else(|errors| panic!("{errors}"));
    let outfit = Outfit::default();
    let disc = Disc { radius: outfit.robot.radius_m, margin: ROOM_M };
    let network = Network::new(&plan, disc).unwrap_or_else(|errors| panic!("{errors}"));
    let building = Building::new(&plan, network);
    (plan, building, outfit)
}

fn mission(
    plan: &FloorPlan,
    building: &Building,
    outfit: &Outfit,
    number: u64,
) -> Option<(Mission, Possible)> {
    let mission = draw(plan, &building.network, outfit.robot.radius_m, number)?;
    let possible = mission.possible(mission.start.at, plan, outfit.robot.radius_m)?;
    Some((mission, possible))
}

fn watch(path: &str, number: u64) {
    let (plan, building, outfit) = load(path);
    let Some((mission, possible)) = mission(&plan, &building, &outfit, number) else { return };
    println!("{possible:?} goal {:?}", mission.goal);
    for obstacle in &mission.obstacles {
        println!("{obstacle:?}");
    }
    let mut film = None;
    let journal = |entry: adit_planners::navigation::Entry| {
        let (pose, off) =
            (entry.event.pose, entry.truth.map_or(0.0, |truth| entry.event.pose.at.distance(truth.at)));
        let at = format!("{:7.2} ({:.2}, {:.2}) off {off:.3}", entry.event.time_s, pose.at.x, pose.at.y);
        match entry.event.what {
            Happening::State { facts: f, decision } => println!(
                "{at} {:?} -> {:?} {:?}: to go {:.2} free {:.2} echo {:.2} turn {:.3} aside {:.3} left {:?} right {:?}",
                f.state,
                decision.state,
                decision.action,
                f.distance_m,
                f.free_m,
                f.echo_m,
                f.heading_error,
                f.off_line_m,
                f.left_m,
                f.right_m
            ),
            Happening::SetEstimatedPosition(_) | Happening::Segments { .. } => {}
            what => println!("{at} {what:?}"),
        }
    };
    let on = Drivable::of(&building.walls, &building);
    let outcome = mission.run(&on, &outfit, None, &mut table::Table, journal, Some(&mut film));
    println!("{outcome:?}");
    let file = format!("mission-{number}.svg");
    if let Some(film) = film {
        std::fs::write(&file, film.svg(4.0)).unwrap_or_else(|error| eprintln!("{file}: {error}"));
    }
}

fn table_of(path: &str, numbers: Range<u64>) {
    let (plan, building, outfit) = load(path);
    let begin = Instant::now();
    let run = |number: u64| {
        let (mission, possible) = mission(&plan, &building, &outfit, number)?;
        let start = Instant::now();
        let on = Drivable::of(&building.walls, &building);
        let outcome = mission.run(&on, &outfit, None, &mut table::Table, |_| {}, None);
        let outcome = outcome.unwrap_or_else(|error| panic!("mission {number}: {error}"));
        let has_movers = mission.obstacles.iter().any(|obstacle| obstacle.course.is_some());
        Some(Case { number, outcome, possible, has_movers, wall_s: start.elapsed().as_secs_f64() })
    };
    let cases: Vec<Case> = numbers.into_par_iter().filter_map(run).collect();
    println!("{}: {} missions in {:.1} s", plan.name, cases.len(), begin.elapsed().as_secs_f64());
    let number = |is: &dyn Fn(&Case) -> bool| cases.iter().filter(|case| is(case)).count();
    let arrived = |case: &Case| case.outcome.trip.ending == Ending::Arrived;
    let no_way = |case: &Case| case.outcome.trip.ending == Ending::NoWay;
    println!(
        "  possible {} (arrived {}), impossible {} (no way {}), between {} (arrived {}), touches {}, overlap {:.1e} m",
        number(&|case| case.possible.is_with_room),
        number(&|case| case.possible.is_with_room && arrived(case)),
        number(&|case| !case.possible.is_for_radius),
        number(&|case| !case.possible.is_for_radius && no_way(case)),
        number(&|case| case.possible.is_for_radius && !case.possible.is_with_room),
        number(&|case| case.possible.is_for_radius && !case.possible.is_with_room && arrived(case)),
        cases.iter().map(|case| case.outcome.trip.touches).sum::<usize>(),
        cases.iter().map(|case| case.outcome.overlap_m).fold(f64::NEG_INFINITY, f64::max),
    );
    let wrong = |case: &Case| match case.outcome.trip.ending {
        Ending::Arrived => !case.possible.is_for_radius || case.outcome.miss_m > outfit.robot.radius_m,
        Ending::NoWay => case.possible.is_with_room,
        _ => false,
    };
    println!(
        "  arrived {}, no way {}, lost {}, out of patience {}; wrong claims {}",
        number(&arrived),
        number(&no_way),
        number(&|case| case.outcome.trip.ending == Ending::Lost),
        number(&|case| case.outcome.trip.ending == Ending::OutOfPatience),
        number(&wrong),
    );
    let mut touched: Vec<(usize, u64, bool)> =
        cases.iter().map(|case| (case.outcome.trip.touches, case.number, case.has_movers)).collect();
    touched.retain(|(touches, ..)| *touches > 0);
    touched.sort_by(|a, b| b.cmp(a));
    println!(
        "  missions with touches: {} (touches, number, something moves): {:?}",
        touched.len(),
        &touched[..touched.len().min(8)]
    );
    let ratio = |case: &Case| case.possible.optimum_m.map(|optimum| case.outcome.trip.path_m() / optimum);
    let reached = || cases.iter().filter(|case| arrived(case));
    spread("path over optimum", reached().filter_map(ratio).collect());
    spread("replans", cases.iter().map(|case| f64::from(case.outcome.trip.replans)).collect());
    spread("detours", cases.iter().map(|case| f64::from(case.outcome.trip.detours)).collect());
    spread("simulated s", cases.iter().map(|case| case.outcome.trip.seconds).collect());
    spread("wall s", cases.iter().map(|case| case.wall_s).collect());
    spread("worst error m", cases.iter().map(|case| case.outcome.worst_error_m).collect());
    spread("miss at the goal m", reached().map(|case| case.outcome.miss_m).collect());
    for case in &cases {
        let is_right =
            match (case.outcome.trip.ending, case.possible.is_for_radius, case.possible.is_with_room) {
                (Ending::Arrived, is_for_radius, _) => is_for_radius && case.outcome.miss_m < 0.2,
                (Ending::NoWay, _, is_with_room) => !is_with_room,
                _ => false,
            };
        if !is_right {
            println!(
                "  {} {}{:?} {:?}",
                case.number,
                if case.has_movers { "(moving) " } else { "" },
                case.possible,
                case.outcome
            );
        }
    }
}

fn spread(what: &str, mut values: Vec<f64>) {
    values.sort_by(f64::total_cmp);
    let at = |share: f64| {
        values.get(((values.len().max(1) - 1) as f64 * share) as usize).copied().unwrap_or(f64::NAN)
    };
    println!(
        "  {what}: median {:.3}, 90 % {:.3}, 99 % {:.3}, worst {:.3}",
        at(0.5),
        at(0.9),
        at(0.99),
        at(1.0)
    );
}
