//! What learning saves by the clock, counted: evaluations, and how often the robot's body is worked out.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use adit_planners::adapt::{
    Adapt, Configuration, Limit, Links, Outcome, PointRobot, Robot, Settings, Strategy, Workcell,
};
use adit_planners::pose::Pose;

use super::support::{Table, arm, planner, plugins, rect};

/// A robot that counts how often its body is asked for.
#[derive(Debug)]
struct Counted {
    robot: Arc<dyn Robot>,
    bodies: Arc<AtomicU64>,
}

impl Robot for Counted {
    fn limits(&self) -> &[Limit] {
        self.robot.limits()
    }

    fn links(&self, at: &[f64]) -> Links {
        self.bodies.fetch_add(1, Ordering::Relaxed);
        self.robot.links(at)
    }

    fn travel(&self, from: &[f64], to: &[f64]) -> Vec<f64> {
        self.robot.travel(from, to)
    }

    fn bend(&self, from: &[f64], to: &[f64]) -> Vec<f64> {
        self.robot.bend(from, to)
    }

    fn tool(&self, at: &[f64]) -> Pose {
        self.robot.tool(at)
    }

    fn branch(&self, at: &[f64]) -> u8 {
        self.robot.branch(at)
    }

    fn inverse(&self, tool: &Pose, branch: u8, near: &[f64]) -> Option<Configuration> {
        self.robot.inverse(tool, branch, near)
    }
}

#[test]
fn one_evaluation_beside_a_wall_tells_that_all_this_side_of_it_is_free() {
    let limits = [Limit { low: -10.0, high: 10.0 }; 2];
    let robot = Arc::new(PointRobot::new(limits, 0.1));
    let wall = rect("wall", [-9.0, 0.12, 9.0, 0.3]);
    let mut adapt = planner(robot, vec![wall], &[-8.0, 0.0]);
    let report = adapt.task(&[8.0, 0.0], &mut Table(Strategy::OnDemand));
    assert_eq!((report.outcome, report.path.len()), (Outcome::Found, 2));
    // Spheres of 2 cm of slack each would take hundreds.
    assert!(report.evaluations <= 3, "{} evaluations", report.evaluations);
}

#[test]
fn a_way_that_was_gone_before_takes_next_to_no_work() {
    let bodies = Arc::new(AtomicU64::new(0));
    let robot = Arc::new(Counted { robot: arm(), bodies: Arc::clone(&bodies) });
    let posts = vec![
        rect("front", [1.1, 0.2, 1.5, 0.6]),
        rect("left", [0.1, 1.1, 0.5, 1.5]),
        rect("back", [-1.3, 0.7, -0.9, 1.1]),
        rect("right", [0.6, -1.4, 1.0, -1.0]),
    ];
    let home = vec![3.0, 0.0];
    let cell = Workcell::new(robot, posts, 0.005).unwrap();
    let mut adapt = Adapt::new(cell, plugins(), Settings::default(), home.clone());
    let goals = [vec![0.9, -0.4], vec![-0.6, 0.4], home];
    let mut go = |goal: &Configuration| {
        let before = bodies.load(Ordering::Relaxed);
        assert_eq!(adapt.task(goal, &mut Table(Strategy::OnDemand)).outcome, Outcome::Found);
        bodies.load(Ordering::Relaxed) - before
    };
    let learning: u64 = goals.iter().map(&mut go).sum();
    let settling: u64 = goals.iter().map(&mut go).sum();
    let known: u64 = goals.iter().map(&mut go).sum();
    // Where it is and where it goes to are looked at each time; the way itself is known to be free, and was checked.
    assert!(known <= 4 * 3, "{known} bodies after {learning} and {settling}");
}
