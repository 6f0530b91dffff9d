//! A topological map of STRANDS and LCAS: `tmap2`, where each edge names an action.

use super::{Lane, LaneGraph, Level, Node};
use crate::geometry::Point;
use crate::read::{At, Read};

pub(super) fn read(top: &At<'_>) -> Read<LaneGraph> {
    let mut graph = LaneGraph { name: top.name("name")?.unwrap_or_default(), ..LaneGraph::default() };
    let level = top.name("metric_map")?.unwrap_or_else(|| "map".to_owned());
    graph.properties = top.rest(&["name", "metric_map", "nodes"]);
    graph.levels.push(Level { level: level.clone(), ..Level::default() });
    for entry in top.need("nodes")?.items()? {
        let node = entry.need("node")?;
        let name = node.need("name")?.id()?;
        let position = node.need("pose")?.need("position")?;
        let at = Point::new(position.need("x")?.number()?, position.need("y")?.number()?);
        for edge in node.list("edges")? {
            graph.lanes.push(Lane {
                lane: edge.need("edge_id")?.id()?,
                from: name.clone(),
                to: edge.need("node")?.id()?,
                action: edge.name("action")?,
                properties: edge.rest(&["edge_id", "node", "action"]),
                ..Lane::default()
            });
        }
        let mut read = Node::new(name.clone(), &level, at);
        read.name = Some(name);
        read.properties = node.rest(&["name", "edges"]);
        graph.nodes.push(read);
    }
    graph.types_by_graph(&[]);
    Ok(graph)
}
