//! The service itself: whether it lives, what it serves, what it counts, how it is described.

use std::sync::OnceLock;

use adit_db::measure::Measure;
use axum::Json;
use axum::http::header;
use axum::response::{IntoResponse, Response};
use serde::Serialize;
use utoipa::ToSchema;

use super::extract::Site;
use crate::error::Code;
use crate::error::problem::Problem;
use crate::serve::fault::{Answered, Fault};
use crate::serve::role::{Caller, Role};
use crate::serve::{gate, meter};

/// Whether the service lives: two bytes. No token is asked for.
#[utoipa::path(get, path = "/api/health", tag = "service", responses((status = 200, body = String, content_type = "text/plain")))]
pub async fn health() -> &'static str {
    "ok"
}

/// Whether edits can be saved: `ready`, or 503 and what is in the way. No token is asked for.
#[utoipa::path(get, path = "/api/ready", tag = "service", responses((status = 200, body = String, content_type = "text/plain")))]
pub async fn ready(shared: Site) -> Answered<&'static str> {
    let hindrances = shared.hindrances();
    match hindrances.first() {
        None => Ok("ready"),
        Some(first) => {
            let what = first.code.map_or("a fault of the service", Code::as_str);
            // what names files is for those who have a token
            Err(Fault::new(Code::ServiceNotReady, format!("edits cannot be saved ({what})"))
                .helped("`problems` of `/api/site` says more"))
        }
    }
}

#[derive(Serialize, ToSchema)]
pub struct SiteAnswer {
    name: String,
    /// Number of the knowledge base's state; it grows with every change.
    generation: u64,
    /// Names the cut of the floor: while it stays, numbers of rooms and doors mean what they meant.
    layout: String,
    /// by-state, paper, minimum, or none.
    rooms_mode: &'static str,
    /// What the map is, where it is not cut into rooms: corridors or parts. Then `/api/picture` draws it.
    layout_kind: Option<&'static str>,
    robots: Vec<String>,
    /// The map's edges, metres: x0, y0, x1, y1.
    bounds: [f64; 4],
    rooms: usize,
    doors: usize,
    places: usize,
    /// What the caller may do.
    roles: Vec<Role>,
    who: String,
    /// When the last change came into force, in UTC.
    changed_at: String,
    /// What is wrong with files that were saved, or with the place where edits are saved; the site goes on with what was
    /// before.
    problems: Vec<Problem>,
    /// Whether routes kept in the database have yet to follow the last change; answers of this service do so at once.
    routes_due: bool,
    /// What the expert should know, in sentences.
    notes: Vec<String>,
    /// What adds up along routes besides hardness, with its unit.
    measures: Vec<Measure>,
    version: &'static str,
}

/// What is served, and where it stands.
#[utoipa::path(get, path = "/api/site", tag = "service", responses((status = 200, body = SiteAnswer)))]
pub async fn site(shared: Site, caller: Caller) -> Answered<Json<SiteAnswer>> {
    let measures = shared.read(|tx| Ok(tx.measures()?)).await?;
    let seen = shared.view.load();
    let view = &seen.view;
    let (graph, site) = (view.graph(), view.site().site());
    let bounds = view.bounds();
    Ok(Json(SiteAnswer {
        name: site.name.clone(),
        generation: view.generation(),
        layout: view.layout().to_owned(),
        rooms_mode: site.rooms.name(),
        layout_kind: view.site().course().map(|course| course.name()),
        robots: view.robots().to_vec(),
        bounds: [bounds.x0, bounds.y0, bounds.x1, bounds.y1],
        rooms: graph.rooms.len(),
        doors: graph.doors.len(),
        places: view.places().count(),
        roles: caller.allowed(),
        who: caller.name,
        changed_at: seen.since.clone(),
        problems: shared.problems(),
        routes_due: view.routes_due(),
        notes: seen.notes.clone(),
        measures,
        version: env!("CARGO_PKG_VERSION"),
    }))
}

/// This description.
#[utoipa::path(get, path = "/api/openapi.json", tag = "service", responses((status = 200, body = Object)))]
pub async fn openapi() -> Response {
    static TEXT: OnceLock<String> = OnceLock::new();
    let text = TEXT.get_or_init(|| super::openapi().to_json().unwrap_or_default());
    ([(header::CONTENT_TYPE, "application/json")], text.as_str()).into_response()
}

/// What is counted and timed, for Prometheus.
#[utoipa::path(get, path = "/metrics", tag = "service", responses((status = 200, body = String, content_type = "text/plain")))]
pub async fn metrics(site: Site, caller: Caller) -> Answered<Response> {
    gate::require(&caller, Role::Read)?;
    Ok(([(header::CONTENT_TYPE, "text/plain; version=0.0.4")], meter::text(&site)).into_response())
}
