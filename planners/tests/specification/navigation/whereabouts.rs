//! Where the robot is: what it cannot be sure of it does not claim, and where it is taken unawares it finds out, or says that it is
//! lost.

use adit_planners::floor_plan::{Drawn, FloorPlan};
use adit_planners::geometry::Point;
use adit_planners::navigation::{Ending, Happening, Navigator, Outfit};
use adit_planners::pose::Pose;
use adit_planners::simulator::Simulator;

use super::scene::{building, two_rooms};
use super::table::Table;

fn plan(walls: &[[f64; 4]]) -> FloorPlan {
    let line = |&[x0, y0, x1, y1]: &[f64; 4]| [Point::new(x0, y0), Point::new(x1, y1)];
    FloorPlan::new(Drawn { walls: walls.iter().map(line).collect(), ..Drawn::default() }).unwrap()
}

fn hall(dx: f64, dy: f64) -> Vec<[f64; 4]> {
    vec![[0.0, 0.0, dx, 0.0], [dx, 0.0, dx, dy], [dx, dy, 0.0, dy], [0.0, dy, 0.0, 0.0]]
}

/// Three rooms of different sizes along a corridor.
fn three_rooms() -> FloorPlan {
    let mut walls = hall(18.0, 8.0);
    walls.extend([
        [0.0, 5.5, 2.0, 5.5],
        [3.0, 5.5, 8.0, 5.5],
        [9.0, 5.5, 15.0, 5.5],
        [16.0, 5.5, 18.0, 5.5],
        [4.0, 0.0, 4.0, 5.5],
        [11.0, 0.0, 11.0, 5.5],
        [13.0, 1.5, 14.0, 1.5],
    ]);
    plan(&walls)
}

struct Told {
    ending: Ending,
    /// Metres from where the robot really was at the end to the goal.
    miss_m: f64,
    sigma_m: f64,
    searches: usize,
}

/// A mission on which the robot is taken elsewhere after some seconds.
fn run(
    plan: &FloorPlan,
    outfit: &Outfit,
    [from, goal]: [Point; 2],
    seed: u64,
    taken: Option<(f64, Pose)>,
) -> Told {
    let building = building(plan);
    let start = Pose { at: from, heading: 0.3 };
    let mut body = Simulator::new(&building.walls, Vec::new(), outfit.robot, start, seed).unwrap();
    let estimate = adit_planners::local_model::Estimate::new(start, 0.01, 0.01);
    let mut navigator = Navigator::new(&building, outfit.model, outfit.navigation, estimate);
    navigator.go(goal, &mut Table);
    let (mut taken, mut searches) = (taken, 0);
    loop {
        if let Some((_, to)) = taken.take_if(|(after_s, _)| body.time_s() >= *after_s) {
            body.put(to).unwrap();
        }
        let ending = navigator.step(&mut body, &mut Table);
        for event in navigator.take_events() {
            searches += usize::from(matches!(event.what, Happening::Located { is_anywhere: true, .. }));
        }
        if let Some(ending) = ending {
            let miss_m = body.pose().at.distance(goal);
            return Told { ending, miss_m, sigma_m: navigator.estimate().sigma_m(), searches };
        }
    }
}

#[test]
fn whoever_is_taken_to_another_room_finds_out_and_arrives() {
    let plan = three_rooms();
    let ends = [Point::new(2.0, 2.0), Point::new(16.0, 3.0)];
    let places = [Pose::new(7.0, 3.0, 1.0), Pose::new(12.0, 4.0, -2.0), Pose::new(1.0, 6.7, 3.0)];
    let mut arrived = 0;
    for (seed, to) in (1..).zip(places) {
        let told = run(&plan, &Outfit::default(), ends, seed, Some((25.0, to)));
        assert!(told.ending != Ending::NoWay, "{to:?}");
        if told.ending == Ending::Arrived {
            arrived += 1;
            assert!(told.miss_m < 0.2 && told.searches > 0, "{to:?}: {} m off", told.miss_m);
        }
    }
    assert!(arrived >= 2, "{arrived} of {} arrived", places.len());
}

#[test]
fn where_rooms_look_alike_the_robot_stays_unsure() {
    // turned by half a turn the two rooms are the same
    let ends = [Point::new(1.0, 1.0), Point::new(9.0, 5.0)];
    for (seed, to) in (1..).zip([Pose::new(3.5, 3.0, 0.0), Pose::new(8.0, 2.0, 1.0)]) {
        let told = run(&two_rooms(), &Outfit::default(), ends, seed, Some((20.0, to)));
        assert_eq!(told.ending, Ending::Lost, "{to:?}: {} m off", told.miss_m);
        assert!(told.sigma_m > 1.0, "{}", told.sigma_m);
    }
}

#[test]
fn in_the_middle_of_a_long_corridor_nothing_tells_how_far_the_robot_has_come() {
    let corridor = plan(&hall(60.0, 2.0));
    for seed in 1..=4 {
        let ends = [Point::new(2.0, 1.0), Point::new(35.0, 1.0)];
        let told = run(&corridor, &Outfit::default(), ends, seed, None);
        assert_eq!(told.ending, Ending::Lost, "{} m off", told.miss_m);
    }
}

#[test]
fn at_the_end_of_a_long_corridor_its_wall_tells() {
    let corridor = plan(&hall(60.0, 2.0));
    for seed in 1..=6 {
        let told =
            run(&corridor, &Outfit::default(), [Point::new(2.0, 1.0), Point::new(57.0, 1.0)], seed, None);
        assert!(
            told.ending == Ending::Arrived && told.miss_m < 0.15,
            "{:?} {} m off",
            told.ending,
            told.miss_m
        );
    }
}

#[test]
fn wheels_that_slip_more_than_is_known_make_no_wrong_arrival() {
    let mut outfit = Outfit::default();
    outfit.robot.distance_noise = 0.15;
    let corridor = plan(&hall(40.0, 2.0));
    for seed in 1..=6 {
        let told = run(&corridor, &outfit, [Point::new(2.0, 1.0), Point::new(37.0, 1.0)], seed, None);
        let is_right = told.ending == Ending::Arrived && told.miss_m < 0.25;
        assert!(is_right || told.ending == Ending::Lost, "{:?} {} m off", told.ending, told.miss_m);
    }
}
