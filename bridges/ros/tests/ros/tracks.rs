//! `ComputeAndTrackRoute`: a route that is followed to its end, another one when the site changes, and what is said on the way.

use serde_json::{Value, json};

use crate::floor::{Client, Floor, is_outside, points, pose};

fn goal() -> Value {
    json!({"start": pose(4.7, 1.5), "goal": pose(53.8, 14.0), "use_start": true, "use_poses": true})
}

fn is_feedback(said: &Value, id: u64) -> bool {
    said["id"] == id && !said["feedback"].is_null()
}

#[test]
fn a_route_is_followed_to_its_end_and_is_another_one_when_a_doorway_closes() {
    if is_outside("tracks::a_route_is_followed_to_its_end_and_is_another_one_when_a_doorway_closes") {
        return;
    }
    let floor = Floor::start("clinic", &[]);
    let mut client = Client::start("tracks");
    client.latched("hear", "/adit/action", "std_msgs/msg/String", &json!({}));
    client.order("hear", "/adit/footprint", "geometry_msgs/msg/PolygonStamped", &json!({}));
    let id = client.begin("/compute_and_track_route", &goal());
    let first = client.until("a route", |said| is_feedback(said, id))["feedback"].clone();
    assert_eq!(first["rerouted"], false);
    assert_eq!(points(&first["path"]), floor.waypoints("4.7,1.5", "53.8,14"));

    floor.edit(&json!({"kind": "close", "what": "doorway 18"}));
    let second = client.until("another route", |said| is_feedback(said, id))["feedback"].clone();
    assert_eq!(second["rerouted"], true);
    let way = points(&second["path"]);
    assert_ne!(way, points(&first["path"]));

    // the robot goes from waypoint to waypoint
    for [x, y] in way.iter().chain(way.last()).chain(way.last()) {
        for _ in 0..2 {
            client.order("publish", "/robot_pose", "geometry_msgs/msg/PoseStamped", &pose(*x, *y));
            std::thread::sleep(std::time::Duration::from_millis(80));
        }
    }
    let result = client.until("the end", |said| said["id"] == id && !said["status"].is_null());
    assert_eq!(result["status"], 4, "{result}");
    assert_eq!(result["result"]["error_code"], 0);
    let took = result["result"]["execution_duration"]["sec"].as_i64().unwrap();
    assert!((2..60).contains(&took), "{took} s");

    // it was said where it was, and what it did there
    let went =
        client.until("how far it is", |said| is_feedback(said, id) && said["feedback"]["last_node_id"] != 0);
    assert_eq!(went["feedback"]["rerouted"], false);
    assert_eq!(client.until("an action", |said| said["topic"] == "/adit/action")["message"]["data"], "WALK");
    let footprint = client.until("a footprint", |said| said["topic"] == "/adit/footprint")["message"].clone();
    let corners = footprint["polygon"]["points"].as_array().unwrap();
    assert_eq!(corners.len(), 16);
    let across = (corners[0]["x"].as_f64().unwrap() - corners[8]["x"].as_f64().unwrap()).abs();
    assert!(
        (0.6..0.62).contains(&across),
        "the robot is 0.6 m wide where it walks, and its footprint {across} m"
    );
    client.until("it goes sideways", |said| {
        said["topic"] == "/adit/action" && said["message"]["data"] == "SIDE-WALK"
    });
}

#[test]
fn a_route_that_leads_nowhere_any_more_is_given_up_and_one_can_be_cancelled() {
    if is_outside("tracks::a_route_that_leads_nowhere_any_more_is_given_up_and_one_can_be_cancelled") {
        return;
    }
    let floor = Floor::start("clinic", &[]);
    let mut client = Client::start("tracks");
    let id = client.begin("/compute_and_track_route", &goal());
    client.until("a route", |said| is_feedback(said, id));
    assert_eq!(client.cancel(id)["code"], 0);
    let ended = client.until("the end", |said| said["id"] == id && !said["status"].is_null());
    assert_eq!(ended["status"], 5);

    let id = client.begin("/compute_and_track_route", &goal());
    client.until("a route", |said| is_feedback(said, id));
    floor.close_dock();
    let ended = client.until("the end", |said| said["id"] == id && !said["status"].is_null());
    assert_eq!(ended["status"], 6);
    assert_eq!(ended["result"]["error_code"], 405);
    assert!(ended["result"]["error_msg"].as_str().unwrap().contains("closed"), "{ended}");

    // a robot that stands elsewhere is followed from there
    floor.edit(&json!({"kind": "open", "what": "doorway 1"}));
    let id = client.begin("/compute_and_track_route", &goal());
    client.until("a route", |said| is_feedback(said, id));
    client.order("keep", "/robot_pose", "geometry_msgs/msg/PoseStamped", &pose(22.2, 27.6));
    let other =
        client.until("another way", |said| is_feedback(said, id) && said["feedback"]["rerouted"] == true);
    assert_eq!(points(&other["feedback"]["path"]), floor.waypoints("22.2,27.6", "53.8,14"));
}
