//! What cannot be used is refused in words, and the node goes on.

use serde_json::{Value, json};

use crate::floor::{Client, Floor, is_outside, points, pose, pose_in};

#[test]
fn requests_that_make_no_sense_are_refused_in_words_and_the_node_goes_on() {
    if is_outside("malformed::requests_that_make_no_sense_are_refused_in_words_and_the_node_goes_on") {
        return;
    }
    let floor = Floor::start("clinic", &[]);
    let mut client = Client::start("odd");
    let archive = pose(53.8, 14.0);
    // JSON has no such numbers; the client reads these words as Python does
    let nan = |mut pose: Value| {
        pose["pose"]["position"]["x"] = "nan".into();
        pose
    };
    let bad = [
        (
            json!({"start": nan(pose(4.7, 1.5)), "goal": archive}),
            "the start is at (NaN, 1.5, 0); expected metres",
        ),
        (
            json!({"start": pose(4.7, 1.5), "goal": nan(archive.clone())}),
            "the goal is at (NaN, 14, 0); expected metres",
        ),
        (json!({}), "the start has no frame; expected `map`"),
        (json!({"start": pose_in("", 4.7, 1.5), "goal": archive}), "the start has no frame"),
        (json!({"start": pose_in("mars", 4.7, 1.5), "goal": archive}), "frame `mars` is not known"),
        (json!({"start": pose(1e300, -1e300), "goal": archive}), "is outside of the map"),
        (
            json!({"start": pose(4.7, 1.5), "goal": archive, "tolerance": -1.0}),
            "the tolerance is -1; expected metres",
        ),
        (
            json!({"start": pose(4.7, 1.5), "goal": archive, "tolerance": "nan"}),
            "the tolerance is NaN; expected metres",
        ),
    ];
    for (request, words) in bad {
        assert!(points(&client.plan(&request)).is_empty(), "{request}");
        floor.says(words);
    }

    let grid = |width: u32, resolution: f64, data: Vec<i8>| {
        json!({"header": {"frame_id": "map"}, "data": data,
            "info": {"resolution": resolution, "width": width, "height": 2, "origin": {"orientation": {"w": 1.0}}}})
    };
    let masks = [
        (grid(3, 0.1, vec![100; 5]), "the keepout mask is not taken: it is 3 by 2 cells, and has 5 of them"),
        (grid(4_000_000_000, 0.1, vec![100; 5]), "it is 4000000000 by 2 cells, and has 5 of them"),
        (grid(2, 0.0, vec![100; 4]), "the keepout mask is not taken: its resolution is 0; expected metres"),
        (json!({"header": {"frame_id": "map"}}), "the keepout mask is not taken: its resolution is 0"),
    ];
    for (mask, words) in masks {
        client.latched("publish", "/keepout_filter_mask", "nav_msgs/msg/OccupancyGrid", &mask);
        floor.says(words);
    }
    let circle = json!({"transforms": [{"header": {"frame_id": "a"}, "child_frame_id": "a"}]});
    client.latched("publish", "/tf_static", "tf2_msgs/msg/TFMessage", &circle);
    floor.says("the transform from `a` to `a` is none, and is not heard");
    let blocked = json!({"header": {"frame_id": "map"}, "pose": {"orientation": {"w": 0.0}}});
    client.order("publish", "/adit/blocked", "geometry_msgs/msg/PoseStamped", &blocked);
    floor.says("the blocked pose has no orientation, so what is ahead is not known");
    client.order("publish", "/adit/close", "std_msgs/msg/String", &json!({"data": ""}));
    floor.says("close ``: ");

    let plan = client.plan(&json!({"start": pose(4.7, 1.5), "goal": archive}));
    assert_eq!(points(&plan), floor.waypoints("4.7,1.5", "53.8,14"));
}
