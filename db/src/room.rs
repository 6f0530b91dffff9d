//! The table `rooms`.

use serde::Serialize;
use sqlx::SqliteConnection;

use crate::block;
use crate::error::Result;
use crate::reason::Derived;
use crate::schema::{Column, Kind, Part, Row, Value, column, names, select};
use crate::stale::in_bulk;
use crate::transaction::Tx;
use crate::weight::Weight;

/// A room: a convex piece of free space, in one layer.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Room {
    /// Its number, from 1.
    pub room: i64,
    /// Its name.
    pub name: String,
    /// Robot and state whose layer it is in; `None` in the paper's modes.
    pub layer: Option<(String, String)>,
    /// How the body lies there, degrees counterclockwise from x, less than 180; `None` for a disc.
    pub facing: Option<f64>,
    /// x0, y0, x1, y1 of the least rectangle about it, metres.
    pub rect: [f64; 4],
    /// Its corners as JSON, `[[x,y],…]`, counterclockwise, metres; `None` where it is that rectangle.
    pub outline: Option<String>,
    /// Of the disc whose middle may be anywhere in it, metres; `None` for a body, and in the paper's modes.
    pub radius: Option<f64>,
    /// How much farther off walls than its outline ways keep where they may, metres.
    pub berth: Option<f64>,
    /// What that may cost at most, as a share of what the best way costs.
    pub berth_cost: Option<f64>,
    /// Metres; `None` is unlimited.
    pub height: Option<f64>,
    /// Its breadth, metres: of a rectangle the smaller side.
    pub width: f64,
    /// The number of the space that its centre lies in; `None` where that is none.
    pub space: Option<i64>,
    /// Cost per metre.
    pub hardness: Derived<f64>,
    /// How to move in it.
    pub action: Derived<String>,
    /// Whether it is entered.
    pub passable: Derived<bool>,
    /// What a metre takes of each [measure](crate::measure::Measures), as JSON; `None`: nothing is said.
    pub measures: Option<String>,
}

impl Row for Room {
    const TABLE: &'static str = "rooms";
    const COLUMNS: &'static [Column<Self>] = &[
        column!(Key Integer "room" room),
        column!(Cut Text "name" name),
        Column {
            name: "robot",
            kind: Kind::Text,
            part: Part::Cut,
            get: |room| room.layer.as_ref().map_or(Value::Null, |(robot, _)| Value::Text(robot)),
            put: |room, value| of_layer(room, value, |layer| &mut layer.0),
        },
        Column {
            name: "state",
            kind: Kind::Text,
            part: Part::Cut,
            get: |room| room.layer.as_ref().map_or(Value::Null, |(_, state)| Value::Text(state)),
            put: |room, value| of_layer(room, value, |layer| &mut layer.1),
        },
        column!(Cut Real "facing" facing),
        column!(Cut Real "x0" rect[0]),
        column!(Cut Real "y0" rect[1]),
        column!(Cut Real "x1" rect[2]),
        column!(Cut Real "y1" rect[3]),
        column!(Cut Text "outline" outline),
        column!(Cut Real "radius" radius),
        column!(Cut Real "berth" berth),
        column!(Cut Real "berth_cost" berth_cost),
        column!(Cut Real "height" height),
        column!(Cut Real "width" width),
        column!(Cut Integer "space" space),
        column!(Weight Real "hardness" hardness.value),
        column!(Weight Integer "hardness_rule" hardness.rule),
        column!(Weight Integer "hardness_witness" hardness.witness),
        column!(Weight Text "action" action.value),
        column!(Weight Integer "action_rule" action.rule),
        column!(Weight Integer "action_witness" action.witness),
        column!(Weight Truth "passable" passable.value),
        column!(Weight Integer "passable_rule" passable.rule),
        column!(Weight Integer "passable_witness" passable.witness),
        column!(Weight Text "measures" measures),
    ];
    const NAMES: &'static [&'static str] = &names::<Self, { Room::COLUMNS.len() }>(Self::COLUMNS, 0);
    const WEIGHT_NAMES: &'static [&'static str] = &names::<Self, 11>(Self::COLUMNS, Self::COLUMNS.len() - 11);

    fn key(&self) -> i64 {
        self.room
    }

    fn numbered(room: i64) -> Self {
        Self { room, ..Self::default() }
    }

    fn weight(&self) -> Weight {
        Weight {
            hardness: self.hardness.clone(),
            action: self.action.clone(),
            passable: self.passable.clone(),
            measures: self.measures.clone(),
        }
    }

    fn weighs(&self, weight: &Weight) -> bool {
        self.hardness == weight.hardness
            && self.action == weight.action
            && self.passable == weight.passable
            && self.measures == weight.measures
    }

    fn weigh(&mut self, weight: Weight) {
        (self.hardness, self.action) = (weight.hardness, weight.action);
        (self.passable, self.measures) = (weight.passable, weight.measures);
    }
}

fn of_layer(room: &mut Room, value: Value<'_>, part: fn(&mut (String, String)) -> &mut String) -> bool {
    match value {
        Value::Null => room.layer = None,
        Value::Text(text) => text.clone_into(part(room.layer.get_or_insert_default())),
        _ => return false,
    }
    true
}

/// All rooms, by number.
pub async fn read(connection: &mut SqliteConnection) -> Result<Vec<Room>> {
    block::read(connection).await
}

/// The room of this name.
pub async fn named(connection: &mut SqliteConnection, name: &str) -> Result<Option<Room>> {
    Ok(select(connection, "WHERE name = ?", &[name.into()]).await?.pop())
}

/// The states of a robot that have rooms; none where rooms are not cut by state.
async fn states(connection: &mut SqliteConnection, robot: &str) -> Result<Vec<String>> {
    let sql = "SELECT DISTINCT state FROM rooms WHERE robot = ? AND state IS NOT NULL ORDER BY state";
    Ok(sqlx::query_scalar(sql).bind(robot).fetch_all(connection).await?)
}

/// Replaces all rooms by these. Doors go with the rooms that they join: write those afterwards.
pub async fn replace(connection: &mut SqliteConnection, rooms: &[Room]) -> Result<()> {
    in_bulk(connection, "rooms", async |connection| {
        sqlx::query("DELETE FROM doors").execute(&mut *connection).await?;
        sqlx::query("DELETE FROM rooms").execute(&mut *connection).await?;
        Ok(())
    })
    .await?;
    block::replace(connection, rooms).await
}

impl Tx<'_> {
    /// All rooms, by number.
    pub fn rooms(&mut self) -> Result<Vec<Room>> {
        self.run(read)
    }

    /// The room of this name.
    pub fn room_named(&mut self, name: &str) -> Result<Option<Room>> {
        self.run(async |connection| named(connection, name).await)
    }

    /// The states of a robot that have rooms; none where rooms are not cut by state.
    pub fn states_with_rooms(&mut self, robot: &str) -> Result<Vec<String>> {
        self.run(async |connection| states(connection, robot).await)
    }

    /// Replaces all rooms by these. Doors go with the rooms that they join: write those afterwards.
    pub fn replace_rooms(&mut self, by: &[Room]) -> Result<()> {
        self.run(async |connection| replace(connection, by).await)
    }
}
