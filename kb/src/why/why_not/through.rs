//! The best way through a room or a door: a search in two copies of the graph, one for what lies before it and one for
//! what comes after. Who is in the second copy has passed it.

use std::ops::Range;

use adit_planners::routes::{
    Closed, DoorIndex, Entry, Goal, Leg, RoomIndex, RouteDoor, RouteGraph, Start, Way,
};

use super::contrast;
use crate::error::Result;
use crate::graph::SiteGraph;
use crate::state::State;
use crate::why::firm::{self, Path, Routes, Weights};

/// What a way is asked to lead through.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Via {
    Room(RoomIndex),
    Door(DoorIndex),
}

/// Ways from a start to a goal.
pub(super) struct Question<'g> {
    graph: &'g SiteGraph,
    start: Start,
    goal: Goal,
}

/// Ways through a room or a door.
pub(super) struct Passing {
    via: Via,
    /// How many rooms the site has.
    rooms: usize,
    /// Of each door of the two copies the site's.
    doors: Vec<DoorIndex>,
    /// The doors by which a way is through.
    entries: Vec<bool>,
    routes: Routes,
}

/// A best way: as it is chosen, and as it is driven, farther off walls.
#[derive(Clone)]
pub(super) struct Choice {
    pub tight: Way,
    pub driven: Way,
}

impl Choice {
    fn of(graph: &RouteGraph, start: &Start, goal: &Goal) -> Option<Self> {
        let goals = std::slice::from_ref(goal);
        let ((_, tight), (_, driven)) = (graph.tightest_way(start, goals)?, graph.way(start, goals)?);
        Some(Self { tight, driven })
    }

    /// What the best way and one through costs as they are driven; as they are chosen where keeping off walls costs the best
    /// one more than the whole difference.
    pub(super) fn costs(best: Option<&Self>, way: Option<&Self>) -> (Option<f64>, Option<f64>) {
        let driven = |way: &Self| way.driven.cost;
        let (Some(one), Some(other)) = (best, way) else { return (best.map(driven), way.map(driven)) };
        if contrast::is_best(one.tight.cost, other.tight.cost) {
            (Some(driven(one)), Some(driven(one)))
        } else if contrast::is_best(driven(one), driven(other)) {
            (Some(one.tight.cost), Some(other.tight.cost))
        } else {
            (Some(driven(one)), Some(driven(other)))
        }
    }
}

impl<'g> Question<'g> {
    pub(super) fn new(fork: &'g State, start: &str, goal: &str, robot: &str) -> Result<Self> {
        let (start, goal) = (fork.end(start)?, fork.end(goal)?);
        let graph = fork.graph();
        let (gauge, robot) = (Some(&*fork.gauge), Some(robot));
        let (start, goal) = (graph.start(gauge, &start, robot), graph.goal(gauge, &goal, robot));
        Ok(Self { graph, start, goal })
    }

    pub(super) fn best(&self) -> Option<Choice> {
        Choice::of(self.graph.graph(), &self.start, &self.goal)
    }

    /// Whether the goal is a point, so that something is walked in the last room.
    pub(super) fn is_to_point(&self) -> bool {
        self.goal.at.is_some()
    }

    /// The best way through a room or a door, and what finds it at other weights.
    pub(super) fn passing(&self, via: Via) -> (Option<Choice>, Passing) {
        let graph = self.graph.graph();
        let count = graph.rooms().len();
        let is_entry = |door: &RouteDoor, index: DoorIndex| match via {
            Via::Room(room) => door.room1 == room || door.room2 == room,
            Via::Door(door) => door == index,
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
                let leads_in = |to: RoomIndex| matches!(via, Via::Door(_)) || via == Via::Room(to);
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
        let begin = |entry: &Entry| if via == Via::Room(entry.room) { in_second(entry) } else { *entry };
        let start = Start { rooms: self.start.rooms.iter().map(begin).collect(), at: self.start.at };
        let goal = Goal { rooms: self.goal.rooms.iter().map(in_second).collect(), ..self.goal };
        let of_site = |way: Way| {
            let leg = |leg: &Leg| {
                let door = leg.door.map(|door| doors[door.index()]);
                Leg { room: RoomIndex::new(leg.room.index() % count), door, ..*leg }
            };
            Way { legs: way.legs.iter().map(leg).collect(), cost: way.cost }
        };
        let way = Choice::of(&both, &start, &goal);
        let way = way.map(|way| Choice { tight: of_site(way.tight), driven: of_site(way.driven) });
        let entries = graph.doors().iter().zip(graph.door_indices());
        let entries = entries.map(|(door, index)| is_entry(door, index)).collect();
        let routes = Routes::between(&both, start, goal);
        (way, Passing { via, rooms: count, doors, entries, routes })
    }
}

impl Passing {
    pub(super) fn holds_way(&self, way: &Way) -> bool {
        firm::Through::holds(self, &Path::of(way))
    }
}

impl firm::Through for Passing {
    fn best(&self, weights: &Weights) -> Option<Path> {
        let twice = Weights {
            rooms: weights.rooms.iter().chain(&weights.rooms).copied().collect(),
            doors: self.doors.iter().map(|&door| weights[door]).collect(),
        };
        let path = self.routes.best(&twice)?;
        let of_site = |room: RoomIndex| RoomIndex::new(room.index() % self.rooms);
        Some(Path {
            metres: path.metres.into_iter().map(|(room, metres)| (of_site(room), metres)).collect(),
            doors: path.doors.into_iter().map(|door| self.doors[door.index()]).collect(),
        })
    }

    fn holds(&self, path: &Path) -> bool {
        let is_in = |&(room, _): &(RoomIndex, f64)| self.via == Via::Room(room);
        path.metres.iter().any(is_in) || path.doors.iter().any(|door| self.entries[door.index()])
    }
}
