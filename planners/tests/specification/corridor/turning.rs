//! A robot that starts with another heading than that of its first line.

use std::f64::consts::{PI, TAU};

use adit_planners::channels::corridor::{Corridors, Drive, DriveError, Primitive, Robot};
use adit_planners::geometry::Point;
use proptest::prelude::*;

use crate::corridor::sampled::{nearest, solid};
use crate::corridor::table2::{corrected, rect};

const L: [[f64; 4]; 2] = [[0.0, 0.0, 3.0, 9.0], [0.0, 6.0, 9.0, 9.0]];

fn drive(robot: Robot, start: Point, heading: Option<f64>) -> Result<Drive, DriveError<String>> {
    let corridors = Corridors::new(&L.map(rect)).unwrap();
    let route =
        corridors.route(start, Point::new(7.0, 7.5), |passage| Ok::<_, ()>(Some(passage.length))).unwrap();
    route.drive(robot, heading, |facts| corrected(facts, 0.2))
}

fn headings(drive: &Drive) -> (f64, f64) {
    let Primitive::Line { from_heading, to_heading, .. } = drive.primitives[0] else { panic!("no line") };
    (from_heading, to_heading)
}

#[test]
fn the_robot_turns_the_shorter_way_while_it_drives_its_first_line() {
    let robot = Robot { width: 0.6, length: 0.8 };
    let start = Point::new(1.5, 2.0);
    let free = drive(robot, start, None).unwrap();
    let (along, _) = headings(&free);
    for given in [0.0, 1.0, PI, -1.0, along + TAU, along - 2.0 * TAU, along + 3.0, along - 3.0] {
        let driven = drive(robot, start, Some(given)).unwrap();
        let (from, to) = headings(&driven);
        assert!((from - given).abs() < 1e-12);
        assert!((to - from).abs() <= PI && ((to - along) / TAU - ((to - along) / TAU).round()).abs() < 1e-12);
        assert!(
            (driven.length - free.length).abs() < 1e-12 && driven.primitives.len() == free.primitives.len()
        );
        for pair in driven.primitives.windows(2) {
            let ends = |primitive: &Primitive| match *primitive {
                Primitive::Line { from_heading, to_heading, .. }
                | Primitive::Arc { from_heading, to_heading, .. } => (from_heading, to_heading),
            };
            assert_eq!(ends(&pair[0]).1, ends(&pair[1]).0, "headings go on where they were");
        }
    }
}

#[test]
fn a_turn_that_hits_a_wall_is_refused_and_one_heading_further_on_it_is_not() {
    // 1.2 m to the left wall; its half diagonal is 1.34 m
    let long = Robot { width: 0.6, length: 2.6 };
    let start = Point::new(1.2, 3.0);
    assert!(drive(long, start, Some(1.6)).is_ok());
    let error = drive(long, start, Some(PI)).unwrap_err();
    let says = error.to_string();
    assert!(
        says.starts_with("the robot hits the wall from (0, 0) to (0, 9) on its way from the start (1.2, 3)"),
        "{says}"
    );
    for heading in [f64::NAN, f64::INFINITY] {
        assert!(matches!(drive(long, start, Some(heading)), Err(DriveError::BadHeading { .. })));
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, ..ProptestConfig::default() })]

    /// The clearance while turning is what dense sampling finds, less a micrometre at most.
    #[test]
    fn the_clearance_of_the_turn_is_exact_to_a_micrometre(
        width in 0.3_f64..1.2, length in 0.3_f64..2.4, x in 0.9_f64..2.0, y in 1.5_f64..5.0, heading in -3.2_f64..3.2,
    ) {
        let robot = Robot { width, length };
        let solid = solid(&L.map(rect));
        let start = Point::new(x, y);
        match drive(robot, start, Some(heading)) {
            Ok(drive) => {
                let turning = &drive.primitives[0];
                let found = nearest(robot, turning, &solid);
                prop_assert!(turning.clearance() <= found, "{} instead of {found}", turning.clearance());
                prop_assert!(turning.clearance() >= found - 1e-6, "{} instead of {found}", turning.clearance());
            }
            Err(DriveError::HitsOnLine { .. }) => {
                if let Some(line) = first_line(robot, start, heading) {
                    prop_assert!(nearest(robot, &line, &solid) < 1e-6);
                }
            }
            Err(other) => prop_assert!(
                matches!(other, DriveError::TooNearInnerWall { .. } | DriveError::InsideCircle { .. }), "{other}"
            ),
        }
    }
}

/// The first line of a robot as wide, but so short that it hits nothing; `None` where its turn hits something anyway.
fn first_line(robot: Robot, start: Point, heading: f64) -> Option<Primitive> {
    let short = Robot { width: robot.width, length: 1e-3 };
    drive(short, start, Some(heading)).ok().map(|drive| drive.primitives[0])
}
