//! On maps that robots drew, routes cost hardly more than the best way, and lie in the free space throughout.

use adit_planners::geometry::Point;
use adit_tests::oracle::body::Body;
use adit_tests::oracle::judge::Judge;
use adit_tests::oracle::random::Chance;
use adit_tests::oracle::site::Built;
use adit_tests::shared;

/// A robot that tucks its arms in, and can lie flat and slim.
fn body() -> Body {
    Body::new(&[("DRIVE", 1.2, 0.35, 1.0), ("TUCKED", 0.5, 0.22, 3.0)])
        .with_changes(&[(0, 1, 0.5), (1, 0, 0.5)])
}

#[track_caller]
fn judged(map: &str, start: (f64, f64), count: usize) {
    let Some(file) = shared(map) else { return };
    let built = Built::of_map(&file, &body());
    let side = built.world.occupancy.as_ref().expect("an image").resolution;
    let judge = Judge::new(&built, side);
    let mut chance = Chance::new(7);
    let goals = judge.points(&mut chance, count);
    let found = judge.judge(map, Point::new(start.0, start.1), &goals, side);
    found.print(map);
    assert!(found.exact.count() >= count / 2, "hardly a goal can be reached");
    found.expect_good();
}

#[test]
fn nav2_depot() {
    judged("data/nav2/depot.yaml", (2.0, 7.0), 16);
}

#[test]
fn nav2_tb3_sandbox() {
    judged("data/nav2/tb3_sandbox.yaml", (-2.0, -0.5), 12);
}

#[test]
fn turtlebot3_world() {
    judged("data/turtlebot3/map.yaml", (-2.0, -0.5), 12);
}

#[test]
fn aws_bookstore() {
    judged("data/aws-robomaker/bookstore_map.yaml", (-2.5, 6.2), 16);
}

#[test]
fn aws_small_warehouse() {
    judged("data/aws-robomaker/small_warehouse_005_map.yaml", (-4.0, -2.85), 16);
}

#[test]
fn mir_maze() {
    judged("data/mir_robot/maze.yaml", (2.0, 2.0), 16);
}

#[test]
fn stage_lse_arena() {
    judged("data/stage/lse_arena.yaml", (0.6, 0.6), 16);
}
