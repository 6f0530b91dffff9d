//! What rules say of a room or a door: the columns that both tables share.

use crate::reason::Derived;

/// What rules say of a room or a door, and why.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Weight {
    /// Of a room the cost of a metre, of a door that of passing it.
    pub hardness: Derived<f64>,
    /// How to move there.
    pub action: Derived<String>,
    /// Whether the room is entered, the door passed.
    pub passable: Derived<bool>,
    /// Of which [measure](crate::measure::Measures) a metre, or passing, takes how much, as JSON.
    pub measures: Option<String>,
}

impl Weight {
    /// Whether the same is said of the way, whoever says it; what it takes besides is not looked at.
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
