//! Where robots are.

use std::collections::BTreeSet;
use std::time::Instant;

use adit_planners::geometry::Point;
use axum::Json;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::extract::{Body, Named, Site};
use crate::answer::pick;
use crate::error::Code;
use crate::serve::fault::{Answered, Fault};
use crate::serve::gate::require;
use crate::serve::question::short;
use crate::serve::role::{Caller, Role};
use crate::serve::whereabouts::{Report, Whereabout};

/// Robots that one message may speak of.
const MOST: usize = 1_000;

#[derive(Serialize, ToSchema)]
pub struct WhereaboutsAnswer {
    generation: u64,
    /// By name; those without one last.
    robots: Vec<Whereabout>,
}

/// Where robots are, as they said last, and the way that each follows, with what it was told. Whoever was not heard for ten
/// minutes and follows no route is left out; nothing of it outlives the service.
#[utoipa::path(get, path = "/api/whereabouts", tag = "robots", responses((status = 200, body = WhereaboutsAnswer)))]
pub async fn list(site: Site) -> Answered<Json<WhereaboutsAnswer>> {
    let shared = site.shared.clone();
    let answer = site.beside(move || {
        let seen = shared.view.load_full();
        let robots = shared.whereabouts.listed(shared.followers.listed(), &seen.view);
        Ok::<_, Fault>(WhereaboutsAnswer { generation: seen.view.generation(), robots })
    });
    answer.await.map(Json)
}

#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct WhereaboutsBody {
    /// At most 1,000; all of them are taken up, or none.
    robots: Vec<WhereaboutBody>,
}

/// Where a robot is.
#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
struct WhereaboutBody {
    /// What people call it; whoever follows a route with the same `name` is the same robot.
    name: String,
    /// Metres, in the map's frame.
    x: f64,
    y: f64,
    /// Degrees, counterclockwise from the x axis.
    #[serde(default)]
    heading: Option<f64>,
    /// Whose routes it drives.
    #[serde(default)]
    robot: Option<String>,
    /// In which state it is.
    #[serde(default)]
    state: Option<String>,
    /// What it does, in a few words.
    #[serde(default)]
    doing: Option<String>,
}

#[derive(Serialize, ToSchema)]
pub struct Heard {
    /// How many robots were spoken of.
    robots: usize,
}

/// Says where robots are, for people who look on; no route follows from it.
#[utoipa::path(post, path = "/api/whereabouts", tag = "robots", request_body = WhereaboutsBody,
    responses((status = 200, body = Heard)))]
pub async fn hear(
    site: Site,
    caller: Caller,
    Body(WhereaboutsBody { robots }): Body<WhereaboutsBody>,
) -> Answered<Json<Heard>> {
    require(&caller, Role::Tell)?;
    let refused = |message: String| Err(Fault::new(Code::ServiceQuestion, message));
    if robots.len() > MOST {
        return refused(format!("{} robots are said at once, and at most {MOST} are taken", robots.len()));
    }
    let known = site.view.load().view.robots().to_vec();
    let mut names = BTreeSet::new();
    let mut reports = Vec::with_capacity(robots.len());
    for said in robots {
        let name = short("name", &said.name)?;
        if !names.insert(name.clone()) {
            return refused(format!("`{name}` is said to be at two places at once"));
        }
        let robot = said.robot.map(|robot| pick(&known, Some(&robot))).transpose()?;
        let [state, doing] = [("state", said.state), ("doing", said.doing)]
            .map(|(what, text)| text.map(|text| short(what, &text)).transpose());
        let at = Point::new(said.x, said.y);
        let report = Report {
            robot,
            at,
            heading: said.heading,
            state: state?,
            doing: doing?,
            who: caller.name.clone(),
            heard: Instant::now(),
        };
        reports.push((name, report));
    }
    let robots = reports.len();
    site.whereabouts.hear(reports)?;
    Ok(Json(Heard { robots }))
}

#[derive(Serialize, ToSchema)]
pub struct Forgotten {
    forgotten: String,
}

/// A robot is nowhere any more: it was switched off, or carried away.
#[utoipa::path(delete, path = "/api/whereabouts/{name}", tag = "robots",
    params(("name" = String, Path, description = "What people call it")), responses((status = 200, body = Forgotten)))]
pub async fn forget(site: Site, caller: Caller, Named(name): Named<String>) -> Answered<Json<Forgotten>> {
    require(&caller, Role::Tell)?;
    if !site.whereabouts.forget(&name) {
        return Err(Fault::new(Code::WhereaboutsUnknown, format!("nobody said where a robot `{name}` is")));
    }
    Ok(Json(Forgotten { forgotten: name }))
}
