//! Routes between places, from each place to all others, as far as there is time to find them.

use std::collections::BTreeMap;
use std::sync::Mutex;

use adit_planners::routes::{CompactGraph, CompactTree, Goal, RoomIndex};
use rayon::prelude::*;

use crate::graph::gauge::Gauge;
use crate::graph::itinerary::Itinerary;
use crate::graph::{End, SiteGraph};

/// A robot and a place, by index: where routes start.
pub type From = (usize, usize);

/// Routes from one start, by place; `None` where there is none.
pub type Row = Vec<Option<Found>>;

/// Costs of the routes between places, by robot, start and goal.
pub type PlaceCosts = BTreeMap<(String, String, String), f64>;

/// A route between two places.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Found {
    /// Its cost.
    pub cost: f64,
    /// A number that is equal for ways that people do not tell apart ([`Itinerary`]).
    pub told: u64,
}

/// Routes that were found of one state of a site, kept for the next question.
#[derive(Default)]
pub struct Known(Mutex<BTreeMap<From, Row>>);

impl Known {
    /// The routes from these starts; those not known yet are found while it goes on.
    pub fn rows(
        &self,
        (graph, gauge): (&SiteGraph, &Gauge),
        robots: &[String],
        wanted: &[From],
        goes_on: impl Fn() -> bool,
    ) -> BTreeMap<From, Row> {
        let mut known = self.0.lock().map(|known| known.clone()).unwrap_or_default();
        let missing: Vec<From> = wanted.iter().filter(|from| !known.contains_key(from)).copied().collect();
        let found = rows((graph, gauge), robots, &missing, goes_on);
        if let Ok(mut kept) = self.0.lock() {
            kept.extend(found.iter().map(|(from, row)| (*from, row.clone())));
        }
        known.extend(found);
        known
    }
}

/// Each place, for each robot.
pub fn starts(graph: &SiteGraph, robots: &[String]) -> Vec<From> {
    let places = graph.places.len();
    (0..robots.len()).flat_map(|robot| (0..places).map(move |place| (robot, place))).collect()
}

/// What these routes cost, by the names of robots and places; those that there are.
pub fn costs(graph: &SiteGraph, robots: &[String], rows: &BTreeMap<From, Row>) -> PlaceCosts {
    let name = |place: usize| graph.places[place].place.clone();
    let costs = rows.iter().flat_map(|(&(robot, start), row)| {
        row.iter().enumerate().filter_map(move |(goal, found)| {
            Some(((robots[robot].clone(), name(start), name(goal)), found.as_ref()?.cost))
        })
    });
    costs.collect()
}

/// The routes from these starts to all places; the first ones where it is broken off.
///
/// # Arguments
/// `goes_on` is asked before the routes of a few starts are found side by side.
pub fn rows(
    (graph, gauge): (&SiteGraph, &Gauge),
    robots: &[String],
    wanted: &[From],
    goes_on: impl Fn() -> bool,
) -> BTreeMap<From, Row> {
    let compact = CompactGraph::new(graph.graph());
    let mut found = BTreeMap::new();
    for batch in wanted.chunks(rayon::current_num_threads().max(1) * 2) {
        if !goes_on() {
            break;
        }
        let rows: Vec<Row> = batch
            .par_iter()
            .map(|&(robot, place)| row((graph, gauge), compact.as_ref(), &robots[robot], place))
            .collect();
        found.extend(batch.iter().copied().zip(rows));
    }
    found
}

fn row(
    (graph, gauge): (&SiteGraph, &Gauge),
    compact: Option<&CompactGraph>,
    robot: &str,
    place: usize,
) -> Row {
    let gauge = Some(gauge);
    let start = graph.start(gauge, &End::Place(place), Some(robot));
    let goals: Vec<Goal> =
        (0..graph.places.len()).map(|goal| graph.goal(gauge, &End::Place(goal), Some(robot))).collect();
    if let Some(compact) = compact {
        let tree = compact.tree(&start);
        let best = |goal: &Goal| {
            let reached =
                goal.rooms.iter().map(|entry| entry.room).filter(|&room| tree.cost(room).is_finite());
            reached.min_by(|&one, &two| tree.cost(one).total_cmp(&tree.cost(two)))
        };
        return goals.iter().map(|goal| best(goal).map(|room| of_tree(graph, &tree, room))).collect();
    }
    let ways = graph.graph().ways(&start, &goals, false).goals;
    let of_way = |way: adit_planners::routes::Way| {
        let itinerary = way.legs.iter().fold(Itinerary::default(), |way, leg| {
            way.through(graph, leg.room, leg.length() > 0.0, leg.door)
        });
        Found { cost: way.cost, told: itinerary.told() }
    };
    ways.into_iter().map(|way| way.map(of_way)).collect()
}

fn of_tree(graph: &SiteGraph, tree: &CompactTree, room: RoomIndex) -> Found {
    let (mut passed, mut at) = (Vec::new(), room);
    while let Some((before, door)) = tree.before(at) {
        passed.push((before, door));
        at = before;
    }
    let steps = passed.into_iter().rev();
    let itinerary =
        steps.fold(Itinerary::default(), |way, (room, door)| way.through(graph, room, true, Some(door)));
    Found { cost: tree.cost(room), told: itinerary.told() }
}
