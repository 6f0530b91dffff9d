//! The service `GetPlan`, and what else is told and heard beside plans.

use serde_json::json;

use crate::floor::{Client, Floor, is_outside, points, pose, pose_in};

#[test]
fn a_plan_of_the_clinic_is_the_route_that_adit_prints() {
    if is_outside("plans::a_plan_of_the_clinic_is_the_route_that_adit_prints") {
        return;
    }
    let floor = Floor::start("clinic", &[]);
    let mut client = Client::start("asks");
    for (start, goal) in
        [([4.7, 1.5], [53.8, 14.0]), ([53.8, 14.0], [22.2, 27.6]), ([22.2, 27.6], [4.7, 1.5])]
    {
        let request = json!({"start": pose(start[0], start[1]), "goal": pose(goal[0], goal[1])});
        let plan = client.plan(&request);
        let words = |at: [f64; 2]| format!("{},{}", at[0], at[1]);
        let expected = floor.waypoints(&words(start), &words(goal));
        assert!(expected.len() > 5);
        assert_eq!(points(&plan), expected);
        assert_eq!(plan["header"]["frame_id"], "map");
        // each is turned as the robot comes there, the last one as the goal asks
        let poses = plan["poses"].as_array().unwrap();
        for (index, pair) in expected.windows(2).enumerate().take(expected.len() - 2) {
            let turned = &poses[index + 1]["pose"]["orientation"];
            let yaw = 2.0 * turned["z"].as_f64().unwrap().atan2(turned["w"].as_f64().unwrap());
            let went = (pair[1][1] - pair[0][1]).atan2(pair[1][0] - pair[0][0]);
            assert!((yaw - went).cos() > 0.999, "waypoint {index}: {yaw} instead of {went}");
        }
        assert_eq!(
            poses.last().unwrap()["pose"]["orientation"],
            json!({"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0})
        );
    }

    // what is inside a wall is moved as far as the request allows
    let request = json!({"start": pose(4.7, 1.0), "goal": pose(53.8, 14.0), "tolerance": 0.0});
    assert_eq!(points(&client.plan(&request)), Vec::<[f64; 2]>::new());
    floor.says("get_plan: 4.7,1 is inside an obstacle");
    let request = json!({"start": pose(4.7, 1.0), "goal": pose(53.8, 14.0), "tolerance": 0.5});
    assert!((points(&client.plan(&request))[0][1] - 1.375).abs() < 0.01);
}

#[test]
fn frames_that_tf_knows_are_the_maps_and_others_are_refused() {
    if is_outside("plans::frames_that_tf_knows_are_the_maps_and_others_are_refused") {
        return;
    }
    let floor = Floor::start("clinic", &[]);
    let mut client = Client::start("asks");
    let request = json!({"start": pose_in("world", 14.7, 1.5), "goal": pose(53.8, 14.0)});
    assert!(points(&client.plan(&request)).is_empty());
    floor.says("frame `world` is not known: TF says no way from it to the map's frame `map`");

    // the map lies ten metres along x in the world's frame
    let transform = json!({"transforms": [{"header": {"frame_id": "map"}, "child_frame_id": "world",
        "transform": {"translation": {"x": -10.0}, "rotation": {"w": 1.0}}}]});
    client.latched("publish", "/tf_static", "tf2_msgs/msg/TFMessage", &transform);
    let expected = floor.waypoints("4.7,1.5", "53.8,14");
    adit_tests::within("the frame is heard", || {
        let plan = points(&client.plan(&request));
        (plan.len() == expected.len() && (plan[0][0] - 4.7).abs() < 1e-9).then_some(())
    });
}

#[test]
fn what_is_closed_and_blocked_is_told_to_the_site() {
    if is_outside("plans::what_is_closed_and_blocked_is_told_to_the_site") {
        return;
    }
    let floor = Floor::start("clinic", &[]);
    let mut client = Client::start("tells");
    let request = json!({"start": pose(4.7, 1.5), "goal": pose(53.8, 14.0)});
    let before = points(&client.plan(&request));
    client.order("publish", "/adit/close", "std_msgs/msg/String", &json!({"data": "doorway 18"}));
    floor.says("close `doorway 18`: told to the site");
    let round = points(&client.plan(&request));
    assert_ne!(round, before);
    client.order("publish", "/adit/open", "std_msgs/msg/String", &json!({"data": "doorway 18"}));
    floor.says("open `doorway 18`: told to the site");
    assert_eq!(points(&client.plan(&request)), before);

    // doorway 18 lies east of here
    let blocked = json!({"header": {"frame_id": "map"},
        "pose": {"position": {"x": 32.7, "y": 9.05}, "orientation": {"w": 1.0}}});
    client.order("publish", "/adit/blocked", "geometry_msgs/msg/PoseStamped", &blocked);
    floor.says("the way ahead of a pose is blocked: told to the site");
    assert_eq!(points(&client.plan(&request)), round);

    client.order("publish", "/adit/close", "std_msgs/msg/String", &json!({"data": "doorway 4711"}));
    floor.says("close `doorway 4711`: ");
}
