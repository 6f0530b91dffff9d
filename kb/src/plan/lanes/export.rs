//! A site's lane graph as a file of others.

use std::collections::{BTreeMap, BTreeSet};

use adit_planners::geometry::Point;
use adit_planners::lanes::{Exported, Format, Lane, LaneGraph, write};

use super::judge::Weighed;
use super::routes::Routes;
use crate::error::{Code, Error, Result};
use crate::words::number::counted;

/// Weights nearer than this are the same.
const SAME: f64 = 1e-9;

/// # Arguments
/// `robot` is the vehicle type whose lanes are written; all are where none is said.
pub fn export(routes: &Routes, format: Format, robot: Option<&str>) -> Result<Exported> {
    let now = routes.now();
    let mut graph = now.lasting();
    let is_closed = graph != now.graph || !now.closed_doors.is_empty() || !now.closed_lifts.is_empty();
    let mut left_out = None;
    if let Some(robot) = robot {
        let weighed = routes.weighed_open(robot)?;
        keep_to(&mut graph, robot, &weighed, format);
        let refused = weighed.iter().filter_map(|weighed| weighed.as_ref().err());
        left_out = refused.clone().next().map(|first| {
            let lanes = counted(refused.count(), "lane");
            format!("without {lanes} on which rules do not let {robot} drive: {first}")
        });
    }
    let Exported { text, mut notes } = write(&graph, format).map_err(Error::of(Code::ExportTooMany))?;
    notes.extend(left_out);
    if is_closed {
        notes.push(
            "what somebody closed or opened is not written, since it holds for now: the file is the same without it"
                .to_owned(),
        );
    }
    Ok(Exported { text, notes })
}

/// Leaves the lanes on which rules let one vehicle type drive, with what rules weigh where Nav2 would weigh otherwise.
fn keep_to(graph: &mut LaneGraph, robot: &str, weighed: &[Weighed], format: Format) {
    let of_graph =
        graph.vehicle_types.iter().find(|of| of.vehicle_type == robot).and_then(|of| of.graph.clone());
    let all = std::mem::take(&mut graph.lanes);
    let at: BTreeMap<&str, Point> = graph.nodes.iter().map(|node| (node.node.as_str(), node.at)).collect();
    let mut lanes = Vec::new();
    for (mut lane, weight) in all.into_iter().zip(weighed) {
        let Ok(weight) = weight else { continue };
        if matches!(format, Format::RouteGraph) && (nav2(&at, &lane) - weight).abs() > SAME {
            (lane.cost, lane.is_cost_fixed) = (Some(*weight), true);
        }
        lanes.push(lane);
    }
    graph.lanes = lanes;
    if of_graph.is_some() && graph.vehicle_types.len() > 1 {
        let used: BTreeSet<String> =
            graph.lanes.iter().flat_map(|lane| [lane.from.clone(), lane.to.clone()]).collect();
        graph.nodes.retain(|node| used.contains(&node.node));
    }
    graph.uses.clear();
}

/// What Nav2's own scorers of distance and penalty make of a lane.
fn nav2(at: &BTreeMap<&str, Point>, lane: &Lane) -> f64 {
    if let (true, Some(cost)) = (lane.is_cost_fixed, lane.cost) {
        return cost;
    }
    let ends = at.get(lane.from.as_str()).zip(at.get(lane.to.as_str()));
    let straight = ends.map_or(0.0, |(from, to)| from.distance(*to));
    straight / lane.speed_share.unwrap_or(1.0) + lane.penalty.unwrap_or(0.0)
}
