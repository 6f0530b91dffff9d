//! The best way through something: rooms or doors, or by a point.
//!
//! Through rooms or doors it is found by a search in two copies of the graph, one for what lies before them and one for what
//! comes after: who is in the second copy has passed them. By a point it is the best way to it and the best way on from there.

use std::collections::BTreeSet;
use std::ops::Range;

use adit_planners::geometry::Point;
use adit_planners::routes::{
    Closed, DoorIndex, Entry, Goal, Leg, RoomIndex, RouteDoor, RouteGraph, Start, Way,
};

use super::{Choice, Path, Routes, Ways};
use crate::state::tunable::Weights;

/// What a way is asked to lead through.
#[derive(Clone, Debug, PartialEq)]
pub enum Via {
    /// Any of these rooms.
    Rooms(BTreeSet<RoomIndex>),
    /// Any of these doors.
    Doors(BTreeSet<DoorIndex>),
    /// A point, in any of these rooms or from where a leg joins them.
    Point(Point, Vec<Entry>),
}

/// Ways through something.
pub struct Through {
    via: Via,
    found: Found,
}

enum Found {
    InCopies(Copies),
    ByPoint(Halves),
}

/// Ways to a point and on from there.
struct Halves {
    routes: Routes,
    at: Point,
    /// The rooms in which a robot may be there.
    entries: Vec<Entry>,
}

struct Copies {
    routes: Routes,
    /// How many rooms the site has.
    rooms: usize,
    /// Of each door of the two copies the site's.
    doors: Vec<DoorIndex>,
    /// The doors by which a way is through.
    entries: Vec<bool>,
}

/// A way keeps to a point that it passes this near, metres.
const AT_M: f64 = 1e-6;

/// A way is in a room, or on a door, to such a length, metres.
const THERE_M: f64 = 1e-3;

impl Through {
    /// With the best one as everything weighs now; `None` where there is none.
    pub fn new(graph: &RouteGraph, (start, goal): (&Start, &Goal), via: Via) -> (Self, Option<Choice>) {
        let Via::Point(at, entries) = &via else {
            let (copies, choice) = Copies::new(graph, (start, goal), &via);
            return (Self { via, found: Found::InCopies(copies) }, choice);
        };
        let routes = Routes::between(graph, start.clone(), goal.clone());
        let halves = Halves { routes, at: *at, entries: entries.clone() };
        let there = halves.best(&Weights::of(graph), f64::INFINITY).map(|(entry, _)| entry);
        let choice = there.and_then(|there| {
            let (to, on) = halves.ends(&[there]);
            Some(Choice::of(graph, start, &to)?.then(&Choice::of(graph, &on, goal)?))
        });
        (Self { via, found: Found::ByPoint(halves) }, choice)
    }

    /// Whether a way leads there as it is driven: farther off walls it may turn back before.
    pub fn holds_way(&self, graph: &RouteGraph, way: &Way) -> bool {
        // about a corner a disc comes nearer to it than its middle's space does
        let is_at = |nearest: Point, leg: &Leg| {
            let about = graph[leg.room].radius.unwrap_or(0.0) + THERE_M;
            graph.is_on_doors() || nearest.distance(leg.to) <= about
        };
        way.legs.iter().any(|leg| match &self.via {
            Via::Point(at, _) => at.nearest_on(leg.from, leg.to).distance(*at) <= AT_M,
            Via::Rooms(rooms) => {
                rooms.contains(&leg.room) && is_at(graph[leg.room].outline.nearest_to(leg.to), leg)
            }
            Via::Doors(doors) => leg.door.is_some_and(|door| {
                doors.contains(&door) && is_at(graph[door].crossing.nearest_to(leg.to), leg)
            }),
        })
    }
}

impl Ways for Through {
    fn best(&self, weights: &Weights, limit: f64) -> Option<Path> {
        match &self.found {
            Found::InCopies(copies) => copies.best(weights, limit),
            Found::ByPoint(halves) => halves.best(weights, limit).map(|(_, path)| path),
        }
    }

    fn holds(&self, path: &Path) -> Option<bool> {
        match (&self.via, &self.found) {
            (Via::Rooms(rooms), _) if path.metres.iter().any(|(room, _)| rooms.contains(room)) => Some(true),
            (_, Found::InCopies(copies)) => Some(path.doors.iter().any(|door| copies.entries[door.index()])),
            // where exactly a way leads is not in it
            (_, Found::ByPoint(_)) => None,
        }
    }
}

impl Halves {
    /// The point as where a way leads and as where one begins, in some rooms.
    fn ends(&self, entries: &[Entry]) -> (Goal, Start) {
        (Goal { rooms: entries.to_vec(), at: Some(self.at) }, Start { rooms: entries.to_vec(), at: self.at })
    }

    fn to(&self, weights: &Weights, entries: &[Entry], limit: f64) -> Option<(Path, f64)> {
        let path = self.routes.best_between(weights, (&self.routes.start, &self.ends(entries).0), limit)?;
        let cost = path.cost(weights);
        Some((path, cost))
    }

    fn on(&self, weights: &Weights, entries: &[Entry], limit: f64) -> Option<(Path, f64)> {
        let path = self.routes.best_between(weights, (&self.ends(entries).1, &self.routes.goal), limit)?;
        let cost = path.cost(weights);
        Some((path, cost))
    }

    /// The best way by the point, with the room in which a robot is there.
    fn best(&self, weights: &Weights, limit: f64) -> Option<(Entry, Path)> {
        // in whatever room each half ends costs no more than in one of both
        let (to, least_to) = self.to(weights, &self.entries, limit)?;
        let (on, least_on) = self.on(weights, &self.entries, limit - least_to)?;
        let likely = [to.metres.last(), on.metres.first()].map(|end| end.map(|(room, _)| *room));
        let mut entries = self.entries.clone();
        entries.sort_by_key(|entry| likely.iter().position(|room| *room == Some(entry.room)).unwrap_or(2));
        let (mut best, mut least) = (None, limit);
        for entry in entries {
            if least <= (least_to + least_on) * (1.0 + 1e-9) {
                break;
            }
            let is_likely = |of: usize| likely[of] == Some(entry.room);
            let here = [entry];
            let known = is_likely(0).then(|| (to.clone(), least_to));
            let Some((to, cost_to)) = known.or_else(|| self.to(weights, &here, least - least_on)) else {
                continue;
            };
            let known = is_likely(1).then(|| (on.clone(), least_on));
            let Some((on, cost_on)) = known.or_else(|| self.on(weights, &here, least - cost_to)) else {
                continue;
            };
            if best.is_none() || cost_to + cost_on < least {
                (best, least) = (Some((entry, to.then(on))), cost_to + cost_on);
            }
        }
        best
    }
}

impl Copies {
    fn new(graph: &RouteGraph, (start, goal): (&Start, &Goal), via: &Via) -> (Self, Option<Choice>) {
        let count = graph.rooms().len();
        let is_via = |room: RoomIndex| matches!(via, Via::Rooms(rooms) if rooms.contains(&room));
        let is_entry = |door: &RouteDoor, index: DoorIndex| match via {
            Via::Doors(doors) => doors.contains(&index),
            _ => is_via(door.room1) || is_via(door.room2),
        };
        let (mut copies, mut doors) = (Vec::new(), Vec::new());
        let mut add = |index: DoorIndex, copy: RouteDoor| {
            copies.push(copy);
            doors.push(index);
        };
        let second = |room: RoomIndex| RoomIndex::new(room.index() + count);
        for (index, door) in graph.door_indices().zip(graph.doors()) {
            let (room1, room2) = (door.room1, door.room2);
            if is_entry(door, index) {
                let leads_in = |to: RoomIndex| matches!(via, Via::Doors(_)) || is_via(to);
                if leads_in(room2) {
                    add(index, RouteDoor { room2: second(room2), one_way: true, ..door.clone() });
                }
                if !door.one_way && leads_in(room1) {
                    add(
                        index,
                        RouteDoor { room1: room2, room2: second(room1), one_way: true, ..door.clone() },
                    );
                }
            } else {
                add(index, door.clone());
            }
            add(index, RouteDoor { room1: second(room1), room2: second(room2), ..door.clone() });
        }
        let rooms = graph.rooms().iter().chain(graph.rooms()).cloned().collect();
        let mut both = RouteGraph::new(rooms, copies);
        // who has come through may go back at once
        let into_second =
            |(_, door): &(DoorIndex, &RouteDoor)| door.room1.index() < count && door.room2.index() >= count;
        let turns: Vec<DoorIndex> =
            both.door_indices().zip(both.doors()).filter(into_second).map(|(index, _)| index).collect();
        both.turn_back_at(turns);
        let twice = |rooms: &Range<usize>| [rooms.clone(), rooms.start + count..rooms.end + count];
        let of_both = |closed: &Closed| Closed {
            only: closed.only.as_ref().map(|only| only.iter().flat_map(twice).collect()),
            ..closed.clone()
        };
        both.close(graph.closed().iter().map(of_both).collect());
        let in_second = |entry: &Entry| Entry { room: second(entry.room), ..*entry };
        let begin = |entry: &Entry| if is_via(entry.room) { in_second(entry) } else { *entry };
        let start = Start { rooms: start.rooms.iter().map(begin).collect(), at: start.at };
        let goal = Goal { rooms: goal.rooms.iter().map(in_second).collect(), ..*goal };
        let entries = graph.doors().iter().zip(graph.door_indices());
        let entries = entries.map(|(door, index)| is_entry(door, index)).collect();
        let is_same = |(copy, &door): (&RouteDoor, &DoorIndex)| {
            (copy.room1.index() % count == graph[door].room1.index() && !is_entry(&graph[door], door))
                .then_some(door)
        };
        let same: Vec<_> = both.doors().iter().zip(&doors).map(is_same).collect();
        both.know_changes(graph, same.into_iter());
        let routes = Routes::between(&both, start, goal);
        let choice = Choice::among(&routes, &both);
        let all = Self { routes, rooms: count, doors, entries };
        let choice = choice.map(|choice| choice.map(|way| all.of_site(&way)));
        (all, choice)
    }

    fn of_site(&self, way: &Way) -> Way {
        let leg = |leg: &Leg| {
            let door = leg.door.map(|door| self.doors[door.index()]);
            Leg { room: self.room(leg.room), door, ..*leg }
        };
        Way { legs: way.legs.iter().map(leg).collect(), cost: way.cost }
    }

    fn room(&self, copy: RoomIndex) -> RoomIndex {
        RoomIndex::new(copy.index() % self.rooms)
    }

    fn best(&self, weights: &Weights, limit: f64) -> Option<Path> {
        let twice = Weights {
            rooms: weights.rooms.iter().chain(&weights.rooms).copied().collect(),
            doors: self.doors.iter().map(|&door| weights[door]).collect(),
        };
        let path = self.routes.best(&twice, limit)?;
        Some(path.renamed(|room| self.room(room), |door| self.doors[door.index()]))
    }
}
