//! The table `doors`: where one goes from room to room, or changes shape.

use serde::{Deserialize, Serialize};
use sqlx::SqliteConnection;

use crate::block;
use crate::cell::Cell;
use crate::error::Result;
use crate::reason::Derived;
use crate::schema::{Column, Field, Row, Value, column, names, select};
use crate::stale::in_bulk;
use crate::transaction::Tx;
use crate::weight::Weight;

/// What happens at a door.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum DoorKind {
    /// The robot goes through.
    #[default]
    Door,
    /// The robot changes its shape.
    Change,
}

/// One side of a door.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
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
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
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
    /// x0, y0, x1, y1, metres: the ends of the crossing segment, or the least rectangle about the area of a change.
    pub segment: [f64; 4],
    /// Cost of passing.
    pub hardness: Derived<f64>,
    /// How to pass.
    pub action: Derived<String>,
    /// Whether it can be passed.
    pub passable: Derived<bool>,
    /// What passing takes of each [measure](crate::measure::Measures), as JSON; `None`: nothing is said.
    pub measures: Option<String>,
    /// Whether it leads from room 1 to room 2 only.
    pub one_way: bool,
}

impl Field for DoorKind {
    fn value(&self) -> Value<'_> {
        Value::Text(match self {
            Self::Door => "door",
            Self::Change => "change",
        })
    }

    fn put(&mut self, value: Value<'_>) -> bool {
        *self = match value {
            Value::Text("door") => Self::Door,
            Value::Text("change") => Self::Change,
            _ => return false,
        };
        true
    }
}

impl Row for Door {
    const TABLE: &'static str = "doors";
    const COLUMNS: &'static [Column<Self>] = &[
        column!(Key Integer "door" door),
        column!(Cut Text "kind" kind),
        column!(Cut Integer "room1" side1.room),
        column!(Cut Integer "room2" side2.room),
        column!(Cut Real "x" at[0]),
        column!(Cut Real "y" at[1]),
        column!(Cut Real "width" width),
        column!(Cut Real "x0" segment[0]),
        column!(Cut Real "y0" segment[1]),
        column!(Cut Real "x1" segment[2]),
        column!(Cut Real "y1" segment[3]),
        column!(Cut Real "height1" side1.height),
        column!(Cut Real "width1" side1.width),
        column!(Cut Real "distance1" side1.distance),
        column!(Cut Real "height2" side2.height),
        column!(Cut Real "width2" side2.width),
        column!(Cut Real "distance2" side2.distance),
        column!(Cut Truth "one_way" one_way),
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
    const NAMES: &'static [&'static str] = &names::<Self, { Door::COLUMNS.len() }>(Self::COLUMNS, 0);
    const WEIGHT_NAMES: &'static [&'static str] = &names::<Self, 11>(Self::COLUMNS, Self::COLUMNS.len() - 11);

    fn key(&self) -> i64 {
        self.door
    }

    fn numbered(door: i64) -> Self {
        Self { door, ..Self::default() }
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

/// All doors, by number.
pub async fn read(connection: &mut SqliteConnection) -> Result<Vec<Door>> {
    block::read(connection).await
}

/// The door of this number.
pub async fn one(connection: &mut SqliteConnection, number: i64) -> Result<Option<Door>> {
    Ok(select(connection, "WHERE door = ?", &[number.into()]).await?.pop())
}

/// Doors whose segment may come within a distance of a point, by number.
pub async fn near(connection: &mut SqliteConnection, [x, y]: [f64; 2], distance: f64) -> Result<Vec<Door>> {
    let around = [x + distance, x - distance, y + distance, y - distance].map(Cell::from);
    let is_near = "WHERE min(x0, x1) <= ? AND max(x0, x1) >= ? AND min(y0, y1) <= ? AND max(y0, y1) >= ?
                   ORDER BY door";
    select(connection, is_near, &around).await
}

/// Replaces all doors by these; their rooms must be there.
pub async fn replace(connection: &mut SqliteConnection, doors: &[Door]) -> Result<()> {
    in_bulk(connection, "doors", async |connection| {
        sqlx::query("DELETE FROM doors").execute(&mut *connection).await?;
        Ok(())
    })
    .await?;
    block::replace(connection, doors).await
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
