//! How firm a route is: for each hardness in the tables, how far it may go up or down before another way is the best.
//!
//! The best way stays the same while no other one costs less; what *the same way* is, [`same_way`](super::contrast::same_way)
//! says. Another one that costs the same, to 1e-9 of the cost where all hardness lies on the doors and to 1e-6 elsewhere, does not
//! end it.

mod beyond;

use serde::Serialize;

use crate::answer;
use crate::error::{Code, Error, Result};
use crate::live::Live;
use crate::state::State;
use crate::state::tunable::{Lever, Side, least};
use crate::why::contrast::same_way::SameWay;
use crate::why::contrast::{Choice, Found, Routes, Turn};
use crate::why::probe::Prober;
pub use beyond::Beyond;

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
    /// Whether the ends are exact: but for rounding where all hardness lies on the doors, to a thousandth elsewhere; otherwise they
    /// were found by trying values.
    pub exact: bool,
    /// What takes over below.
    pub below: Option<Beyond>,
    /// What takes over above.
    pub above: Option<Beyond>,
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
        let Some(best) = Choice::among(&routes, prober.fork.graph().graph()) else { return Ok(firm) };
        let Some(path) = routes.best(&prober.present, f64::INFINITY) else { return Ok(firm) };
        firm.cost = Some(best.driven.cost);
        let same = SameWay::new(&prober, &routes, path);
        let effects = prober.effects()?;
        let mut turn = Turn::new(&mut prober, &same);
        let never = turn.without_end_below(&effects, None);
        let weighing: Vec<_> = effects.iter().zip(never).filter(|(effect, _)| effect.weighs).collect();
        let above = weighing.iter().map(|(effect, _)| (&***effect, Side::Above));
        let below = weighing.iter().filter(|(_, never)| !never).map(|(effect, _)| (&***effect, Side::Below));
        let mut ends = turn.ends(&above.chain(below).collect::<Vec<_>>(), None)?;
        let mut below = ends.split_off(weighing.len()).into_iter();
        let mut found = Vec::new();
        for ((effect, never), above) in weighing.into_iter().zip(ends) {
            let below = if never { None } else { below.next() }.unwrap_or_else(Found::nothing);
            firm.truncated |= !below.is_whole || !above.is_whole;
            found.push((&effect.lever, [below, above]));
        }
        for (lever, sides) in found {
            prober.fork.go_on()?;
            firm.cells.push(FirmCell::new(&mut prober, &same, lever, sides)?);
        }
        firm.cells.sort_by_key(|cell| cell.below.is_none() && cell.above.is_none());
        Ok(firm)
    }

    /// What a name means; an error that names it where it means nothing.
    pub(crate) fn end(&self, name: &str) -> Result<crate::graph::End> {
        self.graph().end(name).ok_or_else(|| {
            let (message, help) = self.graph().no_end(name);
            Error::said(Code::RouteUnknown, message, help)
        })
    }
}

impl FirmCell {
    /// What was found on both sides of a cell.
    pub(super) fn new(
        prober: &mut Prober,
        same: &SameWay,
        lever: &Lever,
        [low, high]: [Found; 2],
    ) -> Result<Self> {
        let mut said = |found: &Found, side: Side| {
            found.end.as_ref().map(|end| Beyond::new(prober, same, lever, (end, side))).transpose()
        };
        let (below, above) = (said(&low, Side::Below)?, said(&high, Side::Above)?);
        prober.restore(lever)?;
        Ok(Self {
            table: lever.class.to_lowercase(),
            key: lever.key.clone(),
            column: lever.column.clone(),
            value: lever.value,
            exact: low.is_exact && high.is_exact,
            low_closed: low.end.as_ref().is_none_or(|end| end.is_closed),
            high_closed: high.end.as_ref().is_some_and(|end| end.is_closed),
            low: Some(low.end.map_or(least(lever), |end| end.at)),
            high: high.end.map(|end| end.at),
            below,
            above,
        })
    }
}
