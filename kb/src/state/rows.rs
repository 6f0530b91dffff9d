//! What planners assert of rooms, doors and areas, as rows of the database, and back.

use adit_db::Derived;
use adit_db::area::Area;
use adit_db::door::{Door, DoorKind, Side};
use adit_db::place::Place;
use adit_db::room::Room;
use adit_planners::facts::{Column, Table};
use adit_planners::world::World;

use crate::error::{Error, Result};

/// The columns of a class, by name, each a problem of its own where it is missing.
struct Columns<'a> {
    class: &'static str,
    table: &'a Table,
}

impl<'a> Columns<'a> {
    fn numbers(&self, property: &str) -> Result<&'a [Option<f64>]> {
        self.table.numbers(property).map_err(|what| self.missing(&what))
    }

    fn texts(&self, property: &str) -> Result<&'a [Option<String>]> {
        self.table.texts(property).map_err(|what| self.missing(&what))
    }

    fn truths(&self, property: &str) -> Result<&'a [Option<bool>]> {
        self.table.truths(property).map_err(|what| self.missing(&what))
    }

    /// The numbers of four properties, row by row.
    fn quads(&self, properties: [&str; 4]) -> Result<Vec<[f64; 4]>> {
        let columns = [
            self.numbers(properties[0])?,
            self.numbers(properties[1])?,
            self.numbers(properties[2])?,
            self.numbers(properties[3])?,
        ];
        let row = |index: usize| columns.map(|column| column[index].unwrap_or(f64::NAN));
        Ok((0..self.table.len()).map(row).collect())
    }

    fn missing(&self, what: &str) -> Error {
        Error::said("facts/property", format!("class {}: {what}", self.class), None)
    }
}

fn key(value: Option<f64>) -> i64 {
    value.unwrap_or(0.0) as i64
}

/// Rooms as rows, without what rules say.
pub fn rooms(table: &Table) -> Result<Vec<Room>> {
    let columns = Columns { class: "ROOMS", table };
    let (keys, names) = (columns.numbers("room")?, columns.texts("name")?);
    let (robots, states) = (columns.texts("robot")?, columns.texts("state")?);
    let rects = columns.quads(["x0", "y0", "x1", "y1"])?;
    let (heights, widths) = (columns.numbers("height")?, columns.numbers("width")?);
    let facings = columns.numbers("facing")?;
    let row = |index: usize| Room {
        room: key(keys[index]),
        name: names[index].clone().unwrap_or_default(),
        layer: robots[index].clone().zip(states[index].clone()),
        facing: facings[index],
        rect: rects[index],
        height: heights[index],
        width: widths[index].unwrap_or_default(),
        hardness: Derived::default(),
        action: Derived::default(),
        passable: Derived::default(),
    };
    Ok((0..table.len()).map(row).collect())
}

/// Rooms as planners assert them.
pub fn rooms_table(rooms: &[Room]) -> Table {
    let layer = |pick: fn(&(String, String)) -> &String| -> Column {
        rooms.iter().map(|room| room.layer.as_ref().map(|layer| pick(layer).clone())).collect()
    };
    let mut table = Table::default()
        .with("room", rooms.iter().map(|room| room.room as f64).collect::<Column>())
        .with("name", rooms.iter().map(|room| room.name.clone()).collect::<Column>())
        .with("robot", layer(|layer| &layer.0))
        .with("state", layer(|layer| &layer.1))
        .with("facing", rooms.iter().map(|room| room.facing).collect::<Column>());
    for (side, name) in ["x0", "y0", "x1", "y1"].iter().enumerate() {
        table = table.with(name, rooms.iter().map(|room| room.rect[side]).collect::<Column>());
    }
    table
        .with("height", rooms.iter().map(|room| room.height).collect::<Column>())
        .with("width", rooms.iter().map(|room| room.width).collect::<Column>())
}

/// Doors as rows, without what rules say.
pub fn doors(table: &Table) -> Result<Vec<Door>> {
    let columns = Columns { class: "DOORS", table };
    let (keys, kinds) = (columns.numbers("door")?, columns.texts("kind")?);
    let (xs, ys, widths) = (columns.numbers("x")?, columns.numbers("y")?, columns.numbers("width")?);
    let segments = columns.quads(["x0", "y0", "x1", "y1"])?;
    let one_way = columns.truths("one_way")?;
    let sides = [
        sides(&columns, ["room1", "height1", "width1", "distance1"])?,
        sides(&columns, ["room2", "height2", "width2", "distance2"])?,
    ];
    let row = |index: usize| Door {
        door: key(keys[index]),
        kind: if kinds[index].as_deref() == Some("change") { DoorKind::Change } else { DoorKind::Door },
        side1: sides[0][index],
        side2: sides[1][index],
        at: [xs[index].unwrap_or_default(), ys[index].unwrap_or_default()],
        width: widths[index].unwrap_or_default(),
        segment: segments[index],
        hardness: Derived::default(),
        action: Derived::default(),
        passable: Derived::default(),
        one_way: one_way[index].unwrap_or(false),
    };
    Ok((0..table.len()).map(row).collect())
}

fn sides(columns: &Columns<'_>, properties: [&str; 4]) -> Result<Vec<Side>> {
    let [rooms, heights, widths, distances] = [
        columns.numbers(properties[0])?,
        columns.numbers(properties[1])?,
        columns.numbers(properties[2])?,
        columns.numbers(properties[3])?,
    ];
    let side = |index: usize| Side {
        room: key(rooms[index]),
        height: heights[index],
        width: widths[index],
        distance: distances[index],
    };
    Ok((0..columns.table.len()).map(side).collect())
}

/// Doors as planners assert them.
pub fn doors_table(doors: &[Door]) -> Table {
    let number = |pick: &dyn Fn(&Door) -> f64| -> Column { doors.iter().map(pick).collect() };
    let maybe = |pick: &dyn Fn(&Door) -> Option<f64>| -> Column { doors.iter().map(pick).collect() };
    let kind = |door: &Door| match door.kind {
        DoorKind::Door => "door".to_owned(),
        DoorKind::Change => "change".to_owned(),
    };
    Table::default()
        .with("door", number(&|door| door.door as f64))
        .with("kind", doors.iter().map(kind).collect::<Column>())
        .with("room1", number(&|door| door.side1.room as f64))
        .with("room2", number(&|door| door.side2.room as f64))
        .with("x", number(&|door| door.at[0]))
        .with("y", number(&|door| door.at[1]))
        .with("width", number(&|door| door.width))
        .with("x0", number(&|door| door.segment[0]))
        .with("y0", number(&|door| door.segment[1]))
        .with("x1", number(&|door| door.segment[2]))
        .with("y1", number(&|door| door.segment[3]))
        .with("height1", maybe(&|door| door.side1.height))
        .with("width1", maybe(&|door| door.side1.width))
        .with("distance1", maybe(&|door| door.side1.distance))
        .with("height2", maybe(&|door| door.side2.height))
        .with("width2", maybe(&|door| door.side2.width))
        .with("distance2", maybe(&|door| door.side2.distance))
        .with("one_way", doors.iter().map(|door| door.one_way).collect::<Column>())
}

/// Prime areas as rows, without what rules say.
pub fn areas(table: &Table) -> Result<Vec<Area>> {
    let columns = Columns { class: "PRIME_AREAS", table };
    let keys = columns.numbers("area")?;
    let strips = columns.quads(["left_first", "left_last", "right_first", "right_last"])?;
    let row = |index: usize| Area {
        area: key(keys[index]),
        x: (strips[index][0] as i64, strips[index][1] as i64),
        y: (strips[index][2] as i64, strips[index][3] as i64),
        open: Derived::default(),
    };
    Ok((0..table.len()).map(row).collect())
}

/// The edges of the strips along x and along y, ascending.
pub fn strip_edges(table: &Table) -> Result<[Vec<f64>; 2]> {
    let columns = Columns { class: "STRIPS", table };
    let axes = columns.texts("axis")?;
    let (lows, highs) = (columns.numbers("low")?, columns.numbers("high")?);
    Ok(["x", "y"].map(|axis| {
        let mut edges: Vec<f64> = Vec::new();
        for index in (0..table.len()).filter(|&index| axes[index].as_deref() == Some(axis)) {
            if edges.is_empty() {
                edges.extend(lows[index]);
            }
            edges.extend(highs[index]);
        }
        edges
    }))
}

/// The map's places as rows.
pub fn places(world: &World) -> Vec<Place> {
    let mut places: Vec<Place> = world
        .places
        .iter()
        .map(|place| Place { place: place.name.clone(), x: place.at.x, y: place.at.y })
        .collect();
    places.sort_by(|a, b| a.place.cmp(&b.place));
    places
}
