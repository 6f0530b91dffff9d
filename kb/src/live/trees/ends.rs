//! The names that routes may start and end at.

use adit_db::tree::{End as EndRow, EndKind};

use crate::error::{Code, Error, Result};
use crate::graph::{SiteGraph, place_node};
use crate::words::point::point;

/// Up to so many rooms of the paper's modes every place and room is a start, unless the site says otherwise. Above, and
/// where rooms are by state, places are: a tree by state takes tens of milliseconds, and who asks names a place or a
/// point, not a piece of a layer.
pub(super) const ALL_STARTS_UP_TO: usize = 2_000;

/// Whether routes are kept to rooms, not to places only.
///
/// Where rooms are by state and there are many, who asks names a place or a point, not a piece of a layer.
pub(super) fn keeps_rooms(graph: &SiteGraph) -> bool {
    graph.graph().is_on_doors() || graph.rooms.len() <= ALL_STARTS_UP_TO
}

/// The names that routes may start and end at. A room's node is its key, a place's is negative.
pub fn ends(graph: &SiteGraph) -> Result<Vec<EndRow>> {
    let mut ends = Vec::with_capacity(graph.rooms.len() + graph.places.len());
    for (index, place) in graph.places.iter().enumerate() {
        if point(&place.place).is_some() {
            return Err(Error::said(
                Code::SitePlaceNamedLikeAPoint,
                format!("place `{}` is named like a point, so it would mean two things", place.place),
                Some("give the place a name that is not `x,y`".to_owned()),
            ));
        }
        if graph.rooms.iter().any(|room| room.name == place.place) {
            return Err(Error::said(
                Code::SitePlaceNamedLikeARoom,
                format!(
                    "place `{}` is named like a room, so `{}` would mean two things",
                    place.place, place.place
                ),
                Some("rooms are named a, b, ... z, aa, ...: give the place a longer name".to_owned()),
            ));
        }
        ends.push(EndRow {
            name: place.place.clone(),
            node: place_node(index),
            kind: EndKind::Place,
            kept: true,
        });
    }
    ends.extend(graph.rooms.iter().map(|room| EndRow {
        name: room.name.clone(),
        node: room.room,
        kind: EndKind::Room,
        kept: keeps_rooms(graph),
    }));
    Ok(ends)
}
