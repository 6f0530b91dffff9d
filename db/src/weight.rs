//! What rules say of a room or a door: the columns that both tables share.

use sqlx::SqliteConnection;

use crate::bulk::{self, Record, Values};
use crate::error::Result;
use crate::reason::Derived;
use crate::stale::in_bulk;
use crate::transaction::Tx;

/// What rules say of a room or a door, and why.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Weight {
    /// Of a room the cost of a metre, of a door that of passing it.
    pub hardness: Derived<f64>,
    /// How to move there.
    pub action: Derived<String>,
    /// Whether the room is entered, the door passed.
    pub passable: Derived<bool>,
}

impl Weight {
    /// Whether the same is said, whoever says it.
    pub fn is_same(&self, other: &Self) -> bool {
        self.hardness.value == other.hardness.value
            && self.action.value == other.action.value
            && self.passable.value == other.passable.value
    }

    /// The witnesses on which it rests.
    pub fn witnesses(&self) -> [Option<i64>; 3] {
        [self.hardness.witness, self.action.witness, self.passable.witness]
    }

    /// The columns that it has in either table, behind the number of the room or door.
    fn bind(&self, values: &mut Values) {
        values.real(self.hardness.value);
        self.hardness.bind_reason(values);
        values.text(self.action.value.as_deref());
        self.action.bind_reason(values);
        values.truth(self.passable.value);
        self.passable.bind_reason(values);
    }
}

struct OfRoom<'w>(i64, &'w Weight);

struct OfDoor<'w>(i64, &'w Weight);

impl Record for OfRoom<'_> {
    const TABLE: &'static str = "rooms";
    const COLUMNS: &'static [&'static str] = &[
        "room",
        "hardness",
        "hardness_rule",
        "hardness_witness",
        "action",
        "action_rule",
        "action_witness",
        "passable",
        "passable_rule",
        "passable_witness",
    ];

    fn bind(&self, values: &mut Values) {
        values.integer(self.0);
        self.1.bind(values);
    }
}

impl Record for OfDoor<'_> {
    const TABLE: &'static str = "doors";
    const COLUMNS: &'static [&'static str] = &[
        "door",
        "hardness",
        "hardness_rule",
        "hardness_witness",
        "action",
        "action_rule",
        "action_witness",
        "passable",
        "passable_rule",
        "passable_witness",
    ];

    fn bind(&self, values: &mut Values) {
        values.integer(self.0);
        self.1.bind(values);
    }
}

async fn put<R: Record>(
    connection: &mut SqliteConnection,
    weights: impl IntoIterator<Item = R>,
) -> Result<u64> {
    let mut weights = weights.into_iter().peekable();
    if weights.peek().is_none() {
        return Ok(0);
    }
    in_bulk(connection, R::TABLE, async |connection| bulk::update::<1, _>(connection, weights).await).await
}

impl Tx<'_> {
    /// Gives these rooms, by number, other weights; how many.
    pub fn put_room_weights<'w>(
        &mut self,
        weights: impl IntoIterator<Item = (i64, &'w Weight)>,
    ) -> Result<u64> {
        let weights = weights.into_iter().map(|(room, weight)| OfRoom(room, weight));
        self.run(async |connection| put(connection, weights).await)
    }

    /// Gives these doors, by number, other weights; how many.
    pub fn put_door_weights<'w>(
        &mut self,
        weights: impl IntoIterator<Item = (i64, &'w Weight)>,
    ) -> Result<u64> {
        let weights = weights.into_iter().map(|(door, weight)| OfDoor(door, weight));
        self.run(async |connection| put(connection, weights).await)
    }
}
