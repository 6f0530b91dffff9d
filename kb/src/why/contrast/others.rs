//! All ways, beside some that speak against the best.

use adit_planners::routes::{Goal, RouteGraph, Start, Way};

use super::{Contrast, Known, Look, Path, Routes};
use crate::state::tunable::Weights;

/// Others are looked for that cost so much more than the best way at most, as a share of what it costs.
const REACH: f64 = 1.01;

/// Some of all ways.
pub trait Ways: Sync {
    /// The best of them, if it costs no more than a limit; one that costs more may be found or not.
    fn best(&self, weights: &Weights, limit: f64) -> Option<Path>;

    /// Whether a way is one of them; `None` where that is not to be seen in it.
    fn holds(&self, path: &Path) -> Option<bool>;
}

/// All ways hold, until the best of them is one of the others, or one of the others is as good.
pub struct Beside<'c> {
    all: &'c Routes,
    others: &'c dyn Ways,
}

impl<'c> Beside<'c> {
    pub fn new(all: &'c Routes, others: &'c dyn Ways) -> Self {
        Self { all, others }
    }
}

impl Contrast for Beside<'_> {
    fn look(&self, weights: &Weights) -> Option<Look> {
        let glance = self.glance(weights)?;
        if glance.is_turned || glance.rival.is_some() {
            return Some(glance);
        }
        let limit = glance.own.as_ref().map_or(f64::INFINITY, |(_, cost)| REACH * cost);
        let rival = self.rival(weights, limit);
        let least = rival.as_ref().map_or(limit, |(_, cost)| *cost);
        Some(Look { rival, least, ..glance })
    }

    fn glance(&self, weights: &Weights) -> Option<Look> {
        let own = self.all.best(weights, f64::INFINITY)?;
        let cost = own.cost(weights);
        let holds = self.others.holds(&own);
        let own = Some((own, cost));
        if holds == Some(true) {
            return Some(Look { own: own.clone(), rival: own, least: cost, is_turned: true });
        }
        // which of two ways that cost the same is found says nothing where ways are lists of doors
        if holds.is_none() || self.all.is_on_doors() {
            let limit = REACH * cost;
            let rival = self.rival(weights, limit);
            let least = rival.as_ref().map_or(limit, |(_, cost)| *cost);
            return Some(Look { own, rival, least, is_turned: self.is_turned(cost, least) });
        }
        Some(Look { own, rival: None, least: 0.0, is_turned: false })
    }

    fn look_beside(&self, weights: &Weights, Known { own, least }: &Known) -> Option<Look> {
        let cost = own.cost(weights);
        let has_not_won = |own: (Path, f64), least: f64| {
            Some(Look { own: Some(own), rival: None, least, is_turned: false })
        };
        if *least > 0.0 {
            if cost.is_finite() && !self.is_turned(cost, *least) {
                return has_not_won(((*own).clone(), cost), *least);
            }
            let best = self.all.best(weights, f64::INFINITY)?;
            let cost = best.cost(weights);
            // what the others cost at least is not exact to the last digit
            return if self.is_turned(cost, *least) || self.others.holds(&best) == Some(true) {
                self.look(weights)
            } else {
                has_not_won((best, cost), *least)
            };
        }
        if !cost.is_finite() {
            return self.look(weights);
        }
        match self.rival(weights, cost).filter(|(_, rival)| self.is_turned(cost, *rival)) {
            None => has_not_won(((*own).clone(), cost), cost),
            Some(rival) => {
                let glance = self.glance(weights)?;
                let is_known = glance.is_turned || glance.rival.is_some();
                Some(if is_known { glance } else { Look { least: rival.1, rival: Some(rival), ..glance } })
            }
        }
    }

    fn rival(&self, weights: &Weights, limit: f64) -> Option<(Path, f64)> {
        let path = self.others.best(weights, limit)?;
        let cost = path.cost(weights);
        Some((path, cost))
    }

    fn is_turned(&self, own: f64, rival: f64) -> bool {
        rival <= own + self.all.rounding() * own.abs().max(1e-9)
    }

    fn hair(&self) -> f64 {
        self.all.hair()
    }
}

/// A best way: as it is chosen, and as it is driven, farther off walls.
#[derive(Clone, Debug)]
pub struct Choice {
    pub tight: Way,
    pub driven: Way,
}

impl Choice {
    pub fn of(graph: &RouteGraph, start: &Start, goal: &Goal) -> Option<Self> {
        let [tight, driven] = graph.tightest_way_and_way(start, goal)?;
        Some(Self { tight, driven })
    }

    /// The best of some ways in their graph, which they are not searched for again.
    pub fn among(routes: &Routes, graph: &RouteGraph) -> Option<Self> {
        let best = Self::of(graph, &routes.start, &routes.goal);
        routes.know(graph, best.as_ref().map(|best| &best.tight));
        best
    }

    #[must_use]
    pub fn map(self, of: impl Fn(Way) -> Way) -> Self {
        Self { tight: of(self.tight), driven: of(self.driven) }
    }

    /// It, and from its end on another one.
    #[must_use]
    pub fn then(self, on: &Self) -> Self {
        let joined = |mut way: Way, on: &Way| {
            let before = way.cost;
            way.legs.extend(
                on.legs.iter().map(|leg| adit_planners::routes::Leg { cost: leg.cost + before, ..*leg }),
            );
            way.cost += on.cost;
            way
        };
        Self { tight: joined(self.tight, &on.tight), driven: joined(self.driven, &on.driven) }
    }

    /// Whether this one is the best by what both cost close to walls, but costs no less than another one as they are driven.
    pub fn is_chosen_close_to_walls(&self, other: &Self) -> bool {
        !is_best(self.tight.cost, other.tight.cost) && is_best(self.driven.cost, other.driven.cost)
    }

    /// What the best way and another one cost as they are driven; as they are chosen where keeping off walls costs the best one
    /// more than the whole difference.
    pub fn costs(best: Option<&Self>, other: Option<&Self>) -> (Option<f64>, Option<f64>) {
        let driven = |way: &Self| way.driven.cost;
        let (Some(one), Some(two)) = (best, other) else { return (best.map(driven), other.map(driven)) };
        if is_best(one.tight.cost, two.tight.cost) {
            (Some(driven(one)), Some(driven(one)))
        } else if one.is_chosen_close_to_walls(two) {
            (Some(one.tight.cost), Some(two.tight.cost))
        } else {
            (Some(driven(one)), Some(driven(two)))
        }
    }
}

/// Whether a way costs what the best one does; the way through a door is measured by one point of it.
pub fn is_best(best: f64, cost: f64) -> bool {
    cost <= best * (1.0 + 1e-6)
}
