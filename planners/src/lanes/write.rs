//! Lane graphs as files of others. Each format is written with what this file gives, and this file asks it: a circle that stays.

mod geojson;
mod lif;
mod nav_graph;

use std::path::Path;

use super::{Lane, LaneGraph, Node};

/// A format that is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// A navigation graph of Open-RMF.
    NavGraph,
    /// A route graph of Nav2.
    RouteGraph,
    Lif,
}

impl Format {
    /// The format of a file of this name.
    pub fn of(path: &Path) -> Option<Self> {
        let name = path.file_name()?.to_string_lossy().to_lowercase();
        let has = |ends: &[&str]| ends.iter().any(|end| name.ends_with(end));
        if has(&[".lif.json", ".lif"]) {
            Some(Self::Lif)
        } else if has(&[".geojson"]) {
            Some(Self::RouteGraph)
        } else if has(&[".yaml", ".yml"]) {
            Some(Self::NavGraph)
        } else {
            None
        }
    }

    /// What people call it.
    pub const fn words(self) -> &'static str {
        match self {
            Self::NavGraph => "a navigation graph of Open-RMF",
            Self::RouteGraph => "a route graph of Nav2",
            Self::Lif => "LIF",
        }
    }
}

/// A text, and what of the graph it cannot say, in sentences.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Exported {
    pub text: String,
    pub notes: Vec<String>,
}

/// More nodes or lanes than Nav2 can number: its ids have sixteen bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "a route graph of Nav2 has at most 65,536 nodes and as many edges; this one has {nodes} nodes and {lanes} lanes"
)]
pub struct TooMany {
    pub nodes: usize,
    pub lanes: usize,
}

/// Writes a graph; the same one gives the same text.
pub fn write(graph: &LaneGraph, format: Format) -> Result<Exported, TooMany> {
    let mut sorted = graph.clone();
    sorted.nodes.sort_by_key(|node| node.number.map_or(u64::MAX, u64::from));
    sorted.lanes.sort_by_key(|lane| lane.number.map_or(u64::MAX, u64::from));
    match format {
        Format::NavGraph => Ok(nav_graph::write(&sorted)),
        Format::RouteGraph => geojson::write(&sorted),
        Format::Lif => Ok(lif::write(&sorted)),
    }
}

/// How many lanes say something that a format has no word for.
fn note(graph: &LaneGraph, what: &str, has: impl Fn(&Lane) -> bool) -> Option<String> {
    let count = graph.lanes.iter().filter(|lane| has(lane)).count();
    let lanes = if count == 1 { "lane" } else { "lanes" };
    (count > 0).then(|| format!("{count} {lanes}: {what}"))
}

/// Which heights of levels a format has no word for.
fn note_heights(graph: &LaneGraph, format: &str) -> Option<String> {
    let high = graph.levels.iter().filter(|level| level.elevation != 0.0);
    let high: Vec<String> = high.map(|level| format!("{} ({} m)", level.level, level.elevation)).collect();
    (!high.is_empty()).then(|| format!("how high levels are has no place in {format}: {}", high.join(", ")))
}

/// As [`note`], of nodes.
fn note_nodes(graph: &LaneGraph, what: &str, has: impl Fn(&Node) -> bool) -> Option<String> {
    let count = graph.nodes.iter().filter(|node| has(node)).count();
    let nodes = if count == 1 { "node" } else { "nodes" };
    (count > 0).then(|| format!("{count} {nodes}: {what}"))
}
