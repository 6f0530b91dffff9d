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

use super::{Choice, Path, Routes, Ways, Weights};

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
    ByPoint(Vec<[Routes; 2]>),
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

impl Through {
    /// With the best one as everything weighs now; `None` where there is none.
    pub fn new(graph: &RouteGraph, (start, goal): (&Start, &Goal), via: Via) -> (Self, Option<Choice>) {
        let Via::Point(at, entries) = &via else {
            let (copies, choice) = Copies::new(graph, (start, goal), &via);
            return (Self { via, found: Found::InCopies(copies) }, choice);
        };
        let halves = |entry: &Entry| {
            let here = vec![*entry];
            let to = Goal { rooms: here.clone(), at: Some(*at) };
            [(start.clone(), to), (Start { rooms: here, at: *at }, goal.clone())]
        };
        let halves: Vec<_> = entries.iter().map(halves).collect();
        let both = |[(start, at), (on, goal)]: &[(Start, Goal); 2]| {
            Some(Choice::of(graph, start, at)?.then(&Choice::of(graph, on, goal)?))
        };
        let choices = halves.iter().filter_map(both);
        let choice = choices.min_by(|one, two| one.tight.cost.total_cmp(&two.tight.cost));
        let routes =
            halves.into_iter().map(|half| half.map(|(start, goal)| Routes::between(graph, start, goal)));
        (Self { via, found: Found::ByPoint(routes.collect()) }, choice)
    }

    pub fn holds_way(&self, way: &Way) -> bool {
        match &self.via {
            Via::Point(at, _) => {
                way.legs.iter().any(|leg| at.nearest_on(leg.from, leg.to).distance(*at) <= AT_M)
            }
            _ => self.holds(&Path::of(way)) == Some(true),
        }
    }
}

impl Ways for Through {
    fn best(&self, weights: &Weights) -> Option<Path> {
        match &self.found {
            Found::InCopies(copies) => copies.best(weights),
            Found::ByPoint(halves) => {
                let mut best: Option<(Path, f64)> = None;
                for [to, on] in halves {
                    let least = best.as_ref().map_or(f64::INFINITY, |(_, cost)| *cost);
                    let Some(to) = to.best(weights).filter(|to| to.cost(weights) < least) else { continue };
                    let Some(both) = on.best(weights).map(|on| to.then(on)) else { continue };
                    let cost = both.cost(weights);
                    if cost < least {
                        best = Some((both, cost));
                    }
                }
                best.map(|(path, _)| path)
            }
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
        let choice = Choice::of(&both, &start, &goal);
        let all = Self { routes: Routes::between(&both, start, goal), rooms: count, doors, entries };
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

    fn best(&self, weights: &Weights) -> Option<Path> {
        let twice = Weights {
            rooms: weights.rooms.iter().chain(&weights.rooms).copied().collect(),
            doors: self.doors.iter().map(|&door| weights[door]).collect(),
        };
        let path = self.routes.best(&twice)?;
        Some(path.renamed(|room| self.room(room), |door| self.doors[door.index()]))
    }
}
