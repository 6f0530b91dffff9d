//! What the robot does, state by state, in two rooms.

use std::f64::consts::PI;

use adit_planners::body::{Body, Command};
use adit_planners::geometry::{Point, Segment};
use adit_planners::local_model::{Estimate, SegmentFacts, Transition};
use adit_planners::navigation::{
    Ending, Happening, Judge, Navigator, Outfit, Settings, State, StateDecision, StateFacts, WayFacts,
};
use adit_planners::pose::Pose;
use adit_planners::simulator::{self, Course, Simulator};

use super::scene::{building, exact, mission, run, run_with, stands, two_rooms};
use super::table::Table;

#[test]
fn a_free_way_is_gone_straight_by_the_states_of_figure_5() {
    use State::{Decide, Hold, Move, Turn, Wait};
    let run = run(&mission([1.0, 1.0], [1.0, 4.0], Vec::new()));
    assert!(run.has_arrived(), "{}", run.told());
    assert_eq!(run.states(), [Decide, Wait, Decide, Turn, Wait, Decide, Move, Wait, Decide, Hold]);
    assert!((run.outcome.trip.path_m() - 3.0).abs() < 0.1);
}

#[test]
fn a_way_through_a_door_is_near_the_shortest() {
    let mission = mission([1.0, 3.0], [9.0, 3.0], Vec::new());
    let optimum = mission.possible(mission.start.at, &two_rooms(), 0.25).unwrap().optimum_m.unwrap();
    let run = run(&mission);
    assert!(run.has_arrived(), "{}", run.told());
    assert!(run.outcome.trip.path_m() < 1.03 * optimum, "{} for {optimum}", run.outcome.trip.path_m());
}

#[test]
fn a_box_on_the_line_is_passed_on_the_shorter_side() {
    // 0.4 m of the box are left of the line, 1.2 m are right of it
    let run = run(&mission([1.0, 3.0], [4.4, 3.0], vec![stands(2.7, 2.6, 0.4, 1.6)]));
    assert!(run.has_arrived(), "{}", run.told());
    assert_eq!(run.outcome.trip.touches, 0);
    assert!(run.count(|what| matches!(what, Happening::Detour { .. })) > 0);
    assert!(run.track().all(|at| at.y > 2.9), "it is passed on the left");
    let lengths = run.journal.iter().find_map(|entry| match entry.event.what {
        Happening::Detour { length_m, other_m, .. } => Some((length_m, other_m)),
        _ => None,
    });
    let (length_m, other_m) = lengths.unwrap();
    assert!(other_m.is_some_and(|other| other > length_m));
}

#[test]
fn a_box_in_a_door_closes_that_way_and_the_other_door_is_taken() {
    let run = run(&mission([2.0, 2.0], [8.0, 2.0], vec![stands(5.0, 1.5, 0.4, 0.8)]));
    assert!(run.has_arrived(), "{}", run.told());
    let doors = building(&two_rooms()).network.regions.doorways;
    let closed = run.journal.iter().find_map(|entry| match &entry.event.what {
        Happening::WayClosed { doorway, .. } => *doorway,
        _ => None,
    });
    let door = doors[closed.unwrap()];
    assert!(door.from.y.max(door.to.y) <= 2.0, "the lower door is the closed one");
    assert!(run.outcome.trip.replans > 0);
    assert!(run.track().any(|at| at.y > 4.0 && (at.x - 5.0).abs() < 0.7), "the upper door is passed");
}

#[test]
fn boxes_in_both_doors_leave_no_way() {
    let boxes = vec![stands(5.0, 1.5, 0.4, 0.8), stands(5.0, 4.5, 0.4, 0.8)];
    let run = run(&mission([2.0, 2.0], [8.0, 2.0], boxes));
    assert_eq!(run.outcome.trip.ending, Ending::NoWay, "{}", run.told());
    assert_eq!(run.outcome.trip.touches, 0);
    let retries = run.count(|what| matches!(what, Happening::Retried));
    assert!(retries >= Settings::default().most_retries as usize, "it is looked at anew before that is said");
    assert!(run.outcome.trip.seconds >= Settings::default().no_way_after_s);
}

#[test]
fn a_goal_under_a_box_is_not_reached() {
    // The sides of the box come into sight one after the other, as if it moved: it went round and round.
    let run = run(&mission([1.0, 3.0], [4.0, 3.0], vec![stands(4.0, 3.0, 0.6, 0.6)]));
    assert_eq!(run.outcome.trip.ending, Ending::NoWay, "{}", run.told());
}

#[test]
fn what_cuts_a_region_is_passed_through_the_other_room() {
    // from the left wall to 0.3 m before the wall between the rooms
    let run = run(&mission([2.0, 1.5], [2.0, 4.5], vec![stands(2.4, 3.0, 4.7, 0.3)]));
    assert!(run.has_arrived(), "{}", run.told());
    assert!(run.track().any(|at| at.x > 5.2));
}

#[test]
fn a_box_that_crosses_is_waited_for_or_passed_and_leaves_no_wall() {
    let through = vec![Point::new(0.0, 3.4)];
    let course = Course { through, speed_m_s: 0.25, starts_s: 5.0, goes_round: false };
    let run = run(&mission([1.0, 3.0], [4.4, 3.0], vec![stands(2.7, 1.3, 0.5, 0.5).on(course)]));
    assert!(run.has_arrived(), "{}", run.told());
}

#[test]
fn a_touch_stops_the_robot_and_it_withdraws() {
    // a pole that is too thin for the sonar to make a segment of it from afar
    let run = run(&mission([1.0, 3.0], [4.4, 3.0], vec![stands(3.4, 3.05, 0.02, 0.02)]));
    assert!(run.has_arrived(), "{}", run.told());
    assert!(run.outcome.overlap_m < 1e-6);
    let touched = run.journal.iter().position(|entry| matches!(entry.event.what, Happening::Contact { .. }));
    if let Some(touched) = touched {
        let then = run.journal[touched..].iter().find_map(|entry| entry.event.what.state());
        assert_eq!(then, Some(State::Blocked));
    }
}

/// A judge with a rule of the house: the lower door is not for robots.
struct LowerDoorForbidden;

impl Judge for LowerDoorForbidden {
    fn next_state(&mut self, facts: &StateFacts) -> StateDecision {
        Table.next_state(facts)
    }

    fn segment(&mut self, facts: &SegmentFacts) -> Transition {
        Table.segment(facts)
    }

    fn weigh(&mut self, facts: &WayFacts) -> Option<f64> {
        let is_low = facts.way.doorway.is_some() && facts.way.points[0].y < 3.0;
        if is_low { None } else { Table.weigh(facts) }
    }
}

#[test]
fn a_door_that_the_judge_closes_is_not_passed_even_if_it_is_the_only_one_left() {
    let far = mission([2.0, 2.0], [8.0, 2.0], Vec::new());
    let round = run_with(&far, &exact(), &mut LowerDoorForbidden);
    assert!(round.has_arrived());
    assert!(round.track().any(|at| at.y > 4.0));

    let blocked = mission([2.0, 2.0], [8.0, 2.0], vec![stands(5.0, 4.5, 0.4, 0.8)]);
    let run = run_with(&blocked, &exact(), &mut LowerDoorForbidden);
    assert_eq!(run.outcome.trip.ending, Ending::NoWay, "{}", run.told());
    assert!(run.track().all(|at| at.x < 5.0));
}

#[test]
fn the_same_seed_gives_the_same_journal_to_the_bit() {
    let mission = mission([1.0, 3.0], [9.0, 3.0], vec![stands(3.0, 2.6, 0.5, 0.5)]);
    let [one, other] = [0, 1].map(|_| run_with(&mission, &Outfit::default(), &mut Table));
    assert_eq!(one.outcome, other.outcome);
    assert_eq!(one.journal, other.journal);
}

#[test]
fn a_mission_ends_when_patience_does() {
    let mut outfit = exact();
    outfit.navigation.patience_s = 3.0;
    let run = run_with(&mission([1.0, 1.0], [9.0, 5.0], Vec::new()), &outfit, &mut Table);
    assert_eq!(run.outcome.trip.ending, Ending::OutOfPatience);
    assert!(run.outcome.trip.seconds < 3.2);
}

#[test]
fn in_manual_mode_the_user_drives_and_the_position_is_kept() {
    let plan = two_rooms();
    let building = building(&plan);
    let walls: Vec<Segment> = plan.barriers().into_iter().map(Segment::from).collect();
    let start = Pose::new(1.0, 1.0, PI / 2.0);
    let mut robot = Simulator::new(&walls, Vec::new(), simulator::Settings::default(), start, 4).unwrap();
    let estimate = Estimate::new(start, 0.01, 0.01);
    let outfit = Outfit::default();
    let mut navigator = Navigator::new(&building, outfit.model, outfit.navigation, estimate);
    assert!(navigator.drive(&mut robot, Command::Move { distance_m: 3.0, bearing: 0.0, speed_m_s: 0.5 }));
    for _ in 0..300 {
        assert_eq!(navigator.step(&mut robot, &mut Table), None);
    }
    assert!(robot.pose().at.distance(Point::new(1.0, 4.0)) < 0.3, "it went");
    assert!(navigator.estimate().pose.at.distance(robot.pose().at) < 0.05, "and knows where to");

    navigator.go(Point::new(1.0, 1.0), &mut Table);
    let stop = Command::Stop;
    assert!(!navigator.drive(&mut robot, stop), "it is not the user who drives now");
    let ending = std::iter::repeat_with(|| navigator.step(&mut robot, &mut Table)).flatten().next();
    assert_eq!(ending, Some(Ending::Arrived));
    assert!(!robot.sense().unwrap().is_busy);
}

#[test]
fn a_robot_at_its_goal_looks_around_and_is_there() {
    let run = run(&mission([2.0, 2.0], [2.0, 2.0], Vec::new()));
    assert!(run.has_arrived(), "{}", run.told());
    assert!(run.outcome.trip.path_m() < 0.01 && run.outcome.trip.seconds < 60.0, "{}", run.told());
}
