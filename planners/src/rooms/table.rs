//! Rooms and doors as facts.

use crate::doors::{SharedEdge, shared_edges};
use crate::facts::{Column, Facts, Table};
use crate::geometry::{Point, Rect};
use crate::known::{keys, with_edges};
use crate::names::room_name;

use super::Room;

/// What `room_facts` gives.
pub(crate) const GIVES: &[&str] = &[
    "ROOMS.room",
    "ROOMS.name: text",
    "ROOMS.robot: text",
    "ROOMS.state: text",
    "ROOMS.facing",
    "ROOMS.x0",
    "ROOMS.y0",
    "ROOMS.x1",
    "ROOMS.y1",
    "ROOMS.height",
    "ROOMS.width",
    "DOORS.door",
    "DOORS.kind: text",
    "DOORS.room1",
    "DOORS.room2",
    "DOORS.x",
    "DOORS.y",
    "DOORS.width",
    "DOORS.x0",
    "DOORS.y0",
    "DOORS.x1",
    "DOORS.y1",
    "DOORS.height1",
    "DOORS.width1",
    "DOORS.distance1",
    "DOORS.height2",
    "DOORS.width2",
    "DOORS.distance2",
    "DOORS.one_way: truth",
];

/// `ROOMS` of these rooms, numbered from 1, and `DOORS` between them (Abou-Ali et al., Table 4). Metres; a `height`
/// that is unlimited is `None`; `x0` to `y1` of a door are the ends of the segment that its rooms share.
pub(crate) fn room_facts(rooms: &[Room]) -> Facts {
    let rects: Vec<_> = rooms.iter().map(|room| room.rect).collect();
    Facts::from([
        ("ROOMS".to_owned(), room_table(rooms, &rects)),
        ("DOORS".to_owned(), door_table(rooms, &rects)),
    ])
}

fn room_table(rooms: &[Room], rects: &[Rect]) -> Table {
    let nobody = || vec![None::<String>; rooms.len()].into_iter().collect::<Column>();
    let table = Table::default()
        .with("room", keys(rooms.len()))
        .with("name", (0..rooms.len()).map(room_name).collect::<Column>())
        .with("robot", nobody())
        .with("state", nobody())
        .with("facing", Column::Number(vec![None; rooms.len()]));
    with_edges(table, rects)
        .with("height", rooms.iter().map(|room| room.height).collect::<Column>())
        .with("width", rects.iter().map(Rect::smaller_side).collect::<Column>())
}

fn door_table(rooms: &[Room], rects: &[Rect]) -> Table {
    let doors = shared_edges(rects);
    let segments: Vec<_> = doors.iter().map(|door| door.segment).collect();
    let middles: Vec<_> = segments.iter().map(Rect::centre).collect();
    let of_middles = |coordinate: fn(&Point) -> f64| middles.iter().map(coordinate).collect::<Column>();
    let table = Table::default()
        .with("door", keys(doors.len()))
        .with("kind", doors.iter().map(|_| "door".to_owned()).collect::<Column>())
        .with("room1", doors.iter().map(|door| (door.first + 1) as f64).collect::<Column>())
        .with("room2", doors.iter().map(|door| (door.second + 1) as f64).collect::<Column>())
        .with("x", of_middles(|middle| middle.x))
        .with("y", of_middles(|middle| middle.y))
        .with("width", doors.iter().map(SharedEdge::length).collect::<Column>());
    let first: Vec<_> = doors.iter().map(|door| door.first).collect();
    let second: Vec<_> = doors.iter().map(|door| door.second).collect();
    let table = with_edges(table, &segments);
    let table = with_side(table, ["height1", "width1", "distance1"], rooms, &first, &middles);
    with_side(table, ["height2", "width2", "distance2"], rooms, &second, &middles)
        .with("one_way", doors.iter().map(|_| false).collect::<Column>())
}

/// Adds height and width of the room on one side of each door, and the distance from the door's middle to its centre.
fn with_side(table: Table, names: [&str; 3], rooms: &[Room], side: &[usize], middles: &[Point]) -> Table {
    let side = || side.iter().map(|&room| rooms[room]);
    let distances = side().zip(middles).map(|(room, middle)| middle.distance(room.rect.centre()));
    table
        .with(names[0], side().map(|room| room.height).collect::<Column>())
        .with(names[1], side().map(|room| room.rect.smaller_side()).collect::<Column>())
        .with(names[2], distances.collect::<Column>())
}
