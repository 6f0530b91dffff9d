//! What the robot does where it is: the action of its route there, and the footprint of the state that it is in.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use adit_site::say;
use ros2_client::Publisher;
use serde_json::Value;
use tokio::sync::watch;

use crate::frames::OnFloor;
use crate::msgs::{Header, Point32, PolygonStamped, Text};
use crate::path::along;
use crate::planner::Planner;

/// How often it is looked where the robot is.
const TICK: Duration = Duration::from_millis(100);

/// Corners of a round body; they lie on a circle around it, so the polygon leaves nothing of it out.
const CORNERS: u16 = 16;

/// How wide a state is, and how long where it is longer than wide; metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Size {
    width: f64,
    length: Option<f64>,
}

/// The sizes of all robots' states, by state and robot.
pub type Sizes = BTreeMap<(String, String), Size>;

/// Reads what `/api/tables` answers.
pub fn sizes(answer: &Value) -> Sizes {
    let tables = answer["tables"].as_array().into_iter().flatten();
    let Some(robots) = tables.into_iter().find(|table| table["table"] == "robots") else {
        return Sizes::new();
    };
    let columns = robots["columns"].as_array().into_iter().flatten();
    let names: Vec<&str> = columns.filter_map(|column| column["name"].as_str()).collect();
    let rows = robots["rows"].as_array().into_iter().flatten();
    let size = |row: &Value| {
        let cell = |name: &str| names.iter().position(|column| *column == name).map(|index| &row[index]);
        let text = |name: &str| cell(name)?.as_str().map(str::to_owned);
        let size = Size { width: cell("width")?.as_f64()?, length: cell("length").and_then(Value::as_f64) };
        Some(((text("state")?, text("robot")?), size))
    };
    rows.filter_map(size).collect()
}

impl Size {
    /// Its outline about a pose.
    fn outline(self, at: OnFloor) -> Vec<Point32> {
        let half = self.width / 2.0;
        let corners: Vec<[f64; 2]> = if let Some(length) = self.length {
            let ahead = length / 2.0;
            vec![[ahead, -half], [ahead, half], [-ahead, half], [-ahead, -half]]
        } else {
            let step = std::f64::consts::TAU / f64::from(CORNERS);
            let radius = half / (step / 2.0).cos();
            (0..CORNERS)
                .map(|corner| f64::from(corner) * step)
                .map(|turn| [radius * turn.cos(), radius * turn.sin()])
                .collect()
        };
        let (sin, cos) = at.yaw.unwrap_or_default().sin_cos();
        let moved = |[x, y]: [f64; 2]| Point32 {
            x: (at.x + cos * x - sin * y) as f32,
            y: (at.y + sin * x + cos * y) as f32,
            z: 0.0,
        };
        corners.into_iter().map(moved).collect()
    }
}

/// Says action and footprint as the robot goes.
pub async fn follow(
    planner: Arc<Planner>,
    sizes: watch::Receiver<Sizes>,
    actions: Publisher<Text>,
    footprints: Publisher<PolygonStamped>,
) {
    let mut ticks = tokio::time::interval(TICK);
    let (mut said, mut was) = (None, None);
    loop {
        ticks.tick().await;
        let (Some(route), Ok(pose)) = (planner.way(), planner.robot()) else { continue };
        let Some(along) = along(&route.waypoints, [pose.x, pose.y], 0) else { continue };
        let Some(point) = route.waypoints.get(along.next) else { continue };
        if point.action.is_some() && point.action != said {
            said.clone_from(&point.action);
            let text = Text { data: point.action.clone().unwrap_or_default() };
            if let Err(error) = actions.publish(text) {
                say(&format!("an action cannot be said: {error:?}"));
            }
        }
        let state = point.state.clone().unwrap_or_default();
        if was.as_ref() == Some(&(pose, state.clone())) {
            continue;
        }
        let size = {
            let sizes = sizes.borrow();
            let robot = planner.settings.robot.as_deref();
            sizes
                .iter()
                .find(|((of, name), _)| *of == state && robot.is_none_or(|robot| robot == name))
                .map(|of| *of.1)
        };
        let Some(size) = size else { continue };
        was = Some((pose, state));
        let footprint =
            PolygonStamped { header: Header::now(planner.frames.map()), points: size.outline(pose) };
        if let Err(error) = footprints.publish(footprint) {
            say(&format!("a footprint cannot be said: {error:?}"));
        }
    }
}
