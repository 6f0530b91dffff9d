//! The way to the goal that costs least, as a hierarchy finds it.

use super::Hierarchy;
use crate::routes::{Goal, RouteGraph, Start, Way};

/// A way that was found: where it begins and ends, and its doors, each with the room behind it.
struct Found {
    start: usize,
    goal: usize,
    doors: Vec<(u32, u32)>,
    cost: f64,
}

impl RouteGraph {
    /// The best way to the goal that costs least; of several the first goal's, from the first room, in their order.
    pub(in crate::routes) fn way_by(
        &self,
        hierarchy: &Hierarchy,
        start: &Start,
        goals: &[Goal],
    ) -> Option<(usize, Way)> {
        let mut best: Option<Found> = None;
        for (goal, to) in
            goals.iter().enumerate().flat_map(|(index, goal)| goal.rooms.iter().map(move |to| (index, *to)))
        {
            for &from in start.rooms.iter().filter(|&&room| self.is_entered(room)) {
                let Some(doors) = hierarchy.doors(from, to) else { continue };
                // as it is driven, so that it is the sum that a search from door to door finds
                let cost = doors.iter().fold(0.0, |cost, (door, _)| {
                    cost + self.passage(*door as usize).unwrap_or(f64::INFINITY)
                });
                if best.as_ref().is_none_or(|best| cost < best.cost) {
                    best = Some(Found { start: from, goal, doors, cost });
                }
            }
        }
        let Found { start: room, goal, doors, .. } = best?;
        let at = |door: u32| self.doors()[door as usize].at;
        let end = goals[goal].at.unwrap_or_else(|| doors.last().map_or(start.at, |(door, _)| at(*door)));
        let doors = doors.into_iter().map(|(door, room)| (door as usize, at(door), room as usize));
        Some((goal, Way::through(self, (room, start.at), doors, end)))
    }
}
