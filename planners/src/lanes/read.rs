//! Which format a file has, and its reader.

use std::path::Path;

use super::check::Place;
use super::{LaneGraph, building, check, geojson, lif, nav_graph, numbers, rmf_site, tmap};
use crate::read::{At, Code, Problem, Read, Source};

/// The formats that are told apart by what stands at the top of a file.
#[derive(Clone, Copy)]
enum Kind {
    Building,
    NavGraph,
    RmfSite,
    Nav2,
    Lif,
    TopologicalMap,
}

/// Whether a file is a lane graph, as far as its name and its beginning say.
pub fn is_lane_graph(path: &Path) -> bool {
    let name = path.file_name().map_or_else(String::new, |name| name.to_string_lossy().to_lowercase());
    if [".json", ".geojson", ".lif", ".tmap2", ".building.yaml"].iter().any(|end| name.ends_with(end)) {
        // one that is not there is refused as such by its reader
        return !path.is_dir();
    }
    if ![".yaml", ".yml"].iter().any(|end| name.ends_with(end)) {
        return false;
    }
    let text = std::fs::read_to_string(path).unwrap_or_default();
    let text = without_mark(&text);
    let starts = |key: &str| text.starts_with(key) || text.contains(&format!("\n{key}"));
    !starts("image:") && (starts("levels:") || starts("nodes:") || text.trim_start().starts_with('{'))
}

/// Reads a lane graph.
pub fn read_lane_graph(path: &Path) -> Result<LaneGraph, Problem> {
    let file = path.display().to_string();
    let text = crate::read::text_of(path)
        .map_err(|error| Problem::of_file(Code::Unreadable, format!("{file} cannot be read: {error}")))?;
    let stem = path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
    let mut graph = parse(&file, &text)?;
    if graph.name.is_empty() {
        stem.split('.').next().unwrap_or_default().clone_into(&mut graph.name);
    }
    Ok(graph)
}

/// A text without the mark of byte order that some editors put before it.
fn without_mark(text: &str) -> &str {
    text.strip_prefix('\u{feff}').unwrap_or(text)
}

/// Reads a text; `file` is how messages call it.
pub(super) fn parse(file: &str, text: &str) -> Result<LaneGraph, Problem> {
    let source = Source::read(file, text)?;
    of_top(file, &source.top())
}

fn of_top(file: &str, top: &At<'_>) -> Read<LaneGraph> {
    let mut graph = match kind(top)? {
        Kind::Building => building::read(top)?,
        Kind::NavGraph => nav_graph::read(top)?,
        Kind::RmfSite => rmf_site::read(top)?,
        Kind::Nav2 => geojson::read(top)?,
        Kind::Lif => lif::read(top)?,
        Kind::TopologicalMap => tmap::read(top)?,
    };
    graph.note_doubts();
    numbers::fill(&mut graph);
    check::refuse_wrong(&graph).map_err(|wrong| match mentions(top, &wrong.place) {
        Some(at) => at.said(wrong.code, &wrong.message),
        None => Problem::of_file(wrong.code, format!("{file}: {}", wrong.message)),
    })?;
    Ok(graph)
}

/// Where a file of LIF, of Nav2 or of topological navigation says what is wrong.
fn mentions<'v>(top: &At<'v>, place: &Place) -> Option<At<'v>> {
    let (keys, id, before): (&[&str], _, _) = match place {
        Place::Twice("node", id) => (&["nodeId", "id"], id, 1),
        Place::Twice("lane", id) => (&["edgeId", "edge_id"], id, 1),
        Place::Twice("level", id) => (&["layoutId"], id, 1),
        Place::Twice("station", id) => (&["stationId"], id, 1),
        Place::Missing(id) => {
            (&["startNodeId", "endNodeId", "interactionNodeIds", "startid", "endid", "node"], id, 0)
        }
        Place::Twice(..) | Place::Anywhere => return None,
    };
    let mut found = Vec::new();
    search(top, &|key| keys.contains(&key), id, &mut found);
    found.into_iter().nth(before)
}

/// Collects the values of such keys, or in the lists under them, that are an id.
fn search<'v>(at: &At<'v>, is_key: &dyn Fn(&str) -> bool, id: &str, found: &mut Vec<At<'v>>) {
    for (key, value) in at.entries().unwrap_or_default() {
        // edges of Nav2 have an `id`, too
        let is_edge = key == "id" && at.get("startid").is_some();
        let mut values = value.items().unwrap_or_else(|_| vec![value.clone()]);
        values.retain(|value| is_key(key) && !is_edge && value.id().is_ok_and(|own| own == id));
        found.append(&mut values);
        search(&value, is_key, id, found);
    }
    for item in at.items().unwrap_or_default() {
        search(&item, is_key, id, found);
    }
}

fn kind(top: &At<'_>) -> Read<Kind> {
    if !top.value.is_object() {
        return Err(top.wrong("an object, as lane graphs are"));
    }
    let has = |key| top.get(key).is_some();
    // what is written for others keeps what its file said as a whole, so that LIF's `metaInformation` stands in any of them
    Ok(if has("features") || top.get("type").is_some_and(|of| of.value == "FeatureCollection") {
        Kind::Nav2
    } else if has("layouts") {
        Kind::Lif
    } else if has("format_version") || has("navigation") {
        Kind::RmfSite
    } else if has("levels") && has("building_name") {
        Kind::NavGraph
    } else if has("levels") {
        Kind::Building
    } else if has("metaInformation") {
        Kind::Lif
    } else if has("nodes") {
        Kind::TopologicalMap
    } else {
        let help = "a building, site or navigation graph of Open-RMF has `levels`, a route graph of Nav2 `features`, \
                    LIF `layouts`, a topological map `nodes`";
        return Err(top.problem(Code::UnknownFormat, "is no lane graph that Adit reads").with_help(help));
    })
}
