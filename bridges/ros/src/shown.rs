//! What of the site is published for whoever comes: its map, what is not to be entered, and the sizes of its robots.

use std::sync::Arc;
use std::time::Duration;

use adit_site::say;
use ros2_client::Publisher;
use tokio::sync::watch;

use crate::msgs::OccupancyGrid;
use crate::planner::Planner;
use crate::{body, grid};

/// How long to wait before a service that is away is asked again.
const PAUSE: Duration = Duration::from_millis(500);

/// Polygons as x, y, x, y, …
type Polygons = Vec<Vec<f64>>;

/// What of the site is shown to whoever comes.
pub struct Shown {
    pub planner: Arc<Planner>,
    pub map: Publisher<OccupancyGrid>,
    pub keepout: Publisher<OccupancyGrid>,
    /// The kind of areas that are not to be entered.
    pub kind: String,
    /// Of a cell.
    pub metres: f64,
    pub tell: watch::Sender<body::Sizes>,
}

impl Shown {
    /// Shows the site anew after each change.
    pub async fn follow(&self) {
        let changed = Arc::new(tokio::sync::Notify::new());
        let showing = async {
            let mut last = (None, None);
            loop {
                changed.notified().await;
                if let Err(words) = self.show(&mut last).await {
                    say(&words);
                    tokio::time::sleep(PAUSE).await;
                    changed.notify_one();
                }
            }
        };
        let hearing = async {
            let mut told = None;
            loop {
                let heard = self.planner.site.hear("/api/events", |event, _| {
                    if matches!(event, "hello" | "changed") {
                        changed.notify_one();
                    }
                });
                let words = heard.await.err().map(|trouble| trouble.to_string());
                if words.is_some() && words != told {
                    say(words.as_deref().unwrap_or_default());
                }
                told = words;
                tokio::time::sleep(PAUSE).await;
            }
        };
        tokio::join!(showing, hearing);
    }

    async fn show(&self, last: &mut (Option<Polygons>, Option<Polygons>)) -> Result<(), String> {
        let words = |trouble: adit_site::Trouble| trouble.to_string();
        self.tell.send_replace(body::sizes(&self.planner.site.get("/api/tables").await.map_err(words)?));
        let map = self.planner.site.get("/api/map").await.map_err(words)?;
        let bounds: [f64; 4] = serde_json::from_value(map["bounds"].clone())
            .map_err(|error| format!("the site's map cannot be read: {error}"))?;
        let walls: Polygons = grid::polygons(&map["walls"]);
        let kept = map["areas"].as_array().into_iter().flatten();
        let kept: Polygons = kept
            .filter(|area| area["kind"].as_str() == Some(&self.kind))
            .filter_map(|area| serde_json::from_value(area["polygon"].clone()).ok())
            .collect();
        let frame = self.planner.frames.map();
        for (publisher, now, last) in [(&self.map, walls, &mut last.0), (&self.keepout, kept, &mut last.1)] {
            if last.as_ref() == Some(&now) {
                continue;
            }
            let drawn = grid::drawn(bounds, self.metres, frame, now.iter().map(Vec::as_slice));
            publisher.publish(drawn).map_err(|error| format!("the map cannot be published: {error:?}"))?;
            *last = Some(now);
        }
        Ok(())
    }
}
