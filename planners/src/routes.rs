//! Routes of least total hardness over rooms and doors.
//!
//! Where all hardness lies on the doors (the paper's Table 6), the search is Dijkstra's ([`Tree`]), or goes up and down a
//! hierarchy of rooms where one was [prepared](RouteGraph::prepare);
//! [petgraph](https://docs.rs/petgraph), whose algorithms can be handed the graph, is the reference that tests compare
//! with. Its `dijkstra` returns no predecessors and is slower (`cargo bench -p adit-planners --bench search` has both), so
//! the loop is our own.
//!
//! Where rooms weigh their metres, a [`Way`] is measured as it is driven: from point to point, straight where nothing
//! is in the way. The search is any-angle over the mesh of rooms, and what it finds is pulled tight.

mod berth;
mod blocked;
mod by_hierarchy;
mod closed;
mod compact;
mod cone;
mod cost;
mod gates;
mod graph;
mod hierarchy;
mod mesh;
mod on_doors;
mod parts;
mod pull;
mod rounded;
mod sequences;
mod taut;
mod trace;
mod turning;
mod visit;
mod way;

use fixedbitset::FixedBitSet;
use petgraph::visit::{Dfs, Visitable};

use crate::geometry::Point;
use crate::geometry::tolerance::ROUNDING;
use taut::{Outcome, Search, Wanted};
use trace::trace;

pub use blocked::{Blockage, Shut, blockage};
pub use compact::{CompactGraph, CompactTree};
pub use graph::{Closed, RouteGraph};
pub use on_doors::{Arrival, Tree};
pub use parts::{Berth, Crossing, DoorIndex, Entry, Goal, RoomIndex, RouteDoor, RouteRoom, Start, Walking};
pub use visit::{OpenDoor, OpenDoors};
pub use way::{Leg, Way, Ways};

/// A best way: as tight as it can be, by which it is chosen, and as far off walls as rooms ask for, where that was asked.
struct Best {
    goal: usize,
    tight: Way,
    wide: Option<Way>,
}

impl RouteGraph {
    /// The best way to the goal that costs least, with that goal's index.
    ///
    /// Where rooms weigh metres, the way is the shortest one of its kind to within the rounding of numbers between
    /// points where hardness changes or a shape is changed, and those points are the best ones near the
    /// best of points at most half a metre apart.
    ///
    /// Where all hardness lies on the doors, and ways are [prepared](Self::prepare), nothing is looked at but what lies
    /// above start and goal in the hierarchy; elsewhere [`tree`](Self::tree) finds the way. Both cost the same; where
    /// several ways do, they may give different ones.
    ///
    /// Where rooms ask for a [`Berth`], a way to a point keeps off walls, and costs more than
    /// [the tightest](Self::tightest_way) by no more than they allow.
    pub fn way(&self, start: &Start, goals: &[Goal]) -> Option<(usize, Way)> {
        let Best { goal, tight, wide } = self.way_at(start, goals, true, f64::INFINITY)?;
        Some((goal, wide.unwrap_or(tight)))
    }

    /// As [`way`](Self::way), whatever berth rooms ask for. It is by what these cost that ways are chosen.
    pub fn tightest_way(&self, start: &Start, goals: &[Goal]) -> Option<(usize, Way)> {
        self.tightest_way_within(start, goals, f64::INFINITY)
    }

    /// As [`tightest_way`](Self::tightest_way), where it costs no more than a limit; one that costs more may be found or not.
    pub fn tightest_way_within(&self, start: &Start, goals: &[Goal], limit: f64) -> Option<(usize, Way)> {
        self.way_at(start, goals, false, limit).map(|best| (best.goal, best.tight))
    }

    /// [The tightest way](Self::tightest_way) to a goal and [the way](Self::way), by one search.
    pub fn tightest_way_and_way(&self, start: &Start, goal: &Goal) -> Option<[Way; 2]> {
        let Best { tight, wide, .. } = self.way_at(start, std::slice::from_ref(goal), true, f64::INFINITY)?;
        let wide = wide.unwrap_or_else(|| tight.clone());
        Some([tight, wide])
    }

    fn way_at(&self, start: &Start, goals: &[Goal], is_wide: bool, limit: f64) -> Option<Best> {
        let as_it_is = |(goal, tight)| Best { goal, tight, wide: None };
        if let Some(hierarchy) = self.hierarchy.as_ref().filter(|_| self.is_on_doors()) {
            return self.way_by(hierarchy, start, goals).map(as_it_is);
        }
        if self.is_on_doors() {
            let all = self.ways(start, goals, false).goals.into_iter().enumerate();
            let ways = all.filter_map(|(goal, way)| Some((goal, way?)));
            return ways.min_by(|(_, one), (_, two)| one.cost.total_cmp(&two.cost)).map(as_it_is);
        }
        if let Some(cut) = self.cut_for(start) {
            return cut.way(start, goals, is_wide, limit);
        }
        let outcome = Search::find(self, start, goals, Wanted::One, limit);
        let ways = (0..goals.len())
            .filter_map(|goal| Some((goal, self.best(&outcome, start, (goal, goals[goal].at))?)));
        let (goal, tight) = ways.min_by(|(_, one), (_, two)| one.cost.total_cmp(&two.cost))?;
        let wide = is_wide.then(|| self.off_walls(tight.clone(), &goals[goal]));
        Some(Best { goal, tight, wide })
    }

    /// A way as it is driven to a goal. Nobody drives to a room as such: a way into one stays tight.
    fn off_walls(&self, tight: Way, goal: &Goal) -> Way {
        if goal.at.is_some() { self.with_berth(tight) } else { tight }
    }

    /// The best of the ways to a goal that were found, pulled tight.
    fn best(&self, outcome: &Outcome, start: &Start, (goal, at): (usize, Option<Point>)) -> Option<Way> {
        let found = &outcome.goals[goal];
        let pulled = |found, instead| trace(self, &outcome.nodes, (start, at), found, instead);
        let mut ways: Vec<Way> = found.iter().map(|found| pulled(found, None)).collect();
        let cost = |way: &usize| ways[*way].cost;
        let first = (0..ways.len()).min_by(|one, two| cost(one).total_cmp(&cost(two)))?;
        let others = outcome.otherwise(self, &found[first]).into_iter();
        ways.extend(others.map(|instead| pulled(&found[first], Some(instead))));
        ways.into_iter().reduce(|best, way| {
            // of ways that cost the same to a rounding, the one that passes fewer doors
            let rounding = ROUNDING * best.cost;
            let is_better = way.cost < best.cost - rounding
                || way.cost <= best.cost + rounding && way.legs.len() < best.legs.len();
            if is_better { way } else { best }
        })
    }

    /// The best ways to all goals; and to all rooms, where asked for.
    pub fn ways(&self, start: &Start, goals: &[Goal], rooms: bool) -> Ways {
        if self.is_on_doors() {
            return self.tree(start).ways(self, start, goals, rooms);
        }
        if let Some(cut) = self.cut_for(start) {
            return cut.ways(start, goals, rooms);
        }
        let wanted = if rooms { Wanted::Rooms } else { Wanted::Goals };
        let outcome = Search::find(self, start, goals, wanted, f64::INFINITY);
        let way = |found: &Vec<taut::Found>| {
            let ways = found.iter().map(|found| trace(self, &outcome.nodes, (start, None), found, None));
            ways.min_by(|one, other| one.cost.total_cmp(&other.cost))
        };
        let to = |goal: usize| {
            let best = self.best(&outcome, start, (goal, goals[goal].at));
            best.map(|way| self.off_walls(way, &goals[goal]))
        };
        Ways { goals: (0..goals.len()).map(to).collect(), rooms: outcome.rooms.iter().map(way).collect() }
    }

    /// The rooms that open doors join with one of these.
    fn joined_with(&self, rooms: &[Entry]) -> FixedBitSet {
        let rooms = rooms.iter().map(|entry| entry.room).filter(|&room| self.is_entered(room)).collect();
        let mut search = Dfs::from_parts(rooms, self.visit_map());
        while search.next(self).is_some() {}
        search.discovered
    }
}
