use std::f64::consts::PI;

use proptest::prelude::*;

use super::*;
use crate::adapt::robot::distance;

fn arm(lengths: &[f64]) -> Arm {
    let limits = vec![Limit { low: -PI, high: PI }; lengths.len()];
    Arm::new(Point::new(0.5, -0.25), lengths.to_vec(), 0.03, limits).unwrap()
}

#[test]
fn an_arm_needs_links_that_are_longer_than_nothing() {
    let limit = Limit { low: -1.0, high: 1.0 };
    assert_eq!(Arm::new(Point::default(), vec![], 0.0, vec![]), Err(ArmError::NoLinks));
    let flat = Arm::new(Point::default(), vec![1.0, 0.0], 0.0, vec![limit; 2]);
    assert_eq!(flat, Err(ArmError::LinkLength(1, 0.0)));
    let few = Arm::new(Point::default(), vec![1.0, 1.0], 0.0, vec![limit]);
    assert_eq!(few, Err(ArmError::Limits { limits: 1, links: 2 }));
    let reversed = Arm::new(Point::default(), vec![1.0], 0.0, vec![Limit { low: 1.0, high: -1.0 }]);
    assert_eq!(reversed, Err(ArmError::Limit(0, 1.0, -1.0)));
}

#[test]
fn what_no_arm_reaches_has_no_configuration() {
    let two = arm(&[1.0, 0.9]);
    assert_eq!(two.inverse(&Pose::new(3.0, 0.0, 0.0), 0, &[0.0, 0.0]), None);
    assert_eq!(arm(&[1.0, 0.5, 0.5]).inverse(&Pose::new(4.0, 0.0, 0.0), 0, &[0.1, 0.1, 0.1]), None);
}

/// The pose of the tool at a configuration is reached again, from wherever it is looked for.
fn is_found_again(arm: &Arm, at: &[f64], near: &[f64]) {
    let tool = arm.tool(at);
    let found = arm.inverse(&tool, arm.branch(at), near).expect("a configuration: there is one");
    let reached = arm.tool(&found);
    assert!(arm.admits(&found));
    assert!(reached.at.distance(tool.at) < 1e-5);
    assert!(crate::pose::wrapped(reached.heading - tool.heading).abs() < 1e-5);
}

proptest! {
    #[test]
    fn two_links_find_back_on_either_elbow(shoulder in -3.0..3.0_f64, elbow in -3.0..3.0_f64) {
        let arm = arm(&[1.0, 0.9]);
        let at = vec![shoulder, elbow];
        let tool = arm.tool(&at);
        let same = arm.inverse(&tool, arm.branch(&at), &at).unwrap();
        prop_assert!(distance(&same, &at) < 1e-5);
        if let Some(other) = arm.inverse(&tool, 1 - arm.branch(&at), &at) {
            prop_assert!(arm.tool(&other).at.distance(tool.at) < 1e-5);
            prop_assert!(other[1] * elbow <= 0.0);
        }
    }

    #[test]
    fn three_links_find_any_pose_that_one_of_the_branches_reaches(
        at in prop::collection::vec(-2.9..2.9_f64, 3),
        near in prop::collection::vec(-2.9..2.9_f64, 3),
    ) {
        is_found_again(&arm(&[0.8, 0.6, 0.2]), &at, &near);
    }

    #[test]
    fn four_links_find_any_pose_that_they_reach(
        at in prop::collection::vec(-2.8..2.8_f64, 4),
        near in prop::collection::vec(-2.8..2.8_f64, 4),
    ) {
        is_found_again(&arm(&[0.8, 0.6, 0.4, 0.2]), &at, &near);
    }

    #[test]
    fn many_links_follow_a_tool_that_moved_a_little(
        at in prop::collection::vec(0.2..0.8_f64, 4),
        turns in prop::collection::vec(-0.05..0.05_f64, 4),
    ) {
        let arm = arm(&[0.6, 0.5, 0.4, 0.3]);
        let moved: Vec<f64> = at.iter().zip(&turns).map(|(angle, turn)| angle + turn).collect();
        let tool = arm.tool(&moved);
        let found = arm.inverse(&tool, arm.branch(&at), &at).unwrap();
        prop_assert!(arm.tool(&found).at.distance(tool.at) < 1e-5);
        prop_assert!(arm.admits(&found));
    }

    #[test]
    fn no_link_travels_farther_than_said(
        from in prop::collection::vec(-3.0..3.0_f64, 3),
        to in prop::collection::vec(-3.0..3.0_f64, 3),
    ) {
        let arm = arm(&[0.7, 0.6, 0.5]);
        let ends = |at: &[f64]| arm.joints(at);
        let mut travelled = [0.0; 4];
        for step in 0..200 {
            let here = ends(&super::super::robot::between(&from, &to, f64::from(step) / 200.0));
            let next = ends(&super::super::robot::between(&from, &to, f64::from(step + 1) / 200.0));
            for joint in 0..4 {
                travelled[joint] += here[joint].distance(next[joint]);
            }
        }
        for (link, said) in arm.travel(&from, &to).into_iter().enumerate() {
            prop_assert!(travelled[link + 1] <= said + 1e-9);
        }
    }
}
