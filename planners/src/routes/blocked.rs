//! Why there is no route: the fewest doors that would have to open.

use std::collections::VecDeque;

use super::closed::NO_DOOR;
use super::graph::RouteGraph;
use super::parts::{DoorIndex, Goal, RoomIndex, Start};

/// What stands between a start and a goal that no route joins.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Blockage {
    /// These, in order, would have to let a state through; fewer do not suffice.
    Shut(Vec<Shut>),
    /// No chain of doors joins them at all, passable or not.
    Apart,
}

/// What lets nobody through.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shut {
    /// A door, by its key.
    Door(u32),
    /// A [closed](RouteGraph::closed) boundary, by index.
    Closed(usize),
    /// A room that is not entered.
    Room(RoomIndex),
}

/// The fewest doors that would have to be passable to reach the goal. O(rooms + doors).
pub fn blockage(graph: &RouteGraph, start: &Start, goal: &Goal) -> Blockage {
    match graph.cut() {
        Some(cut) => {
            let (start, goal) = cut.ends(start, goal);
            let of = |door: DoorIndex| match cut.doors[door.index()] {
                Some(door) => Shut::Door(graph[door].door),
                None if cut.graph[door].door == NO_DOOR => {
                    Shut::Room(cut.rooms[cut.graph[door].room1.index()])
                }
                None => Shut::Closed(cut.graph[door].door as usize),
            };
            shut_between(&cut.graph, (&start, &goal), of)
        }
        None => shut_between(graph, (start, goal), |door| Shut::Door(graph[door].door)),
    }
}

fn shut_between(
    graph: &RouteGraph,
    (start, goal): (&Start, &Goal),
    of: impl Fn(DoorIndex) -> Shut,
) -> Blockage {
    let mut leaving: Vec<Vec<(RoomIndex, DoorIndex)>> = vec![Vec::new(); graph.rooms.len()];
    for (index, door) in graph.door_indices().zip(&graph.doors) {
        leaving[door.room1.index()].push((door.room2, index));
        if !door.one_way {
            leaving[door.room2.index()].push((door.room1, index));
        }
    }
    // 0-1 breadth-first search: an open door costs nothing, a shut one costs one
    let mut least: Vec<Option<usize>> = vec![None; graph.rooms.len()];
    let mut from: Vec<Option<(RoomIndex, DoorIndex)>> = vec![None; graph.rooms.len()];
    let mut queue: VecDeque<(RoomIndex, usize)> = start.rooms.iter().map(|entry| (entry.room, 0)).collect();
    for entry in &start.rooms {
        least[entry.room.index()] = Some(0);
    }
    while let Some((room, shut)) = queue.pop_front() {
        if least[room.index()].is_some_and(|known| known < shut) {
            continue;
        }
        for &(next, door) in &leaving[room.index()] {
            let open = graph.is_open(door);
            let total = shut + usize::from(!open);
            if least[next.index()].is_none_or(|known| total < known) {
                least[next.index()] = Some(total);
                from[next.index()] = Some((room, door));
                if open {
                    queue.push_front((next, total));
                } else {
                    queue.push_back((next, total));
                }
            }
        }
    }
    let reached = goal.rooms.iter().filter_map(|goal| Some((least[goal.room.index()]?, goal.room)));
    let nearest = reached.min();
    let Some((_, mut room)) = nearest else { return Blockage::Apart };
    let mut doors = Vec::new();
    while let Some((before, door)) = from[room.index()] {
        if !graph.is_open(door) {
            doors.push(of(door));
        }
        room = before;
    }
    doors.reverse();
    Blockage::Shut(doors)
}
