//! Objects move, turn, change their shape, come and go, and what is known goes along (section 2.3).

use adit_planners::adapt::{
    Adapt, ChangeFacts, EdgeFacts, Judge, LandmarkFacts, Noted, ObjectChange, Outcome, Removal, Strategy,
    Trust,
};

use super::support::{Table, arm, moved, planner, rect};

/// Everything hangs on the table.
struct OnTheTable;

impl Judge for OnTheTable {
    fn strategy(&mut self, _: &ChangeFacts) -> Strategy {
        Strategy::OnDemand
    }

    fn landmark(&mut self, facts: &LandmarkFacts<'_>) -> Option<f64> {
        (facts.object == "table").then_some(0.0)
    }

    fn trust(&mut self, _: &EdgeFacts) -> Trust {
        Trust::Verify
    }
}

fn table() -> adit_planners::adapt::Object {
    rect("table", [1.2, -0.15, 1.5, 0.15])
}

/// The arm worked on either side of the table.
fn learned() -> Adapt {
    let mut adapt = planner(arm(), vec![table()], &[2.5, 0.0]);
    for goal in [[0.7, 0.4], [-0.9, 0.5], [0.8, -0.3]] {
        assert_eq!(adapt.task(&goal, &mut OnTheTable).outcome, Outcome::Found);
    }
    adapt.take_noted();
    adapt
}

#[test]
fn a_subgoal_keeps_its_place_and_its_elbow_about_an_object_that_moves_and_turns() {
    let mut adapt = learned();
    let robot = arm();
    let before: Vec<_> = adapt.experience().vertices().cloned().collect();
    let now = moved(&table(), 0.05, 0.1, 0.15);
    let changed = adapt.change(vec![now.clone()], &mut OnTheTable).unwrap().unwrap();
    assert_eq!((changed.facts.moved, changed.strategy), (1, Strategy::OnDemand));
    assert!((changed.facts.turned - 0.15).abs() < 1e-9);
    assert!((changed.facts.moved_m - 0.05_f64.hypot(0.1)).abs() < 1e-12);
    assert_eq!(changed.evaluations, 0, "nothing is evaluated until a task needs it");
    let mut checked = 0;
    for old in before.iter().filter(|vertex| vertex.tag.is_some()) {
        let tag = old.tag.as_ref().unwrap();
        let wanted = now.pose.then(&tag.tool).at;
        match adapt.experience().vertex(old.id) {
            Some(new) => {
                assert!(robot.tool(&new.at).at.distance(wanted) < 1e-5);
                assert_eq!(robot.branch(&new.at), tag.branch);
                checked += 1;
            }
            None => assert_eq!(robot.inverse(&wanted_pose(wanted), tag.branch, &old.at), None),
        }
    }
    assert!(checked > 0);
    assert_eq!(adapt.task(&[-0.9, 0.5], &mut OnTheTable).outcome, Outcome::Found);
}

fn wanted_pose(at: adit_planners::geometry::Point) -> adit_planners::pose::Pose {
    adit_planners::pose::Pose::new(at.x, at.y, 0.0)
}

#[test]
fn a_subgoal_that_the_robot_cannot_reach_any_more_is_dropped_and_that_is_said() {
    let mut adapt = learned();
    let hung = adapt.experience().vertices().filter(|vertex| vertex.tag.is_some()).count() as u32;
    let changed = adapt.change(vec![moved(&table(), 9.0, 0.0, 0.0)], &mut OnTheTable).unwrap().unwrap();
    assert_eq!((changed.facts.vertices_dropped, changed.facts.vertices_moved), (hung, 0));
    let noted = adapt.take_noted();
    let dropped =
        noted.iter().filter(|noted| matches!(noted, Noted::VertexRemoved { why: Removal::OutOfReach, .. }));
    assert_eq!(dropped.count() as u32, hung);
}

#[test]
fn what_is_known_of_an_object_goes_along_with_it_until_its_shape_changes() {
    let mut adapt = learned();
    let known = adapt.cell().clearances().count();
    adapt.change(vec![moved(&table(), 0.1, 0.0, 0.3)], &mut OnTheTable).unwrap();
    assert_eq!(adapt.cell().clearances().count(), known);
    let other = rect("table", [1.2, -0.15, 1.5, 0.2]);
    let changed = adapt.change(vec![other], &mut OnTheTable).unwrap().unwrap();
    assert_eq!((changed.facts.reshaped, adapt.cell().clearances().count()), (1, 0));
    let how = ObjectChange::Reshaped;
    let noted = adapt.take_noted();
    assert!(noted.contains(&Noted::ObjectChanged { object: "table".to_owned(), how, revision: 2 }));
}

#[test]
fn a_cell_that_is_told_as_it_is_has_not_changed() {
    let mut adapt = learned();
    assert_eq!(adapt.change(vec![table()], &mut Table(Strategy::Forget)).unwrap(), None);
    assert_eq!((adapt.cell().revision(), adapt.take_noted()), (0, vec![]));
}
