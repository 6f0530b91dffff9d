//! Missions that were driven, to be looked at again.

use adit_db::mission::{Entry, Kept};
use adit_planners::geometry::Point;
use axum::Json;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use utoipa::ToSchema;

use super::extract::{Asked, Named, Site};
use crate::error::{Code, Error};
use crate::live::View;
use crate::navigation::story;
use crate::serve::fault::Answered;

/// Missions that one answer gives at most.
const MOST: u32 = 1_000;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Part {
    limit: Option<u32>,
}

#[derive(Serialize, ToSchema)]
pub struct MissionsAnswer {
    /// The newest first.
    missions: Vec<Driven>,
}

/// A mission that was kept (`adit simulate SITE --keep`, `adit drive SITE --keep`).
#[derive(Serialize, ToSchema)]
struct Driven {
    #[serde(flatten)]
    kept: Kept,
    /// The spaces in which it began and ended, as the map is now.
    spaces: [Option<String>; 2],
}

impl Driven {
    fn all(kept: Vec<Kept>, view: &View) -> Vec<Self> {
        let building = &view.graph().building;
        let ends = kept.iter().flat_map(|of| [of.start, of.goal]).map(|[x, y]| Point::new(x, y));
        let spaces = building.spaces_at(&ends.collect::<Vec<_>>()).into_iter();
        let mut names = spaces.map(|space| building.space(space?.space));
        let mut next = || names.next().flatten();
        kept.into_iter().map(|kept| Self { kept, spaces: [next(), next()] }).collect()
    }
}

/// The missions of the site that were kept, the newest first.
#[utoipa::path(get, path = "/api/missions", tag = "robots",
    params(("limit" = Option<u32>, Query, description = "How many, 50 unless said, at most 1,000")),
    responses((status = 200, body = MissionsAnswer)))]
pub async fn list(site: Site, Asked(part): Asked<Part>) -> Answered<Json<MissionsAnswer>> {
    let limit = part.limit.unwrap_or(50).min(MOST);
    let seen = site.view.load_full();
    let answer = site.read(move |tx| {
        let kept = tx.missions(&seen.view.site().site().name, limit)?;
        Ok(MissionsAnswer { missions: Driven::all(kept, &seen.view) })
    });
    answer.await.map(Json)
}

#[derive(Serialize, ToSchema)]
pub struct MissionAnswer {
    #[serde(flatten)]
    mission: Driven,
    /// What happened, in the order in which it did.
    journal: Vec<Happened>,
}

/// Something that happened on a mission.
#[derive(Serialize, ToSchema)]
struct Happened {
    /// Seconds by the robot's clock.
    time: f64,
    /// Where the robot thought it was: x and y in metres, heading in degrees.
    pose: [f64; 3],
    /// Where it was, if anybody knows: of a simulated robot.
    truth: Option<[f64; 3]>,
    /// What it met, in words.
    words: Option<String>,
    /// What it did from then on, as the rules call it: `move`, `turn`.
    next: Option<String>,
    /// What it did at that moment, as the rules call it; null: nothing.
    action: Option<String>,
    /// The rule that decided so, with its file and line.
    rule: Option<String>,
    /// The shape that it took.
    shape: Option<String>,
    /// The way that it set out on, metres.
    way: Option<Value>,
    /// What it saw there: lines, each as x, y, x, y in metres.
    seen: Option<Value>,
}

impl Happened {
    fn of(entry: Entry) -> Self {
        let mut detail: Value =
            entry.detail.as_deref().and_then(|detail| serde_json::from_str(detail).ok()).unwrap_or_default();
        let words = story::sentence(&entry.event, &detail);
        let is = |event: &str| entry.event == event;
        let mut part = |name: &str, of: bool| detail.get_mut(name).filter(|_| of).map(Value::take);
        let shape = part("state", is("shape")).and_then(|shape| shape.as_str().map(str::to_owned));
        let way = part("points", is("planned") || is("detour"));
        let seen = part("seen", is("way closed"));
        let (next, action) = entry.change.map(|[_, next, action]| (next, action)).unzip();
        let rule = entry.rule.map(|rule| {
            let row = rule.row.map_or_else(String::new, |row| format!(", row {row}"));
            format!("{}{row} ({}:{})", rule.rule, rule.file, rule.line)
        });
        Self {
            time: entry.time,
            pose: entry.pose,
            truth: entry.truth,
            words,
            next,
            action: action.filter(|action| action != "none"),
            rule,
            shape,
            way,
            seen,
        }
    }
}

/// A mission with its journal, to be looked at again.
#[utoipa::path(get, path = "/api/missions/{mission}", tag = "robots",
    params(("mission" = i64, Path, description = "Its number")),
    responses((status = 200, body = MissionAnswer)))]
pub async fn journal(site: Site, Named(number): Named<i64>) -> Answered<Json<MissionAnswer>> {
    let seen = site.view.load_full();
    let answer = site.read(move |tx| {
        let world = &seen.view.site().site().name;
        let unknown = || Error::said(Code::MissionUnknown, format!("{world} has no mission {number}"), None);
        let (kept, entries) = tx.replay(world, number)?.ok_or_else(unknown)?;
        let mission = Driven::all(vec![kept], &seen.view).pop().ok_or_else(unknown)?;
        let journal = entries.into_iter().map(Happened::of).collect();
        Ok(MissionAnswer { mission, journal })
    });
    answer.await.map(Json)
}
