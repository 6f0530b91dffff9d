//! What subscribers hear.

use serde::Serialize;
use utoipa::ToSchema;

use crate::answer::Answer;
use crate::error::problem::Problem;

/// Something that happened, as it goes over the stream: its name, and its data as JSON.
#[derive(Clone, Debug)]
pub struct Event {
    /// hello, changed, routes, problems or route.
    pub name: &'static str,
    pub data: String,
    /// What is said, where it is that something changed.
    pub changed: Option<Changed>,
}

impl Event {
    pub fn new(name: &'static str, data: &impl Serialize) -> Self {
        Self { name, data: serde_json::to_string(data).unwrap_or_default(), changed: None }
    }

    pub fn changed(changed: &Changed) -> Self {
        Self { changed: Some(changed.clone()), ..Self::new("changed", changed) }
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
    /// Whether a route may be another one than before: something was touched that routes follow from.
    pub ways: bool,
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

/// `route`: the best route of whoever follows one, first and whenever it is another one.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub struct Followed {
    /// Names the follower, so that it can say where it now is: `POST /api/route/follow/{follower}`.
    pub follower: String,
    /// What became of the route, and why, for people.
    pub words: String,
    /// What the route cost before; null: there was none, or this is the first word.
    pub cost_before: Option<f64>,
    /// What was done since the route of before, the newest last; what nobody heard in time is left out.
    pub changes: Vec<Changed>,
    /// What `/api/route` answers.
    pub route: Answer,
}

/// `problems`: what is wrong with files that were saved; the site goes on with those of before. Empty: mended.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub struct Problems {
    /// Each with its place.
    pub problems: Vec<Problem>,
}
