//! What it costs to go on the same way at other weights.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};

use adit_planners::routes::{
    Closed, DoorIndex, Entry, Goal, RoomIndex, RouteDoor, RouteGraph, RouteRoom, Start, Way,
};

use super::path::reweigh;
use super::{Path, Prober, Routes, Weights};
use crate::graph::SiteGraph;

/// The present way, as it is driven best at any weights.
pub struct SameWay {
    pub path: Path,
    corridor: Option<Corridor>,
    /// So much more than the best may it cost, as a share.
    pub tolerance: f64,
}

/// The rooms of the way and those beside them, run by run: from a run only the next one is entered.
struct Corridor {
    graph: RefCell<RouteGraph>,
    start: Start,
    goal: Goal,
    /// The site's rooms and doors, by those of the corridor.
    rooms: Vec<RoomIndex>,
    doors: Vec<DoorIndex>,
}

/// What finds a best way.
type Find = fn(&RouteGraph, &Start, &[Goal]) -> Option<(usize, Way)>;

impl SameWay {
    /// Of the best way at present.
    pub fn new(prober: &Prober, routes: &Routes, path: Path) -> Self {
        if routes.is_on_doors() {
            return Self { path, corridor: None, tolerance: 1e-9 };
        }
        let corridor = Corridor::new(prober.fork.graph(), routes, &path);
        let mut same = Self { path, corridor: Some(corridor), tolerance: 1e-6 };
        // two searches for one way may bend a hair apart
        let (own, best) = (same.cost(&prober.present), same.path.cost(&prober.present));
        if own.is_finite() && best > 0.0 {
            same.tolerance += 2.0 * (own / best - 1.0).clamp(0.0, 1e-3);
        }
        same
    }

    /// What it costs; infinite where it is not passed.
    pub fn cost(&self, weights: &Weights) -> f64 {
        match &self.corridor {
            None => self.path.cost(weights),
            Some(corridor) => corridor
                .cost(weights, RouteGraph::tightest_way)
                .unwrap_or(f64::INFINITY)
                .min(self.path.cost(weights)),
        }
    }

    /// What it costs as it is driven, off walls.
    pub fn driven_cost(&self, weights: &Weights) -> f64 {
        let driven = self.corridor.as_ref().and_then(|corridor| corridor.cost(weights, RouteGraph::way));
        driven.unwrap_or_else(|| self.cost(weights))
    }

    /// Whether no way that costs `best` is better.
    pub fn is_best(&self, cost: f64, best: f64) -> bool {
        cost.is_finite() && cost <= best + self.tolerance * best.abs().max(1e-9)
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
        Self { graph: RefCell::new(own), start, goal, rooms, doors }
    }

    /// What the way that a search finds costs.
    fn cost(&self, weights: &Weights, find: Find) -> Option<f64> {
        let mut graph = self.graph.borrow_mut();
        let own = Weights {
            rooms: self.rooms.iter().map(|&room| weights[room]).collect(),
            doors: self.doors.iter().map(|&door| weights[door]).collect(),
        };
        reweigh(&mut graph, &own);
        find(&graph, &self.start, std::slice::from_ref(&self.goal)).map(|(_, way)| way.cost)
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
