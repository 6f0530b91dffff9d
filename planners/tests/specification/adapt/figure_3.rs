//! The eight frames of Figure 3, with geometry of our own: a point robot, a Reach that goes straight, and a Solve of at most two steps.

use std::sync::Arc;

use adit_planners::adapt::{
    Adapt, Limit, Noted, Object, Outcome, Plugins, PointRobot, Removal, Report, Settings, Straight, Strategy,
    Workcell,
};

use super::support::{Table, edges, moved, places, rect};
use super::two_step::TwoStep;

const HOME: [f64; 2] = [4.5, 5.0];
const W1: [f64; 2] = [2.5, 7.5];
const W2: [f64; 2] = [0.5, 5.0];
const W3: [f64; 2] = [7.0, 3.5];
const W4: [f64; 2] = [6.5, 7.5];

/// The edges of frame 5, by the numbers of the paper's vertices.
const EIGHT: [(u32, u32); 8] = [(0, 1), (0, 5), (1, 2), (1, 3), (1, 5), (2, 3), (3, 4), (5, 6)];

fn a() -> Object {
    rect("A", [1.0, 4.0, 4.0, 7.0])
}

fn b() -> Object {
    rect("B", [6.0, 4.0, 9.0, 7.0])
}

/// C between home and v1, as in frame 6.
fn c_in_the_way() -> Object {
    rect("C", [4.1, 5.9, 4.5, 6.1])
}

/// C in the corner of B, as in frame 8.
fn c_in_the_corner() -> Object {
    rect("C", [5.5, 4.1, 5.7, 4.8])
}

fn planner() -> Adapt {
    let limits = [Limit { low: 0.0, high: 10.0 }; 2];
    let cell = Workcell::new(Arc::new(PointRobot::new(limits, 0.0)), vec![a(), b()], 0.005).unwrap();
    let plugins = Plugins { reach: Arc::new(Straight), solve: Arc::new(TwoStep { values: 21 }) };
    let settings =
        Settings { keeps_goals: false, tightens: false, chain_step: f64::INFINITY, ..Settings::default() };
    Adapt::new(cell, plugins, settings, HOME.to_vec())
}

fn go(adapt: &mut Adapt, to: [f64; 2], strategy: Strategy) -> Report {
    let report = adapt.task(&to, &mut Table(strategy));
    assert_eq!(report.outcome, Outcome::Found);
    report
}

/// Frames 1 to 5, and back home.
fn after_frame_5(strategy: Strategy) -> Adapt {
    let mut adapt = planner();
    for goal in [W1, W2, W3, W4, HOME] {
        go(&mut adapt, goal, strategy);
    }
    assert_eq!(edges(&adapt), EIGHT);
    adapt.take_noted();
    adapt
}

fn change(adapt: &mut Adapt, objects: Vec<Object>, strategy: Strategy) -> (u64, u64) {
    let evaluations = adapt.cell().evaluations();
    let changed = adapt.change(objects, &mut Table(strategy)).unwrap().expect("something changed");
    assert_eq!(changed.evaluations, adapt.cell().evaluations() - evaluations);
    (changed.solves, changed.evaluations)
}

/// The edges that went since this was last asked, and why.
fn removed(adapt: &mut Adapt) -> Vec<((u32, u32), Removal)> {
    let gone = |noted| match noted {
        Noted::EdgeRemoved { ends, why, .. } => Some(((ends.0.0, ends.1.0), why)),
        _ => None,
    };
    adapt.take_noted().into_iter().filter_map(gone).collect()
}

#[test]
fn frames_1_to_5_learn_a_graph_with_two_shortcuts() {
    let mut adapt = planner();
    assert_eq!((places(&adapt), edges(&adapt)), (vec![HOME.to_vec()], vec![]));

    let first = go(&mut adapt, W1, Strategy::OnDemand);
    assert_eq!((first.tally.solves, edges(&adapt)), (1, vec![(0, 1), (1, 2)]));
    assert_eq!(first.path, places(&adapt), "along v0, v1, v2");

    let second = go(&mut adapt, W2, Strategy::OnDemand);
    assert_eq!((second.tally.solves, second.tally.edges_added), (1, 2));
    assert_eq!(edges(&adapt), [(0, 1), (1, 2), (2, 3), (3, 4)], "S extends from v2");

    let third = go(&mut adapt, W3, Strategy::OnDemand);
    assert_eq!((third.tally.solves, third.tally.edges_added), (1, 4));
    assert_eq!(edges(&adapt), EIGHT, "S extends from v0, and the corners at v2 and v0 are cut");
    let v = places(&adapt);
    assert_eq!(third.path, [4, 3, 1, 5, 6].map(|vertex: usize| v[vertex].clone()));

    let fourth = go(&mut adapt, W4, Strategy::OnDemand);
    assert_eq!((fourth.tally.solves, edges(&adapt)), (0, EIGHT.to_vec()));
    assert_eq!(fourth.path, [v[6].clone(), v[5].clone(), v[1].clone(), W4.to_vec()], "w4 is reached from v1");
}

#[test]
fn frame_6_forgets_everything_with_a0() {
    let mut adapt = after_frame_5(Strategy::Forget);
    assert_eq!(change(&mut adapt, vec![a(), b(), c_in_the_way()], Strategy::Forget), (0, 0));
    assert_eq!((places(&adapt), edges(&adapt)), (vec![HOME.to_vec()], vec![]));
    assert!(adapt.take_noted().contains(&Noted::Forgotten));
    assert_eq!(go(&mut adapt, W1, Strategy::Forget).tally.solves, 1);
}

#[test]
fn frame_6_breaks_one_of_eight_edges_and_a1_and_a2_remove_it_at_once() {
    for strategy in [Strategy::VerifyAll, Strategy::RepairAll] {
        let mut adapt = after_frame_5(strategy);
        let (solves, evaluations) = change(&mut adapt, vec![a(), b(), c_in_the_way()], strategy);
        assert!(solves == 0 && evaluations > 0, "{strategy:?}");
        assert_eq!(removed(&mut adapt), [((0, 1), Removal::Broken)], "{strategy:?}");
        assert_eq!(edges(&adapt), EIGHT[1..], "{strategy:?}");
    }
}

#[test]
fn frame_6_does_nothing_with_a3_until_a_task_comes_upon_the_broken_edge() {
    let mut adapt = after_frame_5(Strategy::OnDemand);
    assert_eq!(change(&mut adapt, vec![a(), b(), c_in_the_way()], Strategy::OnDemand), (0, 0));
    assert_eq!(edges(&adapt), EIGHT);

    let report = go(&mut adapt, W1, Strategy::OnDemand);
    assert_eq!(report.tally.solves, 0, "v1 is still reached by way of v5");
    let noted = adapt.take_noted();
    let broken = noted.iter().find_map(|noted| match noted {
        Noted::EdgeRemoved { ends, why, object, .. } => Some((ends.0.0, ends.1.0, *why, object.clone())),
        _ => None,
    });
    assert_eq!(broken, Some((0, 1, Removal::Broken, Some("C".to_owned()))));
    assert_eq!(edges(&adapt), EIGHT[1..]);
}

/// Frames 6 and 7: C came, the broken edge was found, the robot is at home, and B was moved.
fn after_frame_7(strategy: Strategy) -> Adapt {
    let mut adapt = after_frame_5(strategy);
    change(&mut adapt, vec![a(), b(), c_in_the_way()], strategy);
    go(&mut adapt, W1, strategy);
    go(&mut adapt, HOME, strategy);
    let before = places(&adapt);
    let (solves, _) = change(&mut adapt, vec![a(), moved(&b(), 0.5, 0.0, 0.0), c_in_the_way()], strategy);
    assert_eq!(solves, 0);
    let after = places(&adapt);
    for vertex in 0..7 {
        let by = if vertex < 5 { 0.0 } else { 0.5 };
        let shifted = [before[vertex][0] + by, before[vertex][1]];
        assert!(
            (after[vertex][0] - shifted[0]).abs() < 1e-12 && (after[vertex][1] - shifted[1]).abs() < 1e-12
        );
    }
    assert_eq!(edges(&adapt), EIGHT[1..], "{strategy:?}");
    adapt.take_noted();
    adapt
}

#[test]
fn frame_7_moves_the_subgoals_of_b_along_with_it() {
    for strategy in [Strategy::VerifyAll, Strategy::RepairAll, Strategy::OnDemand] {
        let mut adapt = after_frame_7(strategy);
        let report = go(&mut adapt, [W3[0] + 0.5, W3[1]], strategy);
        assert_eq!((report.tally.solves, report.tally.edges_added, report.tally.edges_removed), (0, 0, 0));
        let v = places(&adapt);
        assert_eq!(report.path[..2], [v[0].clone(), v[5].clone()], "{strategy:?}");
    }
}

/// Frame 8: C goes to the corner.
fn frame_8(strategy: Strategy) -> (Adapt, u64) {
    let mut adapt = after_frame_7(strategy);
    let objects = vec![a(), moved(&b(), 0.5, 0.0, 0.0), c_in_the_corner()];
    let (solves, _) = change(&mut adapt, objects, strategy);
    (adapt, solves)
}

#[test]
fn frame_8_leaves_a1_the_home_vertex_after_it_verified_seven_edges() {
    let (mut adapt, solves) = frame_8(Strategy::VerifyAll);
    assert_eq!((solves, edges(&adapt), places(&adapt)), (0, vec![], vec![HOME.to_vec()]));
    let gone = removed(&mut adapt);
    let of = |why| gone.iter().filter(|edge| edge.1 == why).map(|edge| edge.0).collect::<Vec<_>>();
    assert_eq!(of(Removal::Broken), [(0, 5), (1, 5)]);
    assert_eq!(of(Removal::CutOff).len(), 5);
}

#[test]
fn frame_8_takes_a2_two_calls_of_solve() {
    let (mut adapt, solves) = frame_8(Strategy::RepairAll);
    assert_eq!(solves, 2);
    for goal in [W1, W2] {
        assert_eq!(go(&mut adapt, goal, Strategy::RepairAll).tally.solves, 0);
    }
}

#[test]
fn frame_8_takes_a3_one_call_of_solve_where_b_is_not_inspected_any_more() {
    let (mut adapt, solves) = frame_8(Strategy::OnDemand);
    assert_eq!(solves, 0);
    assert_eq!(edges(&adapt).len(), 7);
    let calls: u64 =
        [W1, W2, W1, HOME].map(|goal| go(&mut adapt, goal, Strategy::OnDemand).tally.solves).iter().sum();
    assert_eq!(calls, 1);
}

#[test]
fn frame_8_takes_a3_the_second_call_where_b_is_inspected_again() {
    let (mut adapt, _) = frame_8(Strategy::OnDemand);
    let b = [W3[0] + 0.5, W3[1]];
    let calls: u64 =
        [W1, HOME, b].map(|goal| go(&mut adapt, goal, Strategy::OnDemand).tally.solves).iter().sum();
    assert_eq!(calls, 2);
}
