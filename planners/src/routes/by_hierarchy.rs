//! The way to the goal that costs least, as a hierarchy finds it.

use super::graph::RouteGraph;
use super::hierarchy::{Hierarchy, Passed};
use super::parts::{Goal, RoomIndex, Start};
use super::way::{Leg, Way};
use crate::geometry::Point;

struct Found {
    start: RoomIndex,
    goal: usize,
    doors: Vec<Passed>,
    cost: f64,
}

impl RouteGraph {
    /// The best way to the goal that costs least; of several the first goal's, from the first room, in their order.
    pub(super) fn way_by(
        &self,
        hierarchy: &Hierarchy,
        start: &Start,
        goals: &[Goal],
    ) -> Option<(usize, Way)> {
        let mut best: Option<Found> = None;
        for (index, goal) in goals.iter().enumerate() {
            for to in goal.rooms.iter().map(|entry| entry.room) {
                for from in start.rooms.iter().map(|entry| entry.room).filter(|&room| self.is_entered(room)) {
                    let Some(doors) = hierarchy.doors(from, to) else { continue };
                    // as it is driven, so that it is the sum that a search from door to door finds
                    let cost = doors.iter().fold(0.0, |cost, passed| cost + passed.weight);
                    if best.as_ref().is_none_or(|best| cost < best.cost) {
                        best = Some(Found { start: from, goal: index, doors, cost });
                    }
                }
            }
        }
        let found = best?;
        Some((found.goal, self.driven(start, &found, goals[found.goal].at)))
    }

    fn driven(&self, start: &Start, found: &Found, goal: Option<Point>) -> Way {
        let mut legs = Vec::with_capacity(found.doors.len() + 1);
        let (mut room, mut from, mut cost) = (found.start, start.at, 0.0);
        for passed in &found.doors {
            let to = self[passed.door].at;
            cost += passed.weight;
            legs.push(Leg { room, from, to, hardness: 0.0, door: Some(passed.door), cost });
            (room, from) = (passed.room, to);
        }
        legs.push(Leg { room, from, to: goal.unwrap_or(from), hardness: 0.0, door: None, cost });
        Way { legs, cost }
    }
}
