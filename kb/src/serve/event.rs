//! What subscribers hear.

use serde::Serialize;
use utoipa::ToSchema;

use crate::error::problem::Problem;

/// Something that happened, as it goes over the stream: its name, and its data as JSON.
#[derive(Clone, Debug)]
pub struct Event {
    /// hello, changed, routes or problems.
    pub name: &'static str,
    pub data: String,
}

impl Event {
    pub fn new(name: &'static str, data: &impl Serialize) -> Self {
        Self { name, data: serde_json::to_string(data).unwrap_or_default() }
    }
}

/// `hello`: where the knowledge base stands when the stream begins.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub struct Hello {
    /// Number of the knowledge base's state.
    pub generation: u64,
    /// Names the cut of the floor.
    pub layout: String,
}

/// `changed`: an edit, a fact, a rule file, the clock, or another program changed what is known.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub struct Changed {
    /// Number of the knowledge base's state from now on.
    pub generation: u64,
    /// Names the cut of the floor.
    pub layout: String,
    pub who: String,
    pub why: String,
    /// What was done, in a few words.
    pub what: String,
    /// Rooms with another hardness, action or passability.
    pub rooms: usize,
    /// Doors with another hardness, action or passability.
    pub doors: usize,
    /// Whether all was derived anew.
    pub anew: bool,
    /// When, in UTC.
    pub at: String,
}

/// `routes`: routes between places that cost more or less than before.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub struct Rerouted {
    /// The state that they rest on.
    pub generation: u64,
    /// How many routes between places there are.
    pub total: usize,
    /// Those that changed, the ones whose cost changed most first.
    pub changed: Vec<RouteCost>,
    /// Whether there are more than are named.
    pub truncated: bool,
}

/// What a route between two places cost before, and costs now.
#[derive(Clone, Debug, PartialEq, Serialize, ToSchema)]
pub struct RouteCost {
    pub robot: String,
    pub start: String,
    pub goal: String,
    /// Hardness of before; null: there was no route.
    pub old: Option<f64>,
    /// Hardness of now; null: there is no route.
    pub new: Option<f64>,
}

/// `problems`: what is wrong with files that were saved; the site goes on with those of before. Empty: mended.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub struct Problems {
    /// Each with its place.
    pub problems: Vec<Problem>,
}
