//! Trees where all hardness lies on the doors: a row a room, since every way into a room goes on from its best one.

use adit_db::tree::TreeRow;
use adit_planners::geometry::Point;
use adit_planners::routes::{RoomIndex, Start, Tree};

use crate::graph::{End, SiteGraph};
use crate::graph::{heading, place_node};

pub(super) fn rows(graph: &SiteGraph, (robot, start): &(String, Start)) -> Vec<TreeRow> {
    let tree = graph.graph().tree(start);
    let mut rows: Vec<TreeRow> =
        graph.graph().room_indices().filter_map(|room| room_row(graph, &tree, room, start.at)).collect();
    for index in 0..graph.places.len() {
        let rooms = graph.entries(None, &End::Place(index), Some(robot));
        let first = rooms.first().map(|entry| entry.room);
        let Some((room, arrival)) = first.and_then(|room| Some((room, tree.rooms[room.index()]?))) else {
            continue;
        };
        let goal = graph.point(&End::Place(index));
        rows.push(TreeRow {
            node: place_node(index),
            prev: Some(graph[room].room),
            hops: i64::from(arrival.hops),
            reach: arrival.cost,
            at: Some([goal.x, goal.y]),
            heading: heading(entry(graph, &tree, room, start.at), goal),
            ..blank(place_node(index))
        });
    }
    rows.sort_by_key(|row| row.node);
    rows
}

/// Where a room is entered.
fn entry(graph: &SiteGraph, tree: &Tree, room: RoomIndex, start: Point) -> Point {
    let from = tree.rooms[room.index()].and_then(|arrival| arrival.from);
    from.map_or(start, |(_, door)| graph.graph()[door].at)
}

fn room_row(graph: &SiteGraph, tree: &Tree, room: RoomIndex, start: Point) -> Option<TreeRow> {
    let arrival = tree.rooms[room.index()]?;
    let row = blank(graph[room].room);
    let Some((before, door)) = arrival.from else {
        return Some(TreeRow { at: Some([start.x, start.y]), ..row });
    };
    Some(TreeRow {
        prev: Some(graph[before].room),
        door: Some(graph[door].door),
        hops: i64::from(arrival.hops),
        reach: tree.rooms[before.index()]?.cost,
        heading: heading(entry(graph, tree, before, start), entry(graph, tree, room, start)),
        ..row
    })
}

fn blank(node: i64) -> TreeRow {
    TreeRow {
        node,
        prev: None,
        from_room: None,
        door: None,
        hops: 0,
        reach: 0.0,
        leg: 0.0,
        walked: None,
        at: None,
        heading: None,
        distance: None,
        clearance: None,
        bend: true,
    }
}
