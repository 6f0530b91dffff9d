//! What cannot be is said, and nothing is learned from it.

use adit_planners::adapt::{
    Adapt, Object, Outcome, Placed, Plugins, Scenario, Settings, Shape, ShapeError, Strategy, Workcell,
    WorkcellError,
};
use adit_planners::geometry::Point;

use super::arm_scenario::{ArmScenario, ScenarioError};
use super::support::{Table, arm, moved, planner, rect};

/// The arm points to the left, and a box stands on its right.
fn with_box_on_the_right() -> Adapt {
    planner(arm(), vec![rect("box", [1.2, -0.2, 1.6, 0.2])], &[2.5, 0.0])
}

#[test]
fn a_goal_in_collision_is_a_clear_no() {
    let mut adapt = with_box_on_the_right();
    let report = adapt.task(&[0.0, 0.0], &mut Table(Strategy::OnDemand));
    assert_eq!(report.outcome, Outcome::GoalInCollision("box".to_owned()));
    assert!(report.path.is_empty() && report.evaluations > 0);
    assert_eq!(adapt.progress().here, [2.5, 0.0]);
    assert_eq!(adapt.experience().vertices().count(), 1);
}

#[test]
fn a_goal_beyond_the_limits_or_of_another_arm_is_a_clear_no() {
    let mut adapt = with_box_on_the_right();
    for goal in [&[0.5, 2.8][..], &[0.5][..], &[f64::NAN, 0.0][..], &[]] {
        let report = adapt.task(goal, &mut Table(Strategy::OnDemand));
        assert_eq!((report.outcome, report.evaluations), (Outcome::GoalBeyondLimits, 0));
    }
}

#[test]
fn a_start_in_collision_is_a_clear_no_until_the_object_goes() {
    let mut adapt = with_box_on_the_right();
    let box_there = rect("box", [1.2, -0.2, 1.6, 0.2]);
    let mut judge = Table(Strategy::OnDemand);
    adapt.change(vec![moved(&box_there, -2.8, 1.0, 0.0)], &mut judge).unwrap();
    let report = adapt.task(&[1.5, 0.0], &mut judge);
    assert_eq!(report.outcome, Outcome::StartInCollision("box".to_owned()));
    adapt.change(vec![box_there], &mut judge).unwrap();
    assert_eq!(adapt.task(&[1.5, 0.0], &mut judge).outcome, Outcome::Found);
}

#[test]
fn a_goal_that_is_walled_off_is_not_found_and_other_goals_are() {
    let pillars = [[0.0, 0.35, 0.2, 0.6], [0.0, -0.6, 0.2, -0.35]];
    let objects = pillars.iter().enumerate().map(|(i, r)| rect(&format!("pillar {i}"), *r)).collect();
    let mut adapt = planner(arm(), objects, &[2.5, 0.0]);
    let mut judge = Table(Strategy::OnDemand);
    assert_eq!(adapt.task(&[0.0, 0.3], &mut judge).outcome, Outcome::NotFound);
    assert_eq!(adapt.task(&[-2.0, 0.5], &mut judge).outcome, Outcome::NotFound, "joints do not wrap");
    assert_eq!(adapt.task(&[2.0, 0.5], &mut judge).outcome, Outcome::Found);
}

#[test]
fn two_objects_of_one_name_and_objects_nowhere_are_no_cell() {
    let one = rect("box", [1.2, -0.2, 1.6, 0.2]);
    let same = Workcell::new(arm(), vec![one.clone(), moved(&one, 0.0, 1.0, 0.0)], 0.005);
    assert_eq!(same.unwrap_err(), WorkcellError::SameName("box".to_owned()));
    let nowhere = vec![moved(&one, f64::NAN, 0.0, 0.0)];
    assert_eq!(
        with_box_on_the_right().change(nowhere.clone(), &mut Table(Strategy::Forget)).unwrap_err(),
        WorkcellError::NotFinite("box".to_owned())
    );
    let placed = nowhere.into_iter().map(|object| Placed::with(object, 0, 0)).collect();
    assert!(Workcell::resume(arm(), placed, 3, 0.005).is_err());
}

fn scenario() -> ArmScenario {
    ArmScenario {
        name: "test".to_owned(),
        links: vec![1.0, 0.9],
        link_radius: 0.03,
        base: [0.0, 0.0],
        joint_limits: vec![[-3.0, 3.0], [-2.7, 2.7]],
        wrap: false,
        obstacles: vec![vec![[1.2, -0.2], [1.6, -0.2], [1.4, 0.2]]],
        added_obstacle: Some(vec![[1.2, 0.8], [1.6, 0.8], [1.4, 1.2]]),
        added_obstacles: Vec::new(),
        change_after_task: 5,
        tasks: 10,
        home: vec![2.5, 0.0],
        goals: vec![vec![1.0, 1.0], vec![-1.0, 1.0]],
        added_goal: Some(vec![2.0, 0.0]),
        added_goals: Vec::new(),
    }
}

#[test]
fn a_scenario_says_what_is_wrong_with_it() {
    let error = |file: &ArmScenario| Scenario::try_from(file).unwrap_err();
    assert!(Scenario::try_from(&scenario()).is_ok());
    let crossing = vec![[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
    let crosses = ShapeError::SelfCrossing(0, 2);
    assert_eq!(
        error(&ArmScenario { obstacles: vec![crossing.clone()], ..scenario() }),
        ScenarioError::Obstacle(0, crosses.clone())
    );
    assert_eq!(
        error(&ArmScenario { added_obstacle: Some(crossing.clone()), ..scenario() }),
        ScenarioError::AddedObstacle(0, crosses.clone())
    );
    assert_eq!(
        error(&ArmScenario { added_obstacles: vec![crossing], ..scenario() }),
        ScenarioError::AddedObstacle(1, crosses)
    );
    assert_eq!(error(&ArmScenario { wrap: true, ..scenario() }), ScenarioError::Wrap);
    let flat = ArmScenario { links: vec![1.0, 0.0], ..scenario() };
    assert_eq!(error(&flat).to_string(), "link 2 is 0 m long, and must be longer than 0");
    let far = ArmScenario { added_goals: vec![vec![4.0, 0.0]], ..scenario() };
    assert_eq!(
        error(&far).to_string(),
        "added goal 1 is [4.0, 0.0], which is no configuration of the arm: a joint is beyond its limits"
    );
    let far = ArmScenario { goals: vec![vec![1.0, 1.0], vec![4.0, 0.0]], ..scenario() };
    assert_eq!(
        error(&far).to_string(),
        "goals[1] is [4.0, 0.0], which is no configuration of the arm: a joint is beyond its limits"
    );
    let lonely = ArmScenario { goals: vec![vec![1.0, 1.0]], ..scenario() };
    assert_eq!(error(&lonely), ScenarioError::Goals(1));
}

#[test]
fn an_object_that_goes_takes_the_subgoals_with_it_that_hang_on_it() {
    let mut judge = Table(Strategy::OnDemand);
    let shape =
        Shape::new([(0.0, 0.0), (0.1, 0.0), (0.0, 0.1)].map(|(x, y)| Point::new(x, y)).to_vec()).unwrap();
    let far = Object::fixed("far", shape);
    let near = rect("near", [-0.3, 1.2, 0.3, 1.6]);
    let cell = Workcell::new(arm(), vec![moved(&far, 5.0, 5.0, 0.0), near], 0.005).unwrap();
    let mut adapt = Adapt::new(cell, Plugins::standard(), Settings::default(), vec![2.5, 0.0]);
    assert_eq!(adapt.task(&[0.6, 0.0], &mut judge).outcome, Outcome::Found);
    let hung =
        adapt.experience().vertices().filter(|v| v.tag.as_ref().is_some_and(|t| t.object == "near")).count();
    assert!(hung > 0);
    let changed = adapt.change(vec![moved(&far, 5.0, 5.0, 0.0)], &mut judge).unwrap().unwrap();
    assert_eq!(changed.facts.vertices_dropped as usize, hung);
    assert!(adapt.experience().vertices().all(|v| v.tag.as_ref().is_none_or(|t| t.object == "far")));
    assert_eq!(adapt.task(&[2.5, 0.0], &mut judge).outcome, Outcome::Found, "and it goes on");
}
