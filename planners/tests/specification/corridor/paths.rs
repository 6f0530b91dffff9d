//! The eight rules one by one, and the corridors of Figure 8.

use adit_planners::channels::corridor::{Corridors, Drive, DriveError, Primitive, Robot};
use adit_planners::geometry::{Point, Rect};

use crate::corridor::table2::{as_printed, corrected, point, rect};
use crate::corridor::verified::{CASES, CORRIDORS, Case, Leaving};

const ROBOT: Robot = Robot { width: 1.0, length: 1.5 };

/// Short, so that no wall is in the way of the larger gaps.
const SHORT: Robot = Robot { width: 1.0, length: 0.2 };

fn assert_near(found: Point, expected: (f64, f64), what: &str) {
    assert!(found.distance(point(expected)) < 2e-6, "{what}: found {found:?}, expected {expected:?}");
}

fn hull(one: Rect, other: Rect) -> Rect {
    Rect::new(one.x0.min(other.x0), one.y0.min(other.y0), one.x1.max(other.x1), one.y1.max(other.y1))
}

/// Channels for a case: one from its start through the junction, one to the next junction, one on from there the way
/// that the next rule turns; with the goal at its end.
fn channels(case: &Case, leaving: &Leaving) -> ([Rect; 3], Point) {
    let (junction, next) = (rect(case.junction), rect(case.next_junction));
    let from = point(case.from);
    let around = Rect::new(from.x - 1.0, from.y - 1.0, from.x + 1.0, from.y + 1.0);
    let around = if case.rule <= 4 {
        Rect { x0: junction.x0, x1: junction.x1, ..around }
    } else {
        Rect { y0: junction.y0, y1: junction.y1, ..around }
    };
    let (dx, dy) = [(6.0, 0.0), (-6.0, 0.0), (0.0, 6.0), (0.0, -6.0)][(leaving.next_rule as usize - 1) / 2];
    let far = Rect::new(next.x0 + dx, next.y0 + dy, next.x1 + dx, next.y1 + dy);
    ([hull(around, junction), hull(junction, next), hull(next, far)], far.centre())
}

fn drive(case: &Case, leaving: &Leaving) -> Drive {
    let (channels, goal) = channels(case, leaving);
    let corridors = Corridors::new(&channels).unwrap();
    let route = corridors.route(point(case.from), goal, |passage| Ok::<_, ()>(Some(passage.length))).unwrap();
    assert_eq!(route.junctions(), [1, 2]);
    route.drive(SHORT, None, |facts| corrected(facts, case.gap)).unwrap()
}

#[test]
fn each_rule_gives_its_arriving_point_and_leaves_towards_either_sense() {
    for case in &CASES {
        for leaving in &case.leaving {
            let what = format!("rule {} then {}", case.rule, leaving.next_rule);
            let drive = drive(case, leaving);
            let rules: Vec<_> = drive.turns.iter().map(|turn| turn.steer.rule.unwrap()).collect();
            assert_eq!(rules, [case.rule, leaving.next_rule]);
            let first = &drive.turns[0];
            assert_near(first.arriving, case.arriving, &what);
            assert!((first.theta.to_degrees() - case.theta_degrees).abs() < 1e-6, "{what}: {}", first.theta);
            assert_near(first.leaving, leaving.from, &what);
            assert_near(drive.turns[1].arriving, leaving.to, &what);
            let Primitive::Line { from_heading, .. } = drive.primitives[2] else { panic!("{what}: no line") };
            let off = from_heading.to_degrees() - leaving.heading_degrees;
            assert!((off - 360.0 * (off / 360.0).round()).abs() < 1e-6, "{what}: heading {from_heading}");
            assert!((drive.primitives[1].length() - leaving.arc).abs() < 1e-6, "{what}");
            assert!((drive.primitives[2].length() - leaving.line).abs() < 1e-6, "{what}");
        }
    }
}

#[test]
fn as_the_paper_prints_them_only_the_first_rule_touches_its_circle() {
    for case in &CASES {
        let (channels, goal) = channels(case, &case.leaving[0]);
        let corridors = Corridors::new(&channels).unwrap();
        let route =
            corridors.route(point(case.from), goal, |passage| Ok::<_, ()>(Some(passage.length))).unwrap();
        let drive = route.drive(SHORT, None, |facts| {
            if facts.junction == 1 { as_printed(facts, case.gap) } else { corrected(facts, case.gap) }
        });
        if case.rule == 1 {
            assert_near(drive.unwrap().turns[0].arriving, case.as_printed, "rule 1");
            continue;
        }
        let error = drive.unwrap_err();
        let says = error.to_string();
        assert!(
            says.starts_with(&format!("junction 1 (rule {}): the arriving point (", case.rule)),
            "{says}"
        );
        let DriveError::NotOnCircle { arriving, tangent, .. } = error else { panic!("{says}") };
        assert_near(arriving, case.as_printed, &says);
        assert_near(tangent, case.arriving, &says);
    }
}

#[test]
fn corridors_like_l_u_and_s_are_driven_as_verified_at_every_gap() {
    for corridor in &CORRIDORS {
        let channels: Vec<Rect> = corridor.channels.iter().copied().map(rect).collect();
        let corridors = Corridors::new(&channels).unwrap();
        let (start, goal) = (point(corridor.start), point(corridor.goal));
        let route = corridors.route(start, goal, |passage| Ok::<_, ()>(Some(passage.length))).unwrap();
        for path in corridor.paths {
            let what = format!("{} at {:?}", corridor.name, path.gap);
            let drive =
                route.drive(ROBOT, None, |facts| corrected(facts, path.gap.unwrap_or(facts.safest))).unwrap();
            let rules: Vec<_> = drive.turns.iter().map(|turn| turn.steer.rule.unwrap()).collect();
            assert_eq!(rules, path.rules, "{what}");
            assert!((drive.length - path.length).abs() < 1e-5, "{what}: {}", drive.length);
            assert!(
                (drive.min_clearance - path.min_clearance).abs() < 1e-5,
                "{what}: {}",
                drive.min_clearance
            );
            let ends = |primitive: &Primitive| match *primitive {
                Primitive::Line { a, b, .. } | Primitive::Arc { a, b, .. } => [a, b],
            };
            let points: Vec<[Point; 2]> = drive.primitives.iter().map(ends).collect();
            assert_eq!(points.len() + 1, path.points.len(), "{what}");
            for ([a, b], expected) in points.iter().zip(path.points.windows(2)) {
                assert_near(*a, expected[0], &what);
                assert_near(*b, expected[1], &what);
            }
        }
    }
}

#[test]
fn the_safest_gap_of_the_example_is_the_one_in_closed_form() {
    let safest: f64 = (9.0 - 1.0 - 1.5 * 1.5 / 4.0) / 8.0;
    assert!((ROBOT.safest(3.0) - safest).abs() < 1e-15);
    assert!((safest - 0.929_688).abs() < 1e-6);
}

#[test]
fn far_from_the_origin_the_same_is_driven() {
    let (east, north) = (4_512_345.678, -987_654.321);
    for corridor in &CORRIDORS {
        let moved = |r: &[f64; 4]| rect([r[0] + east, r[1] + north, r[2] + east, r[3] + north]);
        let channels: Vec<Rect> = corridor.channels.iter().map(moved).collect();
        let corridors = Corridors::new(&channels).unwrap();
        let at = |(x, y): (f64, f64)| Point::new(x + east, y + north);
        let (start, goal) = (at(corridor.start), at(corridor.goal));
        let route = corridors.route(start, goal, |passage| Ok::<_, ()>(Some(passage.length))).unwrap();
        for path in corridor.paths {
            let drive =
                route.drive(ROBOT, None, |facts| corrected(facts, path.gap.unwrap_or(facts.safest))).unwrap();
            assert!((drive.length - path.length).abs() < 1e-5, "{}: {}", corridor.name, drive.length);
            assert!((drive.min_clearance - path.min_clearance).abs() < 1e-5, "{}", corridor.name);
        }
    }
}
