//! Rooms and doors as facts.

use rayon::prelude::*;

use crate::doors::{SharedEdge, shared_edges};
use crate::facts::{Column, Facts, Table};
use crate::geometry::{Convex, Point, Rect, Segment};
use crate::known::{keys, with_edges};
use crate::names::room_name;
use crate::routes::Berth;
use crate::spaces::Located;

use super::{Room, outline};

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
    "ROOMS.outline: text",
    "ROOMS.radius",
    "ROOMS.berth",
    "ROOMS.berth_cost",
    "ROOMS.height",
    "ROOMS.width",
    "ROOMS.space",
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
    pub outline: Convex,
    /// Of the disc whose middle may be anywhere in it; `None` for what is no disc.
    pub radius: Option<f64>,
    /// How much farther off walls than that ways keep, and as what share of their cost.
    pub berth: Option<Berth>,
    pub height: Option<f64>,
}

/// A door as a row of `DOORS`, its rooms by index.
pub(crate) struct DoorRow {
    pub rooms: [usize; 2],
    /// Where it is passed; of a change of shape opposite corners of the least rectangle about what the outlines of its
    /// rooms have in common, or about the part of that in which it is made.
    pub across: Segment,
    /// Where it is on the map.
    pub at: Point,
    /// How wide it is, metres.
    pub width: f64,
    /// Whether it is a change of shape, one way.
    pub is_change: bool,
}

impl DoorRow {
    /// From a rectangle without extent along one axis.
    fn along(rooms: [usize; 2], rect: Rect) -> Self {
        let across = Segment::new(Point::new(rect.x0, rect.y0), Point::new(rect.x1, rect.y1));
        Self { rooms, across, at: across.middle(), width: across.length(), is_change: false }
    }
}

/// `ROOMS` and `DOORS` between them (Abou-Ali et al., Table 4), both numbered from 1. Metres. A room is of the space that its
/// centre lies in.
pub(crate) fn facts(rooms: &[RoomRow], doors: &[DoorRow], spaces: &Located) -> Facts {
    let space = |room: &RoomRow| spaces.at(room.outline.centre());
    let of_rooms = || {
        let of_spaces: Vec<Option<f64>> = rooms.par_iter().map(space).collect();
        room_table(rooms).with("space", Column::Number(of_spaces))
    };
    let (of_rooms, of_doors) = rayon::join(of_rooms, || door_table(rooms, doors));
    Facts::from([("ROOMS".to_owned(), of_rooms), ("DOORS".to_owned(), of_doors)])
}

/// The facts of rooms that are the same for all robots and states, with a door wherever two of them touch.
pub(crate) fn room_facts(rooms: &[Room], spaces: &Located) -> Facts {
    let rects: Vec<_> = rooms.iter().map(|room| room.rect).collect();
    let edges = shared_edges(&rects).into_iter();
    let door = |edge: SharedEdge| DoorRow::along([edge.first, edge.second], edge.segment);
    let row = |room: &Room| RoomRow {
        robot: None,
        state: None,
        facing: None,
        outline: room.rect.into(),
        radius: None,
        berth: None,
        height: room.height,
    };
    facts(&rooms.iter().map(row).collect::<Vec<_>>(), &edges.map(door).collect::<Vec<_>>(), spaces)
}

fn room_table(rooms: &[RoomRow]) -> Table {
    let rects: Vec<_> = rooms.iter().map(|room| room.outline.bounds()).collect();
    let outlines: Vec<Option<String>> = rooms.par_iter().map(|room| outline::write(&room.outline)).collect();
    let table = Table::default()
        .with("room", keys(rooms.len()))
        .with("name", (0..rooms.len()).map(room_name).collect::<Column>())
        .with("robot", rooms.iter().map(|room| room.robot.clone()).collect::<Column>())
        .with("state", rooms.iter().map(|room| room.state.clone()).collect::<Column>())
        .with("facing", rooms.iter().map(|room| room.facing).collect::<Column>());
    with_edges(table, &rects)
        .with("outline", Column::Text(outlines))
        .with("radius", rooms.iter().map(|room| room.radius).collect::<Column>())
        .with("berth", rooms.iter().map(|room| Some(room.berth?.metres)).collect::<Column>())
        .with("berth_cost", rooms.iter().map(|room| Some(room.berth?.share)).collect::<Column>())
        .with("height", rooms.iter().map(|room| room.height).collect::<Column>())
        .with("width", rooms.iter().map(|room| room.outline.breadth()).collect::<Column>())
}

fn door_table(rooms: &[RoomRow], doors: &[DoorRow]) -> Table {
    let column = |of: &dyn Fn(&DoorRow) -> f64| doors.iter().map(of).collect::<Column>();
    let kind = |door: &DoorRow| if door.is_change { "change" } else { "door" }.to_owned();
    let mut table = Table::default()
        .with("door", keys(doors.len()))
        .with("kind", doors.iter().map(kind).collect::<Column>())
        .with("room1", column(&|door| (door.rooms[0] + 1) as f64))
        .with("room2", column(&|door| (door.rooms[1] + 1) as f64))
        .with("x", column(&|door| door.at.x))
        .with("y", column(&|door| door.at.y))
        .with("width", column(&|door| door.width))
        .with("x0", column(&|door| door.across.a.x))
        .with("y0", column(&|door| door.across.a.y))
        .with("x1", column(&|door| door.across.b.x))
        .with("y1", column(&|door| door.across.b.y));
    let centres: Vec<Point> = rooms.iter().map(|room| room.outline.centre()).collect();
    let breadths: Vec<f64> = rooms.iter().map(|room| room.outline.breadth()).collect();
    for (side, names) in
        [["height1", "width1", "distance1"], ["height2", "width2", "distance2"]].into_iter().enumerate()
    {
        table = table
            .with(names[0], doors.iter().map(|door| rooms[door.rooms[side]].height).collect::<Column>())
            .with(names[1], column(&|door| breadths[door.rooms[side]]))
            .with(names[2], column(&|door| centres[door.rooms[side]].distance(door.at)));
    }
    table.with("one_way", doors.iter().map(|door| door.is_change).collect::<Column>())
}
