//! Learn mode: what a robot has seen becomes a floor plan that is nearly the true one.

use std::path::Path;

use adit_planners::floor_plan::{Disc, FloorPlan, Network, Regions, Rule, read_floor_plan};
use adit_planners::geometry::Point;
use adit_planners::local_model::{SegmentFacts, Transition};
use adit_planners::navigation::learn::{Exploration, Explored, Guide, OpeningFacts, score};
use adit_planners::navigation::{Ending, Judge, Outfit, StateDecision, StateFacts, WayFacts};
use adit_planners::pose::Pose;

use super::scene::{round_a_core, two_rooms};
use super::table::Table;

const START: Point = Point::new(2.0, 3.0);

fn explore(plan: &FloorPlan, towards: Option<Point>, seed: u64, guide: &mut impl Guide) -> Explored {
    explore_from(START, plan, towards, seed, guide)
}

fn explore_from(
    start: Point,
    plan: &FloorPlan,
    towards: Option<Point>,
    seed: u64,
    guide: &mut impl Guide,
) -> Explored {
    let exploration = Exploration { start: Pose { at: start, heading: 0.0 }, towards, seed };
    exploration.run(plan, &Outfit::default(), guide, |_| {}, None).unwrap()
}

/// Explores from a place of the plan: nothing is run into, at least 95 % of the area is learned and next to nothing that is
/// not free, and the robot knows a way to every place.
fn is_learned_from(name: &str, plan: &FloorPlan, seed: u64) {
    let start = plan.places().iter().find(|place| place.name == name).unwrap().at;
    let explored = explore_from(start, plan, None, seed, &mut Table);
    let told = format!("{} from {name}, seed {seed}", plan.name);
    assert_eq!(explored.ending, Ending::Arrived, "{told}");
    assert!(explored.overlap_m <= 1e-6, "{told}: {} m deep in a wall", explored.overlap_m);
    let score = score(&explored.learned, plan).unwrap();
    assert!(score.share >= 0.95 && score.outside_m2 < 0.01 * score.true_m2, "{told}: {score:?}");
    let learned = explored.learned.plan("learned").unwrap();
    let network = Network::new(&learned, Disc { radius: explored.learned.radius_m, margin: 0.0 }).unwrap();
    for place in plan.places() {
        let path = network.path(start, place.at, Rule::Tight, |way| Some(way.length));
        assert!(path.is_ok(), "{told}: no way to {}, {:?}", place.name, path.err());
    }
}

#[test]
fn golden_plans_are_learned_whole() {
    for (file, start) in [("house-7.json", "room-1"), ("office-14.json", "room-1")] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden/floorplans").join(file);
        is_learned_from(start, &read_floor_plan(&path).unwrap(), 1);
    }
}

#[test]
fn a_way_round_a_core_closes_where_it_began() {
    for (start, seed) in [("front", 1), ("room", 2), ("slant", 3)] {
        is_learned_from(start, &round_a_core(), seed);
    }
}

#[test]
fn two_rooms_are_learned_without_a_collision_and_the_network_leads_through() {
    let plan = two_rooms();
    for seed in 1..=3 {
        let explored = explore(&plan, None, seed, &mut Table);
        assert_eq!(explored.ending, Ending::Arrived);
        assert!(explored.overlap_m <= 1e-6, "{} m deep in a wall", explored.overlap_m);
        let score = score(&explored.learned, &plan).unwrap();
        assert!(score.share >= 0.95 && score.walls_off_m[0] < 0.03, "{score:?}");
        let learned = explored.learned.plan("learned").unwrap();
        let network = Network::new(&learned, Disc { radius: 0.25, margin: 0.0 }).unwrap();
        let path = network.path(START, Point::new(8.0, 3.0), Rule::Tight, |way| Some(way.length)).unwrap();
        let shortest = Network::new(&plan, network.disc).unwrap();
        let shortest =
            shortest.path(START, Point::new(8.0, 3.0), Rule::Tight, |way| Some(way.length)).unwrap();
        assert!(path.length < 1.1 * shortest.length, "{} m instead of {}", path.length, shortest.length);
    }
}

#[test]
fn learned_regions_are_disjoint_and_cover_what_is_free() {
    let explored = explore(&two_rooms(), None, 4, &mut Table);
    let learned = explored.learned.plan("learned").unwrap();
    let regions = Regions::of(&learned);
    let sum: f64 = regions.regions.iter().map(|region| region.area).sum();
    assert!((sum - learned.free_area()).abs() < 1e-6 * sum, "{sum} and {}", learned.free_area());
}

#[test]
fn the_same_seed_learns_the_same() {
    let plan = two_rooms();
    assert_eq!(explore(&plan, None, 5, &mut Table), explore(&plan, None, 5, &mut Table));
}

/// A guide that explores nothing.
struct Idle;

impl Judge for Idle {
    fn next_state(&mut self, facts: &StateFacts) -> StateDecision {
        Table.next_state(facts)
    }

    fn segment(&mut self, facts: &SegmentFacts) -> Transition {
        Table.segment(facts)
    }

    fn weigh(&mut self, facts: &WayFacts) -> Option<f64> {
        Table.weigh(facts)
    }
}

impl Guide for Idle {
    fn opening(&mut self, _: &OpeningFacts) -> Option<f64> {
        None
    }
}

#[test]
fn who_is_told_to_explore_nothing_stays_and_knows_the_room_that_it_sees() {
    let plan = two_rooms();
    let explored = explore(&plan, None, 1, &mut Idle);
    assert!(explored.path_m < 0.1 && explored.looks == 1);
    let score = score(&explored.learned, &plan).unwrap();
    assert!((0.2..0.8).contains(&score.share), "{score:?}");
}
