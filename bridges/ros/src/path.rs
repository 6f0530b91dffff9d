//! A route of the site as ROS says it.

use adit_site::{Route, Waypoint};

use crate::frames::OnFloor;
use crate::msgs::{self, Header, Path, Point, Pose, PoseStamped, Quaternion, RouteEdge, RouteNode};

/// Its waypoints as poses. Each is turned as the robot comes there: the way its body lies, or else the way it goes; at the goal as
/// the goal asks, and at the start as it sets out.
pub fn path(route: &Route, goal: &OnFloor, frame: &str) -> Path {
    let header = Header::now(frame);
    let last = route.waypoints.len().saturating_sub(1);
    let pose = |(index, point): (usize, &Waypoint)| {
        let asked = goal.yaw.filter(|_| index == last);
        let turned = asked.or_else(|| yaw(point)).or_else(|| route.waypoints.get(index + 1).and_then(yaw));
        let orientation = Quaternion::yaw(turned.unwrap_or_default());
        PoseStamped { header: header.clone(), pose: Pose { position: position(point), orientation } }
    };
    let poses = route.waypoints.iter().enumerate().map(pose).collect();
    Path { header, poses }
}

/// Its waypoints as nodes, numbered as they come, and what is between them as edges.
pub fn route(route: &Route, frame: &str) -> msgs::Route {
    let number = |index: usize| u16::try_from(index).unwrap_or(u16::MAX);
    let node = |(index, point)| RouteNode { nodeid: number(index), position: position(point) };
    let edge = |(index, pair): (usize, &[Waypoint])| RouteEdge {
        edgeid: number(index),
        start: position(&pair[0]),
        end: position(&pair[1]),
    };
    msgs::Route {
        header: Header::now(frame),
        route_cost: route.cost.unwrap_or_default() as f32,
        nodes: route.waypoints.iter().enumerate().map(node).collect(),
        edges: route.waypoints.windows(2).enumerate().map(edge).collect(),
    }
}

fn position(point: &Waypoint) -> Point {
    Point { x: point.x, y: point.y, z: 0.0 }
}

/// How the body is turned, radians: of the two directions in which it may lie, the one that is nearer to where it goes.
fn yaw(point: &Waypoint) -> Option<f64> {
    let heading = point.heading.map(f64::to_radians);
    let facing = point.facing.map(f64::to_radians);
    let (Some(facing), Some(heading)) = (facing, heading) else { return facing.or(heading) };
    let is_back = (facing - heading).cos() < -1e-9;
    Some(if is_back { facing + std::f64::consts::PI } else { facing })
}

/// How far along a way somebody is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Along {
    /// The waypoint that lies behind, and the one that comes next.
    pub last: usize,
    pub next: usize,
    /// Metres to the way.
    pub off: f64,
    /// Metres to the goal, in a straight line.
    pub to_goal: f64,
}

/// The place of the way that is nearest, at or after `from`.
pub fn along(points: &[Waypoint], at: [f64; 2], from: usize) -> Option<Along> {
    let goal = points.last()?;
    let to_goal = (goal.x - at[0]).hypot(goal.y - at[1]);
    let mut best: Option<Along> = None;
    for (index, pair) in points.windows(2).enumerate().skip(from) {
        let off = distance(at, &pair[0], &pair[1]);
        if best.is_none_or(|best| off < best.off) {
            best = Some(Along { last: index, next: index + 1, off, to_goal });
        }
    }
    let end = points.len() - 1;
    Some(best.unwrap_or(Along { last: end, next: end, off: to_goal, to_goal }))
}

fn distance(at: [f64; 2], a: &Waypoint, b: &Waypoint) -> f64 {
    let (dx, dy) = (b.x - a.x, b.y - a.y);
    let length = dx * dx + dy * dy;
    let share = if length > 0.0 { ((at[0] - a.x) * dx + (at[1] - a.y) * dy) / length } else { 0.0 };
    let share = share.clamp(0.0, 1.0);
    (a.x + share * dx - at[0]).hypot(a.y + share * dy - at[1])
}
