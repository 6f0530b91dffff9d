//! `ComputePathToPose` and `ComputeRoute`, with each of Nav2's error codes where it belongs.
#![allow(clippy::needless_pass_by_value)] // JSON is written where it is given

use serde_json::{Value, json};

use crate::floor::{Client, Floor, is_outside, points, pose, pose_in};

const SUCCEEDED: i64 = 4;
const CANCELED: i64 = 5;
const ABORTED: i64 = 6;

fn between(start: Value, goal: Value) -> Value {
    json!({"start": start, "goal": goal, "use_start": true})
}

fn by_poses(start: Value, goal: Value) -> Value {
    json!({"start": start, "goal": goal, "use_start": true, "use_poses": true})
}

#[track_caller]
fn refused(client: &mut Client, action: &str, goal: &Value, code: u16, words: &str) {
    let ended = client.goal(action, goal);
    assert_eq!(ended["status"], ABORTED, "{ended}");
    assert_eq!(ended["result"]["error_code"], code, "{ended}");
    let said = ended["result"]["error_msg"].as_str().unwrap();
    assert!(said.contains(words), "{said}");
}

#[test]
fn a_path_to_a_pose_is_the_route_or_says_by_nav2s_code_why_not() {
    if is_outside("actions::a_path_to_a_pose_is_the_route_or_says_by_nav2s_code_why_not") {
        return;
    }
    let floor = Floor::start("clinic", &["--tolerance", "0"]);
    let mut client = Client::start("asks");
    let action = "/compute_path_to_pose";
    let (dock, archive) = (pose(4.7, 1.5), pose(53.8, 14.0));
    let goal = between(dock.clone(), archive.clone());
    let ended = client.goal(action, &goal);
    assert_eq!(ended["status"], SUCCEEDED, "{ended}");
    assert_eq!(ended["result"]["error_code"], 0);
    assert_eq!(points(&ended["result"]["path"]), floor.waypoints("4.7,1.5", "53.8,14"));

    // a planner is a robot of the site, or Nav2's usual name for the one that there is
    for planner in ["GridBased", "robot"] {
        let mut goal = goal.clone();
        goal["planner_id"] = planner.into();
        assert_eq!(client.goal(action, &goal)["status"], SUCCEEDED);
    }
    let mut unknown = goal.clone();
    unknown["planner_id"] = "SmacHybrid".into();
    refused(&mut client, action, &unknown, 201, "SmacHybrid");

    let elsewhere = between(pose_in("world", 4.7, 1.5), archive.clone());
    refused(&mut client, action, &elsewhere, 202, "frame `world` is not known");
    let nowhere = json!({"goal": archive});
    refused(&mut client, action, &nowhere, 202, "where the robot is was not said lately");
    let outside = [between(pose(-5.0, 1.5), archive.clone()), between(dock.clone(), pose(900.0, 3.0))];
    refused(&mut client, action, &outside[0], 203, "-5,1.5 is outside of the map");
    refused(&mut client, action, &outside[1], 204, "900,3 is outside of the map");
    let solid = [between(pose(4.7, 1.0), archive.clone()), between(dock.clone(), pose(4.7, 1.0))];
    refused(&mut client, action, &solid[0], 205, "4.7,1 is inside an obstacle");
    refused(&mut client, action, &solid[1], 206, "4.7,1 is inside an obstacle");

    // with the robot's own pose as the start
    let robot = json!({"goal": archive, "use_start": false});
    let ended = adit_tests::within("the pose is heard", || {
        client.order("publish", "/robot_pose", "geometry_msgs/msg/PoseStamped", &pose(4.7, 1.5));
        let ended = client.goal(action, &robot);
        (ended["status"] == SUCCEEDED).then_some(ended)
    });
    assert_eq!(points(&ended["result"]["path"]), floor.waypoints("4.7,1.5", "53.8,14"));

    floor.close_dock();
    refused(&mut client, action, &goal, 208, "closed");
}

#[test]
fn a_route_is_the_same_way_with_the_codes_of_the_route_server() {
    if is_outside("actions::a_route_is_the_same_way_with_the_codes_of_the_route_server") {
        return;
    }
    let floor = Floor::start("clinic", &["--tolerance", "0"]);
    let mut client = Client::start("asks");
    let action = "/compute_route";
    let (dock, archive) = (pose(4.7, 1.5), pose(53.8, 14.0));
    let goal = by_poses(dock.clone(), archive.clone());
    let ended = client.goal(action, &goal);
    assert_eq!(ended["status"], SUCCEEDED, "{ended}");
    let expected = floor.waypoints("4.7,1.5", "53.8,14");
    assert_eq!(points(&ended["result"]["path"]), expected);
    let route = &ended["result"]["route"];
    assert_eq!(route["nodes"].as_array().unwrap().len(), expected.len());
    assert_eq!(route["edges"].as_array().unwrap().len(), expected.len() - 1);
    let cost = floor.route("4.7,1.5", "53.8,14")["cost"].as_f64().unwrap();
    // costs are single-precision there
    assert!(
        (route["route_cost"].as_f64().unwrap() - cost).abs() < 1e-4,
        "{} for {cost}",
        route["route_cost"]
    );

    refused(
        &mut client,
        action,
        &by_poses(pose_in("world", 4.7, 1.5), archive.clone()),
        401,
        "frame `world`",
    );
    let by_ids = json!({"start_id": 1, "goal_id": 2, "use_start": true});
    refused(&mut client, action, &by_ids, 403, "ask by poses");
    refused(&mut client, action, &by_poses(dock, pose(4.7, 1.0)), 403, "is inside an obstacle");
    floor.close_dock();
    refused(&mut client, action, &goal, 405, "closed");
}

#[test]
fn a_plan_that_takes_too_long_is_given_up_and_a_goal_can_be_cancelled() {
    if is_outside("actions::a_plan_that_takes_too_long_is_given_up_and_a_goal_can_be_cancelled") {
        return;
    }
    let floor = Floor::start("clinic", &["--timeout", "2"]);
    let mut client = Client::start("asks");
    let goal = by_poses(pose(4.7, 1.5), pose(53.8, 14.0));
    let stopped = |signal: &str| {
        let pid = floor.service.pid().to_string();
        assert!(std::process::Command::new("kill").args([signal, &pid]).status().unwrap().success());
    };
    stopped("-STOP");
    let to_pose = between(pose(4.7, 1.5), pose(53.8, 14.0));
    refused(&mut client, "/compute_path_to_pose", &to_pose, 207, "no answer within 2 s");
    refused(&mut client, "/compute_route", &goal, 404, "no answer within 2 s");
    refused(&mut client, "/compute_and_track_route", &goal, 404, "no answer within 2 s");
    let id = client.begin("/compute_path_to_pose", &to_pose);
    assert_eq!(client.cancel(id)["code"], 0);
    let ended = client.until("a result", |said| said["id"] == id && !said["status"].is_null());
    assert_eq!(ended["status"], CANCELED);
    stopped("-CONT");
    assert_eq!(client.goal("/compute_route", &goal)["status"], SUCCEEDED);
    // what has ended is not cancelled
    assert_eq!(client.cancel(id)["code"], 3);
}
