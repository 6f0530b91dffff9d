//! What cannot be right in a lane graph, whoever made it: a file, or tables that were edited.

use std::collections::BTreeSet;

use super::LaneGraph;
use crate::read::Code;

/// What is wrong with a lane graph.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Wrong {
    pub code: Code,
    /// A sentence that names the node, lane or station.
    pub message: String,
    /// What a file may be searched for.
    pub place: Place,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// The second of two things of a kind, `node`, that are called so.
    Twice(&'static str, String),
    /// The first mention of a node that is not there.
    Missing(String),
    Anywhere,
}

/// Refuses ids that stand for several things, or for none, and numbers that mean nothing.
pub fn refuse_wrong(graph: &LaneGraph) -> Result<(), Wrong> {
    let at = |place, code, message: String| Err(Wrong { code, message, place });
    let wrong = |code, message: String| at(Place::Anywhere, code, message);
    let missing =
        |node: &str, message: String| at(Place::Missing(node.to_owned()), Code::Impossible, message);
    let twice = [
        ("level", repeated(graph.levels.iter().map(|level| &level.level))),
        ("node", repeated(graph.nodes.iter().map(|node| &node.node))),
        ("lane", repeated(graph.lanes.iter().map(|lane| &lane.lane))),
        ("door", repeated(graph.doors.iter().map(|door| &door.door))),
        ("lift", repeated(graph.lifts.iter().map(|lift| &lift.lift))),
        ("station", repeated(graph.stations.iter().map(|station| &station.station))),
    ];
    if let Some((what, Some(id))) = twice.into_iter().find(|(_, id)| id.is_some()) {
        let message = format!("two {what}s are called `{id}`; expected an id for each");
        return at(Place::Twice(what, id.to_owned()), Code::DuplicateName, message);
    }
    let levels: BTreeSet<&str> = graph.levels.iter().map(|level| level.level.as_str()).collect();
    let nodes: BTreeSet<&str> = graph.nodes.iter().map(|node| node.node.as_str()).collect();
    for node in &graph.nodes {
        if !levels.contains(node.level.as_str()) {
            let message = format!("node `{}` is on level `{}`, which is not there", node.node, node.level);
            return wrong(Code::Impossible, message);
        }
    }
    for lane in &graph.lanes {
        let of = format!("lane `{}` from `{}` to `{}`", lane.lane, lane.from, lane.to);
        if let Some(node) = [&lane.from, &lane.to].into_iter().find(|node| !nodes.contains(node.as_str())) {
            return missing(node, format!("{of}: there is no node `{node}`"));
        }
        let share = lane.speed_share.unwrap_or(1.0);
        if !(share > 0.0 && share <= 1.0) {
            let message = format!(
                "{of}: its speed is limited to {share} of a vehicle's own, expected more than 0, up to 1"
            );
            return wrong(Code::NotPositive, message);
        }
        for (what, number) in [("cost", lane.cost), ("penalty", lane.penalty), ("length", lane.length)] {
            if number.is_some_and(|number| !(number.is_finite() && number >= 0.0)) {
                let found = number.unwrap_or_default();
                return wrong(Code::NotPositive, format!("{of}: its {what} is {found}, expected 0 or more"));
            }
        }
        if lane.speed_limit.is_some_and(|limit| !(limit.is_finite() && limit > 0.0)) {
            let found = lane.speed_limit.unwrap_or_default();
            return wrong(
                Code::NotPositive,
                format!("{of}: its speed limit is {found} m/s, expected more than 0"),
            );
        }
    }
    for of in &graph.uses {
        let (least, most) = (of.min_height.unwrap_or(0.0), of.max_height.unwrap_or(f64::INFINITY));
        if least > most {
            let message = format!(
                "lane `{}` is for {} of {least} m at least and {most} m at most, which no height is",
                of.lane, of.vehicle_type
            );
            return wrong(Code::Impossible, message);
        }
    }
    for station in &graph.stations {
        let mut of = station.nodes.split(',').map(str::trim).filter(|node| !node.is_empty());
        if let Some(node) = of.find(|node| !nodes.contains(node)) {
            return missing(node, format!("station `{}`: there is no node `{node}`", station.station));
        }
    }
    Ok(())
}

fn repeated<'i>(ids: impl Iterator<Item = &'i String>) -> Option<&'i str> {
    let mut seen = BTreeSet::new();
    ids.map(String::as_str).find(|id| !seen.insert(*id))
}
