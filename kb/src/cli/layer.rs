//! `adit export SITE LAYER`: a layer of the site for a geographic information system.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use adit_db::layer::{Layer, Shape};
use adit_db::place::Place;
use adit_db::relation::Relation;
use adit_db::{Cell, Store, Tx};
use adit_planners::lanes::Format;
use serde_json::{Map, Value};

use super::args::SiteArgs;
use super::build::open;
use super::output::{json, line, remark};
use crate::error::{Code, Error, Result};
use crate::site::whole;
use crate::words::number::counted;
use crate::words::suggest::did_you_mean;

/// The layer of areas, the table of what is said of each, and its columns that the layer has already.
const AREAS: (&str, &str, [&str; 4]) = ("map_areas", "areas", ["area", "kind", "x", "y"]);

/// The layer of routes.
const ROUTES: &str = "map_routes";

/// Writes a layer as GeoJSON, in the metres of the map.
pub fn run(site: &SiteArgs, name: &str, to: &Path) -> Result<()> {
    if !to.extension().is_some_and(|end| end == "geojson" || end == "json") {
        let message = format!("{} is neither .geojson nor .json", to.display());
        return Err(Error::said(Code::LayerFile, message, None));
    }
    if matches!(Format::of(to), Some(Format::Lif)) {
        let message = format!("{} is the name of a lane graph's file, and `{name}` is a layer", to.display());
        let help = Some("a layer goes into a .geojson or another .json".to_owned());
        return Err(Error::said(Code::LayerFile, message, help));
    }
    let knowledge = open(site)?;
    knowledge.spare_own(to)?;
    let (layer, rows, said, others, apart) =
        Store::open_read_only(knowledge.database())?.snapshot(|tx| -> Result<_> {
            let layers = tx.layers()?;
            let is_meant = |layer: &&Layer| layer.name == name || layer.table == name;
            let layer = layers.iter().find(is_meant).ok_or_else(|| unknown(name, &layers))?.clone();
            let rows = tx.read_table(&layer.table)?;
            let mut others = Vec::new();
            for other in layers.into_iter().filter(|_| rows_of(&rows) == 0) {
                if rows_of(&tx.read_table(&other.table)?) > 0 {
                    others.push(other.name);
                }
            }
            let said = if layer.table == AREAS.0 { of_areas(tx)? } else { BTreeMap::new() };
            let apart = if layer.table == ROUTES { apart(tx, &rows)? } else { Vec::new() };
            Ok((layer, rows, said, others, apart))
        })?;
    let features = features(&layer, &rows, &said)?;
    let count = features.len();
    let collection =
        serde_json::json!({"type": "FeatureCollection", "name": layer.name, "features": features});
    whole::write(to, collection.to_string().as_bytes())?;
    if site.json {
        return json(&serde_json::json!({"file": to, "features": count}));
    }
    line(&format!("{}: {} of {}", to.display(), counted(count, "feature"), layer.name));
    if let [first, more @ ..] = apart.as_slice() {
        let more = if more.is_empty() { String::new() } else { format!(" and {} more pairs", more.len()) };
        remark(&format!("there is no route, and no line, {first}{more}"));
    }
    if count == 0 {
        let others = match others.as_slice() {
            [] => "and so are all other layers".to_owned(),
            some => format!("layers that are not: {}", some.join(", ")),
        };
        remark(&format!("`{}` is empty; {others}", layer.name));
    }
    Ok(())
}

/// The places between which there is no route, each as `from dock to lobby`.
fn apart(tx: &mut Tx<'_>, routes: &Relation) -> Result<Vec<String>> {
    let column = |name: &str| routes.column(name);
    let [Some(robots), Some(starts), Some(goals)] = ["robot", "start", "goal"].map(column) else {
        return Ok(Vec::new());
    };
    let ends = |row: usize| [robots, starts, goals].map(|column| column.values[row].to_string());
    let known: BTreeSet<[String; 3]> = (0..rows_of(routes)).map(ends).collect();
    let places = tx.places()?;
    let pairs = tx.starts()?.into_iter().flat_map(|start| {
        let ends = |place: &Place| [start.robot.clone(), start.name.clone(), place.place.clone()];
        places.iter().map(ends).collect::<Vec<_>>()
    });
    let is_apart = |ends: &[String; 3]| ends[1] != ends[2] && !known.contains(ends);
    Ok(pairs.filter(is_apart).map(|[_, start, goal]| format!("from {start} to {goal}")).collect())
}

fn unknown(name: &str, layers: &[Layer]) -> Error {
    let names = || layers.iter().map(|layer| layer.name.as_str());
    let known = || format!("there are {}", names().collect::<Vec<_>>().join(", "));
    let help = did_you_mean(name, names()).unwrap_or_else(known);
    Error::said(Code::LayerUnknown, format!("the site has no layer `{name}`"), Some(help))
}

/// By name what else is said of areas, whatever properties those of the site have.
fn of_areas(tx: &mut Tx<'_>) -> Result<BTreeMap<String, Map<String, Value>>> {
    let (_, table, known) = AREAS;
    if !tx.user_tables()?.iter().any(|of| of.name == table) {
        return Ok(BTreeMap::new());
    }
    let relation = tx.read_table(table)?;
    let mut said = BTreeMap::<String, Map<String, Value>>::new();
    let names = relation.column(known[0]);
    for (row, name) in names.iter().flat_map(|names| names.values.iter().enumerate()) {
        let Cell::Text(name) = name else { continue };
        let of = said.entry(name.clone()).or_default();
        for column in relation.columns.iter().filter(|column| !known.contains(&column.name.as_str())) {
            if column.values[row] != Cell::Null {
                of.insert(column.name.clone(), serde_json::json!(column.values[row]));
            }
        }
    }
    Ok(said)
}

/// The rows as features of GeoJSON, each with what else is said of its name; one without a shape has `null`, as GeoJSON wants it.
fn features(
    layer: &Layer,
    rows: &Relation,
    said: &BTreeMap<String, Map<String, Value>>,
) -> Result<Vec<Value>> {
    let feature = |row: usize| {
        let (mut properties, mut geometry) = (Map::new(), Value::Null);
        for column in &rows.columns {
            match &column.values[row] {
                Cell::Blob(blob) if column.name == layer.shape => {
                    let shape = Shape::of_blob(blob).ok_or_else(|| unreadable(&layer.table, row + 1))?;
                    geometry = geojson(&shape);
                }
                _ if column.name == layer.shape => {}
                cell => _ = properties.insert(column.name.clone(), serde_json::json!(cell)),
            }
        }
        let more = properties.get("name").and_then(Value::as_str).and_then(|name| said.get(name));
        properties.extend(more.cloned().unwrap_or_default());
        Ok(serde_json::json!({"type": "Feature", "geometry": geometry, "properties": properties}))
    };
    (0..rows_of(rows)).map(feature).collect()
}

fn rows_of(relation: &Relation) -> usize {
    relation.columns.first().map_or(0, |column| column.values.len())
}

fn unreadable(table: &str, row: usize) -> Error {
    let message = format!("the shape in row {row} of `{table}` is neither a line nor a polygon of the plane");
    Error::said(Code::LayerUnreadable, message, None)
}

fn geojson(shape: &Shape) -> Value {
    match shape {
        Shape::LineString(points) => serde_json::json!({"type": "LineString", "coordinates": points}),
        Shape::Polygon(rings) => serde_json::json!({"type": "Polygon", "coordinates": rings}),
    }
}
