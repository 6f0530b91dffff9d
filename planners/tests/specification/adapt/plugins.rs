//! Reach that slides, and Solve that was taught.

use std::sync::Arc;

use adit_planners::adapt::{
    Adapt, Limit, Outcome, Plugins, PointRobot, Reach, RrtConnect, Settings, Straight, Strategy, Taught,
    Workcell,
};

use super::sliding::Sliding;
use super::support::{Table, rect};

fn planner(plugins: Plugins) -> Adapt {
    let robot = PointRobot::new([Limit { low: 0.0, high: 10.0 }; 2], 0.2);
    let cell = Workcell::new(Arc::new(robot), vec![rect("box", [4.0, 2.0, 6.0, 6.0])], 0.005).unwrap();
    let settings = Settings { cuts_corners: false, tightens: false, ..Settings::default() };
    Adapt::new(cell, plugins, settings, vec![1.0, 5.0])
}

#[test]
fn sliding_goes_round_a_corner_where_straight_has_to_solve() {
    let rrt = Arc::new(RrtConnect::default());
    let calls = |reach: Arc<dyn Reach>| {
        let mut adapt = planner(Plugins { reach, solve: rrt.clone() });
        let mut solves = Vec::new();
        for goal in [[9.0, 7.0], [1.0, 5.0]] {
            let report = adapt.task(&goal, &mut Table(Strategy::OnDemand));
            assert_eq!(report.outcome, Outcome::Found);
            solves.push(report.tally.solves);
        }
        solves
    };
    assert_eq!(calls(Arc::new(Straight)), [1, 0]);
    assert_eq!(calls(Arc::new(Sliding { step: 0.25, steps: 40 })), [0, 0]);
}

#[test]
fn a_taught_path_is_used_either_way_and_only_while_it_is_free() {
    let lesson = vec![vec![1.0, 5.0], vec![1.0, 9.0], vec![9.0, 9.0], vec![9.0, 5.0]];
    let taught = Taught::new(vec![lesson.clone()], RrtConnect { step: 0.6, samples: 0 });
    let mut adapt = planner(Plugins { reach: Arc::new(Straight), solve: Arc::new(taught) });
    let mut judge = Table(Strategy::Forget);
    let there = adapt.task(&[9.0, 5.0], &mut judge);
    assert_eq!((there.outcome, there.tally.solves), (Outcome::Found, 1));
    assert_eq!(adapt.task(&[1.0, 5.0], &mut judge).path, there.path.into_iter().rev().collect::<Vec<_>>());
    let cell = vec![rect("box", [4.0, 2.0, 6.0, 6.0]), rect("lid", [4.0, 6.5, 6.0, 9.5])];
    adapt.change(cell, &mut judge).unwrap();
    assert_eq!(adapt.task(&[9.0, 5.0], &mut judge).outcome, Outcome::NotFound);
}
