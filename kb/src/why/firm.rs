//! How firm a route is: for each hardness in the tables, how far it may go up or down before another way is the best.
//!
//! The best way stays the same while no other one costs less. What *the same way* is:
//! - where all hardness lies on the doors (the paper's modes), the same doors in the same order; another way that costs
//!   the same, to 1e-9 of the cost, does not end the interval;
//! - where rooms weigh their metres, the same actions in the same order, each in the rooms in which the route does it
//!   now, or in rooms beside these, driven as is best at each value: where hardness changes, a way bends a little
//!   elsewhere with every value, and that is no other way. Another one that costs the same to 1e-6 does not end it.
//!
//! Each rule may use a number as it likes. Between the values that other rows of the same column have, the shipped rules
//! give weights that are linear in the cell; that is looked at, piece by piece. Where it holds, ends are found by
//! cutting: at the far end the best way is looked for, the cell is moved to where that way costs as much as this
//! one, and so on until no way costs less. Where it does not hold, ends are found by trying values and halving, and
//! [`FirmCell::exact`] is false.
//!
//! The search and the words for what it finds take their types from here and are called from here: a circle that stays,
//! since a lever, a path and a probe mean nothing without them.

mod cells;
mod corridor;
mod linear;
mod path;
mod probe;
mod search;
mod turn;
mod words;

use std::time::{Duration, Instant};

use serde::Serialize;

use crate::answer;
use crate::error::{Code, Error, Result};
use crate::live::Live;
use crate::state::State;
use crate::words::suggest::did_you_mean;
pub(crate) use path::{Path, Routes};
pub(crate) use probe::{Lever, Prober, Weights};
pub(crate) use turn::{Through, Turn, scale};
pub(crate) use words::{actions, instead};

/// How long is spent on one question.
const PATIENCE: Duration = Duration::from_secs(10);

/// How firm a route is.
#[derive(Clone, Debug, PartialEq, Serialize, utoipa::ToSchema)]
pub struct Firm {
    /// The state of the knowledge base that it rests on.
    pub generation: u64,
    /// Whose route.
    pub robot: String,
    /// From where.
    pub start: String,
    /// Where to.
    pub goal: String,
    /// What the route costs; `null`: there is none, and nothing to be firm.
    pub cost: Option<f64>,
    /// The cells that weigh anything, the ones that have an end first.
    pub cells: Vec<FirmCell>,
    /// Whether the time was over before all cells were looked at.
    pub truncated: bool,
}

/// How far one cell may change.
#[derive(Clone, Debug, PartialEq, Serialize, utoipa::ToSchema)]
pub struct FirmCell {
    /// Its table.
    pub table: String,
    /// Its row.
    pub key: String,
    /// Its column.
    pub column: String,
    /// What it is now, with the named tunings that are on.
    pub value: f64,
    /// Down to where the way is the best; 0 (with `below` null) where it is down to the least value that a cell may have.
    pub low: Option<f64>,
    /// Up to where; `null`: without an end.
    pub high: Option<f64>,
    /// Whether it is still the best at `low` itself.
    pub low_closed: bool,
    /// Whether it is still the best at `high` itself.
    pub high_closed: bool,
    /// Whether the ends are exact but for rounding; otherwise they were found by trying values.
    pub exact: bool,
    /// What takes over below.
    pub below: Option<Beyond>,
    /// What takes over above.
    pub above: Option<Beyond>,
}

/// What takes over beyond an end.
#[derive(Clone, Debug, PartialEq, Serialize, utoipa::ToSchema)]
pub struct Beyond {
    /// What the route costs at the end; `null` where it has no way there.
    pub cost_at_end: Option<f64>,
    /// The other way, in words.
    pub way: String,
    /// The first room or door where it leaves the present way.
    pub route_differs_at: Option<String>,
}

impl Live {
    /// How firm the best route from `start` to `goal` is, cell by cell.
    pub fn firm(&self, start: &str, goal: &str, robot: Option<&str>) -> Result<Firm> {
        self.fork().firm(start, goal, robot)
    }
}

impl State {
    /// As [`Live::firm`], of the state that was forked; the site is not held up meanwhile.
    pub fn firm(self, start: &str, goal: &str, robot: Option<&str>) -> Result<Firm> {
        self.site.site().needs_rooms()?;
        let robot = answer::pick(&self.robots(), robot)?;
        let routes = Routes::new(&self, start, goal, &robot)?;
        let mut prober = Prober::new(self);
        let mut firm = Firm {
            generation: prober.fork.generation,
            robot,
            start: start.to_owned(),
            goal: goal.to_owned(),
            cost: None,
            cells: Vec::new(),
            truncated: false,
        };
        let Some(path) = routes.best(&prober.present) else { return Ok(firm) };
        firm.cost = routes.driven_cost(&prober.present);
        let same = corridor::SameWay::new(&prober, &routes, path);
        let deadline = Instant::now() + PATIENCE;
        let levers = prober.levers()?;
        for lever in levers {
            if Instant::now() >= deadline {
                firm.truncated = true;
                break;
            }
            firm.cells.extend(search::firm_cell(&mut prober, &routes, &same, &lever, deadline)?);
        }
        firm.cells.sort_by_key(|cell| cell.below.is_none() && cell.above.is_none());
        Ok(firm)
    }

    /// What a name means; an error that names it where it means nothing.
    pub(crate) fn end(&self, name: &str) -> Result<crate::graph::End> {
        self.graph().end(name).ok_or_else(|| {
            let message = format!("`{name}` is no place, no room and no point `x,y`");
            Error::said(Code::RouteUnknown, message, did_you_mean(name, self.graph().names()))
        })
    }
}
