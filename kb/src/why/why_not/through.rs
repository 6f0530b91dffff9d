//! The best way through a room or a door: a search in two copies of the graph, one for what lies before it and one for
//! what comes after. Who is in the second copy has passed it.

use adit_planners::routes::{Goal, Leg, RouteDoor, RouteGraph, Start, Way};

use crate::error::Result;
use crate::graph::SiteGraph;
use crate::state::State;
use crate::why::firm::{self, Path, Routes, Weights};

/// What a way is asked to lead through, by index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Via {
    Room(usize),
    Door(usize),
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
    /// Rooms and doors of the site.
    rooms: usize,
    /// Of each door of the two copies the site's, by index.
    doors: Vec<usize>,
    /// The doors by which a way is through.
    entries: Vec<bool>,
    routes: Routes,
}

impl<'g> Question<'g> {
    pub(super) fn new(fork: &'g State, start: &str, goal: &str, robot: &str) -> Result<Self> {
        let (start, goal) = (fork.end(start)?, fork.end(goal)?);
        let graph = fork.graph();
        Ok(Self { graph, start: graph.start(&start, Some(robot)), goal: graph.goal(&goal, Some(robot)) })
    }

    pub(super) fn best(&self) -> Option<Way> {
        let goals = std::slice::from_ref(&self.goal);
        self.graph.graph().way(&self.start, goals).map(|(_, way)| way)
    }

    /// Whether the goal is a point, so that something is walked in the last room.
    pub(super) fn is_to_point(&self) -> bool {
        self.goal.at.is_some()
    }

    /// The best way through a room or a door, and what finds it at other weights.
    pub(super) fn passing(&self, via: Via) -> (Option<Way>, Passing) {
        let graph = self.graph.graph();
        let count = graph.rooms().len();
        let is_entry = |door: &RouteDoor, index: usize| match via {
            Via::Room(room) => door.room1 == room || door.room2 == room,
            Via::Door(door) => door == index,
        };
        let (mut copies, mut doors) = (Vec::new(), Vec::new());
        let mut add = |index: usize, copy: RouteDoor| {
            copies.push(copy);
            doors.push(index);
        };
        for (index, door) in graph.doors().iter().enumerate() {
            let (room1, room2) = (door.room1, door.room2);
            if is_entry(door, index) {
                let leads_in = |to: usize| matches!(via, Via::Door(_)) || via == Via::Room(to);
                if leads_in(room2) {
                    add(index, RouteDoor { room2: room2 + count, one_way: true, ..*door });
                }
                if !door.one_way && leads_in(room1) {
                    add(index, RouteDoor { room1: room2, room2: room1 + count, one_way: true, ..*door });
                }
            } else {
                add(index, *door);
            }
            add(index, RouteDoor { room1: room1 + count, room2: room2 + count, ..*door });
        }
        let rooms = graph.rooms().iter().chain(graph.rooms()).copied().collect();
        let mut both = RouteGraph::new(rooms, copies);
        both.close(graph.closed().to_vec());
        let begin = |&room: &usize| if via == Via::Room(room) { room + count } else { room };
        let start = Start { rooms: self.start.rooms.iter().map(begin).collect(), at: self.start.at };
        let goal = Goal { rooms: self.goal.rooms.iter().map(|room| room + count).collect(), ..self.goal };
        let way = both.way(&start, std::slice::from_ref(&goal)).map(|(_, way)| {
            let leg =
                |leg: &Leg| Leg { room: leg.room % count, door: leg.door.map(|door| doors[door]), ..*leg };
            Way { legs: way.legs.iter().map(leg).collect(), cost: way.cost }
        });
        let entries = graph.doors().iter().enumerate().map(|(index, door)| is_entry(door, index)).collect();
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
            doors: self.doors.iter().map(|&door| weights.doors[door]).collect(),
        };
        let path = self.routes.best(&twice)?;
        Some(Path {
            metres: path.metres.into_iter().map(|(room, metres)| (room % self.rooms, metres)).collect(),
            doors: path.doors.into_iter().map(|door| self.doors[door]).collect(),
        })
    }

    fn holds(&self, path: &Path) -> bool {
        let is_in = |&(room, _): &(usize, f64)| self.via == Via::Room(room);
        path.metres.iter().any(is_in) || path.doors.iter().any(|&door| self.entries[door])
    }
}
