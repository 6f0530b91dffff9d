//! Where the robot is, said to the site for people who look on.

use std::sync::Arc;
use std::time::{Duration, Instant};

use adit_site::{Trouble, say};
use serde_json::json;

use crate::planner::Planner;

/// How often it is said.
const TICK: Duration = Duration::from_secs(1);

/// How often it is said of a robot that stands still that it is still there.
const STILL: Duration = Duration::from_secs(5);

/// Says where the robot is, for as long as anybody knows.
pub async fn follow(planner: Arc<Planner>) {
    let mut ticks = tokio::time::interval(TICK);
    let (mut said, mut is_refused) = (None, false);
    loop {
        ticks.tick().await;
        let Ok(pose) = planner.robot() else { continue };
        if said.is_some_and(|(was, when): (_, Instant)| was == pose && when.elapsed() < STILL) {
            continue;
        }
        let mut robot = json!({"name": planner.settings.name, "x": pose.x, "y": pose.y});
        if let Some(yaw) = pose.yaw {
            robot["heading"] = yaw.to_degrees().rem_euclid(360.0).into();
        }
        if let Some(kind) = &planner.settings.robot {
            robot["robot"] = kind.as_str().into();
        }
        match planner.site.post("/api/whereabouts", &json!({"robots": [robot]})).await {
            // where nobody hears it, it is said again in a moment
            Err(Trouble::Away(_)) => continue,
            Err(Trouble::Refused { words, .. }) if !std::mem::replace(&mut is_refused, true) => {
                say(&format!("people do not see where the robot is: {words}"));
            }
            Err(_) | Ok(_) => {}
        }
        said = Some((pose, Instant::now()));
    }
}
