//! The least-cost ways from one start where all hardness lies on the doors.

use super::compact::search;
use super::graph::RouteGraph;
use super::parts::{DoorIndex, Goal, RoomIndex, Start};
use super::way::{Way, Ways};
use crate::geometry::Point;

/// The best way into a room.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arrival {
    /// The room before and the door passed; `None` where the search began.
    pub from: Option<(RoomIndex, DoorIndex)>,
    pub cost: f64,
    pub hops: u32,
}

/// Least-cost ways from one start.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Tree {
    /// For each room the best arrival; `None` where it is not reached.
    pub rooms: Vec<Option<Arrival>>,
}

impl RouteGraph {
    /// The least cost of every room from the start, with the door that it is entered by; what walking in a room weighs
    /// is not looked at.
    ///
    /// Equal costs: the room, then the door, of lower number. O((rooms + doors) log rooms).
    pub fn tree(&self, start: &Start) -> Tree {
        let starts = start.rooms.iter().map(|entry| entry.room).filter(|&room| self.is_entered(room));
        let leaving = |room: RoomIndex| self.exits(room).map(|exit| (exit.to, exit.door));
        let weight = |door: DoorIndex| self.passage(door).unwrap_or(f64::INFINITY);
        let found = search(self.rooms().len(), starts, leaving, weight, |door| self[door].door);
        let arrival = |room: RoomIndex| {
            let (cost, hops) = (found.cost(room), found.hops(room));
            cost.is_finite().then(|| Arrival { from: found.before(room), cost, hops })
        };
        Tree { rooms: self.room_indices().map(arrival).collect() }
    }
}

impl Tree {
    /// The ways to goals, and to all rooms where asked for: from door to door.
    pub(super) fn ways(&self, graph: &RouteGraph, start: &Start, goals: &[Goal], rooms: bool) -> Ways {
        let goals = goals.iter().map(|goal| {
            let reached =
                goal.rooms.iter().filter_map(|entry| Some((entry.room, self.rooms[entry.room.index()]?)));
            let best = reached.min_by(|(_, one), (_, two)| one.cost.total_cmp(&two.cost));
            best.map(|(room, _)| self.way(graph, start, room, goal.at))
        });
        let way = |room: RoomIndex| self.rooms[room.index()].map(|_| self.way(graph, start, room, None));
        let count = if rooms { self.rooms.len() } else { 0 };
        Ways { goals: goals.collect(), rooms: graph.room_indices().take(count).map(way).collect() }
    }

    fn way(&self, graph: &RouteGraph, start: &Start, to: RoomIndex, goal: Option<Point>) -> Way {
        let (mut room, mut doors) = (to, Vec::new());
        while let Some((before, door)) = self.rooms[room.index()].and_then(|arrival| arrival.from) {
            doors.push((Some(door), graph[door].at, room));
            room = before;
        }
        doors.reverse();
        let end = goal.unwrap_or_else(|| doors.last().map_or(start.at, |(_, at, _)| *at));
        Way::through(graph, (room, start.at), doors, end)
    }
}
