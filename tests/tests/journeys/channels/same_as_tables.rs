//! The shipped rules say at every step what the tables say that the planners' property tests steer by (no collision, the
//! clearance that a gap promises, no error within the bounds): what holds there holds for the rules.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::{Arc, OnceLock};

use adit::plan::assembly::Assembly;
use adit::plan::corridor::Corridor;
use adit::plan::{Asked, Steps, Turns, Wanted, Wishes, rules};
use adit_engine::RuleBase;
use adit_planners::channels::assembly::{self, StepFacts};
use adit_planners::channels::corridor::{Axis, Corridors, Robot};
use adit_planners::geometry::{Point, Rect};
use proptest::prelude::*;

use super::chains::{Chain, chains};
use super::table1::{table_for_any_dimension, table1};
use super::table2::corrected;

fn shipped() -> Arc<RuleBase> {
    static RULES: OnceLock<Arc<RuleBase>> = OnceLock::new();
    Arc::clone(RULES.get_or_init(|| {
        rules::load(rules::Kind::Channels, "corrected", Path::new("")).expect("a shipped rule base").0
    }))
}

/// The chain as a world, with a gap of its own for each junction.
fn world<const D: usize>(chain: &Chain<D>) -> Assembly<D> {
    let geometry = assembly::Assembly::new(chain.channels.clone(), chain.part).expect("a chain");
    let gaps =
        geometry.junctions().iter().zip(&chain.shares).enumerate().map(|(index, (junction, shares))| {
            let bound = |axis: usize| (junction.size(axis) - chain.part.size(axis)) / 2.0;
            (index + 1, Asked::Gap(std::array::from_fn(|axis| shares[axis] * bound(axis))))
        });
    Assembly {
        wanted: Wanted {
            mover: "part".to_owned(),
            gap: Asked::Safest,
            gaps: gaps.collect(),
            fragile: false,
            hurry: false,
        },
        geometry,
        female_moves: false,
        displacement: None,
        base: None,
    }
}

fn gap_at<const D: usize>(world: &Assembly<D>, facts: &StepFacts<D>) -> [f64; D] {
    match world.wanted.gaps[&facts.number] {
        Asked::Gap(gap) => gap,
        _ => facts.bound,
    }
}

fn numbers() -> impl Strategy<Value = f64> {
    (-40_i32..40).prop_map(|number| f64::from(number) / 4.0 + 0.125)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn table_1_in_the_plane(chain in chains::<2>(1..8)) {
        let mut steps = Steps::new(&shipped()).expect("rules");
        prop_assert!(steps.is_direct());
        let world = world(&chain);
        let by_rules = world.plan(&mut steps).expect("a path");
        let by_table = world.geometry.disassemble(None, |facts| table1(facts, gap_at(&world, facts)));
        prop_assert_eq!(by_rules, by_table.expect("a path"));
    }

    #[test]
    fn table_1_in_space(chain in chains::<3>(1..6)) {
        let mut steps = Steps::new(&shipped()).expect("rules");
        let world = world(&chain);
        let by_rules = world.plan(&mut steps).expect("a path");
        let by_table = world.geometry.disassemble(None, |facts| table_for_any_dimension(facts, gap_at(&world, facts)));
        prop_assert_eq!(by_rules.waypoints, by_table.expect("a path").waypoints);
    }

    #[test]
    fn table_2(
        [x, y] in prop::array::uniform2(numbers()),
        [from_x, from_y] in prop::array::uniform2(numbers()),
        [to_x, to_y] in prop::array::uniform2(numbers()),
        upright in any::<bool>(),
    ) {
        let mut turns = Turns::new(&shipped()).expect("rules");
        prop_assert!(turns.is_direct());
        // The junction's middle lies on other numbers than the points, so that none is level with it.
        let facts = adit_planners::channels::corridor::StepFacts {
            junction: 1,
            rect: Rect::new(x - 1.5, y - 1.5, x + 1.75, y + 1.75),
            channel: 1,
            next_channel: 2,
            entering: if upright { Axis::Y } else { Axis::X },
            present: Point::new(from_x, from_y),
            next: Point::new(to_x + 0.01, to_y + 0.01),
            next_junction: None,
            width: 3.0,
            safest: 0.9,
            robot: Robot { width: 1.0, length: 1.5 },
        };
        let wishes = Wishes { mover: "robot", gap: &Asked::Gap([0.25]), fragile: false, hurry: false };
        let (by_rules, remark) = turns.decide(&facts, wishes).expect("a rule speaks");
        prop_assert_eq!(Ok(by_rules), corrected(&facts, 0.25));
        prop_assert_eq!(remark, None);
    }
}

#[test]
fn a_path_through_a_network_is_what_its_table_gives() {
    let channels = [
        Rect::new(0.0, 0.0, 3.0, 30.0),
        Rect::new(0.0, 12.0, 25.0, 15.0),
        Rect::new(22.0, 5.0, 25.0, 30.0),
        Rect::new(0.0, 27.0, 25.0, 30.0),
    ];
    let corridors = Corridors::new(&channels).expect("corridors");
    let mut turns = Turns::new(&shipped()).expect("rules");
    let robot = Robot { width: 1.0, length: 1.5 };
    for (start, goal) in [((1.5, 2.0), (23.5, 7.0)), ((23.5, 28.5), (1.5, 2.0)), ((10.0, 28.5), (10.0, 13.5))]
    {
        let world = Corridor {
            corridors: corridors.clone(),
            robot,
            start: Point::new(start.0, start.1),
            heading: None,
            goal: Point::new(goal.0, goal.1),
            places: Vec::new(),
            closed: BTreeSet::new(),
            wanted: Wanted {
                mover: "robot".to_owned(),
                gap: Asked::Gap([0.4]),
                gaps: BTreeMap::new(),
                fragile: false,
                hurry: false,
            },
        };
        let by_rules = world.plan(&mut turns).expect("a path");
        let route = corridors
            .route(world.start, world.goal, |passage| Ok::<_, String>(Some(passage.length)))
            .expect("a route");
        let by_table = route.drive(robot, None, |facts| corrected(facts, 0.4)).expect("a drive");
        assert_eq!(by_rules.drive, by_table);
        assert!(by_rules.drive.min_clearance >= 0.4 - 1e-9, "{start:?} to {goal:?}");
    }
}
