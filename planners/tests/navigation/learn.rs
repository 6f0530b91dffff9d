//! Learn mode: what a robot has seen becomes a floor plan that is nearly the true one.

use adit_planners::floor_plan::{Disc, FloorPlan, Network, Regions, Rule};
use adit_planners::geometry::Point;
use adit_planners::local_model::{SegmentFacts, Transition};
use adit_planners::navigation::learn::{Exploration, Explored, Guide, OpeningFacts, score};
use adit_planners::navigation::{Ending, Judge, Outfit, StateDecision, StateFacts, WayFacts};
use adit_planners::pose::Pose;

use super::scene::two_rooms;
use super::table::Table;

const START: Point = Point::new(2.0, 3.0);

fn explore(plan: &FloorPlan, towards: Option<Point>, seed: u64, guide: &mut impl Guide) -> Explored {
    let exploration = Exploration { start: Pose { at: START, heading: 0.0 }, towards, seed };
    exploration.run(plan, &Outfit::default(), guide, |_| {}, None).unwrap()
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
