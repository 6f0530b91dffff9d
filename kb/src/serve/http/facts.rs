//! Facts that people and robots tell.

use axum::Json;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::edits::{self, Edited, Scalar, Wish};
use super::extract::Site;
use super::extract::{Asked, Body, Named};
use crate::edit::Edit;
use crate::graph::Building;
use crate::serve::fault::Answered;
use crate::serve::gate::require;
use crate::serve::role::{Caller, Role};
#[derive(Serialize, ToSchema)]
pub struct FactsAnswer {
    generation: u64,
    /// In the order in which they were told.
    facts: Vec<FactOf>,
}

#[derive(Serialize, ToSchema)]
struct FactOf {
    id: i64,
    class: String,
    /// The object: its name, or `x,y`.
    object: String,
    /// The objects that it is about now, as people call them.
    about: Vec<String>,
    property: String,
    #[schema(value_type = serde_json::Value)]
    value: serde_json::Value,
    /// When it ends, in UTC.
    until: Option<String>,
    who: String,
    /// When, in UTC.
    at: String,
    why: String,
    /// holds, lost (it no longer finds what it is about) or expired.
    standing: &'static str,
}

/// All facts that are told.
#[utoipa::path(get, path = "/api/facts", tag = "facts", responses((status = 200, body = FactsAnswer)))]
pub async fn list(site: Site) -> Answered<Json<FactsAnswer>> {
    let answer = site.read(|tx| {
        let generation = crate::knowledge::generation::read(tx)?;
        let standings = tx.standings()?;
        let standing = |id: i64| {
            let state = standings.iter().find(|standing| standing.told == id);
            match state.map(|standing| standing.state.as_str()) {
                Some("lost") => "lost",
                Some("expired") => "expired",
                _ => "holds",
            }
        };
        let building = Building::read(tx)?;
        let about = |fact: &adit_db::told::Told| -> Vec<String> {
            let standing = standings.iter().find(|standing| standing.told == fact.id);
            let keys = standing.into_iter().flat_map(|standing| &standing.keys);
            keys.map(|key| building.called(&fact.class, key).unwrap_or_else(|| key.clone())).collect()
        };
        let facts = tx.facts_told()?.into_iter().map(|fact| FactOf {
            about: about(&fact),
            standing: standing(fact.id),
            id: fact.id,
            class: fact.class,
            object: fact.key.or_else(|| fact.at.map(|[x, y]| format!("{x},{y}"))).unwrap_or_default(),
            property: fact.property,
            value: match (fact.kind.as_str(), fact.value) {
                ("truth", adit_db::Cell::Integer(truth)) => serde_json::json!(truth != 0),
                (_, value) => serde_json::json!(value),
            },
            until: fact.until,
            who: fact.who,
            at: fact.told_at,
            why: fact.why,
        });
        Ok(FactsAnswer { generation, facts: facts.collect() })
    });
    answer.await.map(Json)
}

#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct TellBody {
    class: String,
    object: String,
    property: String,
    #[schema(value_type = serde_json::Value)]
    value: Scalar,
    #[serde(default)]
    until: Option<String>,
    #[serde(default)]
    for_seconds: Option<u32>,
    #[serde(default)]
    why: Option<String>,
}

#[derive(Serialize, ToSchema)]
pub struct Told {
    fact: i64,
    #[serde(flatten)]
    edited: Edited,
}

/// Tells a fact: "door 7 is closed", "spill in room d". It stands before what rules conclude until it ends.
#[utoipa::path(post, path = "/api/facts", tag = "facts", request_body = TellBody,
    responses((status = 200, body = Told)))]
pub async fn tell(site: Site, caller: Caller, Body(body): Body<TellBody>) -> Answered<Json<Told>> {
    require(&caller, Role::Tell)?;
    let TellBody { class, object, property, value, until, for_seconds, why } = body;
    let edit = Wish::Tell { class, object, property, value, until, for_seconds }.edit()?;
    let edited = edits::make(&site, &caller, edit, why.unwrap_or_default()).await?;
    let fact = edited.done.as_ref().and_then(|done| done.key.parse().ok()).unwrap_or_default();
    Ok(Json(Told { fact, edited }))
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Why {
    #[serde(default)]
    pub why: String,
}

/// Takes a fact back.
#[utoipa::path(delete, path = "/api/facts/{fact}", tag = "facts",
    params(("fact" = i64, Path, description = "Its number"), ("why" = Option<String>, Query, description = "Why")),
    responses((status = 200, body = Edited)))]
pub async fn retract(
    site: Site,
    caller: Caller,
    Named(fact): Named<i64>,
    Asked(Why { why }): Asked<Why>,
) -> Answered<Json<Edited>> {
    require(&caller, Role::Tell)?;
    edits::make(&site, &caller, Edit::Retract(fact), why).await.map(Json)
}
