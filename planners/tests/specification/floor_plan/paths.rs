//! Paths for a disc: as short as may be, never through a wall, over open ways only.

use std::path::Path;

use adit_planners::floor_plan::clear::wall_distance;
use adit_planners::floor_plan::{Disc, Network, NoPath, Rule, Spot, Way};
use adit_planners::geometry::Point;
use serde_json::Value;

use super::oracle::Oracle;
use super::random_plan::random_plan;
use super::regions::{GOLDEN, golden};

const DISC: Disc = Disc { radius: 0.25, margin: 0.0 };

/// The figures of a pair; of the adits to a thousandth, of the optimum to three decimals.
struct Pair {
    ends: [Point; 2],
    optimum: f64,
    all_adits: f64,
    nearest: f64,
}

fn pairs(name: &str) -> Vec<Pair> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden/floorplans").join(name);
    let plan: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    let point = |value: &Value| Point::new(value[0].as_f64().unwrap(), value[1].as_f64().unwrap());
    let pair = |pair: &Value| Pair {
        ends: [point(&pair["start"]), point(&pair["goal"])],
        optimum: pair["shortest_r025"].as_f64().unwrap(),
        all_adits: pair["adit_all"].as_f64().unwrap(),
        nearest: pair["adit_nearest"].as_f64().unwrap(),
    };
    plan["pairs"].as_array().unwrap().iter().map(pair).collect()
}

#[allow(clippy::unnecessary_wraps)] // the shape of a weight: some ways may be closed
fn length(way: &Way) -> Option<f64> {
    Some(way.length)
}

fn median_and_worst(mut ratios: Vec<f64>) -> (f64, f64) {
    ratios.sort_by(f64::total_cmp);
    let middle = ratios.len() / 2;
    (
        f64::midpoint(ratios[middle - usize::from(ratios.len().is_multiple_of(2))], ratios[middle]),
        ratios[ratios.len() - 1],
    )
}

#[test]
fn tight_paths_are_within_a_percent_of_the_any_angle_optimum() {
    for name in GOLDEN {
        let network = Network::new(&golden(name), DISC).unwrap();
        for rule in [Rule::Nearest, Rule::AllAdits, Rule::Tight] {
            let ratio = |pair: &Pair| {
                let [from, to] = pair.ends;
                network.path(from, to, rule, length).unwrap().length / pair.optimum
            };
            let (median, worst) = median_and_worst(pairs(name).iter().map(ratio).collect());
            println!("{name} {rule:?}: median {median:.4}, worst {worst:.4} of the optimum");
            assert!(rule != Rule::Tight || median <= 1.01 && worst <= 1.03, "{name}");
        }
    }
}

#[test]
fn paths_over_adits_are_as_long_as_those_of_the_reference() {
    for name in GOLDEN {
        let network = Network::new(&golden(name), DISC).unwrap();
        for pair in pairs(name) {
            let [from, to] = pair.ends;
            for (rule, expected) in [(Rule::Nearest, pair.nearest), (Rule::AllAdits, pair.all_adits)] {
                let found = network.path(from, to, rule, length).unwrap();
                assert!(
                    (found.length - expected).abs() < 1e-3,
                    "{name} {rule:?}: {} {expected}",
                    found.length
                );
                assert!((found.weight - found.length).abs() < 1e-9);
            }
        }
    }
}

#[test]
fn no_leg_of_a_path_comes_nearer_to_a_wall_than_the_disc() {
    for name in GOLDEN {
        let plan = golden(name);
        for margin in [0.0, 0.1] {
            let network = Network::new(&plan, Disc { margin, ..DISC }).unwrap();
            for pair in pairs(name) {
                for rule in [Rule::Nearest, Rule::AllAdits, Rule::Tight] {
                    let Ok(path) = network.path(pair.ends[0], pair.ends[1], rule, length) else { continue };
                    let clear = wall_distance(&path.points, &plan.barriers());
                    assert!(clear >= DISC.radius + margin - 1e-9, "{name} {rule:?}: {clear}");
                }
            }
        }
    }
}

#[test]
fn on_random_plans_a_path_is_found_where_the_oracle_finds_one_and_is_hardly_longer() {
    let (mut ratios, mut unreachable) = (Vec::new(), 0);
    for seed in 0..25 {
        let plan = random_plan(seed, 2 + seed as usize % 12);
        let radius = if seed % 3 == 0 { 0.45 } else { 0.25 };
        let disc = Disc { radius, margin: 0.0 };
        let Ok(network) = Network::new(&plan, disc) else { continue };
        let oracle = Oracle::new(&plan, radius * 1.001);
        for pair in plan.places().windows(2) {
            let found = network.path(pair[0].at, pair[1].at, Rule::Tight, length);
            match (found, oracle.shortest(pair[0].at, pair[1].at)) {
                (Ok(path), Some(optimum)) => {
                    let clear = wall_distance(&path.points, &plan.barriers());
                    assert!(clear >= radius, "seed {seed}: {clear}");
                    ratios.push(path.length / optimum);
                }
                (Err(_), None) => unreachable += 1,
                (found, optimum) => panic!(
                    "seed {seed}, {} to {}: {:?}, the oracle {optimum:?}",
                    pair[0].name,
                    pair[1].name,
                    found.map(|path| path.length)
                ),
            }
        }
    }
    let count = ratios.len();
    let (median, worst) = median_and_worst(ratios);
    println!("{count} paths, {unreachable} impossible: median {median:.4}, worst {worst:.4} of the optimum");
    assert!(median <= 1.01 && worst <= 1.03);
}

#[test]
fn ways_tell_their_length_what_stays_free_and_the_doorway_that_they_pass() {
    let plan = golden("house-7.json");
    let network = Network::new(&plan, Disc { margin: 0.05, ..DISC }).unwrap();
    assert_eq!(network.adits.len(), 16, "two for each of the 8 doors");
    for (index, adit) in network.adits.iter().enumerate() {
        assert_eq!(network.adits[adit.twin].twin, index);
        assert!(network.regions.regions[adit.region].contains(adit.at));
        assert!(network.regions.doorways[adit.doorway].regions.contains(&adit.region));
    }
    for way in &network.ways {
        assert!(way.clearance >= 0.05 - 1e-9, "{way:?}");
        let legs = way.points.windows(2).map(|leg| leg[0].distance(leg[1]));
        assert!((legs.sum::<f64>() - way.length).abs() < 1e-12);
        assert_eq!(way.doorway.is_none(), way.region.is_some());
    }
    let through = |doorway: usize| network.ways.iter().find(|way| way.doorway == Some(doorway)).unwrap();
    for (index, doorway) in network.regions.doorways.iter().enumerate() {
        assert!((through(index).length - 0.6).abs() < 1e-9, "0.3 m on each side");
        assert!(
            (through(index).clearance - (doorway.width() / 2.0 - 0.25)).abs() < 1e-5,
            "through the middle"
        );
    }
    for place in 0..plan.places().len() {
        assert!(network.ways.iter().any(|way| way.from == Spot::Place(place)));
    }
}

#[test]
fn a_closed_doorway_is_gone_round_and_without_another_way_there_is_none() {
    let plan = golden("house-7.json");
    let network = Network::new(&plan, DISC).unwrap();
    let at = |name: &str| plan.places().iter().find(|place| place.name == name).unwrap().at;
    let (from, to) = (at("room-0"), at("room-1"));
    let open = network.path(from, to, Rule::Tight, length).unwrap();
    let [shut] = open.doorways[..] else { panic!("{:?}", open.doorways) };
    let around = |way: &Way| length(way).filter(|_| way.doorway != Some(shut));
    for rule in [Rule::Nearest, Rule::AllAdits, Rule::Tight] {
        let path = network.path(from, to, rule, around).unwrap();
        assert_eq!(path.doorways.len(), 2, "{rule:?}: through the corridor");
        assert!(!path.doorways.contains(&shut) && path.length > open.length);
    }
    let all_shut = |way: &Way| length(way).filter(|_| way.doorway.is_none());
    assert_eq!(network.path(from, to, Rule::Tight, all_shut), Err(NoPath::NoWay));
}

#[test]
fn a_door_that_squeaks_is_avoided_as_long_as_that_costs_less() {
    let plan = golden("house-7.json");
    let network = Network::new(&plan, DISC).unwrap();
    let (from, to) = (plan.places()[0].at, plan.places()[1].at);
    let free = network.path(from, to, Rule::Tight, length).unwrap();
    let squeaks = free.doorways[0];
    let with = |metres: f64| {
        let weigh =
            move |way: &Way| Some(way.length + if way.doorway == Some(squeaks) { metres } else { 0.0 });
        network.path(from, to, Rule::Tight, weigh).unwrap()
    };
    let detour =
        network.path(from, to, Rule::Tight, |way| length(way).filter(|_| way.doorway != Some(squeaks)));
    let spared = detour.unwrap().length - free.length;
    assert_eq!(with(spared - 0.1).doorways, [squeaks]);
    assert!((with(spared - 0.1).weight - free.length - spared + 0.1).abs() < 1e-9);
    assert!(!with(spared + 0.1).doorways.contains(&squeaks));
}

#[test]
fn whoever_stands_in_a_wall_or_outside_has_no_path() {
    let plan = golden("house-7.json");
    let network = Network::new(&plan, DISC).unwrap();
    let (inside, at_wall, outside) = (plan.places()[0].at, Point::new(0.1, 0.1), Point::new(-3.0, 1.0));
    let path = |from, to| network.path(from, to, Rule::Tight, length).unwrap_err();
    assert_eq!(path(at_wall, inside), NoPath::Start);
    assert_eq!(path(inside, at_wall), NoPath::Goal);
    assert_eq!(path(outside, inside), NoPath::Start);
}
