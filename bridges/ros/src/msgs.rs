//! Messages as their public definitions say (`geometry_msgs`, `nav_msgs`, `nav2_msgs` of Kilted, `tf2_msgs`), with what we use of them.

use ros2_client::Message;
use serde::{Deserialize, Serialize};

macro_rules! messages {
    ($($(#[$doc:meta])* $name:ident { $($field:ident: $kind:ty),* $(,)? })*) => {
        $(
            $(#[$doc])*
            #[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
            #[allow(clippy::struct_field_names)] // they are called as in the messages
            pub struct $name {
                $(pub $field: $kind),*
            }

            impl Message for $name {}
        )*
    };
}

messages! {
    Time { sec: i32, nanosec: u32 }
    Header { stamp: Time, frame_id: String }
    Point { x: f64, y: f64, z: f64 }
    Point32 { x: f32, y: f32, z: f32 }
    Quaternion { x: f64, y: f64, z: f64, w: f64 }
    Pose { position: Point, orientation: Quaternion }
    PoseStamped { header: Header, pose: Pose }
    PolygonStamped { header: Header, points: Vec<Point32> }
    Transform { translation: Point, rotation: Quaternion }
    TransformStamped { header: Header, child_frame_id: String, transform: Transform }
    TfMessage { transforms: Vec<TransformStamped> }
    Text { data: String }
    Path { header: Header, poses: Vec<PoseStamped> }
    MapMetaData { map_load_time: Time, resolution: f32, width: u32, height: u32, origin: Pose }
    OccupancyGrid { header: Header, info: MapMetaData, data: Vec<i8> }

    GetPlanRequest { start: PoseStamped, goal: PoseStamped, tolerance: f32 }
    GetPlanResponse { plan: Path }

    /// A message without fields has one all the same on the wire.
    Empty { structure_needs_at_least_one_member: u8 }
    RouteNode { nodeid: u16, position: Point }
    RouteEdge { edgeid: u16, start: Point, end: Point }
    Route { header: Header, route_cost: f32, nodes: Vec<RouteNode>, edges: Vec<RouteEdge> }

    ToPoseGoal { goal: PoseStamped, start: PoseStamped, planner_id: String, use_start: bool }
    ToPoseResult { path: Path, planning_time: Time, error_code: u16, error_msg: String }

    RouteGoal {
        start_id: u16,
        start: PoseStamped,
        goal_id: u16,
        goal: PoseStamped,
        use_start: bool,
        use_poses: bool,
    }
    RouteResult { planning_time: Time, path: Path, route: Route, error_code: u16, error_msg: String }
    TrackResult { execution_duration: Time, error_code: u16, error_msg: String }
    TrackFeedback {
        last_node_id: u16,
        next_node_id: u16,
        current_edge_id: u16,
        route: Route,
        path: Path,
        operations_triggered: Vec<String>,
        rerouted: bool,
    }
}

impl Time {
    /// The time of day.
    pub fn now() -> Self {
        let since = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH).unwrap_or_default();
        since.into()
    }
}

impl From<std::time::Duration> for Time {
    fn from(duration: std::time::Duration) -> Self {
        Self { sec: duration.as_secs().try_into().unwrap_or(i32::MAX), nanosec: duration.subsec_nanos() }
    }
}

impl Header {
    /// Now, in this frame.
    pub fn now(frame: &str) -> Self {
        Self { stamp: Time::now(), frame_id: frame.to_owned() }
    }
}

impl Quaternion {
    /// A turn about the vertical, radians.
    pub fn yaw(radians: f64) -> Self {
        Self { z: (radians / 2.0).sin(), w: (radians / 2.0).cos(), ..Self::default() }
    }
}
