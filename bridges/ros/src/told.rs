//! What is heard of closings and told to the site.

use std::sync::Arc;

use adit_site::say;
use serde_json::json;

use crate::msgs::{PoseStamped, Text};
use crate::planner::Planner;

/// Closes, or opens again, what the site knows by this name: `doorway 42`, a named door, an area, `x,y`.
pub async fn closing(planner: Arc<Planner>, kind: &'static str, what: Text) {
    let name = what.data.trim();
    let edit = json!({"edit": {"kind": kind, "what": name}, "why": "heard over ROS"});
    match planner.site.post("/api/edits", &edit).await {
        Ok(_) => say(&format!("{kind} `{name}`: told to the site")),
        Err(trouble) => say(&format!("{kind} `{name}`: {trouble}")),
    }
}

/// The way ahead of a pose is blocked, for so many seconds.
pub async fn blocked(planner: Arc<Planner>, pose: PoseStamped, seconds: u32) {
    let told = async {
        let at = planner.frames.on_floor("blocked pose", &pose).map_err(|failure| failure.words)?;
        let yaw = at.yaw.ok_or("the blocked pose has no orientation, so what is ahead is not known")?;
        let body = json!({"x": at.x, "y": at.y, "heading": yaw.to_degrees(), "for_seconds": seconds, "why": "heard over ROS"});
        planner.site.post("/api/blocked", &body).await.map_err(|trouble| trouble.to_string())
    };
    match told.await {
        Ok(_) => say("the way ahead of a pose is blocked: told to the site"),
        Err(words) => say(&format!("a blocked way is not told to the site: {words}")),
    }
}
