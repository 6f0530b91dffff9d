//! Rooms by state: a route that a person believes, on a floor of thin walls.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use adit_tests::TestSite;

/// Where on the way from the dock to ward 6 the robot does this: the least and the most x and y.
fn extent(site: &TestSite, action: &str) -> Option<Vec<f64>> {
    // a room's row says where the way in it ends; it began where the row before ended
    let rows = site.sqlite3(&format!(
        "WITH way AS (SELECT kind, action, lag(x) OVER (ORDER BY step) AS x0, x AS x1,
                             lag(y) OVER (ORDER BY step) AS y0, y AS y1
                      FROM action_sequence WHERE start = 'dock' AND goal = 'ward 6')
         SELECT min(x0), max(x1), min(y0), max(y1) FROM way
         WHERE kind = 'room' AND action = '{action}' AND (x1 <> x0 OR y1 <> y0) HAVING count(*) > 0"
    ));
    rows.first().map(|row| row.split('|').map(|v| v.parse().unwrap()).collect())
}

#[test]
fn from_the_dock_to_ward_6_the_robot_goes_sideways_through_the_narrow_door_unless_that_is_harder_than_the_pipe()
 {
    let site = TestSite::example("hospital").built();
    // the doorway of half a metre is at 27.2 m; the way around by it is 4.5 m longer and still the easier one
    let sideways = extent(&site, "SIDE-WALK").unwrap();
    assert!(sideways[0] > 26.9 && sideways[1] < 27.5, "{sideways:?}");
    assert_eq!(extent(&site, "WALK-ON-KNEE"), None);
    site.adit("tune", &["robots", "SIDE-STAND", "hardness", "8"]).expect_status(0);
    // the pipe hangs across the corridor at 18.5 to 20.5 m
    let knees = extent(&site, "WALK-ON-KNEE").unwrap();
    assert!(knees[0] < 18.5 && knees[1] > 20.5 && knees[2] > 11.15 && knees[3] < 14.85, "{knees:?}");
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
fn what_a_change_of_shape_costs_is_in_the_table_of_changes() {
    let site = TestSite::example("hospital").built();
    let cost = |site: &TestSite| -> f64 {
        site.sqlite3("SELECT cost FROM route WHERE start = 'dock' AND goal = 'ward 6'")[0].parse().unwrap()
    };
    let before = cost(&site);
    site.adit("tune", &["changes", "STAND/SIDE-STAND", "--add", "hardness=0.1"]).expect_status(0);
    assert!((cost(&site) - before - 0.1).abs() < 1e-6, "{} after {before}", cost(&site));
}

#[test]
fn any_two_points_are_answered_though_no_start_is_kept_there() {
    let site = TestSite::example("hospital").built();
    let kept = site.adit("route", &["dock", "ward 6", "--json"]).expecting(0).json();
    let points = site.adit("route", &["1.2,1.2", "42,24", "--json"]).expecting(0).json();
    let cost = |answer: &serde_json::Value| answer["cost"].as_f64().unwrap();
    assert!((cost(&points) - cost(&kept)).abs() < 1e-9 * cost(&kept));
    let states = |answer: &serde_json::Value| -> Vec<String> {
        let waypoints = answer["waypoints"].as_array().unwrap().iter();
        waypoints.map(|waypoint| waypoint["state"].as_str().unwrap().to_owned()).collect()
    };
    assert_eq!(states(&points), states(&kept));
}
