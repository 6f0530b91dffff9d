//! Rooms by state: a route that a person believes, on a floor of thin walls.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use adit_tests::TestSite;

#[test]
fn from_the_dock_to_ward_6_the_robot_goes_under_the_pipe_on_its_knees() {
    let site = TestSite::example("hospital").built();
    // a room's row says where the way in it ends; it began where the row before ended
    let rows = site.sqlite3(
        "WITH way AS (SELECT kind, action, lag(x) OVER (ORDER BY step) AS x0, x AS x1, y FROM action_sequence
                      WHERE start = 'dock' AND goal = 'ward 6')
         SELECT min(x0), max(x1), min(y), max(y) FROM way WHERE kind = 'room' AND action = 'WALK-ON-KNEE'",
    );
    let knees: Vec<f64> = rows[0].split('|').map(|v| v.parse().unwrap()).collect();
    // the pipe hangs across the corridor at 18.5 to 20.5 m
    assert!(knees[0] < 18.5 && knees[1] > 20.5 && knees[2] > 11.15 && knees[3] < 14.85, "{rows:?}");
}

#[test]
fn the_costs_of_the_steps_add_up() {
    let site = TestSite::example("hospital").built();
    let sums = site.sqlite3(
        "SELECT round(sum(hardness), 6) = round(max(cost), 6),
                (SELECT round(r.cost, 6) FROM route r WHERE r.start = 'dock' AND r.goal = 'ward 6') = round(max(cost), 6)
         FROM action_sequence WHERE start = 'dock' AND goal = 'ward 6'",
    );
    assert_eq!(sums, ["1|1"]);
}

#[test]
fn what_squatting_down_costs_is_in_the_table_of_changes() {
    let site = TestSite::example("hospital").built();
    let cost = |site: &TestSite| -> f64 {
        site.sqlite3("SELECT cost FROM route WHERE start = 'dock' AND goal = 'ward 6'")[0].parse().unwrap()
    };
    let before = cost(&site);
    for from in ["STAND", "SIDE-STAND", "LIE"] {
        site.adit("tune", &["changes", &format!("{from}/SQUAT"), "--add", "hardness=2.5"]).expect_status(0);
    }
    assert!((cost(&site) - before - 2.5).abs() < 1e-6);
}

#[test]
fn any_two_points_are_answered_though_no_start_is_kept_there() {
    let site = TestSite::example("hospital").built();
    let kept = site.adit("route", &["dock", "ward 6", "--json"]).expecting(0).json();
    let points = site.adit("route", &["1.2,1.2", "42,24", "--json"]).expecting(0).json();
    assert_eq!(points["cost"], kept["cost"]);
    assert_eq!(points["steps"].as_array().unwrap().len(), kept["steps"].as_array().unwrap().len());
}
