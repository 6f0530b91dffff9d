//! The table `doors`: where one goes from room to room, or changes shape.

use serde::{Deserialize, Serialize};
use sqlx::sqlite::SqliteRow;
use sqlx::{Row, SqliteConnection};

use crate::bulk::{self, Record, Values};
use crate::cell::Cell;
use crate::dynamic;
use crate::error::Result;
use crate::reason::Derived;
use crate::stale::in_bulk;
use crate::transaction::Tx;
use crate::weight::Weight;

/// What happens at a door.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum DoorKind {
    /// The robot goes through.
    Door,
    /// The robot changes its shape.
    Change,
}

/// One side of a door.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Side {
    /// The room there.
    pub room: i64,
    /// Metres; `None` is unlimited.
    pub height: Option<f64>,
    /// Metres.
    pub width: Option<f64>,
    /// From the crossing point to the room's centre, metres.
    pub distance: Option<f64>,
}

/// A door, from side 1 to side 2 and back unless it is one-way. Two rooms may have several.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Door {
    /// Its number, from 1.
    pub door: i64,
    /// What happens there.
    pub kind: DoorKind,
    /// The first room's side.
    pub side1: Side,
    /// The second room's side.
    pub side2: Side,
    /// The crossing point, metres.
    pub at: [f64; 2],
    /// Metres.
    pub width: f64,
    /// x0, y0, x1, y1 of the crossing segment, metres.
    pub segment: [f64; 4],
    /// Cost of passing.
    pub hardness: Derived<f64>,
    /// How to pass.
    pub action: Derived<String>,
    /// Whether it can be passed.
    pub passable: Derived<bool>,
    /// Whether it leads from room 1 to room 2 only.
    pub one_way: bool,
}

impl Door {
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

impl Record for &Door {
    const TABLE: &'static str = "doors";
    const COLUMNS: &'static [&'static str] = &[
        "door",
        "kind",
        "room1",
        "room2",
        "x",
        "y",
        "width",
        "height1",
        "width1",
        "distance1",
        "height2",
        "width2",
        "distance2",
        "hardness",
        "action",
        "passable",
        "one_way",
        "x0",
        "y0",
        "x1",
        "y1",
        "hardness_rule",
        "hardness_witness",
        "action_rule",
        "action_witness",
        "passable_rule",
        "passable_witness",
    ];

    fn bind(&self, values: &mut Values) {
        values.integer(self.door);
        values.text(match self.kind {
            DoorKind::Door => "door",
            DoorKind::Change => "change",
        });
        values.integer(self.side1.room);
        values.integer(self.side2.room);
        self.at.iter().for_each(|metres| values.real(*metres));
        values.real(self.width);
        for side in [&self.side1, &self.side2] {
            values.real(side.height);
            values.real(side.width);
            values.real(side.distance);
        }
        values.real(self.hardness.value);
        values.text(self.action.value.as_deref());
        values.truth(self.passable.value);
        values.truth(self.one_way);
        self.segment.iter().for_each(|metres| values.real(*metres));
        self.hardness.bind_reason(values);
        self.action.bind_reason(values);
        self.passable.bind_reason(values);
    }
}

fn side(row: &SqliteRow, room: usize, height: usize) -> sqlx::Result<Side> {
    Ok(Side {
        room: row.try_get(room)?,
        height: row.try_get(height)?,
        width: row.try_get(height + 1)?,
        distance: row.try_get(height + 2)?,
    })
}

fn door(row: &SqliteRow) -> Result<Door> {
    let kind = match row.try_get::<&str, _>(1)? {
        "change" => DoorKind::Change,
        _ => DoorKind::Door,
    };
    Ok(Door {
        door: row.try_get(0)?,
        kind,
        side1: side(row, 2, 7)?,
        side2: side(row, 3, 10)?,
        at: [row.try_get(4)?, row.try_get(5)?],
        width: row.try_get(6)?,
        segment: [row.try_get(17)?, row.try_get(18)?, row.try_get(19)?, row.try_get(20)?],
        hardness: Derived::of(row, 13, 21)?,
        action: Derived::of(row, 14, 23)?,
        passable: Derived::of(row, 15, 25)?,
        one_way: row.try_get(16)?,
    })
}

/// All doors, by number.
pub async fn read(connection: &mut SqliteConnection) -> Result<Vec<Door>> {
    let sql = format!("SELECT {} FROM doors ORDER BY door", <&Door>::COLUMNS.join(","));
    dynamic::fetch(connection, sql, &[]).await?.iter().map(door).collect()
}

/// The door of this number.
pub async fn one(connection: &mut SqliteConnection, number: i64) -> Result<Option<Door>> {
    let sql = format!("SELECT {} FROM doors WHERE door = ?", <&Door>::COLUMNS.join(","));
    dynamic::fetch(connection, sql, &[number.into()]).await?.first().map(door).transpose()
}

/// Doors whose segment may come within a distance of a point, by number.
pub async fn near(connection: &mut SqliteConnection, [x, y]: [f64; 2], distance: f64) -> Result<Vec<Door>> {
    let sql = format!(
        "SELECT {} FROM doors WHERE min(x0, x1) <= ? AND max(x0, x1) >= ? AND min(y0, y1) <= ? AND max(y0, y1) >= ?
         ORDER BY door",
        <&Door>::COLUMNS.join(",")
    );
    let around = [x + distance, x - distance, y + distance, y - distance].map(Cell::from);
    dynamic::fetch(connection, sql, &around).await?.iter().map(door).collect()
}

/// Replaces all doors by these; their rooms must be there.
pub async fn replace(connection: &mut SqliteConnection, doors: &[Door]) -> Result<()> {
    in_bulk(connection, "doors", async |connection| {
        sqlx::query("DELETE FROM doors").execute(&mut *connection).await?;
        bulk::insert(connection, doors).await
    })
    .await?;
    Ok(())
}

impl Tx<'_> {
    /// All doors, by number.
    pub fn doors(&mut self) -> Result<Vec<Door>> {
        self.run(read)
    }

    /// The door of this number.
    pub fn door(&mut self, number: i64) -> Result<Option<Door>> {
        self.run(async |connection| one(connection, number).await)
    }

    /// Doors whose segment may come within a distance of a point, by number.
    pub fn doors_near(&mut self, at: [f64; 2], distance: f64) -> Result<Vec<Door>> {
        self.run(async |connection| near(connection, at, distance).await)
    }

    /// Replaces all doors by these; their rooms must be there.
    pub fn replace_doors(&mut self, by: &[Door]) -> Result<()> {
        self.run(async |connection| replace(connection, by).await)
    }
}
