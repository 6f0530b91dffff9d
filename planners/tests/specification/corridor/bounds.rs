//! When a drive is refused, and what is said then.

use adit_planners::channels::corridor::{
    Corridors, Drive, DriveError, End, Extreme, Robot, Steer, StepFacts, Turn,
};
use adit_planners::geometry::{Point, Rect};

use crate::corridor::table2::{corrected, rect};

const ROBOT: Robot = Robot { width: 1.0, length: 1.5 };
const L: [[f64; 4]; 2] = [[0.0, 0.0, 3.0, 9.0], [0.0, 6.0, 9.0, 9.0]];

type Driven = Result<Drive, DriveError<String>>;

fn drive(channels: &[[f64; 4]], ends: [(f64, f64); 2], robot: Robot, gap: f64) -> Driven {
    drive_by(channels, ends, robot, |facts| corrected(facts, gap))
}

fn drive_by(
    channels: &[[f64; 4]],
    [start, goal]: [(f64, f64); 2],
    robot: Robot,
    steer: impl FnMut(&StepFacts) -> Result<Steer, String>,
) -> Driven {
    let channels: Vec<Rect> = channels.iter().copied().map(rect).collect();
    let corridors = Corridors::new(&channels).unwrap();
    let (start, goal) = (Point::new(start.0, start.1), Point::new(goal.0, goal.1));
    let route = corridors.route(start, goal, |passage| Ok::<_, ()>(Some(passage.length))).unwrap();
    route.drive(robot, None, steer)
}

fn says(driven: Driven) -> String {
    driven.unwrap_err().to_string()
}

#[test]
fn a_junction_too_small_for_the_robot_is_told_with_the_gap_that_it_can_keep() {
    let narrow = [[0.0, 0.0, 1.2, 9.0], [0.0, 7.8, 9.0, 9.0]];
    let driven = drive_by(&narrow, [(0.6, 2.0), (7.0, 8.4)], ROBOT, |facts| corrected(facts, facts.safest));
    let expected = "junction 1 (rule 1): the gap is -0.027841 m, expected a finite number that is not \
                    negative; in a channel 1.2 m wide the robot can keep -0.027841 m";
    assert_eq!(says(driven), expected);
}

#[test]
fn a_gap_above_the_safest_one_is_driven_until_a_wall_is_hit() {
    let ends = [(1.5, 2.0), (7.0, 7.5)];
    let wide = drive(&L, ends, ROBOT, 1.0).unwrap();
    let turn = &wide.turns[0];
    assert!(turn.steer.gap > turn.facts.safest && wide.min_clearance < turn.facts.safest);
    let slim = Robot { width: 1.0, length: 4.0 };
    let expected = "junction 1 (rule 1) is too small for the robot with a gap of 0.9 m: turning about (3, 6), its outer \
                    corner reaches 2.758623 m, and the wall from (0.5, 0) to (0.5, 9) is 2.5 m away; the safest gap is \
                    0.178571 m";
    let narrower = [[0.5, 0.0, 3.0, 9.0], [0.5, 6.0, 9.0, 9.0]];
    assert_eq!(says(drive(&narrower, [(1.5, 2.5), (6.0, 7.5)], slim, 0.9)), expected);
}

#[test]
fn start_and_goal_keep_away_from_the_corner_and_from_the_inner_wall() {
    let beside = says(drive(&L, [(2.5, 2.0), (7.0, 7.5)], ROBOT, 0.2));
    let expected = "junction 1 (rule 1): the start (2.5, 2) is 0.5 m to the side of the inner wall, expected at least 0.7 \
                    m (half the robot's width and the gap)";
    assert_eq!(beside, expected);
    let driven = drive(&L, [(1.5, 2.0), (7.0, 6.6)], ROBOT, 0.2);
    assert!(matches!(driven, Err(DriveError::TooNearInnerWall { what: End::Goal, .. })), "{driven:?}");
    let inside = says(drive(&L, [(2.6, 5.8), (7.0, 7.5)], ROBOT, 0.2));
    let expected = "junction 1 (rule 1): the start (2.6, 5.8) is 0.447214 m from the corner (3, 6), expected at least 0.7 \
                    m (half the robot's width and the gap)";
    assert_eq!(inside, expected);
    // exactly as far as the radius is far enough
    assert!(drive(&L, [(2.3, 2.0), (7.0, 6.7)], ROBOT, 0.2).is_ok());
}

#[test]
fn two_junctions_too_near_each_other_for_opposite_turns_are_named() {
    // the corners (3, 6) and (3.5, 7) are 1.118 m apart
    let step = [[0.0, 0.0, 3.0, 7.0], [0.0, 6.0, 7.0, 7.0], [3.5, 6.0, 7.0, 15.0]];
    let small = Robot { width: 0.4, length: 0.4 };
    let ends = [(1.0, 2.0), (5.0, 13.0)];
    let expected = "junctions 1 and 2: their corners are 1.118034 m apart, expected at least 1.2 m for a turn to the \
                    right about 0.6 m and then to the left about 0.6 m";
    assert_eq!(says(drive(&step, ends, small, 0.4)), expected);
    assert!(drive(&step, ends, small, 0.3).is_ok());
}

#[test]
fn a_start_that_is_no_place_for_the_robot_is_told_by_the_wall_that_it_hits() {
    let expected = "the robot hits the wall from (0, 0) to (3, 0) on its way from the start (1.5, 0.5) to junction 1 \
                    (2.30716, 6.099865)";
    assert_eq!(says(drive(&L, [(1.5, 0.5), (7.0, 7.5)], ROBOT, 0.2)), expected);
    let found = says(drive(&L, [(1.5, 2.0), (8.5, 7.5)], ROBOT, 0.2));
    assert!(
        found.starts_with("the robot hits the wall from (9, 6) to (9, 9) on its way from junction 1 ("),
        "{found}"
    );
    assert!(found.ends_with(" to the goal (8.5, 7.5)"), "{found}");
}

#[test]
fn a_robot_and_a_gap_are_numbers_that_make_sense() {
    let ends = [(1.5, 2.0), (7.0, 7.5)];
    for robot in [Robot { width: 0.0, ..ROBOT }, Robot { length: f64::NAN, ..ROBOT }] {
        assert!(matches!(drive(&L, ends, robot, 0.2), Err(DriveError::BadRobot { .. })));
    }
    for gap in [-0.1, f64::NAN, f64::INFINITY] {
        assert!(matches!(drive(&L, ends, ROBOT, gap), Err(DriveError::BadGap { junction: 1, .. })));
    }
    assert!(drive(&L, ends, ROBOT, 0.0).unwrap().min_clearance.abs() < 1e-9, "it slides round the corner");
}

#[test]
fn what_steering_fails_with_is_handed_on() {
    let driven = drive_by(&L, [(1.5, 2.0), (7.0, 7.5)], ROBOT, |_| Err("no rule fires".to_owned()));
    assert_eq!(driven.unwrap_err(), DriveError::Steer("no rule fires".to_owned()));
}

#[test]
fn a_decision_that_is_wrong_in_one_place_misses_its_circle_or_hits_a_wall() {
    let ends = [(1.5, 2.0), (7.0, 7.5)];
    for wrong in 0..4 {
        let steer = |facts: &StepFacts| {
            let right = corrected(facts, 0.2)?;
            Ok(match wrong {
                0 => Steer { turn: Turn::Left, ..right },
                1 => Steer { corner: (Extreme::Max, Extreme::Max), ..right },
                2 => Steer { corner: (Extreme::Min, Extreme::Min), ..right },
                _ => Steer { measured_along: right.measured_along.across(), ..right },
            })
        };
        let driven = drive_by(&L, ends, ROBOT, steer);
        match driven {
            Err(DriveError::HitsOnLine { .. }) if wrong == 1 => {}
            Err(DriveError::NotOnCircle { .. }) if wrong != 1 => {}
            other => panic!("{wrong}: {other:?}"),
        }
    }
}

#[test]
fn a_corner_that_the_way_passes_by_needs_no_turn() {
    let ends = [(0.8, 5.5), (3.4, 8.2)];
    let driven = drive(&L, ends, Robot { width: 0.6, length: 0.8 }, 0.1).unwrap();
    assert_eq!(driven.primitives.len(), 1);
    let turn = &driven.turns[0];
    assert!(turn.angle == 0.0 && turn.arriving == turn.leaving);
    assert!(turn.arriving.distance(turn.corner) > turn.radius);
    assert!((driven.length - 2.6_f64.hypot(2.7)).abs() < 1e-12);
}

#[test]
fn without_a_junction_the_way_is_straight_and_whoever_is_at_the_goal_stands() {
    let driven = drive(&L, [(1.5, 2.0), (1.0, 5.0)], ROBOT, 0.2).unwrap();
    assert!(driven.turns.is_empty() && driven.primitives.len() == 1);
    let standing = drive(&L, [(1.5, 2.0), (1.5, 2.0)], ROBOT, 0.2).unwrap();
    assert!(standing.length == 0.0 && (standing.min_clearance - 1.0).abs() < 1e-9, "{standing:?}");
}
