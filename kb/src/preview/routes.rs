//! Routes between places, before and after.

use adit_db::place::Place;
use serde::Serialize;

use crate::graph::SiteGraph;
use crate::graph::gauge::Gauge;
use crate::graph::pairs::{self, Found, From, Known};
use crate::state::Courses;

/// How many rooms, doors or routes are listed.
pub(super) const LISTED: usize = 5_000;

/// How the routes between places would change.
#[derive(Clone, Debug, Default, PartialEq, Serialize, utoipa::ToSchema)]
pub struct PlaceRoutes {
    /// How many pairs of places there are, for all robots.
    pub total: usize,
    /// How many of them were looked at.
    pub compared: usize,
    /// Whether the time was over before all were looked at.
    pub truncated: bool,
    /// Those with another cost or another way; where rooms are cut anew, those whose cost is another by more than a thousandth.
    pub changed: usize,
    /// Those that lead another way; none is known where rooms are cut anew.
    pub rerouted: usize,
    /// Those that cost more.
    pub longer: usize,
    /// Those that cost less.
    pub shorter: usize,
    /// Those that are no more.
    pub lost: usize,
    /// Those that were not before.
    pub found: usize,
    /// Those that changed, the ones whose cost changes most first; at most 5,000.
    pub list: Vec<PlaceRoute>,
}

/// A route between two places.
#[derive(Clone, Debug, PartialEq, Serialize, utoipa::ToSchema)]
pub struct PlaceRoute {
    /// Whose.
    pub robot: String,
    /// From where.
    pub start: String,
    /// Where to.
    pub goal: String,
    /// Its cost; `null`: there is none.
    pub old: Option<f64>,
    /// What it would cost; `null`: there would be none.
    pub new: Option<f64>,
    /// Whether it would lead through another doorway or space, or be in another state there; `null` where rooms are cut anew.
    pub other_way: Option<bool>,
}

impl PlaceRoutes {
    /// All stay as they are.
    pub(super) fn none(robots: usize, places: usize) -> Self {
        let total = robots * places * places.saturating_sub(1);
        Self { total, compared: total, ..Self::default() }
    }
}

/// Compares the routes from each place to all others that there are afterwards. Those of before are looked up where they are
/// known. `is_time` says whether there is time left; of 2, whether half of it is.
pub(super) fn compare(
    (before, known): ((&SiteGraph, &Gauge), &Known),
    after: (&SiteGraph, &Gauge),
    robots: &[String],
    is_anew: bool,
    is_time: &dyn Fn(u32) -> bool,
) -> PlaceRoutes {
    let mut all = PlaceRoutes { compared: 0, ..PlaceRoutes::none(robots.len(), after.0.places.len()) };
    let wanted = pairs::starts(before.0, robots);
    let old = known.rows(before, robots, &wanted, || is_time(2));
    // which of the places of before, in the order of their names, each one is
    let known_as = |place: &Place| {
        let found = before.0.places.binary_search_by(|old| old.place.cmp(&place.place)).ok();
        found.filter(|at| before.0.places[*at] == *place)
    };
    let was: Vec<Option<usize>> = after.0.places.iter().map(known_as).collect();
    let is_ready = |&(robot, start): &From| was[start].is_none_or(|start| old.contains_key(&(robot, start)));
    let wanted: Vec<From> = pairs::starts(after.0, robots).into_iter().filter(is_ready).collect();
    let new = pairs::rows(after, robots, &wanted, || is_time(1));
    for ((robot, start), row) in &new {
        for (goal, new) in row.iter().enumerate().filter(|(goal, _)| goal != start) {
            let of_before = was[*start].zip(was[goal]);
            let old = of_before.and_then(|(start, goal)| *old.get(&(*robot, start))?.get(goal)?);
            all.compared += 1;
            if let Some(other_way) = all.note(old, *new, is_anew) {
                let name = |place: usize| after.0.places[place].place.clone();
                all.list.push(PlaceRoute {
                    robot: robots[*robot].clone(),
                    start: name(*start),
                    goal: name(goal),
                    old: old.map(|found| found.cost),
                    new: new.map(|found| found.cost),
                    other_way: (!is_anew).then_some(other_way),
                });
            }
        }
    }
    all.truncated = all.compared < all.total;
    let by = |route: &PlaceRoute| match (route.old, route.new) {
        (Some(old), Some(new)) => (new - old).abs(),
        _ => f64::INFINITY,
    };
    all.list.sort_by(|one, two| by(two).total_cmp(&by(one)));
    all.list.truncate(LISTED);
    all
}

/// Compares the routes over a map that is not cut into rooms.
pub(super) fn between(before: &Courses, after: &Courses) -> PlaceRoutes {
    let total = after.kept().len();
    let mut all = PlaceRoutes { total, compared: total, ..PlaceRoutes::default() };
    for route in after.changed(before) {
        all.changed += 1;
        all.rerouted += usize::from(route.is_rerouted());
        match (route.old, route.new) {
            (Some(_), None) => all.lost += 1,
            (None, Some(_)) => all.found += 1,
            (Some(old), Some(new)) if new > old => all.longer += 1,
            (Some(old), Some(new)) if new < old => all.shorter += 1,
            _ => {}
        }
        all.list.push(PlaceRoute {
            robot: route.robot,
            start: route.start,
            goal: route.goal,
            old: route.old,
            new: route.new,
            other_way: Some(route.other_way),
        });
    }
    all
}

impl PlaceRoutes {
    /// Counts a route; whether it leads another way, where it changed.
    fn note(&mut self, old: Option<Found>, new: Option<Found>, is_anew: bool) -> Option<bool> {
        let is_same = match (old, new) {
            (None, None) => true,
            // another cut moves crossing points by a hair
            (Some(old), Some(new)) if is_anew => (old.cost - new.cost).abs() <= 1e-3 * old.cost,
            // where it is slid to is found to a rounding
            (Some(old), Some(new)) => old.told == new.told && (old.cost - new.cost).abs() <= 1e-6 * old.cost,
            _ => false,
        };
        if is_same {
            return None;
        }
        self.changed += 1;
        match (old, new) {
            (Some(_), None) => self.lost += 1,
            (None, _) => self.found += 1,
            (Some(old), Some(new)) if new.cost > old.cost => self.longer += 1,
            (Some(old), Some(new)) if new.cost < old.cost => self.shorter += 1,
            _ => {}
        }
        let other_way = old.map(|found| found.told) != new.map(|found| found.told);
        let is_rerouted = other_way && !is_anew && old.is_some() && new.is_some();
        self.rerouted += usize::from(is_rerouted);
        Some(other_way)
    }
}
