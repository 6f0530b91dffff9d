//! A keepout mask, as Nav2's costmap filters publish it, becomes areas of the site; what it no longer has is taken back.

use std::collections::BTreeMap;
use std::sync::Arc;

use adit_site::say;
use nalgebra::{Isometry3, Point3, Translation3};
use serde_json::{Value, json};
use tokio::sync::watch;

use crate::frames::{Frames, unit};
use crate::grid::{check, rectangles};
use crate::msgs::OccupancyGrid;

/// What names of areas begin with that a mask laid.
const NAMED: &str = "keepout";

/// The most areas of a mask.
const MOST: usize = 100;

/// The settings of masks.
pub struct Settings {
    /// What such an area is, for rules.
    pub kind: String,
    /// From which value on a cell is one.
    pub least: i8,
}

/// Corners by the area's name.
type Areas = BTreeMap<String, Vec<[f64; 2]>>;

/// The areas of a mask, or why it is none.
fn areas(grid: &OccupancyGrid, frames: &Frames, least: i8) -> Result<(Areas, usize), String> {
    check(grid)?;
    let frame = frames.of(&grid.header.frame_id).map_err(|failure| failure.words)?;
    let at = &grid.info.origin.position;
    let turned = unit(&grid.info.origin.orientation).filter(|_| at.x.is_finite() && at.y.is_finite());
    let turned = turned.ok_or("its origin is no pose")?;
    let to_map = frame * Isometry3::from_parts(Translation3::new(at.x, at.y, 0.0), turned);
    let (found, joined) = rectangles(&grid.data, grid.info.width as usize, least, MOST);
    let metres = f64::from(grid.info.resolution) * joined as f64;
    let (across, along) = (f64::from(grid.info.width), f64::from(grid.info.height));
    let resolution = f64::from(grid.info.resolution);
    let areas = found.into_iter().map(|cells| {
        let corner = |x: usize, y: usize| {
            let (x, y) =
                ((x as f64 * metres).min(across * resolution), (y as f64 * metres).min(along * resolution));
            let at = to_map * Point3::new(x, y, 0.0);
            // cells are no finer than a millimetre, and names should be short
            [at.x, at.y].map(|v| (v * 1000.0).round() / 1000.0 + 0.0)
        };
        let ([x0, y0], [x1, y1]) = (cells.from, cells.to);
        let corners = vec![corner(x0, y0), corner(x1, y0), corner(x1, y1), corner(x0, y1)];
        let [[ax, ay], _, [bx, by], _] = [corners[0], corners[1], corners[2], corners[3]];
        (format!("{NAMED} {ax},{ay} {bx},{by}"), corners)
    });
    Ok((areas.collect(), joined))
}

/// Follows masks as they come. Of several that come while one is laid, the last counts.
pub async fn follow(
    site: adit_site::Site,
    frames: Arc<Frames>,
    settings: Settings,
    mut masks: watch::Receiver<Option<Arc<OccupancyGrid>>>,
) {
    while masks.changed().await.is_ok() {
        let Some(mask) = masks.borrow_and_update().clone() else { continue };
        match areas(&mask, &frames, settings.least) {
            Err(words) => say(&format!("the keepout mask is not taken: {words}")),
            Ok((wanted, joined)) => {
                if joined > 1 {
                    say(&format!(
                        "the keepout mask has more than {MOST} rectangles; {joined} by {joined} cells are one"
                    ));
                }
                if let Err(words) = lay(&site, &wanted, &settings.kind).await {
                    say(&format!("the keepout mask is not told to the site: {words}"));
                }
            }
        }
    }
}

async fn lay(site: &adit_site::Site, wanted: &Areas, kind: &str) -> Result<(), String> {
    let words = |trouble: adit_site::Trouble| trouble.to_string();
    let answer = site.get("/api/areas").await.map_err(words)?;
    let laid: Vec<&str> =
        answer["laid"].as_array().into_iter().flatten().filter_map(|of| of["name"].as_str()).collect();
    let ours: Vec<&str> =
        laid.iter().copied().filter(|name| name.starts_with(&format!("{NAMED} "))).collect();
    let (mut new, mut gone) = (0, 0);
    for (name, corners) in wanted.iter().filter(|(name, _)| !ours.contains(&name.as_str())) {
        let body: Value = json!({"name": name, "corners": corners, "properties": {"kind": kind}, "why": "the keepout mask"});
        site.post("/api/areas", &body).await.map_err(words)?;
        new += 1;
    }
    for name in ours.into_iter().filter(|name| !wanted.contains_key(*name)) {
        let path = format!("/api/areas/{}", name.replace(' ', "%20").replace(',', "%2C"));
        site.delete(&format!("{path}?why=the%20keepout%20mask")).await.map_err(words)?;
        gone += 1;
    }
    say(&format!("the keepout mask is {} areas of the site: {new} new, {gone} taken back", wanted.len()));
    Ok(())
}
