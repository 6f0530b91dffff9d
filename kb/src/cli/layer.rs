//! `adit export`: a layer of the site for a geographic information system.

use std::path::PathBuf;

use adit_db::layer::{Layer, Shape};
use adit_db::relation::Relation;
use adit_db::{Cell, Store};
use clap::Args;
use serde_json::{Map, Value};

use super::args::SiteArgs;
use super::build::open;
use super::output::{json, line};
use crate::error::{Code, Error, Result};
use crate::site::whole;
use crate::words::suggest::did_you_mean;

#[derive(Args, Debug)]
pub struct ExportArgs {
    #[command(flatten)]
    pub site: SiteArgs,
    /// What: rooms, spaces, doorways, areas, routes, drawn, or a layer that you put into the database
    pub layer: String,
    /// The file: .geojson or .json
    #[arg(long, value_name = "FILE")]
    pub to: PathBuf,
}

/// Writes a layer as GeoJSON, in the metres of the map.
pub fn run(args: &ExportArgs) -> Result<()> {
    if !args.to.extension().is_some_and(|end| end == "geojson" || end == "json") {
        let message = format!("{} is neither .geojson nor .json", args.to.display());
        return Err(Error::said(Code::LayerFile, message, None));
    }
    let knowledge = open(&args.site)?;
    let (layer, rows) = Store::open_read_only(knowledge.database())?.snapshot(|tx| -> Result<_> {
        let layers = tx.layers()?;
        let is_meant = |layer: &&Layer| layer.name == args.layer || layer.table == args.layer;
        let layer = layers.iter().find(is_meant).ok_or_else(|| unknown(&args.layer, &layers))?.clone();
        let rows = tx.read_table(&layer.table)?;
        Ok((layer, rows))
    })?;
    let features = features(&layer, &rows)?;
    let count = features.len();
    let collection =
        serde_json::json!({"type": "FeatureCollection", "name": layer.name, "features": features});
    whole::write(&args.to, collection.to_string().as_bytes())?;
    if args.site.json {
        return json(&serde_json::json!({"file": args.to, "features": count}));
    }
    let s = if count == 1 { "" } else { "s" };
    line(&format!("{}: {count} feature{s} of {}", args.to.display(), layer.name));
    Ok(())
}

fn unknown(name: &str, layers: &[Layer]) -> Error {
    let names = || layers.iter().map(|layer| layer.name.as_str());
    let known = || format!("there are {}", names().collect::<Vec<_>>().join(", "));
    let help = did_you_mean(name, names()).unwrap_or_else(known);
    Error::said(Code::LayerUnknown, format!("the site has no layer `{name}`"), Some(help))
}

/// The rows as features of GeoJSON; one without a shape has `null`, as that wants it.
fn features(layer: &Layer, rows: &Relation) -> Result<Vec<Value>> {
    let count = rows.columns.first().map_or(0, |column| column.values.len());
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
        Ok(serde_json::json!({"type": "Feature", "geometry": geometry, "properties": properties}))
    };
    (0..count).map(feature).collect()
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
