//! The table `rooms`.

use serde::Serialize;
use sqlx::sqlite::SqliteRow;
use sqlx::{Row, SqliteConnection};

use crate::bulk::{self, Record, Values};
use crate::dynamic;
use crate::error::Result;
use crate::reason::Derived;
use crate::stale::in_bulk;
use crate::transaction::Tx;
use crate::weight::Weight;

/// A room: a rectangle of free space, in one layer.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Room {
    /// Its number, from 1.
    pub room: i64,
    /// Its name.
    pub name: String,
    /// Robot and state whose layer it is in; `None` in the paper's modes.
    pub layer: Option<(String, String)>,
    /// How the body lies there, degrees counterclockwise from x, less than 180; `None` for a disc.
    pub facing: Option<f64>,
    /// x0, y0, x1, y1 in metres.
    pub rect: [f64; 4],
    /// Metres; `None` is unlimited.
    pub height: Option<f64>,
    /// The smaller side, metres.
    pub width: f64,
    /// Cost per metre.
    pub hardness: Derived<f64>,
    /// How to move in it.
    pub action: Derived<String>,
    /// Whether it is entered.
    pub passable: Derived<bool>,
}

impl Room {
    /// What rules say about it.
    pub fn weight(&self) -> Weight {
        Weight {
            hardness: self.hardness.clone(),
            action: self.action.clone(),
            passable: self.passable.clone(),
        }
    }

    /// Has rules say something else about it.
    pub fn weigh(&mut self, weight: Weight) {
        (self.hardness, self.action, self.passable) = (weight.hardness, weight.action, weight.passable);
    }
}

impl Record for &Room {
    const TABLE: &'static str = "rooms";
    const COLUMNS: &'static [&'static str] = &[
        "room",
        "name",
        "robot",
        "state",
        "x0",
        "y0",
        "x1",
        "y1",
        "height",
        "width",
        "hardness",
        "action",
        "hardness_rule",
        "hardness_witness",
        "action_rule",
        "action_witness",
        "passable",
        "passable_rule",
        "passable_witness",
        "facing",
    ];

    fn bind(&self, values: &mut Values) {
        values.integer(self.room);
        values.text(&*self.name);
        values.text(self.layer.as_ref().map(|(robot, _)| &**robot));
        values.text(self.layer.as_ref().map(|(_, state)| &**state));
        self.rect.iter().for_each(|edge| values.real(*edge));
        values.real(self.height);
        values.real(self.width);
        values.real(self.hardness.value);
        values.text(self.action.value.as_deref());
        self.hardness.bind_reason(values);
        self.action.bind_reason(values);
        values.truth(self.passable.value);
        self.passable.bind_reason(values);
        values.real(self.facing);
    }
}

fn room(row: &SqliteRow) -> Result<Room> {
    let layer: (Option<String>, Option<String>) = (row.try_get(2)?, row.try_get(3)?);
    Ok(Room {
        room: row.try_get(0)?,
        name: row.try_get(1)?,
        layer: layer.0.zip(layer.1),
        facing: row.try_get(19)?,
        rect: [row.try_get(4)?, row.try_get(5)?, row.try_get(6)?, row.try_get(7)?],
        height: row.try_get(8)?,
        width: row.try_get(9)?,
        hardness: Derived::of(row, 10, 12)?,
        action: Derived::of(row, 11, 14)?,
        passable: Derived::of(row, 16, 17)?,
    })
}

/// All rooms, by number.
pub async fn read(connection: &mut SqliteConnection) -> Result<Vec<Room>> {
    let sql = format!("SELECT {} FROM rooms ORDER BY room", <&Room>::COLUMNS.join(","));
    dynamic::fetch(connection, sql, &[]).await?.iter().map(room).collect()
}

/// The room of this name.
pub async fn named(connection: &mut SqliteConnection, name: &str) -> Result<Option<Room>> {
    let sql = format!("SELECT {} FROM rooms WHERE name = ?", <&Room>::COLUMNS.join(","));
    dynamic::fetch(connection, sql, &[name.into()]).await?.first().map(room).transpose()
}

/// Replaces all rooms by these. Doors go with the rooms that they join: write those afterwards.
pub async fn replace(connection: &mut SqliteConnection, rooms: &[Room]) -> Result<()> {
    in_bulk(connection, "rooms", async |connection| {
        sqlx::query("DELETE FROM doors").execute(&mut *connection).await?;
        sqlx::query("DELETE FROM rooms").execute(&mut *connection).await?;
        bulk::insert(connection, rooms).await
    })
    .await?;
    Ok(())
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

    /// Replaces all rooms by these. Doors go with the rooms that they join: write those afterwards.
    pub fn replace_rooms(&mut self, by: &[Room]) -> Result<()> {
        self.run(async |connection| replace(connection, by).await)
    }
}
