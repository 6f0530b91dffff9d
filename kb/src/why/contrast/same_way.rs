//! The present way at other weights, driven as is best there: the ways that hold where it is asked how firm a route is.
//!
//! What *the same way* is:
//! - where all hardness lies on the doors (the paper's modes), the same doors in the same order;
//! - where rooms weigh their metres, the same actions in the same order, each in the rooms in which the route does it now, or
//!   in rooms beside these: where hardness changes, a way bends a little elsewhere with every value, and that is no other way.

use std::collections::{BTreeMap, BTreeSet};

use adit_planners::routes::{
    Closed, DoorIndex, Entry, Goal, RoomIndex, RouteDoor, RouteGraph, RouteRoom, Start,
};

use super::{Contrast, Look, Path, Prober, Routes, Weights};
use crate::graph::SiteGraph;

/// The present way, as it is driven best at any weights, beside all ways.
pub struct SameWay<'r> {
    pub path: Path,
    all: &'r Routes,
    corridor: Option<Corridor>,
    /// So much more than the best may it cost, as a share.
    tolerance: f64,
}

/// The rooms of the way and those beside them, run by run: from a run only the next one is entered.
struct Corridor {
    routes: Routes,
    runs: Vec<BTreeSet<RoomIndex>>,
    /// The site's rooms and doors, by those of the corridor.
    rooms: Vec<RoomIndex>,
    doors: Vec<DoorIndex>,
}

impl<'r> SameWay<'r> {
    /// Of the best way at present.
    pub fn new(prober: &Prober, all: &'r Routes, path: Path) -> Self {
        let mut same = Self { path, all, corridor: None, tolerance: all.rounding() };
        if all.is_on_doors() {
            return same;
        }
        same.corridor = Some(Corridor::new(prober.fork.graph(), all, &same.path));
        // two searches for one way may bend a hair apart
        let own = same.best(&prober.present).map_or(f64::INFINITY, |(_, cost)| cost);
        let best = same.path.cost(&prober.present);
        if own.is_finite() && best > 0.0 {
            same.tolerance += 2.0 * (own / best - 1.0).clamp(0.0, 1e-3);
        }
        same
    }

    /// As it is driven best at some weights; `None` where it is not passed.
    fn best(&self, weights: &Weights) -> Option<(Path, f64)> {
        let as_now = (self.path.clone(), self.path.cost(weights));
        let bent = self.corridor.as_ref().and_then(|corridor| corridor.best(weights));
        let (path, cost) = match bent {
            Some(bent) if bent.1 < as_now.1 => bent,
            _ => as_now,
        };
        cost.is_finite().then_some((path, cost))
    }

    /// What it costs as it is driven, off walls.
    pub fn driven_cost(&self, weights: &Weights) -> Option<f64> {
        let corridor = self.corridor.as_ref();
        let driven = corridor.and_then(|corridor| corridor.routes.driven_cost(&corridor.weights(weights)));
        driven.or_else(|| self.best(weights).map(|(_, cost)| cost))
    }

    /// Whether a way is this one, driven a little otherwise at most.
    fn is_this(&self, path: &Path) -> bool {
        match &self.corridor {
            None => self.path.doors == path.doors,
            Some(corridor) => corridor.holds(path),
        }
    }
}

impl Contrast for SameWay<'_> {
    fn look(&self, weights: &Weights) -> Option<Look> {
        let Some((best, cost)) = self.rival(weights) else {
            return Some(Look { own: None, rival: None, is_turned: true });
        };
        if self.is_this(&best) {
            let best = Some((best, cost));
            return Some(Look { own: best.clone(), rival: best, is_turned: false });
        }
        let own = self.best(weights);
        // what is found is driven, though this way may cost less: it is turned unless both cost the same
        let is_turned =
            own.as_ref().is_none_or(|(_, own)| (*own - cost).abs() > self.tolerance * cost.abs().max(1e-9));
        Some(Look { own, rival: Some((best, cost)), is_turned })
    }

    fn rival(&self, weights: &Weights) -> Option<(Path, f64)> {
        let path = self.all.best(weights)?;
        let cost = path.cost(weights);
        Some((path, cost))
    }

    fn is_turned(&self, own: f64, rival: f64) -> bool {
        own > rival + self.tolerance * rival.abs().max(1e-9)
    }

    fn hair(&self) -> f64 {
        self.all.hair()
    }
}
/// What tells runs apart: the layer, its facing and the action.
type Kind<'g> = (Option<&'g (String, String)>, Option<f64>, Option<&'g str>);

fn kind(graph: &SiteGraph, room: RoomIndex) -> Kind<'_> {
    let room = &graph[room];
    (room.layer.as_ref(), room.facing, room.action.value.as_deref())
}

impl Corridor {
    fn new(graph: &SiteGraph, routes: &Routes, path: &Path) -> Self {
        let beside = beside(graph, path);
        let mut runs: Vec<BTreeSet<RoomIndex>> = Vec::new();
        let mut last = None;
        for &(room, _) in &path.metres {
            if last.is_none_or(|last| kind(graph, last) != kind(graph, room)) {
                runs.push(BTreeSet::new());
            }
            last = Some(room);
            if let Some(run) = runs.last_mut() {
                run.insert(room);
                run.extend(beside.get(&room).into_iter().flatten());
            }
        }
        let mut index = BTreeMap::new();
        let mut rooms = Vec::new();
        for (run, members) in runs.iter().enumerate() {
            for &room in members {
                index.insert((run, room), RoomIndex::new(rooms.len()));
                rooms.push(room);
            }
        }
        let (mut doors, mut copies) = (Vec::new(), Vec::new());
        for (door, of) in graph.graph().door_indices().zip(graph.graph().doors()) {
            let mut join = |from: RoomIndex, to: RoomIndex, one_way: bool| {
                copies.push(RouteDoor {
                    door: copies.len() as u32 + 1,
                    room1: from,
                    room2: to,
                    one_way,
                    ..of.clone()
                });
                doors.push(door);
            };
            let is_within = kind(graph, of.room1) == kind(graph, of.room2);
            for run in 0..runs.len() {
                let at = |run: usize, room: RoomIndex| index.get(&(run, room)).copied();
                if is_within && !of.is_change() {
                    if let (Some(from), Some(to)) = (at(run, of.room1), at(run, of.room2)) {
                        join(from, to, of.one_way);
                    }
                    continue;
                }
                if let (Some(from), Some(to)) = (at(run, of.room1), at(run + 1, of.room2)) {
                    join(from, to, true);
                }
                if let (false, Some(from), Some(to)) = (of.one_way, at(run, of.room2), at(run + 1, of.room1))
                {
                    join(from, to, true);
                }
            }
        }
        let copied: Vec<RouteRoom> = rooms.iter().map(|&room| graph.graph()[room].clone()).collect();
        let of_run = |run: usize, wanted: &[Entry]| -> Vec<Entry> {
            let own = |entry: &Entry| Some(Entry { room: *index.get(&(run, entry.room))?, ..*entry });
            wanted.iter().filter_map(own).collect()
        };
        let start = Start { rooms: of_run(0, &routes.start.rooms), at: routes.start.at };
        let goal =
            Goal { rooms: of_run(runs.len().saturating_sub(1), &routes.goal.rooms), at: routes.goal.at };
        let mut own = RouteGraph::new(copied, copies);
        let own_rooms = |closed: &Closed| {
            let held = rooms.iter().enumerate().filter(|(_, room)| closed.holds_for(**room));
            held.map(|(own, _)| own..own + 1).collect()
        };
        let of_copies = |closed: &Closed| Closed {
            only: closed.only.as_ref().map(|_| own_rooms(closed)),
            ..closed.clone()
        };
        own.close(graph.graph().closed().iter().map(of_copies).collect());
        Self { routes: Routes::between(&own, start, goal), runs, rooms, doors }
    }

    fn weights(&self, of_site: &Weights) -> Weights {
        Weights {
            rooms: self.rooms.iter().map(|&room| of_site[room]).collect(),
            doors: self.doors.iter().map(|&door| of_site[door]).collect(),
        }
    }

    /// The best way in it, as one of the site, and what it costs.
    fn best(&self, weights: &Weights) -> Option<(Path, f64)> {
        let path = self.routes.best(&self.weights(weights))?;
        let path = path.renamed(|room| self.rooms[room.index()], |door| self.doors[door.index()]);
        let cost = path.cost(weights);
        Some((path, cost))
    }

    /// Whether a way leads through its runs, one after the other.
    fn holds(&self, path: &Path) -> bool {
        let mut run = 0;
        let is_in = |run: usize, room: RoomIndex| self.runs.get(run).is_some_and(|run| run.contains(&room));
        path.metres.iter().all(|&(room, _)| {
            run += usize::from(!is_in(run, room));
            is_in(run, room)
        }) && run + 1 == self.runs.len()
    }
}

/// For each room of a way the ones of its kind behind a door of it.
fn beside(graph: &SiteGraph, path: &Path) -> BTreeMap<RoomIndex, Vec<RoomIndex>> {
    let own: BTreeSet<RoomIndex> = path.metres.iter().map(|(room, _)| *room).collect();
    let mut beside: BTreeMap<RoomIndex, Vec<RoomIndex>> = BTreeMap::new();
    for door in graph.graph().doors().iter().filter(|door| !door.is_change()) {
        for (room, other) in [(door.room1, door.room2), (door.room2, door.room1)] {
            if own.contains(&room) && kind(graph, room) == kind(graph, other) {
                beside.entry(room).or_default().push(other);
            }
        }
    }
    beside
}
