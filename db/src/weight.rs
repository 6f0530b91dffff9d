//! What rules say of a room or a door: the columns that both tables share.

use crate::block;
use crate::error::Result;
use crate::reason::Derived;
use crate::schema::Row;
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
}

impl Tx<'_> {
    /// Gives these rooms or doors, by number, other weights; how many.
    pub fn put_weights<'w, R: Row>(
        &mut self,
        weights: impl IntoIterator<Item = (i64, &'w Weight)>,
    ) -> Result<u64> {
        let row = |(key, weight): (i64, &Weight)| {
            let mut row = R::numbered(key);
            row.weigh(weight.clone());
            row
        };
        let rows = weights.into_iter().map(row).collect();
        self.run(async |connection| block::reweigh::<R>(connection, rows).await)
    }

    /// Writes the blocks of the rooms or doors that there are, where they have none.
    pub fn restore_blocks<R: Row>(&mut self, rows: &[R]) -> Result<()> {
        self.run(async |connection| block::restore(connection, rows).await)
    }
}
