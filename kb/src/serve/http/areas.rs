//! Areas, obstacles and places that people lay over the map.

use std::collections::BTreeMap;

use adit_db::relation::Relation;
use adit_db::{Cell, Tx};
use axum::Json;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use utoipa::ToSchema;

use super::edits::{self, Edited, LaidBody, LaidThing, Scalar, Wish};
use super::extract::{Asked, Body, Named, Site};
use super::facts::Why;
use crate::edit::Edit;
use crate::error::Result;
use crate::serve::fault::Answered;
use crate::serve::gate::require;
use crate::serve::role::{Caller, Role};

#[derive(Serialize, ToSchema)]
pub struct AreasAnswer {
    generation: u64,
    /// By name.
    laid: Vec<LaidOf>,
    /// All areas, those of the map too, by name.
    areas: Vec<NamedArea>,
}

#[derive(Serialize, ToSchema)]
struct NamedArea {
    name: String,
    kind: Option<String>,
    /// A list of `[x, y]`, metres.
    #[schema(value_type = Vec<[f64; 2]>)]
    corners: Value,
    /// What the map, people and rules say of it.
    #[schema(value_type = Object)]
    properties: Map<String, Value>,
}

#[derive(Serialize, ToSchema)]
struct LaidOf {
    name: String,
    /// area, obstacle or place.
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

/// What people laid over the map; and all areas with what is said of each.
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
        Ok(AreasAnswer { generation, laid: laid.collect(), areas: named(tx)? })
    });
    answer.await.map(Json)
}

/// The areas as the last build knows them, with what is said of each, and what rules conclude.
fn named(tx: &mut Tx<'_>) -> Result<Vec<NamedArea>> {
    let mut areas: BTreeMap<String, NamedArea> = BTreeMap::new();
    for row in tx.area_outlines()? {
        let corners = serde_json::from_str(&row.outline).unwrap_or_default();
        let area = NamedArea { name: row.area.clone(), kind: row.kind, corners, properties: Map::new() };
        areas.insert(row.area, area);
    }
    let mut say = |area: &Cell, property: &str, value: Value| {
        if let (Cell::Text(area), false) = (area, value.is_null())
            && let Some(area) = areas.get_mut(area)
        {
            area.properties.insert(property.to_owned(), value);
        }
    };
    if tx.user_tables()?.iter().any(|table| table.name == "areas") {
        let said = tx.read_table("areas")?;
        let names = values(&said, "area");
        let known = ["area", "kind", "x", "y"];
        for column in said.columns.iter().filter(|column| !known.contains(&column.name.as_str())) {
            for (area, cell) in names.iter().zip(&column.values) {
                let value = match cell {
                    Cell::Integer(truth) if column.declared.contains("BOOL") => Value::from(*truth != 0),
                    other => serde_json::json!(other),
                };
                say(area, &column.name, value);
            }
        }
    }
    let concluded = tx.read_table("derivations")?;
    let [classes, keys, properties, found] =
        ["class", "key", "property", "value"].map(|column| values(&concluded, column));
    let of_areas = (0..classes.len()).filter(|&row| classes[row] == Cell::from("areas"));
    for row in of_areas {
        say(&keys[row], &properties[row].to_string(), serde_json::json!(found[row]));
    }
    Ok(areas.into_values().collect())
}

fn values<'r>(relation: &'r Relation, name: &str) -> &'r [Cell] {
    let column = relation.column(name);
    column.map_or(&[][..], |column| column.values.as_slice())
}

#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct AreaBody {
    #[serde(default)]
    what: LaidThing,
    name: String,
    /// `[x, y]` in metres, in the order in which they follow one another; two are those of a rectangle, and one is a place.
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

/// Lays an area, an obstacle or a place over the map. The same as the edit `lay`.
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
