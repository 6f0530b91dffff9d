//! Ways that keep out of some rooms and doors: those of a state, or those that are passed by an action.

use adit_planners::routes::{DoorIndex, Goal, RoomIndex, RouteGraph, Start, Walking};

use super::others::Choice;
use super::{Path, Routes, Ways};
use crate::state::tunable::Weights;

/// Ways that keep out of some rooms and doors.
pub struct Without {
    routes: Routes,
    rooms: Vec<RoomIndex>,
    doors: Vec<DoorIndex>,
}

impl Without {
    /// With the best one as everything weighs now; `None` where there is none.
    pub fn new(
        graph: &RouteGraph,
        (start, goal): (&Start, &Goal),
        (rooms, doors): (Vec<RoomIndex>, Vec<DoorIndex>),
    ) -> (Self, Option<Choice>) {
        let mut graph = graph.clone();
        graph.reweigh(
            rooms.iter().map(|&room| (room, Walking::Unknown)),
            doors.iter().map(|&door| (door, None, false)),
        );
        let routes = Routes::between(&graph, start.clone(), goal.clone());
        let choice = Choice::among(&routes, &graph);
        (Self { routes, rooms, doors }, choice)
    }
}

impl Ways for Without {
    fn best(&self, weights: &Weights, limit: f64) -> Option<Path> {
        let mut weights = weights.clone();
        for room in &self.rooms {
            weights.rooms[room.index()] = Walking::Unknown;
        }
        for door in &self.doors {
            weights.doors[door.index()] = f64::INFINITY;
        }
        self.routes.best(&weights, limit)
    }

    fn holds(&self, path: &Path) -> Option<bool> {
        let is_kept_out = !path.metres.iter().any(|(room, _)| self.rooms.contains(room))
            && !path.doors.iter().any(|door| self.doors.contains(door));
        Some(is_kept_out)
    }
}
