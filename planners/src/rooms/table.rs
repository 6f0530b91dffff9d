//! Rooms and doors as facts.

use crate::doors::{SharedEdge, shared_edges};
use crate::facts::{Column, Facts, Table};
use crate::geometry::Rect;
use crate::known::{keys, with_edges};
use crate::names::room_name;

use super::Room;

/// What [`facts`] gives.
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

/// A room as a row of `ROOMS`; `None` is unknown, a `height` that is `None` unlimited.
#[derive(Clone, Debug)]
pub(crate) struct RoomRow {
    pub robot: Option<String>,
    pub state: Option<String>,
    pub facing: Option<f64>,
    pub rect: Rect,
    pub height: Option<f64>,
}

/// A door as a row of `DOORS`: its rooms by index, and the segment or the area in which it is passed.
pub(crate) struct DoorRow {
    pub rooms: [usize; 2],
    pub rect: Rect,
    /// Whether it is a change of shape, one way.
    pub is_change: bool,
}

/// `ROOMS` and `DOORS` between them (Abou-Ali et al., Table 4), both numbered from 1. Metres.
pub(crate) fn facts(rooms: &[RoomRow], doors: &[DoorRow]) -> Facts {
    Facts::from([("ROOMS".to_owned(), room_table(rooms)), ("DOORS".to_owned(), door_table(rooms, doors))])
}

/// The facts of rooms that are the same for all robots and states, with a door wherever two of them touch.
pub(crate) fn room_facts(rooms: &[Room]) -> Facts {
    let rects: Vec<_> = rooms.iter().map(|room| room.rect).collect();
    let edges = shared_edges(&rects).into_iter();
    let door =
        |edge: SharedEdge| DoorRow { rooms: [edge.first, edge.second], rect: edge.segment, is_change: false };
    let row = |room: &Room| RoomRow {
        robot: None,
        state: None,
        facing: None,
        rect: room.rect,
        height: room.height,
    };
    facts(&rooms.iter().map(row).collect::<Vec<_>>(), &edges.map(door).collect::<Vec<_>>())
}

fn room_table(rooms: &[RoomRow]) -> Table {
    let rects: Vec<_> = rooms.iter().map(|room| room.rect).collect();
    let table = Table::default()
        .with("room", keys(rooms.len()))
        .with("name", (0..rooms.len()).map(room_name).collect::<Column>())
        .with("robot", rooms.iter().map(|room| room.robot.clone()).collect::<Column>())
        .with("state", rooms.iter().map(|room| room.state.clone()).collect::<Column>())
        .with("facing", rooms.iter().map(|room| room.facing).collect::<Column>());
    with_edges(table, &rects)
        .with("height", rooms.iter().map(|room| room.height).collect::<Column>())
        .with("width", rects.iter().map(Rect::smaller_side).collect::<Column>())
}

fn door_table(rooms: &[RoomRow], doors: &[DoorRow]) -> Table {
    let column = |of: &dyn Fn(&DoorRow) -> f64| doors.iter().map(of).collect::<Column>();
    let kind = |door: &DoorRow| if door.is_change { "change" } else { "door" }.to_owned();
    let width = |door: &DoorRow| {
        if door.is_change { door.rect.smaller_side() } else { door.rect.dx().max(door.rect.dy()) }
    };
    let table = Table::default()
        .with("door", keys(doors.len()))
        .with("kind", doors.iter().map(kind).collect::<Column>())
        .with("room1", column(&|door| (door.rooms[0] + 1) as f64))
        .with("room2", column(&|door| (door.rooms[1] + 1) as f64))
        .with("x", column(&|door| door.rect.centre().x))
        .with("y", column(&|door| door.rect.centre().y))
        .with("width", column(&width));
    let rects: Vec<_> = doors.iter().map(|door| door.rect).collect();
    let mut table = with_edges(table, &rects);
    for (side, names) in
        [["height1", "width1", "distance1"], ["height2", "width2", "distance2"]].into_iter().enumerate()
    {
        let room = |door: &DoorRow| &rooms[door.rooms[side]];
        table = table
            .with(names[0], doors.iter().map(|door| room(door).height).collect::<Column>())
            .with(names[1], column(&|door| room(door).rect.smaller_side()))
            .with(names[2], column(&|door| room(door).rect.centre().distance(door.rect.centre())));
    }
    table.with("one_way", doors.iter().map(|door| door.is_change).collect::<Column>())
}
