//! No path that is executed is in collision: looked at by sampling that shares nothing with the planner.

use std::f64::consts::PI;
use std::sync::Arc;

use adit_planners::adapt::{
    Adapt, Arm, Configuration, Limit, Object, Outcome, Robot, Shape, Strategy, Workcell, between, collision,
};
use adit_planners::geometry::Point;
use geo::{Distance, Euclidean, Line, LineString, Polygon};
use proptest::prelude::*;
use proptest::strategy::Strategy as _;

use super::support::{Table, planner};

const RADIUS: f64 = 0.03;

fn arm(links: usize) -> Arc<dyn Robot> {
    let limits = vec![Limit { low: -PI, high: PI }; links];
    Arc::new(Arm::new(Point::default(), vec![1.9 / links as f64; links], RADIUS, limits).unwrap())
}

/// A star-shaped outline about a place, mostly not convex.
fn object(number: usize, (x, y): (f64, f64), radii: &[f64]) -> Object {
    let step = 2.0 * PI / radii.len() as f64;
    let corner =
        |(k, r): (usize, &f64)| Point::new(x + r * (step * k as f64).cos(), y + r * (step * k as f64).sin());
    Object::fixed(number.to_string(), Shape::new(radii.iter().enumerate().map(corner).collect()).unwrap())
}

/// What is kept between the arm and objects all along a path, metres: half of what counts as touching.
const KEPT_M: f64 = 0.0025;

fn overlap(links: &[Line], objects: &[Object], radius: f64) -> bool {
    objects.iter().any(|object| {
        let ring: Vec<(f64, f64)> = object.corners().iter().map(|c| (c.x, c.y)).collect();
        let polygon = Polygon::new(LineString::from(ring), vec![]);
        links.iter().any(|link| Euclidean.distance(link, &polygon) < radius - 1e-6)
    })
}

fn body(lengths: usize, at: &[f64]) -> Vec<Line> {
    let (mut x, mut y, mut heading, long) = (0.0, 0.0, 0.0, 1.9 / lengths as f64);
    let mut links = Vec::new();
    for angle in at {
        heading += angle;
        let (next_x, next_y) = (x + long * f64::cos(heading), y + long * f64::sin(heading));
        links.push(Line::new((x, y), (next_x, next_y)));
        (x, y) = (next_x, next_y);
    }
    links
}

fn is_free(links: usize, path: &[Configuration], objects: &[Object], radius: f64) -> bool {
    path.windows(2).all(|motion| {
        (0..=150).all(|k| {
            !overlap(&body(links, &between(&motion[0], &motion[1], f64::from(k) / 150.0)), objects, radius)
        })
    })
}

type Outline = ((f64, f64), Vec<f64>);

fn outlines(count: usize) -> impl proptest::strategy::Strategy<Value = Vec<Outline>> {
    let place = (0.45..1.7_f64, -PI..PI).prop_map(|(r, a)| (r * a.cos(), r * a.sin()));
    prop::collection::vec((place, prop::collection::vec(0.05..0.3_f64, 3..9)), count)
}

fn cell(outlines: &[Outline]) -> Vec<Object> {
    outlines.iter().enumerate().map(|(number, (at, radii))| object(number, *at, radii)).collect()
}

/// Does tasks, has objects come and go, and does more of them; all paths, with the objects that there were.
fn run(
    links: usize,
    before: &[Outline],
    after: &[Outline],
    goals: &[Vec<f64>],
    strategy: Strategy,
) -> Vec<(Vec<Configuration>, Vec<Object>)> {
    let mut adapt = planner(arm(links), cell(before), &vec![0.0; links]);
    let mut judge = Table(strategy);
    let mut paths = Vec::new();
    for (task, goal) in goals.iter().enumerate() {
        let objects = if task * 2 < goals.len() { cell(before) } else { cell(after) };
        adapt.change(objects.clone(), &mut judge).unwrap();
        let report = adapt.task(&goal[..links], &mut judge);
        if report.outcome == Outcome::Found {
            assert_eq!(report.path.last(), Some(&goal[..links].to_vec()));
            paths.push((report.path, objects));
        } else {
            adapt.put(goal[..links].to_vec());
        }
    }
    paths
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    #[test]
    fn executed_paths_keep_off_objects(
        before in outlines(4),
        after in outlines(4),
        goals in prop::collection::vec(prop::collection::vec(-2.6..2.6_f64, 4), 12),
        links in 1_usize..5,
        strategy in prop::sample::select(vec![
            Strategy::Forget, Strategy::VerifyAll, Strategy::RepairAll, Strategy::OnDemand,
        ]),
    ) {
        for (path, objects) in run(links, &before, &after, &goals, strategy) {
            prop_assert!(is_free(links, &path, &objects, RADIUS + KEPT_M));
        }
    }

    #[test]
    fn the_check_before_execution_finds_what_sampling_finds_and_nothing_else(
        outlines in outlines(3),
        from in prop::collection::vec(-2.6..2.6_f64, 3),
        to in prop::collection::vec(-2.6..2.6_f64, 3),
    ) {
        let objects = cell(&outlines);
        let path = vec![from, to];
        let hit = collision(arm(3).as_ref(), &objects, &path);
        if !is_free(3, &path, &objects, RADIUS) {
            prop_assert!(hit.is_some(), "the motion is in collision");
        }
        if let Some(hit) = hit {
            let at = between(&path[0], &path[1], hit.share);
            let named: Vec<Object> = objects.into_iter().filter(|object| object.name == hit.object).collect();
            prop_assert!(overlap(&body(3, &at), &named, RADIUS + 2e-6));
        }
    }
}

#[test]
fn a_judge_that_trusts_everything_is_saved_by_the_check_before_execution() {
    struct Trusting;
    impl adit_planners::adapt::Judge for Trusting {
        fn strategy(&mut self, _: &adit_planners::adapt::ChangeFacts) -> Strategy {
            Strategy::OnDemand
        }
        fn landmark(&mut self, _: &adit_planners::adapt::LandmarkFacts<'_>) -> Option<f64> {
            None
        }
        fn trust(&mut self, _: &adit_planners::adapt::EdgeFacts) -> adit_planners::adapt::Trust {
            adit_planners::adapt::Trust::AsItIs
        }
    }
    let mut adapt: Adapt = planner(arm(2), vec![], &[-1.0, 0.0]);
    assert_eq!(adapt.task(&[1.0, 0.0], &mut Trusting).path.len(), 2);
    let post = object(0, (1.5, 0.0), &[0.1; 6]);
    adapt.change(vec![post.clone()], &mut Trusting).unwrap();
    let back = adapt.task(&[-1.0, 0.0], &mut Trusting);
    assert_eq!((back.outcome, back.tally.refusals), (Outcome::Found, 1));
    assert!(is_free(2, &back.path, &[post], RADIUS));
}

#[test]
fn evaluations_are_counted_wherever_the_shape_of_an_object_is_read() {
    let objects = cell(&[((1.2, 0.0), vec![0.1; 5])]);
    let count = Workcell::new(arm(2), objects, 0.005).unwrap().evaluations();
    assert_eq!(count, 0);
}
