//! What cannot be used is refused in words, and the node goes on.

use std::time::Instant;

use serde_json::{Value, json};

use crate::floor::{Client, Floor, is_outside, points, pose, pose_in};
use crate::storm::held;

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

/// Longer by hand: `ADIT_FUZZ_SECONDS=60`.
#[test]
#[allow(clippy::print_stdout)] // how much was tried is what a long run is for
fn bytes_that_are_nearly_messages_leave_the_node_as_it_was() {
    if is_outside("malformed::bytes_that_are_nearly_messages_leave_the_node_as_it_was") {
        return;
    }
    let floor = Floor::start("clinic", &[]);
    let mut client = Client::start("noise");
    let asked = json!({"start": pose_in("mars", 4.7, 1.5), "goal": pose(53.8, 14.0)});
    assert!(points(&client.plan(&asked)).is_empty());
    let at = pose(4.7, 1.5);
    let grid = json!({"header": {"frame_id": "map"}, "data": vec![100; 12],
        "info": {"resolution": 0.1, "width": 4, "height": 3, "origin": {"position": {"x": 30.0}, "orientation": {"w": 1.0}}}});
    let frames = json!({"transforms": [{"header": {"frame_id": "map"}, "child_frame_id": "odom", "transform": {"rotation": {"w": 1.0}}}]});
    let all = [
        ("/keepout_filter_mask", "nav_msgs/msg/OccupancyGrid", &grid, true),
        ("/tf", "tf2_msgs/msg/TFMessage", &frames, false),
        ("/tf_static", "tf2_msgs/msg/TFMessage", &frames, true),
        ("/robot_pose", "geometry_msgs/msg/PoseStamped", &at, false),
        ("/adit/blocked", "geometry_msgs/msg/PoseStamped", &at, false),
        ("/adit/close", "std_msgs/msg/String", &json!({"data": "doorway 1"}), false),
        ("/adit/open", "std_msgs/msg/String", &json!({"data": "doorway 1"}), false),
    ];
    let seconds = std::env::var("ADIT_FUZZ_SECONDS").ok().and_then(|seconds| seconds.parse().ok());
    let (began, mut seed) = (Instant::now(), 0);
    let (before, _) = held(floor.pid());
    while seed == 0 || began.elapsed().as_secs_f64() < seconds.unwrap_or(2.0) {
        for (name, kind, message, latched) in all {
            seed += 1;
            client.noise((name, kind), message, (seed, 100), latched);
        }
    }
    println!("fuzz ros: {} tried", 100 * seed);
    assert!(points(&client.plan(&asked)).is_empty());
    floor.says("frame `mars` is not known");
    let grown = held(floor.pid()).0.saturating_sub(before);
    assert!(grown < 256 << 10, "{} MB more", grown >> 10);
}
