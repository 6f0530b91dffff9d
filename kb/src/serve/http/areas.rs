//! Areas and obstacles that people lay over the map.

use std::collections::BTreeMap;

use axum::Json;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use utoipa::ToSchema;

use super::edits::{self, Edited, LaidBody, LaidThing, Scalar, Wish};
use super::extract::{Asked, Body, Named, Site};
use super::facts::Why;
use crate::edit::Edit;
use crate::serve::fault::Answered;
use crate::serve::gate::require;
use crate::serve::role::{Caller, Role};

#[derive(Serialize, ToSchema)]
pub struct AreasAnswer {
    generation: u64,
    /// By name.
    laid: Vec<LaidOf>,
}

#[derive(Serialize, ToSchema)]
struct LaidOf {
    name: String,
    /// area or obstacle.
    what: String,
    kind: Option<String>,
    /// A list of `[x, y]`, metres.
    #[schema(value_type = Vec<[f64; 2]>)]
    corners: Value,
    #[schema(value_type = Object)]
    properties: Value,
    /// When it ends, in UTC.
    until: Option<String>,
    who: String,
    /// When, in UTC.
    at: String,
    why: String,
}

/// What people laid over the map. The map's own areas are in `/api/map`.
#[utoipa::path(get, path = "/api/areas", tag = "facts", responses((status = 200, body = AreasAnswer)))]
pub async fn list(site: Site) -> Answered<Json<AreasAnswer>> {
    let answer = site.read(|tx| {
        let generation = crate::knowledge::generation::read(tx)?;
        let json = |text: &str| serde_json::from_str(text).unwrap_or_default();
        let laid = tx.laid()?.into_iter().map(|row| LaidOf {
            corners: json(&row.outline),
            properties: json(&row.properties),
            name: row.name,
            what: row.what,
            kind: row.kind,
            until: row.until,
            who: row.who,
            at: row.at,
            why: row.why,
        });
        Ok(AreasAnswer { generation, laid: laid.collect() })
    });
    answer.await.map(Json)
}

#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct AreaBody {
    #[serde(default)]
    what: LaidThing,
    name: String,
    /// `[x, y]` in metres, in the order in which they follow one another; two are those of a rectangle.
    corners: Vec<[f64; 2]>,
    /// What is said of an area; `kind` is what it is: `wet`, `keep-out`.
    #[serde(default)]
    #[schema(value_type = BTreeMap<String, serde_json::Value>)]
    properties: BTreeMap<String, Scalar>,
    /// When it ends: `18:00`, `2h`, `2026-11-21T18:00:00Z`.
    #[serde(default)]
    until: Option<String>,
    /// After how many seconds it ends, instead.
    #[serde(default)]
    for_seconds: Option<u32>,
    #[serde(default)]
    why: Option<String>,
}

/// Lays an area or an obstacle over the map. The same as the edit `lay`.
#[utoipa::path(post, path = "/api/areas", tag = "facts", request_body = AreaBody,
    responses((status = 200, body = Edited)))]
pub async fn lay(site: Site, caller: Caller, Body(body): Body<AreaBody>) -> Answered<Json<Edited>> {
    require(&caller, Role::Tell)?;
    let AreaBody { what, name, corners, properties, until, for_seconds, why } = body;
    let edit = Wish::Lay(LaidBody { what, name, corners, properties, until, for_seconds }).edit()?;
    edits::make(&site, &caller, edit, why.unwrap_or_default()).await.map(Json)
}

/// Takes away what was laid over the map. The same as the edit `lift`.
#[utoipa::path(delete, path = "/api/areas/{name}", tag = "facts",
    params(("name" = String, Path, description = "Its name"), ("why" = Option<String>, Query, description = "Why")),
    responses((status = 200, body = Edited)))]
pub async fn lift(
    site: Site,
    caller: Caller,
    Named(name): Named<String>,
    Asked(Why { why }): Asked<Why>,
) -> Answered<Json<Edited>> {
    require(&caller, Role::Tell)?;
    edits::make(&site, &caller, Edit::Lift(name), why).await.map(Json)
}
